"""The container FMUs: valid, reproducible, and step by step what the harness makes of the same FMUs.

The container steps its FMUs in order, each with the newest outputs: the harness' `zero_delay`.
"""

import subprocess
import sys
import zipfile
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from exo.errors import ExoError
from exo.fmu import Archive
from exo.master import simulate
from exo.recording import Recording
from exo.scenario import PROFILE
from exo.systems import container, system
from exo.validate import problems

from commands import full_beyond
from foreign.record import Record
from foreign.runs import by_calls, by_cosim, nanoseconds


@pytest.fixture(scope="module")
def containers(archives: Mapping[str, Archive], tmp_path_factory: Any) -> dict[str, Path]:
    """Both containers."""
    folder = tmp_path_factory.mktemp("container")
    return {
        name: container.write(system=system.load(name), archives=archives, folder=folder) for name in system.RECIPES
    }


@pytest.fixture(params=system.RECIPES)
def built(request: pytest.FixtureRequest, containers: dict[str, Path]) -> Path:
    """Each container in turn."""
    return containers[request.param]


def test_fmpy_finds_no_problems(built: Path) -> None:
    assert problems(built) == []


def test_fmutool_finds_nothing(built: Path) -> None:
    answer = subprocess.run(
        [sys.executable, "-m", "fmu_manipulation_toolbox.cli.fmutool", "-input", built, "-check"],
        capture_output=True,
        text=True,
        check=False,
    )
    assert answer.returncode == 0, answer.stdout + answer.stderr


def test_two_builds_give_the_same_bytes(built: Path, archives: Mapping[str, Archive]) -> None:
    assert built.read_bytes() == container.content(system=system.load(built.stem), archives=archives)


def test_the_archive_carries_the_licences_of_all_that_is_in_it_and_nothing_of_the_machine(built: Path) -> None:
    with zipfile.ZipFile(built) as files:
        names = files.namelist()
        description = files.read("modelDescription.xml").decode()
        assert "Redistribution and use" in files.read(container.LICENCE).decode()
    assert f"binaries/linux64/{built.stem}.so" in names
    for i in range(len(system.load(built.stem).components)):
        assert f"resources/{i:02}/documentation/licenses/LICENSE-MIT.txt" in names
    assert "author=" not in description
    assert "generationDateAndTime" not in description


def both(name: str, case: str, duration: float, built: Path, archives: Mapping[str, Archive]) -> list[Recording]:
    """A case of the scenario by the harness alone and with the container as its only FMU."""
    data = system.load(name)
    without_delay = dict(system.case_plans(name)[case].parameters) | {"controller.delay": 0}
    plan = replace(system.case_plans(name)[case], coupling="zero_delay", duration=duration, parameters=without_delay)
    boxed = replace(
        plan,
        components={"box": built.name},
        parameters={f"box.{key}": value for key, value in without_delay.items()},
        inputs={f"box.{key}": f"{PROFILE}.{key}" for key in data.inputs if key in plan.profiles},
    )
    with Archive(built) as archive:
        return [simulate(plan=plan, archives=archives), simulate(plan=boxed, archives={built.name: archive})]


def differences(alone: Recording, boxed: Recording) -> dict[str, float]:
    """Largest difference of each column that both have."""
    shared = [name for name in alone.columns if f"box.{name}" in boxed.columns]
    assert len(shared) > 20
    ours = {name: np.asarray(alone.columns[name], dtype=float) for name in shared}
    return {name: float(np.max(np.abs(ours[name] - boxed.columns[f"box.{name}"]))) for name in shared}


def test_the_testbed_s_container_is_the_zero_delay_loop_bit_for_bit(
    containers: dict[str, Path], archives: Mapping[str, Archive]
) -> None:
    name, case = "TestbedSystem", "wall-passive_10_0.5"
    alone, boxed = both(name, case, 8.0, containers[name], archives)
    assert np.min(alone.columns["plant.tau_e"]) < 0.0, "the wall was met"
    assert {key: d for key, d in differences(alone, boxed).items() if d != 0.0} == {}


