"""Scenario arm_joint_space on the built FMUs."""

from typing import Any

import numpy as np
import pytest

from exo.experiment import Experiment

SCENARIO = "arm_joint_space"


def test_the_payload_hangs_from_the_grip_to_the_release(experiment: Experiment) -> None:
    run = experiment.recordings["K400"]
    # The pad is on the table when the vacuum comes on, so it grips in that very step.
    assert (run["plant.attached"] == run["plant.vacuum"]).all()


def test_the_controller_does_not_know_the_payload(experiment: Experiment) -> None:
    # The spring carries the load's moment: K K_P e_q of joint 2 is the torque at rest, within the damper's part.
    run = experiment.recordings["K400"]
    resting = (run.time >= 22.5) & (run.time < 24.0)
    spring = 400.0 * 20.0 * np.mean(run["controller.e_q[2]"][resting])
    assert spring == pytest.approx(np.mean(run["controller.tau_a[2]"][resting]), rel=0.05)


def test_the_handle_s_image_is_what_the_joints_say(experiment: Experiment) -> None:
    run = experiment.recordings["K400"]
    A1, L1, L2 = 0.06, 0.32, 0.36
    q_1, q_2, q_3 = (run[f"controller.q_n[{i}]"] for i in (1, 2, 3))
    reach = A1 + L1 * np.cos(q_2) + L2 * np.cos(q_2 + q_3)
    z = L1 * np.sin(q_2) + L2 * np.sin(q_2 + q_3)
    expected = (reach * np.cos(q_1), reach * np.sin(q_1), z)
    for i, values in enumerate(expected, start=1):
        # Four sines and cosines of about 1 m.
        assert run[f"controller.p_n[{i}]"] == pytest.approx(values, abs=1e-14)


def test_in_task_space_the_joints_outputs_are_the_robot_s(experiment: Experiment) -> None:
    run = experiment.recordings["task"]
    for i in (1, 2, 3):
        assert (run[f"controller.q_n[{i}]"] == run[f"controller.q[{i}]"]).all()
        assert not run[f"controller.e_q[{i}]"].any()


def test_the_law_that_winds_up_lifts_late(results: dict[str, Any]) -> None:
    delay = {case: results[f"lifting_delay/{case}"].value for case in ("passive", "passive_applied", "K400")}
    assert delay["passive_applied"] > delay["K400"] + 1.0
    assert delay["passive_applied"] > delay["passive"] + 1.0
    assert results["lift/passive_applied"].value < results["lift/K400"].value - 0.1
