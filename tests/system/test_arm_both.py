"""Scenario arm_both on the built FMUs: the two arms are held against the one."""

from contextlib import ExitStack
from dataclasses import replace
from pathlib import Path

import numpy as np

from exo import scenario as scenarios
from exo.experiment import Experiment
from exo.fmu import Archive
from exo.master import plan, simulate

SCENARIO = "arm_both"


def test_equal_hands_make_each_arm_the_single_arm_with_half_the_payload(experiment: Experiment, fmu_dir: Path) -> None:
    single = scenarios.load("arm_payload")
    case = next(case for case in single.cases if case.id == "passive_bounded_17.5kg")
    with ExitStack() as stack:
        names = {part.archive for part in single.components.values()}
        archives = {name: stack.enter_context(Archive(fmu_dir / name)) for name in names}
        # 9 s: pressed, gripped and on its way up.
        alone = simulate(plan=replace(plan(scenario=single, case=case), duration=9.0), archives=archives)
    both = experiment.recordings["equal"]
    for axis, base in ((1, 0.0), (2, 0.2), (3, 0.0)):
        expected = np.asarray(alone[f"plant.p[{axis}]"])
        for side, sign in (("left", 1.0), ("right", -1.0)):
            found = np.asarray(both[f"plant.{side}.p[{axis}]"])[: len(expected)] - sign * base
            # The same numbers up to the rounding of the shoulder's 0.2 m.
            assert np.max(np.abs(found - expected)) < 1e-15


def test_the_pads_keep_their_distance_while_the_arms_move(experiment: Experiment) -> None:
    run = experiment.recordings["unequal"]
    pads = [np.column_stack([run[f"plant.{side}.p_pad[{axis}]"] for axis in (1, 2, 3)]) for side in ("left", "right")]
    # A discrete output: row k is what step k leaves, so it belongs to the positions of row k + 1.
    held = np.concatenate([[False], run["plant.attached"][:-1]])
    apart = (pads[0] - pads[1])[held]
    # 20 µm: twice the largest gap, once at the first sample and once at the other.
    assert np.max(np.abs(apart - apart[0])) < 2e-5
    assert np.ptp(pads[0][held][:, 2]) > 0.3
    gap = run["plant.gap"]
    assert 0.0 < np.max(gap[held]) < 1e-5
    assert np.all(gap[~held] == 0.0)


def test_unequal_hands_lift_the_payload_between_those_of_their_forces(experiment: Experiment) -> None:
    heights = {
        case: max(np.max(run[f"plant.{side}.p[3]"]) for side in ("left", "right"))
        for case, run in experiment.recordings.items()
    }
    assert heights["unequal"] < heights["equal"]


def test_both_cups_bear_the_weight_together_whoever_lifts_more(experiment: Experiment) -> None:
    run = experiment.recordings["unequal"]
    slow = (run.time > 23.9) & (run.time < 24.9)
    left, right = run["plant.left.tension"][slow], run["plant.right.tension"][slow]
    # 35 kg · 9.81 m/s²; 1 %: it still sinks, at changing speed.
    assert np.isclose(np.mean(left + right), 35.0 * 9.81, rtol=0.01)
    assert abs(np.mean(left - right)) > 1.0
    # Each half hangs at its own pad: what the tensions differ by is twice what passes inside the payload.
    assert np.isclose(np.mean(left - right), -2.0 * np.mean(run["plant.lambda[3]"][slow]), rtol=0.02)


def test_the_wrists_bear_the_moment_of_the_pads_forces_about_the_middle_of_the_payload(experiment: Experiment) -> None:
    """From the tensions, not from lambda: each cup pulls at its end, half the pads' distance from the middle."""
    for case in ("unequal", "left_only"):
        run = experiment.recordings[case]
        resting = (run.time > 9.0) & (run.time < 9.4)
        apart = np.mean((run["plant.left.p_pad[2]"] - run["plant.right.p_pad[2]"])[resting])
        ends = [run[f"plant.{side}.tension"] + run[f"plant.{side}.f_e[3]"] for side in ("left", "right")]
        expected = -0.5 * apart * np.mean((ends[0] - ends[1])[resting])
        found = np.mean(run["plant.wrist[1]"][resting])
        assert abs(found) > 5.0
        # Both halves accelerate alike, but for a gap of 10 µm.
        assert np.isclose(found, expected, rtol=1e-3), case


def test_one_hand_alone_does_not_lift_what_its_arm_s_limit_does_not_bear(experiment: Experiment) -> None:
    run = experiment.recordings["left_only"]
    pressed = (run.time > 8.5) & (run.time < 9.4)
    assert run["plant.attached"][pressed].all()
    # No lift: the tables' springs give back a fraction of the 4 mm by which they were pressed in.
    assert np.ptp(run["plant.left.p[3]"][pressed]) < 1e-3
    # The left law asks for K f_h = 8 kN and gets f_max = 400 N; the right one, which no hand pushes, asks for nothing.
    assert np.allclose(run["left_controller.f_a[3]"][pressed], 400.0, atol=1.0)
    # So the right half hangs at the left one: 17.5 kg · 9.81 m/s², but for what the right arm's stiction bears.
    right = 17.5 * 9.81
    stiction = 18.0 / 0.38
    assert abs(abs(np.mean(run["plant.lambda[3]"][pressed])) - right) < stiction
