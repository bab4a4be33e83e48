"""Scenario arm_performance_hand on the built FMUs."""

from typing import Any

import numpy as np
import pytest

from exo.experiment import Experiment

SCENARIO = "arm_performance_hand"
GAINS = (250, 500, 1000)


def off(results: dict[str, Any], operator: str) -> list[float]:
    """By how much the errors differ from the paper's, for each K (1)."""
    found = [results[f"max_error/{operator}_K{K}"] for K in GAINS]
    return [result.value / result.paper.value - 1.0 for result in found]


def test_the_hand_comes_nearer_to_every_error_of_the_paper_than_the_given_force_does_at_worst(
    results: dict[str, Any],
) -> None:
    force, hand = off(results, "force"), off(results, "hand")
    assert force == pytest.approx([-0.055, 0.047, 0.022], abs=0.001)  # off by what arm_performance is
    assert max(map(abs, hand)) < 0.04 < max(map(abs, force))
    # The ratio of the first two, which no scaling of the hand changes, is what a given force misses most.
    assert abs(hand[0] - hand[1]) < 0.6 * abs(force[0] - force[1])


def test_the_hand_pushes_less_where_the_arm_follows_better_and_the_given_force_does_not(
    results: dict[str, Any],
) -> None:
    hand = [results[f"largest_force/hand_K{K}"].value for K in GAINS]
    assert hand[0] > 1.1 * hand[1] > 1.1 * hand[2]
    assert [results[f"largest_force/force_K{K}"].value for K in GAINS] == pytest.approx([6.9] * 3, abs=1e-3)


def test_the_force_is_that_of_a_spring_and_a_damper_to_a_sine(experiment: Experiment) -> None:
    run = experiment.recordings["hand_K500"]
    s = np.clip(run.time / 2.0, 0.0, 1.0)
    wanted = run["plant.p[1]"][0] + 0.208 * s**3 * (10.0 - 15.0 * s + 6.0 * s**2) * np.sin(2 * np.pi * 0.325 * run.time)
    assert run["operator.p_target[1]"] == pytest.approx(wanted, abs=1e-12)
    # Its velocity by central differences: the third derivative, at most 10 m/s³, times (1 ms)²/6; 6 N·s/m.
    moving = np.gradient(wanted, run.step)
    force = 26.6 * (wanted - run["plant.p[1]"]) + 6.0 * (moving - run["plant.dp[1]"])
    assert run["operator.f_h[1]"][1:-1] == pytest.approx(force[1:-1], abs=2e-5)
    for i in (2, 3):  # the hand holds on along the other axes, too
        held = 26.6 * (run[f"plant.p[{i}]"][0] - run[f"plant.p[{i}]"]) - 6.0 * run[f"plant.dp[{i}]"]
        assert run[f"operator.f_h[{i}]"] == pytest.approx(held, abs=1e-9)
