"""Scenario arm_servo on the built FMUs: the drives close their own loops, and the law feels what they gave."""

import numpy as np
import pytest
from numpy.typing import NDArray

from exo.experiment import Experiment
from exo.recording import Recording

SCENARIO = "arm_servo"
K, K_P, T = 400.0, 20.0, 0.001


def joints(run: Recording, name: str) -> NDArray[np.float64]:
    """A vector of the joints, a row a tick."""
    return np.stack([run[f"{name}[{i}]"] for i in (1, 2, 3)], axis=1)


@pytest.mark.parametrize("form", ["position", "velocity"])
def test_the_drives_torque_is_their_loop_over_the_step(form: str, experiment: Experiment) -> None:
    run = experiment.recordings[f"lift_{form}"]
    q, q_d, dq_d = joints(run, "plant.q_joint"), joints(run, "controller.q_d"), joints(run, "controller.dq_d")
    # A position drive sees q at the begin of each of its ten cycles, 0.45 of the way in the mean; a velocity drive what
    # it was at the begin of the step.
    seen = q[:-1] + (0.0 if form == "velocity" else 0.45) * np.diff(q, axis=0)
    loop = K * ((dq_d[:-1] - np.diff(q, axis=0) / T) + K_P * (q_d[:-1] - seen))
    given = joints(run, "plant.tau_drive")[1:]
    lifting = (run.time[1:] >= 8.5) & (run.time[1:] < 9.5)
    assert np.abs(given[lifting, 1]).min() > 50.0
    # The lag of the torque is .5 ms and a cycle .1 ms: what the torque changes by meanwhile, at up to 20 N·m/s.
    assert given[lifting] == pytest.approx(loop[lifting], abs=0.02)


def test_the_law_gives_no_torque_and_gets_what_the_drives_gave(experiment: Experiment) -> None:
    for case in ("lift_position", "table_velocity"):
        run = experiment.recordings[case]
        assert not joints(run, "controller.tau_a").any()
        assert (joints(run, "controller.tau_a_measured") == joints(run, "plant.tau_drive")).all()
        assert np.abs(joints(run, "controller.tau_a_measured")).max() > 100.0
    turned = experiment.recordings["wrong_sign"]
    assert (joints(turned, "controller.tau_a_measured") == -joints(turned, "plant.tau_drive")).all()


def test_by_torques_the_arm_gets_what_the_law_asks_for_and_its_drives_lag(experiment: Experiment) -> None:
    run = experiment.recordings["lift_torque"]
    tau_a, given = joints(run, "controller.tau_a"), joints(run, "plant.tau_drive")
    # dτ/dt = ω (τ_a − τ) held for T, from what arrived at its begin: the mean is τ_a + (τ − τ_a) m.
    cutoff, n = 318.0, 10
    keep = np.exp(-2 * np.pi * cutoff * T / n)
    m = np.mean(keep ** np.arange(1, n + 1))
    arrived = joints(run, "plant.tau_applied")
    expected = tau_a[:-1] + (arrived[:-1] - tau_a[:-1]) * m
    # Rounding of ten torques of up to 155 N·m, and of their mean.
    assert given[1:] == pytest.approx(expected, abs=1e-11)
