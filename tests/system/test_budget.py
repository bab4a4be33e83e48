"""Scenario budget on the built FMUs."""

import numpy as np
import pytest

from exo.experiment import Experiment

SCENARIO = "budget"
T = 0.002


@pytest.mark.parametrize(("case", "start"), [("10J", 10.0), ("100mJ", 0.1)])
def test_what_went_out_by_the_ports_exceeds_what_came_in_by_no_more_than_the_start(
    experiment: Experiment, case: str, start: float
) -> None:
    """From forces, positions and velocities alone: v_m is the nominal's equation of motion solved for it."""
    run = experiment.recordings[case]
    M_n, D_n, K = (run.parameter(f"controller.{name}") for name in ("M_n", "D_n", "K"))
    force, human = run["controller.tau_a"], run["controller.tau_h"]
    v_m = (2.0 * M_n / T * run["controller.dq_n"] + human - force / K) / (2.0 * M_n / T + D_n)
    out = np.cumsum((force[:-1] * np.diff(run["controller.q"])) - (K * human * v_m * T)[:-1])
    assert out.max() <= start + 1e-9  # rounding of 6000 samples of some J
    assert out.max() > 0.9 * start, "the tank was not needed"


def test_the_shaking_takes_what_is_in_the_tank_and_the_control_gives_more(experiment: Experiment) -> None:
    before = experiment.recordings["10J"].time < 4.0
    kept = experiment.recordings["10J"]["controller.energy.tank"][before]
    control = experiment.recordings["passive"]["controller.energy.tank"][before]
    assert kept[-1] < 0.01 * kept[0]
    # And at a steady rate: twice as much after twice the time, within a tenth.
    half = len(control) // 2
    assert control[0] - control[-1] == pytest.approx(2.0 * (control[0] - control[half]), rel=0.1)
    assert control[-1] < -20.0
