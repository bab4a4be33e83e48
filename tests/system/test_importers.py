"""Tools that judge FMUs: fmpy, the official schema, fmutool, libcosimpy."""

import subprocess
import sys
import zipfile
from pathlib import Path

import fmpy
from lxml import etree

from exo.validate import problems

from foreign.cosim import cosim


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
            "inputs": {},
            "outputs": ["plant.q"],
        }
    )
    # 3 N on M_n = 5 kg with D_n + friction for 1 s, up to the wall at 0.3 m: it has moved toward it.
    assert 0.1 < found["plant.q"][-1] < 0.3


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
            "inputs": {},
            "outputs": ["plant.p[3]", "controller.p[3]", "controller.e_nr[3]"],
        }
    )
    # 6 N on 5 kg with 20 N·s/m for 1.4 s: 0.3 m/s after 0.25 s, 0.35 m up from −0.24 m, less friction.
    assert 0.0 < found["plant.p[3]"][-1] < 0.15
    assert abs(found["controller.e_nr[3]"][-1]) < 0.02


def test_the_archive_has_the_parts_that_importers_look_for(fmu: Path) -> None:
    name = fmu.stem
    with zipfile.ZipFile(fmu) as archive:
        names = archive.namelist()
    assert "modelDescription.xml" in names
    assert f"binaries/linux64/{name}.so" in names
    assert "documentation/index.html" in names
    assert any(entry.startswith("documentation/licenses/") for entry in names)
    assert all(entry.isascii() and "\\" not in entry for entry in names)
