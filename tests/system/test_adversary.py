"""Scenario adversary on the built FMUs: every verdict is a test."""

from typing import Any

import pytest

from exo.experiment import Experiment

from conftest import verdict_ids

SCENARIO = "adversary"


@pytest.mark.parametrize("metric", verdict_ids(SCENARIO))
def test_verdict_does_not_fail(metric: str, results: dict[str, Any]) -> None:
    result = results[metric]
    assert result.verdict != "fail", f"{result.value:.6g} {result.unit}, expected {result.expectation()}"


def test_the_negative_control_creates_energy_only_while_shaken(experiment: Experiment) -> None:
    run = experiment.recordings["passive"]
    energy = run["controller.energy.G"]
    peak = run.time[energy.argmax()]
    assert 15.0 <= peak <= 35.0
    assert energy[run.time < 15.0].max() < 1.0
