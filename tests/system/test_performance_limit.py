"""Scenario performance_limit on the built FMUs: theorem 3."""

import math
from typing import Any

import numpy as np
import pytest

from exo import derived
from exo.experiment import Experiment
from exo.tuning import region
from exo.tuning.machine import Gains, Machine

from conftest import recording

SCENARIO = "performance_limit"


def test_the_expected_norms_are_those_of_the_closed_form(experiment: Experiment) -> None:
    machine = Machine(T=0.002, M_min=6.0, M_max=6.0, substep=8e-5)
    metric = next(one for one in experiment.scenario.metrics if one.id == "max_state")
    for case, check in metric.expected.items():
        gains = Gains(M_n=5.0, D_n=0.5, K=float(case.removeprefix("smooth_K")), K_P=10.0)
        error = region.error_per_newton(machine=machine, gains=gains, M=6.0, frequency=0.363)
        # e and de are a quarter of a period apart, so that ‖x_nr‖ has its largest value where de has: ω |E|.
        assert check.value == pytest.approx(4.43 * 2.0 * math.pi * 0.363 * error, rel=1e-4)


def test_with_dry_friction_the_error_halves_and_how_fast_it_changes_does_not(results: dict[str, Any]) -> None:
    def quotient(metric: str, K: float) -> float:
        return float(results[f"{metric}/dry_K{K:g}"].value / results[f"{metric}/dry_K{2.0 * K:g}"].value)

    assert quotient("max_error", 15.0) > 1.8
    assert quotient("max_state", 15.0) < 1.5
    assert [quotient("max_state", K) for K in (15.0, 30.0, 60.0, 120.0)] == sorted(
        quotient("max_state", K) for K in (15.0, 30.0, 60.0, 120.0)
    )


def test_the_norm_adds_up_the_errors_and_their_rates_of_all_axes() -> None:
    time = np.arange(1000) * 1e-3
    columns = {
        "controller__e_nr[1]": 0.3 * np.sin(2.0 * time),
        "controller__e_nr[2]": np.full(1000, 0.4),
        "controller__e_nr[3]": 0.1 * time,
    }
    run = derived.added(recording(time=time, **columns), ["x_nr"])
    expected = np.sqrt(0.09 * np.sin(2.0 * time) ** 2 + 0.36 * np.cos(2.0 * time) ** 2 + 0.16 + 0.01 * time**2 + 0.01)
    # Central differences inside: 0.3 · 2³ · (1 ms)²/6; one-sided at the ends.
    assert run["derived.x_nr"][1:-1] == pytest.approx(expected[1:-1], abs=1e-6)
