"""Scenario live_tuning on the built FMUs."""

import numpy as np

from exo.experiment import Experiment

SCENARIO = "live_tuning"


def test_the_human_stays_on_the_wall_while_gains_change(experiment: Experiment) -> None:
    # At once, the nominal's rebound takes the mass off the wall for a moment.
    run = experiment.recordings["ramp"]
    assert np.all(run["plant.tau_e"][run.time > 9.0] < -5.0)


def test_gains_at_once_and_over_time_end_in_the_same_state(experiment: Experiment) -> None:
    slow, fast = experiment.recordings["ramp"], experiment.recordings["at_once"]
    # The swing that a change leaves decays with 3 1/s; the last change is 12 s before the end.
    assert abs(slow["controller.tau_a"][-1] - fast["controller.tau_a"][-1]) < 1e-6


def test_a_change_at_once_is_felt_while_moving(experiment: Experiment) -> None:
    run = experiment.recordings["moving_at_once"]
    k = int(np.searchsorted(run.time, 10.0 - 1e-9))
    steps = np.abs(np.diff(run["controller.tau_a"][k - 20 : k + 20]))
    assert np.max(steps) > 10.0 * np.median(steps)
