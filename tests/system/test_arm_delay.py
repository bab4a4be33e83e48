"""Scenario arm_delay on the built FMUs."""

from exo.experiment import Experiment

SCENARIO = "arm_delay"


def test_the_delayed_torque_is_the_last_tick_s_and_starts_at_zero(experiment: Experiment) -> None:
    late, direct = (experiment.recordings[f"sine_{c}"] for c in ("one_sample_delay", "zero_delay"))
    for i in (1, 2, 3):
        name = f"[{i}]"
        assert late["plant.tau_a" + name][0] == 0.0
        assert (late["plant.tau_a" + name][1:] == late["controller.tau_a" + name][:-1]).all()
        assert (direct["plant.tau_a" + name] == direct["controller.tau_a" + name]).all()
    assert not (late["plant.p[1]"] == direct["plant.p[1]"]).all()


def test_exchanging_at_once_equals_one_sample_of_delay_bit_for_bit(experiment: Experiment) -> None:
    # f_h is a plan and reaches both directly, so the torque is the only connection whose lateness shows.
    for kind in ("sine", "press"):
        at_once, delayed = (experiment.recordings[f"{kind}_{c}"] for c in ("exchange_at_once", "one_sample_delay"))
        for i in (1, 2, 3):
            assert (at_once[f"plant.q_joint[{i}]"] == delayed[f"plant.q_joint[{i}]"]).all()
