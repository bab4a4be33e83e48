"""Scenario arm_vacuum_loss on the built FMUs."""

from exo.experiment import Experiment

SCENARIO = "arm_vacuum_loss"


def test_the_paths_part_when_the_vacuum_fails(experiment: Experiment) -> None:
    lost, held = (experiment.recordings[case]["plant.p[3]"] for case in ("passive_bounded", "held"))
    assert (lost[:4601] == held[:4601]).all()
    assert lost[5000] - held[5000] > 0.01


def test_the_torque_that_carried_the_weight_is_what_throws_the_hand(experiment: Experiment) -> None:
    run = experiment.recordings["passive_bounded"]
    force = run["controller.f_a[3]"]
    # f_a before the loss: the weight, and the friction of lifting.
    assert force[4599] > 25.0 * 9.81
    assert force[4700] < 0.5 * force[4599]
