"""Scenario arm_drift_watch on the built FMUs."""

from itertools import groupby

import numpy as np
from numpy.typing import NDArray

from exo.experiment import Experiment
from exo.recording import Recording

SCENARIO = "arm_drift_watch"
READY, ENGAGED, HOLD, SOFT_STOP, FAULT = 2, 3, 4, 5, 6
NOT_ACKNOWLEDGED, STEADY, TOOL = 9, 14, 15


def passed(run: Recording, column: str, *, after: float) -> list[int]:
    """What an Integer passes through from `after` (s) on."""
    return [int(value) for value, _ in groupby(run[column][run.time >= after])]


def strength(run: Recording, component: str) -> NDArray[np.float64]:
    """|f| (N) of a force's columns."""
    return np.linalg.norm([run[f"{component}[{i}]"] for i in (1, 2, 3)], axis=0)


def test_nobody_touches_the_handle_while_the_sensor_drifts_beyond_the_end_of_a_hold(experiment: Experiment) -> None:
    for case in ("drift_6_task", "drift_12_joint", "drift_unwatched", "drift_stop"):
        run = experiment.recordings[case]
        assert not strength(run, "operator.f_h").any()
        assert strength(run, "controller.ft.f_h")[run.time > 31.5].max() > 3.0
    # The true rate, over six minutes.
    slow = strength(experiment.recordings["slow"], "controller.ft.f_h")
    assert 0.55 < slow[-1000:].mean() < 0.65


def test_a_drift_ends_the_hold_without_the_watch_and_not_with_it(experiment: Experiment) -> None:
    assert passed(experiment.recordings["drift_unwatched"], "controller.state", after=2.0)[:2] == [HOLD, ENGAGED]
    for case in ("drift_6_task", "drift_6_joint", "drift_12_task", "drift_12_joint", "slow"):
        assert passed(experiment.recordings[case], "controller.state", after=2.0) == [HOLD]


def test_after_a_push_it_warns_while_it_moves_and_then_holds(experiment: Experiment) -> None:
    for case in ("push_task", "push_joint"):
        run = experiment.recordings[case]
        assert passed(run, "controller.state", after=2.1) == [ENGAGED, HOLD]
        held = int(np.argmax((run.time > 2.1) & (run["controller.state"] == HOLD)))
        warned = int(np.argmax((run.time > 2.1) & (run["controller.diagnostic"] == STEADY)))
        assert run.time[warned] < run.time[held]
        assert (run["controller.diagnostic"][held:] == STEADY).all()


def test_a_drift_that_goes_on_is_a_warning_first_and_then_a_fault_of_the_same_name(experiment: Experiment) -> None:
    run = experiment.recordings["drift_stop"]
    assert passed(run, "controller.state", after=2.0) == [HOLD, SOFT_STOP, FAULT]
    # In the fault the law no longer acts, so that its cause is gone.
    assert passed(run, "controller.diagnostic", after=2.0) == [0, STEADY, NOT_ACKNOWLEDGED]
    assert passed(run, "controller.first_fault", after=2.0) == [0, STEADY]


def test_a_wrong_tool_is_named_where_it_engages_and_moves_nothing_there(experiment: Experiment) -> None:
    for case in (f"tool_{tool}_{space}" for tool in ("heavier", "lighter") for space in ("task", "joint")):
        run = experiment.recordings[case]
        assert passed(run, "controller.state", after=3.9) == [READY, ENGAGED, HOLD], case
        assert passed(run, "controller.diagnostic", after=4.1) == [0, TOOL], case
        assert strength(run, "controller.ft.f_h")[run.time > 4.1].min() > 3.0, case


def test_a_hand_that_kept_still_goes_on_when_it_changes_its_force(experiment: Experiment) -> None:
    run = experiment.recordings["still_hand"]
    assert passed(run, "controller.state", after=1.7) == [ENGAGED, HOLD, ENGAGED, HOLD]
    let_go = int(np.argmax(run.time > 3.5))
    assert (np.diff(run["plant.p[2]"][let_go:]) >= -1e-9).all()
    assert run["plant.p[2]"][-1] - run["plant.p[2]"][let_go] > 0.01
