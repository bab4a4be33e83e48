"""Tools that judge FMUs: fmpy, the official schema, fmutool, libcosimpy."""

import subprocess
import sys
import zipfile
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import fmpy
import numpy as np
import pytest
from lxml import etree

from exo.fmu import Archive
from exo.master import Plan, simulate
from exo.profile import evaluate
from exo.scenario import PROFILE, Value
from exo.systems import system
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


@pytest.mark.parametrize("steps", [3.0, 100.5, 7.001])
def test_fmpy_ends_at_the_stop_time_that_it_defines(fmu: Path, fmu_dir: Path, steps: float) -> None:
    """Whole steps, of which the third of 0.1 s ends a rounding past the stop time, and a part of one."""
    step, stop = 0.1, 0.3
    if steps != 3.0 or fmu.stem.endswith("Controller"):  # 0.1 s would be the sample of a law
        step = float(fmpy.read_model_description(str(fmu)).defaultExperiment.stepSize)
        stop = steps * step
    for path in (fmu, fmu_dir / "fmi3" / fmu.name):
        result = fmpy.simulate_fmu(str(path), stop_time=stop, output_interval=step)
        assert result["time"][-1] == pytest.approx(stop, rel=1e-15)
        assert len(result) == np.ceil(steps) + 1


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


@pytest.mark.parametrize(
    ("name", "case", "steps", "moves"),
    [
        ("TestbedSystem", "gain_study-K30", 500, "plant.q"),
        ("ExoskeletonSystem", "arm_performance-K500", 800, "plant.p[1]"),
    ],
)
def test_libcosimpy_couples_a_system_as_the_harness_does(
    name: str, case: str, steps: int, moves: str, archives: Mapping[str, Archive]
) -> None:
    one = system.case_plans(name)[case]
    plan = replace(one, coupling="exchange_at_once", duration=steps * one.step)
    run = simulate(plan=plan, archives=archives)
    forces = {key: evaluate(segments=s, time=np.arange(steps) * plan.step).tolist() for key, s in plan.profiles.items()}
    wired = {to: origin.split(".", 1) for to, origin in plan.inputs.items()}
    known = described(plan, archives)
    outputs = [key for key in run.columns if key in known]
    start = {key: number(plan, archives, key, value) for key, value in plan.parameters.items()}
    found = cosim(
        {
            "step_ns": round(plan.step * 1e9),
            "steps": steps,
            "instances": {part: str(archives[file].path) for part, file in plan.components.items()},
            "start": start,
            "connections": {to: ".".join(origin) for to, origin in wired.items() if origin[0] != PROFILE},
            "inputs": {to: forces[origin[1]] for to, origin in wired.items() if origin[0] == PROFILE},
            "outputs": outputs,
        }
    )
    beyond = {}
    for key in outputs:
        # After a step, libcosim reads the sampled outputs of its tick, and the continuous ones as they begin the next.
        sampled = known[key].variability == "discrete"
        ours = np.asarray(run.columns[key], dtype=float)[: None if sampled else steps]
        theirs = np.array(found[key], dtype=float)
        ours, theirs = (ours, theirs) if sampled else (ours[1:], theirs[: steps - 1])
        # libcosim's instants and step sizes differ from k·T and T in the last bit.
        difference = np.abs(ours - theirs) / np.maximum(1.0, np.abs(ours))
        if not np.max(difference) <= 1e-12:
            beyond[key] = float(np.max(difference))
    assert beyond == {}
    assert np.ptp(found[moves]) > 1e-3


def described(plan: Plan, archives: Mapping[str, Archive]) -> dict[str, Any]:
    """The outputs of a plan's components that are numbers, by `component.name`."""
    return {
        f"{part}.{output}": archives[file].variable(output)
        for part, file in plan.components.items()
        for output in archives[file].names("output")
    }


def number(plan: Plan, archives: Mapping[str, Archive], key: str, value: Value) -> float | int:
    """A parameter as a number, where a scenario may name it."""
    part, name = key.split(".", 1)
    return archives[plan.components[part]].start_value(name, value)[1]


def test_the_archive_has_the_parts_that_importers_look_for(fmu: Path) -> None:
    name = fmu.stem
    with zipfile.ZipFile(fmu) as archive:
        names = archive.namelist()
    assert "modelDescription.xml" in names
    assert f"binaries/linux64/{name}.so" in names
    assert "documentation/index.html" in names
    assert any(entry.startswith("documentation/licenses/") for entry in names)
    assert all(entry.isascii() and "\\" not in entry for entry in names)
