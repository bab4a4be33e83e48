"""Scenario arm_drift on the built FMUs: every verdict is a test."""

from typing import Any

import pytest

from exo.experiment import Experiment

from conftest import verdict_ids

SCENARIO = "arm_drift"


@pytest.mark.parametrize("metric", verdict_ids(SCENARIO))
def test_verdict_does_not_fail(metric: str, results: dict[str, Any]) -> None:
    result = results[metric]
    assert result.verdict != "fail", f"{result.value:.6g} {result.unit}, expected {result.expectation()}"


def test_the_heavier_payload_sinks_faster(results: dict[str, Any]) -> None:
    for law in ("passive", "passive_bounded"):
        light, heavy = (results[f"drift/{law}_{m}kg"].value for m in ("10", "17.5"))
        assert heavy < 1.5 * light < 0.0


def test_nobody_touches_the_handle_while_it_is_judged(experiment: Experiment) -> None:
    run = experiment.recordings["passive_bounded_17.5kg"]
    assert not run["operator.f_h[3]"][run.time >= 6.3].any()
