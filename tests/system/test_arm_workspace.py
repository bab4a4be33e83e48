"""Scenario arm_workspace on the built FMUs."""

import numpy as np
import pytest

from exo.experiment import Experiment

SCENARIO = "arm_workspace"

WAYS = ("+x", "-x", "+y", "-y", "+z", "-z")


@pytest.mark.parametrize("way", ["+x", "-x"])
def test_limits_change_nothing_before_they_act(experiment: Experiment, way: str) -> None:
    limited, free = experiment.recordings[f"task_{way}"], experiment.recordings[f"unlimited_{way}"]
    first = int(np.argmax(limited["controller.held"]))
    assert limited.time[first] > 0.2
    assert np.array_equal(limited["plant.p[1]"][:first], free["plant.p[1]"][:first])


@pytest.mark.parametrize("way", WAYS)
def test_in_joint_space_the_nominal_keeps_to_each_limit_exactly(experiment: Experiment, way: str) -> None:
    run = experiment.recordings[f"joint_{way}"]
    for joint in (1, 2, 3):
        q_n = run[f"controller.q_n[{joint}]"]
        low, high = (run.parameter(f"controller.workspace.q_{end}[{joint}]") for end in ("min", "max"))
        assert low - 1e-12 <= q_n.min(), joint  # the rounding of q + e
        assert q_n.max() <= high + 1e-12, joint


@pytest.mark.parametrize("way", WAYS)
def test_in_task_space_the_handle_keeps_off_the_straight_elbow(experiment: Experiment, way: str) -> None:
    run = experiment.recordings[f"task_{way}"]
    shoulder = run.parameter("controller.kinematics.A1")
    x, y, z = (run[f"controller.p_n[{i}]"] for i in (1, 2, 3))
    distance = np.hypot(np.hypot(x, y) - shoulder, z)
    # The law of cosines at q_3 = workspace.q_min[3]; a spring stretched by friction leads the nominal a little further.
    lengths = run.parameter("controller.kinematics.L1"), run.parameter("controller.kinematics.handle_x")
    bend = np.cos(run.parameter("controller.workspace.q_min[3]"))
    reach = np.sqrt(lengths[0] ** 2 + lengths[1] ** 2 + 2.0 * lengths[0] * lengths[1] * bend)
    assert distance.max() < reach + 0.004
    assert run["controller.sigma_min"].min() > 0.06


def test_without_limits_the_straight_elbow_holds_the_arm(experiment: Experiment) -> None:
    run = experiment.recordings["unlimited_+x"]
    pulled = run.time > 10.0
    assert run["controller.sigma_min"][pulled].max() < 0.045
    assert run["controller.q[3]"][pulled].max() < 0.3
