"""Scenario arm_stiff_hand_map on the built FMUs: why it takes a probe, by a regression that is not the detector's."""

import numpy as np
import pytest

from exo.experiment import Experiment
from exo.recording import Recording

SCENARIO = "arm_stiff_hand_map"

SHAKES = {"shake_1.6_free": 1.6, "shake_2.3_free": 2.3, "shake_1.6_loaded": 1.6, "shake_2.3_loaded": 2.3}


def hand_in(run: Recording, *, after: float, before: float) -> tuple[float, float]:
    """k (N/m) and b (N·s/m) of f_h = c − k p − b dp in a window (s), by least squares."""
    window = (run.time >= after) & (run.time < before)
    p, f = run["plant.p[1]"], run["operator.f_h[1]"]
    dp = np.gradient(p, run.time)
    columns = np.stack([p[window], dp[window], np.ones(window.sum())], axis=1)
    k, b, _ = -np.linalg.lstsq(columns, f[window], rcond=None)[0]
    return float(k), float(b)


def probed(run: Recording) -> tuple[float, float]:
    """When the damping came and when it had gone or was all there (s)."""
    damping = run["controller.stiff_hand.D[1]"]
    first = int(np.argmax(damping > 0.0))
    rest = damping[first:]
    ended = (rest == 0.0) | (rest > 1.2 * rest[200])
    length = int(np.argmax(ended)) if ended.any() else len(rest)
    return float(run.time[first]), float(run.time[first + length - 1])


def test_in_a_steady_swing_a_force_that_is_meant_looks_like_a_passive_hand(experiment: Experiment) -> None:
    k, b = hand_in(experiment.recordings["hand_1000_50_free_off"], after=3.0, before=3.0 + 3 / 2.375)
    assert k == pytest.approx(1000.0, rel=0.01)
    assert b == pytest.approx(50.0, rel=0.02)
    for case, frequency in SHAKES.items():
        k, b = hand_in(experiment.recordings[f"{case}_off"], after=4.0, before=4.0 + 4 / frequency)
        assert 400.0 < k < 1300.0, case
        assert 0.0 < b < 100.0, case


def test_the_robot_feeds_both_so_that_energy_does_not_tell_them_apart(experiment: Experiment) -> None:
    # ∫ f_h dp over whole periods: a damper takes it, and so does a force at a port that is not passive.
    cases = {"hand_1000_50_free": 2.375, "hand_2000_50_free": 2.37} | SHAKES
    for case, frequency in cases.items():
        run = experiment.recordings[f"{case}_off"]
        window = (run.time >= 4.0) & (run.time < 4.0 + 4 / frequency)
        f, p = run["operator.f_h[1]"][window], run["plant.p[1]"][window]
        work = np.trapezoid(f - f.mean(), p)
        assert work < 0.0, case


def test_under_the_probe_a_hand_stays_what_it_is_and_a_force_does_not(experiment: Experiment) -> None:
    for case in ("hand_1000_50_free", "hand_1000_50_loaded", "hand_700_50_free", "hand_700_25_loaded"):
        run = experiment.recordings[f"{case}_on"]
        begin, _ = probed(run)
        k, b = hand_in(run, after=begin + 0.1, before=begin + 0.6)
        assert k == pytest.approx(float(case.split("_")[1]), rel=0.02), case
        assert b == pytest.approx(float(case.split("_")[2]), rel=0.1), case
    for case, frequency in SHAKES.items():
        run = experiment.recordings[f"{case}_on"]
        begin, end = probed(run)
        omega = 2.0 * np.pi * frequency
        before = complex(*hand_in(run, after=begin - 1 / frequency, before=begin))
        under = complex(*hand_in(run, after=end - 1 / frequency, before=end))
        before, under = before.real + 1j * omega * before.imag, under.real + 1j * omega * under.imag
        assert abs(under - before) > 0.28 * abs(before), case


def test_the_probe_is_half_of_the_impedance_that_the_hand_seems_to_have(experiment: Experiment) -> None:
    for case, frequency in SHAKES.items():
        run = experiment.recordings[f"{case}_on"]
        begin, _ = probed(run)
        omega = 2.0 * np.pi * frequency
        k, b = hand_in(run, after=begin - 2 / frequency, before=begin)
        expected = run.parameter("controller.stiff_hand.probe") * np.hypot(k, omega * b) / omega
        # Friction's harmonics in p have a share of 1 %, which the band weighs differently.
        assert run["controller.stiff_hand.D[1]"].max() == pytest.approx(expected, rel=0.08), case


def test_until_it_probes_something_it_changes_no_number(experiment: Experiment) -> None:
    for case in ("hand_1000_50_free", "hand_460_25_loaded", "shake_1.6_free", "growing_1.6_loaded"):
        off, on = experiment.recordings[f"{case}_off"], experiment.recordings[f"{case}_on"]
        damped = np.stack([on[f"controller.stiff_hand.D[{i}]"] for i in (1, 2, 3)]).any(axis=0)
        first = int(np.argmax(damped))
        assert first > 1000, case
        assert np.array_equal(off["plant.p[1]"][:first], on["plant.p[1]"][:first]), case


def test_a_reach_and_a_swing_below_f_min_are_not_touched(experiment: Experiment) -> None:
    for case in ("reach_free", "reach_loaded", "hand_460_50_free", "hand_460_50_loaded"):
        off, on = experiment.recordings[f"{case}_off"], experiment.recordings[f"{case}_on"]
        assert np.array_equal(off["plant.p[1]"], on["plant.p[1]"]), case
