"""Scenario arm_bias on the built FMUs: every verdict is a test."""

from typing import Any

import pytest

from exo.experiment import Experiment

from conftest import verdict_ids

SCENARIO = "arm_bias"


@pytest.mark.parametrize("metric", verdict_ids(SCENARIO))
def test_verdict_does_not_fail(metric: str, results: dict[str, Any]) -> None:
    result = results[metric]
    assert result.verdict != "fail", f"{result.value:.6g} {result.unit}, expected {result.expectation()}"


def test_the_sensor_shows_the_bias_and_nobody_pushes(experiment: Experiment) -> None:
    for i, case in enumerate("xyz", start=1):
        run = experiment.recordings[case]
        for j in (1, 2, 3):
            assert not run[f"plant.f_h[{j}]"].any()
            assert (run[f"controller.f_h[{j}]"] == (1.0 if i == j else 0.0)).all()
