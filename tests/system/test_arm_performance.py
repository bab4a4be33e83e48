"""Scenario arm_performance on the built FMUs."""

import itertools
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from exo import experiment as experiments
from exo.experiment import Experiment
from exo.scenario import load

SCENARIO = "arm_performance"


def test_the_published_errors_are_met_within_six_percent(results: dict[str, Any]) -> None:
    # The print has two digits (1.1 % at K = 250, 4.5 % at K = 1000), and the paper's friction is not published.
    for case in ("K250", "K500", "K1000"):
        result = results[f"max_error/{case}"]
        assert result.value == pytest.approx(result.paper.value, rel=0.06)


def test_the_controller_gets_the_force_and_the_position_of_its_own_instant(experiment: Experiment) -> None:
    run = experiment.recordings["K1000"]
    for i in (1, 2, 3):
        assert (run[f"controller.f_h[{i}]"] == run[f"operator.f_h[{i}]"]).all()
        assert (run[f"plant.f_h[{i}]"] == run[f"operator.f_h[{i}]"]).all()
        assert (run[f"plant.tau_a[{i}]"] == run[f"controller.tau_a[{i}]"]).all()
        # Controller and plant derive the handle from the same angles, each with its own code: 1 ulp of 0.5 m a term.
        assert run[f"controller.p[{i}]"] == pytest.approx(run[f"plant.p[{i}]"], abs=1e-15)


def test_the_force_is_the_specified_one(experiment: Experiment) -> None:
    run = experiment.recordings["K250"]
    force = 6.9 * np.sin(2.0 * np.pi * 0.4 * run.time) * np.clip(run.time / 2.0, 0.0, 1.0)
    assert run["operator.f_h[1]"] == pytest.approx(force, abs=1e-12)
    assert not run["operator.f_h[2]"].any()
    assert not run["operator.f_h[3]"].any()


def test_another_gain_set_for_all_axes_at_once_is_outside_of_every_tolerance(fmu_dir: Path) -> None:
    other = experiments.run(scenario=load(SCENARIO), fmu_dir=fmu_dir, overrides={"controller.K[1..3]": "700"})
    assert {other.recordings["K250"].parameter(f"controller.K[{i}]") for i in (1, 2, 3)} == {700.0}
    errors = [result for result in other.results if result.id.startswith("max_error/")]
    assert errors
    for result in errors:
        assert result.margin < 0.0, result.id
        assert (result.verdict, result.void_by[0]) == ("info", "controller.K[1]")


def test_the_whole_norm_of_theorem_3_falls_with_every_doubling_too(results: dict[str, Any]) -> None:
    # Between a step of friction far below the limit, √2 less what sampling hides, and the theorem's 2.
    norms = [results[f"max_state/K{K}"].value for K in (250, 500, 1000)]
    for less, more in itertools.pairwise(norms):
        assert 1.3 < less / more < 2.0
