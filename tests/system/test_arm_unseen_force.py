"""Scenario arm_unseen_force on the built FMUs."""

import numpy as np
import pytest

from exo.experiment import Experiment

SCENARIO = "arm_unseen_force"


def test_the_hand_never_exceeds_a_fifth_of_a_newton(experiment: Experiment) -> None:
    for run in experiment.recordings.values():
        assert np.abs(run["operator.f_h[3]"]).max() == pytest.approx(0.2)


@pytest.mark.parametrize(("case", "bound"), [("start_values", 400.0), ("f_max_60", 60.0), ("K_250", 400.0)])
def test_f_max_bounds_what_the_controller_ever_presses_with(experiment: Experiment, case: str, bound: float) -> None:
    assert np.abs(experiment.recordings[case]["controller.f_a[3]"]).max() <= bound


def test_what_the_table_gets_grows_with_the_gain_and_not_with_the_hand(experiment: Experiment) -> None:
    table = {case: run["plant.f_e[3]"][-2000:-500].mean() for case, run in experiment.recordings.items()}
    assert table["start_values"] > 5.0 * table["K_250"] > 0.0
    assert table["start_values"] > 500.0 * 0.2
