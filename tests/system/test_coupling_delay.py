"""Scenario coupling_delay on the built FMUs."""

from exo.experiment import Experiment

SCENARIO = "coupling_delay"


def test_exchanging_at_once_equals_one_sample_of_delay_bit_for_bit(experiment: Experiment) -> None:
    # τ_h reaches both directly, so the torque is the only connection that is late.
    at_once = experiment.recordings["gain_exchange_at_once_K30"]
    delayed = experiment.recordings["gain_one_sample_delay_K30"]
    assert (at_once["plant.q"] == delayed["plant.q"]).all()


def test_the_delayed_torque_is_the_last_tick_s_and_starts_at_zero(experiment: Experiment) -> None:
    late = experiment.recordings["gain_one_sample_delay_K30"]
    assert late["plant.tau_a"][0] == 0.0
    assert (late["plant.tau_a"][1:] == late["controller.tau_a"][:-1]).all()
    direct = experiment.recordings["gain_zero_delay_K30"]
    assert (direct["plant.tau_a"] == direct["controller.tau_a"]).all()


def test_the_load_cell_is_one_sample_late(experiment: Experiment) -> None:
    run = experiment.recordings["gain_measured_K30"]
    assert (run["controller.tau_h"][1:] == run["plant.tau_h"][:-1]).all()
