"""Scenario arm_ft_conditioning on the built FMUs."""

import numpy as np

from exo.experiment import Experiment

SCENARIO = "arm_ft_conditioning"


def test_the_sensor_breaks_at_three_seconds_and_the_run_goes_on(experiment: Experiment) -> None:
    shown = experiment.recordings["not_finite"]["plant.f_h_measured[2]"]
    assert np.isfinite(shown[:2999]).all()
    assert np.isnan(shown[3001:]).all()
    assert len(shown) >= 5000
    for case in ("stuck", "dropout", "over_range"):
        shown = experiment.recordings[case]["plant.f_h_measured[2]"]
        assert (np.diff(shown[3001:]) == 0.0).sum() > 0.99 * len(shown[3001:]) or case == "over_range"
        assert (np.diff(shown[:2999]) != 0.0).all()


def test_a_fault_keeps_its_name_while_the_sensor_is_broken(experiment: Experiment) -> None:
    for case, code in {"not_finite": 1, "over_range": 2, "stuck": 4, "dropout": 5}.items():
        assert (experiment.recordings[case]["controller.ft.fault"][3002:] == code).all(), case


def test_a_jump_is_forgiven_when_the_signal_has_recovered(experiment: Experiment) -> None:
    fault = experiment.recordings["rate"]["controller.ft.fault"]
    assert fault[3150] == 3  # the way back at 3.1 s is a jump as well
    assert not fault[3210:].any()


def test_the_force_is_not_used_while_the_tare_runs(experiment: Experiment) -> None:
    run = experiment.recordings["tared"]
    running = run["controller.ft.tare_state"] == 1
    assert running.sum() == 499
    for i in (1, 2, 3):
        assert not run[f"controller.ft.f_h[{i}]"][running].any()
