"""Scenario arm_contact_printed on the built FMUs: experiment 2 without a lift."""

from typing import Any

import numpy as np

from exo.experiment import Experiment

SCENARIO = "arm_contact_printed"


def test_nothing_lifts_the_arm_but_the_sines(experiment: Experiment) -> None:
    for run in experiment.recordings.values():
        after = run.time >= 40.5
        assert np.max(run["operator.f_h[3]"][after]) <= 4.0
        assert abs(np.mean(run["operator.f_h[3]"][after])) < 0.2
        assert run["operator.f_h[3]"][39_000] == -20.0


def test_the_paper_s_law_leaves_later_than_the_bounded_one_and_the_standard_one_not_at_all(
    results: dict[str, Any],
) -> None:
    for sines in ("up", "going_on"):
        passive, bounded = (results[f"leaving_delay/{law}_{sines}"].value for law in ("passive", "passive_bounded"))
        assert 2.0 < passive / bounded < 7.0
        assert results[f"stuck_rise/standard_{sines}"].value < 0.001
