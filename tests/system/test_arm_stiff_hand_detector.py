"""Scenario arm_stiff_hand_detector on the built FMUs: no alarm in the paper's experiments."""

from pathlib import Path

import numpy as np
import pytest

from exo import scenario as scenarios
from exo import theory
from exo.experiment import Experiment, run

SCENARIO = "arm_stiff_hand_detector"


def test_what_the_largest_damping_holds_by_the_closed_form_lies_between_the_two_limit_cases() -> None:
    damped = theory.Loop(M=99.93, M_n=5.0, D_n=220.0, K=1000.0, K_P=20.0, alpha=1.0, T=0.001, substep=1e-4)
    assert theory.hand_growth_rate(loop=damped, k_h=2762.0) < 0.0 < theory.hand_growth_rate(loop=damped, k_h=2763.0)


def test_the_damping_ramps_and_never_exceeds_its_parameter(experiment: Experiment) -> None:
    for recording in experiment.recordings.values():
        damping = np.stack([recording[f"controller.stiff_hand.D[{i}]"] for i in (1, 2, 3)])
        D_max = recording.parameter("controller.stiff_hand.D_max")
        T = recording.parameter("controller.T")
        change = np.diff(damping, axis=1)
        rounding = 1e-9  # of a sum of up to 200 N·s/m in a thousand steps
        assert damping.min() >= 0.0
        assert damping.max() <= D_max
        assert change.max() <= D_max * T / recording.parameter("controller.stiff_hand.attack") + rounding
        assert change.min() >= -D_max * T / recording.parameter("controller.stiff_hand.release") - rounding


def test_until_it_probes_something_it_changes_no_number(experiment: Experiment) -> None:
    off, on = experiment.recordings["friction_off_460"], experiment.recordings["friction_on_460"]
    seen = int(np.argmax(on["controller.stiff_hand.D[1]"] > 0.0))
    assert seen > 1000
    for column in ("plant.p[1]", "plant.p[3]", "controller.tau_a[2]", "controller.p_n[1]"):
        assert np.array_equal(off[column][:seen], on[column][:seen]), column


@pytest.mark.parametrize("name", ["arm_performance", "arm_contact", "arm_payload"])
def test_in_the_papers_experiments_it_detects_nothing_and_changes_no_number(name: str, fmu_dir: Path) -> None:
    scenario = scenarios.load(name)
    wanted = [case for case in scenario.cases if scenario.id == "arm_performance" or "passive" in case.id]
    scenario = scenario.model_copy(update={"cases": tuple(wanted), "metrics": (), "ratios": (), "figures": ()})
    off = run(scenario=scenario, fmu_dir=fmu_dir)
    on = run(scenario=scenario, fmu_dir=fmu_dir, overrides={"controller.stiff_hand.active": "true"})
    for case in wanted:
        watched, alone = on.recordings[case.id], off.recordings[case.id]
        assert not watched["controller.stiff_hand.detected"].any(), case.id
        for column in alone.columns:
            if not column.startswith("controller.stiff_hand."):
                assert np.array_equal(watched[column], alone[column]), f"{case.id}: {column}"
