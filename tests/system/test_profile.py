"""Force profiles against the formulas of docs/specification.md section 5."""

import numpy as np
import pytest

from exo.profile import evaluate
from exo.scenario import Segment, load

TIME = np.arange(30_000) * 0.002


def clip(x: np.ndarray) -> np.ndarray:
    return np.clip(x, 0.0, 1.0)


def test_the_wall_s_force_is_the_specified_one() -> None:
    force = evaluate(segments=load("wall").profiles["tau_h"], time=TIME)
    free = np.where(TIME < 10.0, 4.17 * np.sin(2.0 * np.pi * 0.31 * TIME), 0.0)
    expected = free + 5.0 * clip((TIME - 10.0) / 0.5) - 10.0 * clip((TIME - 20.0) / 0.5)
    assert force == pytest.approx(expected, abs=1e-12)
    assert force[round(20.25 / 0.002)] == pytest.approx(0.0, abs=1e-12)
    assert force[-1] == -5.0


def test_the_gain_study_s_force_ramps_over_two_seconds() -> None:
    force = evaluate(segments=load("gain_study").profiles["tau_h"], time=TIME)
    assert force == pytest.approx(4.43 * np.sin(2.0 * np.pi * 0.363 * TIME) * clip(TIME / 2.0), abs=1e-12)


def test_the_adversary_s_force_changes_sign_every_half_cycle() -> None:
    force = evaluate(segments=load("adversary").profiles["tau_d"], time=TIME)
    assert not force[TIME < 15.0].any()
    assert not force[TIME >= 35.0].any()
    inside = force[(TIME >= 15.0) & (TIME < 35.0)]
    assert inside[0] == 25.0
    assert set(np.unique(inside)) == {-25.0, 25.0}
    # 20 s at 0.7 Hz: 14 cycles, 28 halves.
    assert np.count_nonzero(np.diff(inside)) == 27


def test_a_square_wave_is_right_continuous_at_its_zeros() -> None:
    # 20 s is 3.5 cycles after 15 s, where sin(7π) is rounding of either sign.
    square = Segment(kind="square", amplitude=25.0, frequency=0.7, t_on=15.0)
    assert evaluate(segments=(square,), time=np.array([19.998, 20.0, 20.002])).tolist() == [25.0, -25.0, -25.0]


def test_phase_counts_from_t_on() -> None:
    sine = Segment(kind="sine", amplitude=2.0, frequency=1.0, phase=np.pi / 2, t_on=3.3)
    assert evaluate(segments=(sine,), time=np.array([3.2, 3.3, 3.8])).tolist() == pytest.approx([0.0, 2.0, -2.0])


def test_windows_are_those_of_the_specification() -> None:
    # w(t; 5, 25) with 0.5 s ramps.
    window = Segment(kind="constant", amplitude=1.0, t_on=5.0, t_off=25.0, ramp=0.5)
    expected = clip((TIME - 5.0) / 0.5) - clip((TIME - 25.0) / 0.5)
    assert evaluate(segments=(window,), time=TIME) == pytest.approx(expected, abs=1e-15)


def test_a_table_is_linear_in_between_and_held_outside() -> None:
    table = Segment(kind="table", amplitude=2.0, t_on=1.0, points=((0.0, 0.0), (2.0, 3.0)))
    assert evaluate(segments=(table,), time=np.array([0.5, 1.0, 2.0, 9.0])).tolist() == [0.0, 0.0, 3.0, 6.0]


def test_a_step_happens_on_a_tick_that_rounding_puts_before_it() -> None:
    # 3·0.1 > 0.3 and 0.1·3 − 1 ulp < 0.3: both are the tick at 0.3 s.
    step = Segment(kind="constant", amplitude=1.0, t_on=0.3)
    assert evaluate(segments=(step,), time=np.array([np.nextafter(0.3, 0.0), 3 * 0.1])).tolist() == [1.0, 1.0]
