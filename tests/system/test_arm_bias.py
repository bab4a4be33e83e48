"""Scenario arm_bias on the built FMUs."""

from exo.experiment import Experiment

SCENARIO = "arm_bias"


def test_the_sensor_shows_the_bias_and_nobody_pushes(experiment: Experiment) -> None:
    for i, case in enumerate("xyz", start=1):
        run = experiment.recordings[case]
        for j in (1, 2, 3):
            assert not run[f"plant.f_h[{j}]"].any()
            assert (run[f"controller.f_h[{j}]"] == (1.0 if i == j else 0.0)).all()
