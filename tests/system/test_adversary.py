"""Scenario adversary on the built FMUs."""

from exo.experiment import Experiment

SCENARIO = "adversary"


def test_the_negative_control_creates_energy_only_while_shaken(experiment: Experiment) -> None:
    run = experiment.recordings["passive"]
    energy = run["controller.energy.G"]
    peak = run.time[energy.argmax()]
    assert 15.0 <= peak <= 35.0
    assert energy[run.time < 15.0].max() < 1.0
