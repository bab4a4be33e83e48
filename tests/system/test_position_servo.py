"""Scenario position_servo on the built FMUs:  the difference of the forms has its cause."""

from typing import Any

import numpy as np
import pytest

from exo.experiment import Experiment
from exo.scenario import load
from oracles import comparators, servo

SCENARIO = "position_servo"


@pytest.mark.parametrize("K", ["7.5", "15", "30"])
def test_the_expected_errors_are_those_of_the_second_implementation(K: str) -> None:
    expected = next(metric.expected for metric in load(SCENARIO).metrics if metric.id == "max_error")
    error = servo.gain_study_error(force=comparators.gain_study_force(), K=float(K))
    assert expected[f"gain_servo_K{K}"].value == pytest.approx(error, rel=1e-3)  # the printed digits


@pytest.mark.parametrize("K", ["7.5", "15", "30"])
def test_the_torque_form_s_late_velocity_makes_its_error_smaller_whatever_the_gain(
    K: str, results: dict[str, Any], experiment: Experiment
) -> None:
    # The backward difference is one sample behind the middle of the sample that begins: dq_late = dq − T a. The torque
    # form so pushes by K T a too much, which the spring K K_P need not: T a/K_P in e, whatever K, in the phase of a.
    run = experiment.recordings[f"gain_servo_K{K}"]
    late = run.time >= 40.0
    a_max = np.max(np.abs(np.diff(run["plant.dq"][late]))) / run.step
    difference = results[f"max_error/gain_servo_K{K}"].value - results[f"max_error/gain_torque_K{K}"].value
    assert 0.5 * 0.002 * a_max / 10.0 < difference < 0.002 * a_max / 10.0


def test_the_controller_gives_no_force_and_the_drive_no_more_than_its_limit(experiment: Experiment) -> None:
    run = experiment.recordings["wall_servo_passive_bounded"]
    assert not np.any(run["controller.tau_a"])
    assert 12.0 < np.max(np.abs(run["plant.tau_drive"])) <= 12.5 * (1 + 1e-15)  # mean of 25 equal numbers


def test_the_command_is_the_middle_of_the_nominal_s_next_sample(experiment: Experiment) -> None:
    run = experiment.recordings["gain_servo_K30"]
    q_n, q_d, dq_d = (run[f"controller.{name}"] for name in ("q_n", "q_d", "dq_d"))
    # The recording's rows are ticks; the law does not slip here.
    assert np.allclose(q_d[:-1], (q_n[:-1] + q_n[1:]) / 2, rtol=0, atol=1e-14)
    assert np.allclose(dq_d[:-1], np.diff(q_n) / run.step, rtol=0, atol=1e-11)
