"""Scenario arm_drift on the built FMUs."""

from typing import Any

from exo.experiment import Experiment

SCENARIO = "arm_drift"


def test_the_heavier_payload_sinks_faster(results: dict[str, Any]) -> None:
    for law in ("passive", "passive_bounded"):
        light, heavy = (results[f"drift/{law}_{m}kg"].value for m in ("10", "17.5"))
        assert heavy < 1.5 * light < 0.0


def test_nobody_touches_the_handle_while_it_is_judged(experiment: Experiment) -> None:
    run = experiment.recordings["passive_bounded_17.5kg"]
    assert not run["operator.f_h[3]"][run.time >= 6.3].any()
