"""Scenario gain_guide on the built FMUs: boundaries found by simulation alone."""

from collections.abc import Callable, Mapping
from dataclasses import replace

import numpy as np
import pytest

from exo import scenario as scenarios
from exo.experiment import Experiment
from exo.fmu import Archive
from exo.master import plan, simulate
from exo.tuning import region
from exo.tuning.machine import Gains, Machine

SCENARIO = "gain_guide"
GAINS = Gains(M_n=1.0, D_n=2.0, K=30.0, K_P=10.0)


def grows(archives: Mapping[str, Archive], case: str, name: str, value: float) -> bool:
    """Whether e_nr is larger in the last tenth of the run than in the tenth before half of it. No closed form."""
    data = scenarios.load(SCENARIO)
    (chosen,) = [c for c in data.cases if c.id == case]
    run = simulate(plan=plan(scenario=data, case=chosen, overrides={name: value}), archives=archives)
    e = np.abs(run["controller.e_nr"])
    tenth = len(e) // 10
    return bool(np.max(e[-tenth:]) > np.max(e[4 * tenth : 5 * tenth]))


def simulated_boundary(grown: Callable[[float], bool], *, low: float, high: float) -> float:
    """Bisected to 1 %."""
    assert not grown(low)
    assert grown(high)
    while high / low > 1.01:
        middle = (low * high) ** 0.5
        low, high = (low, middle) if grown(middle) else (middle, high)
    return (low * high) ** 0.5


# Far above the limit the swing meets the wall at 1e9 m within the run, and ends.
@pytest.mark.parametrize(("delay", "high"), [(0, 9000.0), (1, 3000.0)])
def test_the_gain_at_which_the_fmus_begin_to_ring_is_the_predicted_one(
    delay: int, high: float, archives: Mapping[str, Archive]
) -> None:
    machine = Machine(T=0.002, delay=delay, M_min=6.0, M_max=6.0, substep=8e-5)
    predicted = region.gain_interval(machine=machine, gains=GAINS, M=6.0)
    assert predicted is not None
    found = simulated_boundary(
        lambda K: grows(archives, f"gain_above_delay_{delay}", "controller.K", K), low=750.0, high=high
    )
    # docs/tuning.md: within 10 %. The bisection's 1 %, and what may ring for long: less than 2 % is seen.
    assert found == pytest.approx(predicted.high, rel=0.02)


@pytest.mark.parametrize(
    ("case", "changes"),
    [("hand_above", {}), ("hand_late_above", {"delay": 1, "b_h": 2.0, "hand_delay": 0.021})],
)
def test_the_hand_at_which_the_fmus_begin_to_swing_is_the_predicted_one(
    case: str, changes: dict[str, float], archives: Mapping[str, Archive]
) -> None:
    machine = replace(Machine(T=0.002, M_min=6.0, M_max=6.0, substep=8e-5), **changes)
    predicted = region.hand_limit(machine=machine, gains=GAINS, M=6.0)
    found = simulated_boundary(lambda k_h: grows(archives, case, "operator.k_h", k_h), low=10.0, high=100.0)
    assert found == pytest.approx(predicted, rel=0.02)  # as above


def test_the_nominal_of_the_guided_cases_is_what_the_guide_gives(experiment: Experiment) -> None:
    run = experiment.recordings["guided_below"]
    machine = Machine(T=0.002, delay=1, M_min=6.0, M_max=6.0, k_h=500.0, substep=8e-5)
    gains = Gains(M_n=1.0, D_n=2.0, K=0.25 * 6.0 / 0.002, K_P=10.0)
    smallest = region.smallest(
        stable=lambda M_n: region.stable_at_all(machine=machine, gains=replace(gains, M_n=M_n), k_h_factor=2.0),
        low=0.06,
        high=12.0,
    )
    assert smallest == pytest.approx(run.parameter("controller.M_n"), rel=1e-5)  # as printed in the scenario
    assert run.parameter("controller.K") == gains.K