def test_the_exoskeleton_s_container_is_the_zero_delay_loop_to_1e_12(
    containers: dict[str, Path], archives: Mapping[str, Archive]
) -> None:
    name, case = "ExoskeletonSystem", "arm_payload-passive_bounded_17.5kg"
    alone, boxed = both(name, case, 3.0, containers[name], archives)
    assert alone.columns["plant.attached"][-1], "the vacuum came through"
    # The container counts its own time; whether its instants are k·T to the last bit decides on zero.
    assert max(differences(alone, boxed).values()) <= 1e-12


#: What libcosim's log has as errors and warnings though nothing is wrong: the container's library tells how it starts.
TOLD = ("FMUContainer 'V2.0'", "Solver configure....", "Container use SEQUENTIAL mode.")


def pushed(name: str, case: str, steps: int, archive: Archive) -> Record:
    """The case's parameters in the container, and a hand that moves from the beginning on."""
    plan = system.case_plans(name)[case]
    k = np.arange(steps)
    inputs = {"tau_h": 12.0 * np.sin(4.0 * np.pi * k * plan.step), "vacuum": k % 300 > 100, "engage": k > 10}
    parameters = dict(plan.parameters) | {"controller.delay": 0}
    if "operator.segment[1].t_on" in parameters:
        parameters["operator.segment[1].t_on"] = 0.05
    return Record(
        settings={key: archive.start_value(key, value)[1] for key, value in parameters.items()},
        step=plan.step,
        time=k * plan.step,
        inputs={key: np.asarray(inputs[key], dtype=np.float64) for key in system.load(name).inputs},
    )


@pytest.mark.parametrize(
    ("name", "case"),
    [("TestbedSystem", "wall-passive_10_0.5"), ("ExoskeletonSystem", "arm_payload-passive_bounded_17.5kg")],
)
def test_libcosim_steps_a_container_as_fmpy_does_bit_for_bit(
    name: str, case: str, containers: dict[str, Path], tmp_path: Path
) -> None:
    with Archive(containers[name]) as archive:
        one = pushed(name, case, 600, archive)
        expected = by_calls(archive, one, nanoseconds)
        found = by_cosim(archive, one, tmp_path, tolerated=TOLD)
    assert {key: values.tobytes() for key, values in found.items()} == {
        key: values.tobytes() for key, values in expected.items()
    }
    assert np.ptp(found["controller.e_nr" if name == "TestbedSystem" else "controller.e_nr[3]"]) > 0.0


def test_another_exchange_order_is_seen(containers: dict[str, Path], archives: Mapping[str, Archive]) -> None:
    """Were the container's FMUs stepped with old outputs, the comparison above would say so."""
    name = "TestbedSystem"
    plan = replace(system.case_plans(name)["gain_study-K7.5"], duration=1.0, coupling="exchange_at_once")
    late = simulate(plan=plan, archives=archives)
    _, boxed = both(name, "gain_study-K7.5", 1.0, containers[name], archives)
    assert max(differences(late, boxed).values()) > 1e-6


@pytest.mark.skipif(sys.platform != "linux", reason="limits of a process")
def test_an_archive_that_does_not_fit_is_named_and_the_one_before_stays(
    archives: Mapping[str, Archive], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "TestbedSystem.fmu"
    path.write_bytes(b"as before")
    data = container.content(system=system.load("TestbedSystem"), archives=archives)  # which needs room of its own
    monkeypatch.setattr(container, "content", lambda **_: data)
    with (
        full_beyond(1000),
        pytest.raises(ExoError, match=r"System\.fmu: cannot be written: File too large; what was there before stays"),
    ):
        container.write(system=system.load("TestbedSystem"), archives=archives, folder=tmp_path)
    assert path.read_bytes() == b"as before"
    assert [one.name for one in tmp_path.iterdir()] == [path.name]
