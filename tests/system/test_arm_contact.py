"""Scenario arm_contact on the built FMUs."""

from typing import Any

import numpy as np
import pytest

from exo.experiment import Experiment

SCENARIO = "arm_contact"


def w(t: np.ndarray, a: float, b: float) -> np.ndarray:
    return np.clip((t - a) / 0.5, 0.0, 1.0) - np.clip((t - b) / 0.5, 0.0, 1.0)


def test_the_force_is_the_specified_one(experiment: Experiment) -> None:
    run = experiment.recordings["passive"]
    t = run.time
    moving = w(t, 5.0, 25.0) + w(t, 41.0, 50.0)
    sines = [A * np.sin(2.0 * np.pi * f * (t - 5.0)) * moving for A, f in ((7.0, 0.8), (5.0, 0.6), (4.0, 0.7))]
    sines[2] += -20.0 * w(t, 25.0, 40.0) + 10.0 * w(t, 40.0, 41.0)
    for i, force in enumerate(sines, start=1):
        # Phases up to 25 rad, sines of arguments up to 250 rad: 250 × 2⁻⁵³ × 7 N, generously.
        assert run[f"operator.f_h[{i}]"] == pytest.approx(force, abs=1e-11)
    # The pull outweighs the push from 40.333 s on: −20 (1 − s) + 10 s = 0 at s = 2/3.
    assert run["operator.f_h[3]"][40_333] < 0.0 < run["operator.f_h[3]"][40_334]


def test_the_laws_without_the_reaction_of_the_whole_y_wind_up(results: dict[str, Any]) -> None:
    for law in ("standard", "passive_applied"):
        assert results[f"e_z/{law}"].value < 10.0 * results["e_z/passive"].value


def test_the_paper_s_law_lives_on_the_torque_limit_and_the_bounded_one_does_not(experiment: Experiment) -> None:
    pressing = slice(35_000, 40_000)
    assert experiment.recordings["passive"]["controller.saturated"][pressing].all()
    bounded = experiment.recordings["passive_bounded"]
    torque = np.abs([bounded[f"controller.tau_a[{i}]"][pressing] for i in (1, 2, 3)])
    assert (torque.max(axis=1) < [153.0, 259.0, 153.0]).all()


def test_torques_never_exceed_their_limits(experiment: Experiment) -> None:
    for run in experiment.recordings.values():
        for i, limit in enumerate((153.0, 259.0, 153.0), start=1):
            assert np.abs(run[f"controller.tau_a[{i}]"]).max() <= limit * (1.0 + 1e-15)


def test_scaling_keeps_the_direction_of_the_force_and_clipping_turns_it(experiment: Experiment) -> None:
    def turned(case: str) -> float:
        run = experiment.recordings[case]
        tick = 38_000
        torque, asked = ([run[f"controller.{n}[{i}]"][tick] for i in (1, 2, 3)] for n in ("tau_a", "tau_demand"))
        return float(np.dot(torque, asked) / (np.linalg.norm(torque) * np.linalg.norm(asked)))

    assert turned("passive") == pytest.approx(1.0, abs=1e-12)
    assert turned("passive_clip") < 1.0 - 1e-4


def test_the_paper_s_law_draws_on_the_tank_once_saturated(experiment: Experiment) -> None:
    # The negative control of the tank's verdict.
    tank = experiment.recordings["passive"]["controller.energy.tank"]
    assert tank.min() < tank[0] - 0.1
    assert experiment.recordings["passive"]["controller.saturated"][tank.argmin()]
