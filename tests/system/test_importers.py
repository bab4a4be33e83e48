"""Tools that judge FMUs: fmpy, the official schema, fmutool, libcosimpy."""

import json
import subprocess
import sys
import zipfile
from pathlib import Path
from typing import Any

import fmpy
from lxml import etree

from exo.fmu import Archive, Instance
from exo.validate import problems

#: Runs in a process of its own: libcosimpy ends it with a segmentation fault when it refuses an FMU. What it does comes
#: as JSON: step (ns) and count, instances, start values, connections, outputs to print.
COSIM = """
import json, sys
from libcosimpy.CosimExecution import CosimExecution
from libcosimpy.CosimLogging import CosimLogLevel, log_output_level
from libcosimpy.CosimObserver import CosimObserver
from libcosimpy.CosimSlave import CosimLocalSlave

job = json.loads(sys.argv[1])
log_output_level(CosimLogLevel.INFO)
execution = CosimExecution.from_step_size(step_size=job["step_ns"])
indices = {}
for name, path in job["instances"].items():
    slave = CosimLocalSlave(fmu_path=path, instance_name=name)
    indices[name] = execution.add_local_slave(local_slave=slave)
references = {
    name: {v.name.decode(): v.reference for v in execution.slave_variables(index)} for name, index in indices.items()
}
def at(key):
    name, variable = key.split(".", 1)
    return indices[name], references[name][variable]
for key, value in job["start"].items():
    (execution.real_initial_value if isinstance(value, float) else execution.integer_initial_value)(*at(key), value)
for target, source in job["connections"].items():
    execution.connect_real_variables(*at(source), *at(target))
observer = CosimObserver.create_last_value()
execution.add_observer(observer=observer)
assert execution.step(step_count=job["steps"])
found = {}
for key in job["outputs"]:
    index, reference = at(key)
    (found[key],) = observer.last_real_values(slave_index=index, variable_references=[reference])
print("found", json.dumps(found))
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


def cosim(job: dict[str, Any]) -> dict[str, float]:
    """Runs the job; any complaint of libcosimpy fails."""
    answer = subprocess.run(
        [sys.executable, "-c", COSIM, json.dumps(job)], capture_output=True, text=True, check=False, timeout=60
    )
    output = answer.stdout + answer.stderr
    assert answer.returncode == 0, output
    complaints = [line for line in output.splitlines() if "[error]" in line.lower() or "[warning]" in line.lower()]
    assert complaints == []
    return dict(json.loads(output.split("found ")[1].splitlines()[0]))


def test_libcosimpy_couples_the_testbed_without_a_complaint(fmu_dir: Path) -> None:
    found = cosim(
        {
            "step_ns": 2_000_000,
            "steps": 500,
            "instances": {
                "controller": str(fmu_dir / "TestbedController.fmu"),
                "plant": str(fmu_dir / "Testbed.fmu"),
            },
            "start": {"controller.tau_h": 3.0, "plant.tau_h": 3.0},
            "connections": {"controller.q": "plant.q", "plant.tau_a": "controller.tau_a"},
            "outputs": ["plant.q"],
        }
    )
    # 3 N on M_n = 5 kg with D_n + friction for 1 s, up to the wall at 0.3 m: it has moved toward it.
    assert 0.1 < found["plant.q"] < 0.3


def test_libcosimpy_couples_arm_controller_and_operator_without_a_complaint(fmu_dir: Path) -> None:
    three = (1, 2, 3)
    pairs = {
        "controller.q": "plant.q",
        "controller.f_h": "operator.f_h",
        "plant.tau_a": "controller.tau_a",
        "plant.f_h": "operator.f_h",
        "operator.p": "plant.p",
        "operator.dp": "plant.dp",
    }
    start = {"axis": 3, "kind": 2, "t_on": 0.1, "amplitude": 6.0}
    names = {"controller": "ArmController", "plant": "ExoskeletonArm", "operator": "HumanOperator"}
    found = cosim(
        {
            "step_ns": 1_000_000,
            "steps": 1500,
            "instances": {name: str(fmu_dir / f"{archive}.fmu") for name, archive in names.items()},
            # libcosim exchanges after each step; engaged before the first exchange the controller would see q = 0.
            "start": {f"operator.segment[1].{key}": value for key, value in start.items()}
            | {f"controller.q[{i}]": q for i, q in zip(three, (0.0, -1.48096, 1.70138), strict=True)},
            "connections": {f"{to}[{i}]": f"{origin}[{i}]" for to, origin in pairs.items() for i in three},
            "outputs": ["plant.p[3]", "controller.p[3]", "controller.e_nr[3]"],
        }
    )
    # 6 N on 5 kg with 20 N·s/m for 1.4 s: 0.3 m/s after 0.25 s, 0.35 m up from −0.24 m, less friction.
    assert 0.0 < found["plant.p[3]"] < 0.15
    assert abs(found["controller.e_nr[3]"]) < 0.02


def test_the_archive_has_the_parts_that_importers_look_for(fmu: Path) -> None:
    name = fmu.stem
    with zipfile.ZipFile(fmu) as archive:
        names = archive.namelist()
    assert "modelDescription.xml" in names
    assert f"binaries/linux64/{name}.so" in names
    assert "documentation/index.html" in names
    assert any(entry.startswith("documentation/licenses/") for entry in names)
    assert all(entry.isascii() and "\\" not in entry for entry in names)


#: What each kind of input is held at, by unit: no FMU stays at rest, none leaves its range.
HELD = {"rad": 0.2, "m": 0.01, "m/s": 0.02, "N": 3.0, "N.m": 5.0}
#: Without a segment and a hand the operator does nothing.
SET = {
    "HumanOperator": {"segment[1].axis": 3, "segment[1].kind": 2, "segment[1].t_on": 0.1, "segment[1].amplitude": 6.0}
}


def test_libcosimpy_and_fmpy_give_the_same_outputs(fmu: Path) -> None:
    steps = 200
    with Archive(fmu) as archive, Instance(archive, "one") as instance:
        T = float(archive.description.defaultExperiment.stepSize)
        units = {name: archive.variable(name).unit for name in archive.names("input")}
        start = {name: HELD[unit] for name, unit in units.items() if unit in HELD} | SET.get(fmu.stem, {})
        outputs = [name for name in archive.names("output") if archive.variable(name).type == "Real"]
        instance.setup_experiment(start_time=0.0, stop_time=steps * T)
        for name, value in start.items():
            instance.set_start(name, value)
        instance.enter_initialization_mode()
        instance.exit_initialization_mode()
        begin = instance.values(outputs)
        for k in range(steps):
            instance.do_step(k * T, T)
        through_fmpy = instance.values(outputs)
    job = {
        "step_ns": round(T * 1e9),
        "steps": steps,
        "instances": {"one": str(fmu)},
        "start": {f"one.{name}": value for name, value in start.items()},
        "connections": {},
        "outputs": [f"one.{name}" for name in outputs],
    }
    through_cosim = {key.removeprefix("one."): value for key, value in cosim(job).items()}
    assert through_fmpy != begin, "something has moved"
    # libcosim counts nanoseconds; that its instants and k·T may round apart is what the tolerance leaves room for.
    beyond = {
        name: (ours, through_cosim[name])
        for name, ours in through_fmpy.items()
        if not abs(through_cosim[name] - ours) <= 1e-12 * max(1.0, abs(ours))
    }
    assert beyond == {}
