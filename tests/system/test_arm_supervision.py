"""Scenario arm_supervision on the built FMUs."""

from itertools import groupby

import numpy as np

from exo.experiment import Experiment

SCENARIO = "arm_supervision"
OFF, INIT, READY, ENGAGED, HOLD, SOFT_STOP, FAULT = range(7)
ACTING = [ENGAGED, HOLD, SOFT_STOP]


def passed(experiment: Experiment, case: str) -> list[int]:
    """The states that a case passes through."""
    return [int(state) for state, _ in groupby(experiment.recordings[case]["controller.state"])]


def test_the_payload_s_story_has_its_states_in_order(experiment: Experiment) -> None:
    start = [OFF, INIT, READY, ENGAGED]
    assert passed(experiment, "payload") == [*start, HOLD, ENGAGED, SOFT_STOP, OFF, INIT, READY]
    # The hand rests before it presses, and after it has lifted.
    assert passed(experiment, "payload_automatic") == [*start, HOLD, ENGAGED, HOLD]


def test_the_faults_story_has_its_states_and_first_faults_in_order(experiment: Experiment) -> None:
    again = [OFF, INIT, READY, ENGAGED]
    soft, hard = [*again, SOFT_STOP, FAULT], [*again, FAULT]
    assert passed(experiment, "faults") == [*soft, *soft, *hard, *hard, OFF, INIT, READY]
    first = experiment.recordings["faults"]["controller.first_fault"]
    # heartbeat_lost, ft_invalid, emergency_stop, encoder_invalid, each gone after its acknowledgement
    assert [int(code) for code, _ in groupby(first)] == [0, 4, 0, 5, 0, 1, 0, 2, 0]


def test_an_acknowledgement_under_the_emergency_stop_does_not_count(experiment: Experiment) -> None:
    run = experiment.recordings["faults"]
    during = (run.time >= 13.4) & (run.time < 14.4)
    assert (run["controller.state"][during] == FAULT).all()


def test_there_is_no_torque_where_the_law_does_not_act(experiment: Experiment) -> None:
    for run in experiment.recordings.values():
        rests = ~np.isin(run["controller.state"], ACTING)
        assert rests.any()
        for joint in (1, 2, 3):
            assert not run[f"controller.tau_a[{joint}]"][rests].any()
            assert not run["controller.authority"][rests].any()


def test_the_payload_is_supported_throughout_the_hold(experiment: Experiment) -> None:
    run = experiment.recordings["payload"]
    held = run["controller.state"] == HOLD
    assert run["plant.attached"][held].all()
    # Its weight within what friction can carry at the handle.
    assert np.abs(run["controller.f_a[3]"][held] - 17.5 * 9.81).max() < 60.0


def test_the_heartbeat_is_the_integer_that_the_profile_says(experiment: Experiment) -> None:
    beat = experiment.recordings["payload"]["controller.heartbeat"]
    assert set(np.unique(beat)) == {-1, 1}
    assert np.count_nonzero(np.diff(beat)) == 24 * 50 - 1
