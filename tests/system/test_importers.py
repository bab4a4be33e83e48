"""Tools that judge FMUs: fmpy, the official schema, fmutool, libcosimpy."""

import subprocess
import sys
import zipfile
from pathlib import Path

import fmpy
import pytest
from lxml import etree

from exo.validate import problems

#: Runs in a process of its own: libcosimpy ends it with a segmentation fault when it refuses an FMU.
COSIM = """
import sys
from libcosimpy.CosimExecution import CosimExecution
from libcosimpy.CosimLogging import CosimLogLevel, log_output_level
from libcosimpy.CosimObserver import CosimObserver
from libcosimpy.CosimSlave import CosimLocalSlave

log_output_level(CosimLogLevel.INFO)
execution = CosimExecution.from_step_size(step_size=2_000_000)
indices = {}
for name, path in zip(("controller", "plant"), sys.argv[1:]):
    slave = CosimLocalSlave(fmu_path=path, instance_name=name)
    indices[name] = execution.add_local_slave(local_slave=slave)
references = {
    name: {v.name.decode(): v.reference for v in execution.slave_variables(index)} for name, index in indices.items()
}
execution.real_initial_value(indices["controller"], references["controller"]["tau_h"], 3.0)
execution.real_initial_value(indices["plant"], references["plant"]["tau_h"], 3.0)
execution.connect_real_variables(
    indices["plant"], references["plant"]["q"], indices["controller"], references["controller"]["q"]
)
execution.connect_real_variables(
    indices["controller"], references["controller"]["tau_a"], indices["plant"], references["plant"]["tau_a"]
)
observer = CosimObserver.create_last_value()
execution.add_observer(observer=observer)
assert execution.step(step_count=500)
(q,) = observer.last_real_values(slave_index=indices["plant"], variable_references=[references["plant"]["q"]])
print("q =", q)
"""


def test_fmpy_finds_no_problems(fmu: Path) -> None:
    assert problems(fmu) == []


def test_fmpy_s_command_says_so_too(fmu: Path) -> None:
    answer = subprocess.run(
        [sys.executable, "-m", "fmpy", "validate", fmu], capture_output=True, text=True, check=False
    )
    assert answer.returncode == 0, answer.stdout + answer.stderr
    assert "No problems found." in answer.stdout


def test_the_description_obeys_the_official_schema(fmu: Path) -> None:
    xsd = Path(fmpy.__file__).parent / "schema" / "fmi2" / "fmi2ModelDescription.xsd"
    schema = etree.XMLSchema(etree.parse(str(xsd)))
    with zipfile.ZipFile(fmu) as archive, archive.open("modelDescription.xml") as file:
        document = etree.parse(file)
    assert schema.validate(document), schema.error_log
    root = document.getroot()
    root.append(etree.Element("Unknown"))
    assert not schema.validate(document)


def test_fmutool_finds_nothing(fmu: Path) -> None:
    answer = subprocess.run(
        [sys.executable, "-m", "fmu_manipulation_toolbox.cli.fmutool", "-input", fmu, "-check"],
        capture_output=True,
        text=True,
        check=False,
    )
    output = answer.stdout + answer.stderr
    assert answer.returncode == 0, output
    assert not any(word in output for word in ("ERROR", "WARNING", "CRITICAL")), output


def cosim(*paths: Path) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, "-c", COSIM, *map(str, paths)], capture_output=True, text=True, check=False, timeout=60
    )


def test_libcosimpy_loads_couples_and_steps_without_a_complaint(fmu_dir: Path) -> None:
    answer = cosim(fmu_dir / "TestbedController.fmu", fmu_dir / "Testbed.fmu")
    output = answer.stdout + answer.stderr
    assert answer.returncode == 0, output
    complaints = [line for line in output.splitlines() if "[error]" in line.lower() or "[warning]" in line.lower()]
    assert complaints == []
    # 3 N on M_n = 5 kg with D_n + friction for 1 s, up to the wall at 0.3 m: it has moved toward it.
    assert 0.1 < float(output.split("q =")[1].split()[0]) < 0.3


@pytest.mark.parametrize("name", ["TestbedController", "Testbed"])
def test_the_archive_has_the_parts_that_importers_look_for(name: str, fmu_dir: Path) -> None:
    with zipfile.ZipFile(fmu_dir / f"{name}.fmu") as archive:
        names = archive.namelist()
    assert "modelDescription.xml" in names
    assert f"binaries/linux64/{name}.so" in names
    assert "documentation/index.html" in names
    assert any(entry.startswith("documentation/licenses/") for entry in names)
    assert all(entry.isascii() and "\\" not in entry for entry in names)
