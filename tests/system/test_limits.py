"""Scenario limits on the built FMUs."""

import numpy as np

from exo.experiment import Experiment

SCENARIO = "limits"


def test_held_is_shown_where_a_limit_acts_and_nowhere_else(experiment: Experiment) -> None:
    for case, acts in (("speed", True), ("box", True), ("load_hold", True), ("load_free", False), ("none", False)):
        assert bool(np.any(experiment.recordings[case]["controller.held"])) == acts, case


def test_the_limits_change_nothing_before_they_act(experiment: Experiment) -> None:
    limited, free = experiment.recordings["speed"], experiment.recordings["box_fast"]
    first = int(np.argmax(limited["controller.held"]))
    assert limited.time[first] > 1.2
    assert np.array_equal(limited["plant.q"][:first], free["plant.q"][:first])


def test_a_box_without_a_speed_limit_is_overrun(experiment: Experiment) -> None:
    # The momentum of 6 kg meets 12.5 N at most; the slip takes the nominal along.
    run = experiment.recordings["box_fast"]
    assert np.max(run["controller.q_n"]) > 0.25
    assert np.max(experiment.recordings["box"]["controller.q_n"]) < 0.2 + 1e-12
