"""The master on the built FMUs: start, wiring errors, and refusals in the loop."""

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from exo import loop, master, profile
from exo.errors import ExoError, FmuError
from exo.fmu import Archive, Instance
from exo.scenario import Segment, load


def job(**changes: Any) -> master.Plan:
    scenario = load("gain_study")
    plan = master.plan(scenario=scenario, case=scenario.cases[2])
    return replace(plan, duration=0.1, **changes)


def test_the_controller_engages_at_the_plant_s_start_position(archives: Mapping[str, Archive]) -> None:
    start = job()
    run = master.simulate(
        plan=replace(start, parameters={**start.parameters, "plant.q_start": -0.25}), archives=archives
    )
    assert run["plant.q"][0] == -0.25
    assert run["controller.q_n"][0] == -0.25
    assert run["controller.e_nr"][0] == 0.0
    # The force ramps from zero: the first torque has nothing to answer.
    assert run["controller.tau_a"][0] == 0.0


def test_wired_inputs_are_set_before_initialization_ends(
    archives: Mapping[str, Archive], monkeypatch: pytest.MonkeyPatch
) -> None:
    after: dict[str, dict[str, float]] = {}

    def looked_at(works: list[loop.Work], *_rest: Any, **_named: Any) -> None:
        for work in works:
            instance = work.part.instance
            after[instance.name] = instance.values(["q_n", "e_nr"] if work is works[0] else ["q"])

    monkeypatch.setattr(loop, "run", looked_at)
    start = job()
    master.simulate(plan=replace(start, parameters={**start.parameters, "plant.q_start": -0.25}), archives=archives)
    assert after == {"controller": {"q_n": -0.25, "e_nr": 0.0}, "plant": {"q": -0.25}}


def test_sampled_outputs_belong_to_the_tick_and_continuous_ones_to_its_instant(archives: Mapping[str, Archive]) -> None:
    run = master.simulate(plan=job(), archives=archives)
    assert run["controller.tick"].tolist() == list(range(50))
    assert run.time[49] == pytest.approx(0.098, abs=1e-15)
    # e_nr = q_n − q at the same instant; half an ulp of each of the three numbers.
    assert run["controller.q_n"] - run["plant.q"] == pytest.approx(run["controller.e_nr"], abs=1e-16)
    assert (run["controller.q"] == run["plant.q"]).all()


def test_all_parameters_are_read_back(archives: Mapping[str, Archive]) -> None:
    run = master.simulate(plan=job(), archives=archives)
    assert run.parameter("controller.law") == 2
    assert run.choice("controller.law") == "passive"
    with pytest.raises(ExoError, match=r"no enumeration parameter controller\.K"):
        run.choice("controller.K")
    assert run.parameter("plant.M") == 6.0
    assert run.parameter("plant.substep") == 8e-5
    with pytest.raises(ExoError, match=r"no parameter controller\.M .*controller\.M_n"):
        run.parameter("controller.M")


@pytest.mark.parametrize(
    ("inputs", "message"),
    [
        ({"controller.tau_hh": "profile.tau_h"}, r"TestbedController\.fmu: no variable tau_hh \(close matches: tau_h"),
        ({"controller.engage": "plant.q"}, r"Testbed\.fmu: q: expected a Boolean output, this is output of type Real"),
        ({"controller.T": "plant.q"}, "T: only inputs and tunables can be wired, this is a fixed parameter"),
        ({"plant.tau_a": "controller.tick"}, "tick: expected a Real output, this is output of type Integer"),
        ({"plant.tau_a": "controller.torque"}, r"TestbedController\.fmu: no variable torque"),
    ],
)
def test_wrong_wiring_is_named(inputs: dict[str, str], message: str, archives: Mapping[str, Archive]) -> None:
    with pytest.raises(FmuError, match=message):
        master.simulate(plan=job(inputs=inputs), archives=archives)


def test_a_source_with_a_minus_is_turned_over(archives: Mapping[str, Archive]) -> None:
    start = job()
    run = master.simulate(
        plan=replace(
            start,
            inputs={**start.inputs, "plant.tau_d": "-controller.tau_a", "plant.tau_h": "-profile.tau_h"},
            profiles={**start.profiles, "tau_h": (Segment(kind="constant", amplitude=3.0, t_on=0.01),)},
        ),
        archives=archives,
    )
    assert np.abs(run["controller.tau_a"]).max() > 0.1
    assert (run["plant.tau_a"] == run["controller.tau_a"]).all()
    assert (run["plant.tau_d"] == -run["controller.tau_a"]).all()
    assert (run["plant.tau_h"] == -run["controller.tau_h"]).all()


def test_a_refusal_in_the_loop_says_when_and_in_the_fmu_s_words(
    archives: Mapping[str, Archive], monkeypatch: pytest.MonkeyPatch
) -> None:
    def broken(*, time: np.ndarray, **_segments: Any) -> np.ndarray:
        return np.where(time > 0.0199, np.nan, 0.0)

    monkeypatch.setattr(profile, "evaluate", broken)
    with pytest.raises(FmuError, match=r"controller: fmi2SetReal returned fmi2Error: .*tau_h.*\(step at t = 0\.02 s\)"):
        master.simulate(plan=job(), archives=archives)


def test_a_profile_drives_a_boolean_input_from_a_half_on(archives: Mapping[str, Archive]) -> None:
    ramp = Segment(kind="constant", amplitude=1.0, t_on=0.02, ramp=0.04)
    start = job()
    run = master.simulate(
        plan=replace(
            start,
            inputs={**start.inputs, "controller.engage": "profile.engage"},
            profiles={**start.profiles, "engage": (ramp,)},
        ),
        archives=archives,
    )
    # Half of the ramp is at 0.04 s, tick 20.
    assert run["controller.engage"].dtype == bool
    assert (run["controller.engage"] == (np.arange(50) >= 20)).all()
    assert (run["controller.engaged"] == run["controller.engage"]).all()


def test_a_boolean_output_drives_a_boolean_input(archives: Mapping[str, Archive]) -> None:
    start = job()
    run = master.simulate(
        plan=replace(start, inputs={**start.inputs, "controller.engage": "controller.saturated"}), archives=archives
    )
    # Nothing is ever engaged by what only an engaged controller shows.
    assert not run["controller.engaged"].any()


def test_messages_of_two_instances_are_told_apart(archives: Mapping[str, Archive]) -> None:
    archive = archives["TestbedController.fmu"]
    with Instance(archive, "first") as first, Instance(archive, "second") as second:
        first.messages.clear()
        second.messages.clear()
        with pytest.raises(FmuError, match=r"first: fmi2ExitInitializationMode"):
            first.exit_initialization_mode()
        assert len(first.messages) == 1
        assert not second.messages
