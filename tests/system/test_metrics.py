"""Metrics on signals whose answer is known."""

import math

import numpy as np
import pytest

from exo import metrics, theory
from exo.errors import ExoError, ScenarioError
from exo.metrics import basic, coupling, events, growth, impedance, loops, response, theorems, wall
from exo.scenario import Check, Segment
from exo.verdict import judge

from conftest import recording

TIME = np.arange(1000) * 0.01


def test_release_delay_is_the_first_tick_a_margin_from_the_wall() -> None:
    # Down through 0.3 − 0.001 at t = 5.01 s; a dip before `after` does not count.
    position = np.where(TIME < 5.005, 0.3, 0.2)
    position[100] = 0.0
    run = recording(time=TIME, plant__q=position, parameters={"plant.wall.q": 0.3})
    delay = events.release_delay(run, position="plant.q", wall="plant.wall.q", margin=0.001, after=4.0)
    assert delay == pytest.approx(1.01)


def test_release_delay_of_a_mass_that_stays_is_nan_and_fails() -> None:
    run = recording(time=TIME, plant__q=np.full(1000, 0.2995), parameters={"plant.wall.q": 0.3})
    delay = events.release_delay(run, position="plant.q", wall="plant.wall.q", margin=0.001, after=4.0)
    assert math.isnan(delay)
    for check in (Check(value=1.0, within=1e9), Check(at_most=1e9), Check(at_least=-1e9)):
        result = judge(metric="m", title="", value=delay, unit="s", check=check, source="")
        assert result.verdict == "fail"
        assert result.as_json()["value"] is None


def test_windows_take_the_first_tick_and_leave_the_last() -> None:
    run = recording(time=TIME, x=TIME)
    assert basic.maximum(run, column="x", after=2.0, before=3.0) == pytest.approx(2.99)
    assert basic.mean(run, column="x", after=2.0, before=3.0) == pytest.approx(2.495)
    assert basic.max_abs(run, column="x") == pytest.approx(9.99)


def test_max_abs_sees_negative_peaks() -> None:
    assert basic.max_abs(recording(time=TIME, x=-TIME), column="x") == pytest.approx(9.99)


def test_minimum_is_the_least_value_of_the_window() -> None:
    run = recording(time=TIME, x=-TIME)
    assert basic.minimum(run, column="x", before=3.0) == pytest.approx(-2.99)


def test_max_abs_while_looks_where_the_flag_is_set_and_is_nan_where_it_never_is() -> None:
    run = recording(time=TIME, x=-TIME, flag=TIME < 2.005, never=np.zeros(1000))
    assert basic.max_abs_while(run, column="x", flag="flag") == pytest.approx(2.0)
    assert math.isnan(basic.max_abs_while(run, column="x", flag="never"))


def test_lowest_change_is_negative_once_the_column_falls_below_its_start() -> None:
    column = np.full(1000, 10.0)
    assert basic.lowest_change(recording(time=TIME, E=column), column="E") == 0.0
    column[500] = 9.5
    assert basic.lowest_change(recording(time=TIME, E=column), column="E") == -0.5


def test_the_largest_step_is_that_into_a_tick_of_the_window() -> None:
    x = np.zeros(1000)
    x[200:] = 1.0  # into t = 2.00 s
    x[300:] = -4.0
    run = recording(time=TIME, x=x, y=0.1 * TIME)
    assert basic.largest_step(run, columns=("x", "y"), after=2.0, before=3.0) == 1.0
    assert basic.largest_step(run, columns=("x",), after=2.01, before=3.0) == 0.0
    assert basic.largest_step(run, columns=("y",), after=0.0, before=3.0) == pytest.approx(0.001)
    assert basic.largest_step(run, columns=("y", "x"), after=2.5, before=3.01) == 5.0


def test_the_farthest_is_a_distance_from_the_first_tick_of_the_window() -> None:
    # Three quarters of a circle of radius 2 m about (2, 0) from t = 0 on: the far side is 4 m away.
    angle = np.pi + 1.5 * np.pi * TIME / TIME[-1]
    run = recording(time=TIME, x=2.0 + 2.0 * np.cos(angle), y=2.0 * np.sin(angle))
    assert basic.farthest(run, columns=("x", "y"), after=0.0) == pytest.approx(4.0)
    assert basic.farthest(run, columns=("y",), after=0.0) == pytest.approx(2.0)
    half = TIME[-1] / 2
    chord = 4.0 * np.sin(0.75 * np.pi / 2)  # three quarters of half a turn
    assert basic.farthest(run, columns=("x", "y"), after=half) == pytest.approx(chord, rel=1e-3)
    assert basic.farthest(run, columns=("x",), after=1.0, before=1.005) == 0.0


def test_ticks_until_counts_from_the_first_tick_of_the_window() -> None:
    state = np.where(TIME < 5.0, 3, 6)
    run = recording(time=TIME, state=state)
    assert events.ticks_until(run, column="state", value=6, after=4.0) == 100.0
    assert events.ticks_until(run, column="state", value=6, after=5.0) == 0.0
    assert math.isnan(events.ticks_until(run, column="state", value=2, after=0.0))


def test_rise_is_taken_above_the_mean_of_its_own_window() -> None:
    run = recording(time=TIME, z=np.where(TIME < 5.0, 1.0, 1.0 + 0.1 * (TIME - 5.0)))
    value = basic.rise(run, column="z", after=6.0, before=8.0, above_mean=(1.0, 4.0))
    assert value == pytest.approx(0.299)
    assert basic.peak_to_peak(run, column="z", after=6.0, before=8.0) == pytest.approx(0.199)


def test_leaving_delay_counts_from_after_and_is_nan_for_what_stays() -> None:
    z = np.where(TIME < 7.0, 0.5, 0.503)
    z[450] = 0.6
    run = recording(time=TIME, z=z)
    arguments = {"position": "z", "after": 5.0, "above_mean": (1.0, 4.0)}
    assert events.leaving_delay(run, margin=0.002, **arguments) == pytest.approx(2.0)
    assert math.isnan(events.leaving_delay(run, margin=0.004, **arguments))


def test_least_peak_to_peak_is_that_of_the_quietest_span_of_its_window() -> None:
    # A swing of ±1 that is ±0.25 from 4 to 6 s, and rests from 9 s on.
    size = np.where((TIME >= 4.0) & (TIME < 6.0), 0.25, np.where(TIME < 9.0, 1.0, 0.0))
    run = recording(time=TIME, x=size * np.sin(2.0 * np.pi * TIME))
    assert basic.least_peak_to_peak(run, column="x", span=1.0, before=9.0) == pytest.approx(0.5)
    assert basic.least_peak_to_peak(run, column="x", span=1.0, before=4.0) == pytest.approx(2.0)
    assert basic.least_peak_to_peak(run, column="x", span=3.0, before=9.0) > 1.0
    assert basic.least_peak_to_peak(run, column="x", span=1.0) == 0.0


def test_time_above_counts_the_ticks_above_a_level() -> None:
    run = recording(time=TIME, x=np.where((TIME >= 2.0) & (TIME < 3.5), 1.0, 0.5))
    assert basic.time_above(run, column="x", level=0.5) == pytest.approx(1.5)
    assert basic.time_above(run, column="x", level=0.0) == pytest.approx(10.0)
    assert basic.time_above(run, column="x", level=1.0) == 0.0


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_return_delay_counts_from_the_turn_on_either_side_and_is_nan_for_what_stays_away(side: float) -> None:
    z = 0.4 + side * np.where(TIME < 5.0, TIME, np.maximum(10.0 - TIME, -1.0))  # out, and home at 10 s
    z[TIME > 8.0] = 0.4 - side * 0.01
    assert events.return_delay(recording(time=TIME, z=z), column="z", at=6.0) == pytest.approx(2.01)
    assert math.isnan(events.return_delay(recording(time=TIME, z=z + side * 20.0 * (TIME > 1.0)), column="z", at=6.0))


def test_mean_rate_is_taken_between_two_ticks() -> None:
    run = recording(time=TIME, z=TIME**2)
    assert basic.mean_rate(run, column="z", first=2.0, last=4.0) == pytest.approx(6.0)


def test_jump_is_what_goes_beyond_the_velocity_before() -> None:
    z = 0.3 * TIME + np.where(TIME < 4.0, 0.0, 0.02 * (1.0 - np.exp(-10.0 * (TIME - 4.0))))
    run = recording(time=TIME, z=z, dz=np.full(1000, 0.3))
    value = events.jump(run, position="z", velocity="dz", at=4.0, within=2.0)
    assert value == pytest.approx(0.02, rel=1e-6)


@pytest.mark.parametrize("sigma", [-1.3, 0.4])
def test_the_growth_rate_of_a_known_swing_is_found(sigma: float) -> None:
    swing = 0.44 + 1e-4 * np.exp(sigma * TIME) * np.sin(9.0 * TIME + 0.7)
    run = recording(time=TIME, x=swing)
    assert growth.growth_rate(run, column="x", after=2.0, before=6.0) == pytest.approx(sigma, abs=1e-6)


def test_spring_share_is_that_of_the_worst_axis() -> None:
    names = {"K": (1000.0, 1000.0, 500.0), "K_P": (20.0, 20.0, 20.0), "f_max": (400.0, 400.0, 100.0)}
    parameters = {f"c.{name}[{i}]": x for name, xs in names.items() for i, x in enumerate(xs, start=1)}
    errors = {"c__e_nr[1]": [0.0, 0.01], "c__e_nr[2]": [-0.015, 0.0], "c__e_nr[3]": [0.001, -0.0095]}
    run = recording(time=TIME[:2], parameters=parameters, **errors)
    # 200/400, 300/400, 95/100 N.
    assert coupling.spring_share(run, controller="c") == pytest.approx(0.95)


def test_drift_is_compared_with_the_reaction_of_the_load() -> None:
    parameters = {"c.K[3]": 1000.0, "c.D_n[3]": 20.0, "c.alpha": 1.0}
    columns = {"c__p[3]": -0.01 * TIME, "c__f_a[3]": np.full(1000, 180.0)}
    run = recording(time=TIME, parameters=parameters, **columns)
    value = coupling.drift_over_prediction(run, controller="c", axis=3, moving=(2.0, 5.0), loaded=(4.0, 5.0))
    assert value == pytest.approx(0.01 / 0.009)


def test_only_a_loss_under_vacuum_is_a_break() -> None:
    held = np.array([False, True, True, False, True, True, False])
    vacuum = np.array([True, True, True, True, True, True, False])
    run = recording(time=TIME[:7], held=held, vacuum=vacuum)
    assert events.bond_breaks(run, attached="held", vacuum="vacuum") == 1.0


def test_the_residual_is_shared_over_the_work_that_went_through() -> None:
    # Work back and forth counts both ways: 3 J, then 1 J of another.
    run = recording(time=TIME[:3], r=[0.0, -0.02, 0.01], a=[0.0, 2.0, 1.0], b=[0.0, 0.0, 1.0])
    assert basic.residual_share(run, residual="r", works=("a", "b")) == pytest.approx(0.005)
    idle = recording(time=TIME[:3], r=np.zeros(3), a=np.zeros(3))
    assert math.isnan(basic.residual_share(idle, residual="r", works=("a",)))


def test_spring_force_takes_the_gains_from_the_run() -> None:
    run = recording(time=TIME[:3], e=[0.0, -0.05, 0.01], parameters={"K": 30.0, "K_P": 10.0})
    assert coupling.max_spring_force(run, error="e", K="K", K_P="K_P") == pytest.approx(15.0)


def test_the_fit_finds_amplitude_and_phase() -> None:
    omega = 2.0 * math.pi * 0.4
    phasor = response.fit_phasor(time=TIME, signal=0.3 * np.sin(omega * TIME - 0.7), omega=omega)
    assert abs(phasor) == pytest.approx(0.3, rel=1e-12)
    assert np.angle(phasor) == pytest.approx(-0.7, rel=1e-12)


@pytest.mark.parametrize(
    ("mask", "expected"), [([0, 1, 1, 0, 1, 1, 1, 0], [4, 5, 6]), ([1, 1, 0, 1], [0, 1]), ([0, 0], []), ([1], [0])]
)
def test_longest_stretch(mask: list[int], expected: list[int]) -> None:
    assert wall.longest_stretch(np.array(mask, dtype=bool)).tolist() == expected


def wall_run(*, M_n: float) -> object:
    """A mass that rests at a wall while the nominal follows its closed form, M_n = 10 kg, from e = 0.2 m."""
    force = np.full(1000, 5.0)
    e = theory.error_at_a_wall(time=TIME, f_h=force, e=0.2, de=-0.1, M_n=10.0, D_n=0.5, K_P=10.0, alpha=1.0)
    names = {"M_n": M_n, "D_n": 0.5, "K_P": 10.0, "alpha": 1.0}
    return recording(
        time=TIME,
        parameters={f"c.{name}": value for name, value in names.items()},
        c__e_nr=e,
        c__dq_n=np.full(1000, -0.1),
        c__tau_h=force,
        p__dq=np.zeros(1000),
        p__tau_e=np.full(1000, -12.5),
    )


ARGUMENTS = {
    "controller": "c",
    "plant": "p",
    "after": 0.0,
    "before": 10.0,
    "rest_speed": 0.001,
    "at_least": 2.0,
    "force": 5.0,
}


def test_the_wall_curve_fits_its_own_nominal_and_no_other() -> None:
    assert wall.wall_curve_error(wall_run(M_n=10.0), **ARGUMENTS) < 1e-12
    assert wall.wall_curve_error(wall_run(M_n=9.8), **ARGUMENTS) > 0.01


def test_the_wall_curve_of_a_mass_that_does_not_rest_is_nan() -> None:
    run = wall_run(M_n=10.0)
    run["p.dq"][::150] = 0.01
    assert math.isnan(wall.wall_curve_error(run, **ARGUMENTS))


def test_the_wall_curve_obeys_the_textbook_solution() -> None:
    # Underdamped second order from rest: e = F/k (1 − exp(−ζωt)(cos ω_d t + ζ/√(1 − ζ²) sin ω_d t)); the paper's worst
    # case has ω = 1 rad/s, ζ = 0.075, time constant 13.3 s.
    omega, zeta = 1.0, 0.075
    damped = omega * math.sqrt(1.0 - zeta**2)
    decay = np.exp(-zeta * omega * TIME)
    swing = np.cos(damped * TIME) + zeta / math.sqrt(1.0 - zeta**2) * np.sin(damped * TIME)
    curve = theory.error_at_a_wall(
        time=TIME, f_h=np.full(1000, 5.0), e=0.0, de=0.0, M_n=10.0, D_n=0.5, K_P=10.0, alpha=1.0
    )
    assert curve == pytest.approx(0.5 * (1.0 - decay * swing), abs=1e-12)
    assert 1.0 / (zeta * omega) == pytest.approx(13.3, abs=0.05)


def test_the_sampled_loop_tends_to_the_continuous_one_with_first_order() -> None:
    def distance(T: float) -> float:
        loop = theory.Loop(M=6.0, M_n=5.0, D_n=0.5, K=30.0, K_P=10.0, alpha=1.0, T=T, substep=T / 25.0)
        return abs(theory.sampled(loop=loop, omega=5.0) / theory.continuous(loop=loop, omega=5.0) - 1.0)

    assert distance(1e-3) < 0.01
    assert distance(1e-3) / distance(5e-4) == pytest.approx(2.0, rel=0.02)


def test_the_dc_gain_of_the_corrected_transfer_function() -> None:
    loop = theory.Loop(M=6.0, M_n=5.0, D_n=0.5, K=30.0, K_P=10.0, alpha=1.0, T=0.002, substep=8e-5)
    assert theory.continuous(loop=loop, omega=1e-9) == pytest.approx((1.0 + 1.0 / 30.0) / 0.5, rel=1e-6)


def test_a_response_of_more_than_one_sine_is_refused() -> None:
    run = recording(time=TIME, f=TIME, v=TIME)
    sine = Segment(kind="sine", frequency=1.0)
    object.__setattr__(run, "profiles", {"two": (sine, sine)})
    with pytest.raises(ValueError, match="too many values"):
        response.measured_response(run, force="f", velocity="v", profile="two", after=0.0)


def test_the_desired_mass_is_the_robot_s_own_under_natural_only() -> None:
    parameters = {"c.comparator.M": 6.0, "c.M_n": 5.0}
    for law, mass in (("natural", 6.0), ("sliding_mode", 5.0), ("passive", 5.0)):
        run = recording(time=TIME, parameters=parameters, choices={"c.law": law})
        assert loops.desired_mass(run, controller="c") == mass


def test_a_metric_takes_the_components_that_it_is_told() -> None:
    names = {"M_n": 5.0, "D_n": 0.5, "K": 30.0, "K_P": 10.0, "alpha": 1.0, "T": 0.01}
    parameters = {f"left.{name}": value for name, value in names.items()} | {"mass.M": 6.0, "mass.substep": 4e-4}
    parameters["hand.k_h"] = 50.0
    expected = theory.hand_growth_rate(loop=theory.Loop(M=6.0, substep=4e-4, **names), k_h=50.0)
    swing = 1e-4 * np.exp(expected * TIME) * np.sin(3.0 * TIME)
    run = recording(time=TIME, parameters=parameters, choices={"left.law": "passive"}, x=swing)
    arguments = {"column": "x", "after": 1.0, "before": 6.0, "controller": "left", "plant": "mass", "operator": "hand"}
    assert growth.testbed_hand_growth_error(run, **arguments) < 1e-6
    called = metrics.evaluate(recording=run, function="testbed_hand_growth_error", arguments=arguments, owner="here")
    assert called == growth.testbed_hand_growth_error(run, **arguments)
    with pytest.raises(ExoError, match="plant"):
        metrics.evaluate(
            recording=run,
            function="testbed_hand_growth_error",
            arguments={key: value for key, value in arguments.items() if key != "plant"},
            owner="here",
        )


def test_unknown_columns_functions_and_arguments_name_what_is_known() -> None:
    run = recording(time=TIME, plant__q=TIME)
    with pytest.raises(ExoError, match=r"no recorded column plant\.x.*plant\.q"):
        basic.maximum(run, column="plant.x")
    with pytest.raises(ScenarioError, match=r"wall: unknown function maximal.*maximum"):
        metrics.check(function="maximal", arguments={}, owner="wall")
    with pytest.raises(ScenarioError, match="wall: maximum: got an unexpected keyword argument 'befor'"):
        metrics.check(function="maximum", arguments={"column": "q", "befor": 1.0}, owner="wall")


@pytest.mark.parametrize(
    ("check", "good", "bad"),
    [
        (Check(value=10.0, within=0.5), 10.5, 10.6),
        (Check(value=-10.0, relative=0.01), -10.1, -10.2),
        (Check(at_most=1e-9), 1e-9, 2e-9),
        (Check(at_most=12.5, within=1e-12), 12.5 + 9e-13, 12.5 + 2e-12),
        (Check(at_least=0.0), 0.0, -1e-15),
    ],
)
def test_verdicts_turn_at_the_tolerance(check: Check, good: float, bad: float) -> None:
    for value, verdict in ((good, "pass"), (bad, "fail")):
        assert judge(metric="m", title="", value=value, unit="", check=check, source="").verdict == verdict


def test_without_an_expectation_a_number_is_information() -> None:
    assert judge(metric="m", title="", value=1.0, unit="", check=Check(), source="").verdict == "info"


def test_an_l2_gain_is_a_quotient_of_norms_and_infinite_where_nothing_drives() -> None:
    run = recording(time=TIME, a=np.full(1000, 3.0), b=np.full(1000, -4.0), u=np.full(1000, 2.0), none=np.zeros(1000))
    assert theorems.l2_square(run, columns=("a", "b"), after=2.0, before=4.0) == pytest.approx(50.0)
    assert theorems.l2_gain(run, outputs=("a", "b"), inputs=("u",)) == pytest.approx(2.5)
    assert theorems.l2_gain(run, outputs=("a",), inputs=("none",)) == math.inf
    assert math.isnan(theorems.l2_gain(run, outputs=("none",), inputs=("none",)))


def test_the_rise_of_a_first_order_lag_takes_its_time_constant_and_does_not_overshoot() -> None:
    step = np.where(TIME >= 1.0, 5.0, 0.0)
    lag = step * (1.0 - np.exp(-(TIME - 1.0) / 0.5))
    run = recording(time=TIME, step=step, lag=lag, above=1.2 * step)
    rise = theorems.rise_time(run, column="lag", of="step", after=1.0, share=1.0 - math.exp(-1.0))
    assert rise == pytest.approx(0.5, abs=0.011)  # a tick
    assert math.isnan(theorems.rise_time(run, column="lag", of="step", after=1.0, share=2.0))
    assert theorems.overshoot(run, column="lag", of="step", after=1.0) < 0.0
    assert theorems.overshoot(run, column="above", of="step", after=1.0) == pytest.approx(0.2)


def test_what_is_left_at_the_end_is_a_share_of_the_largest() -> None:
    run = recording(time=TIME, x=-np.exp(-TIME))
    assert theorems.left_at_the_end(run, column="x", last=1.0) == pytest.approx(math.exp(-8.99), rel=0.02)


def test_a_swing_that_grows_is_told_from_one_that_decays() -> None:
    run = recording(
        time=TIME, up=np.exp(0.1 * TIME) * np.sin(3.0 * TIME), down=np.exp(-0.1 * TIME) * np.sin(3.0 * TIME)
    )
    assert impedance.grows(run, column="up") == 1.0
    assert impedance.grows(run, column="down") == 0.0


def test_an_impedance_is_found_from_several_sines_at_once() -> None:
    # Z = 2 s + 3 for the robot, and a hand of 4 N·s/m beside it.
    time = np.arange(20_000) * 1e-3
    omega = 2.0 * math.pi * np.array([0.5, 2.0])
    turns = np.outer(time, omega)
    dq = np.sin(turns).sum(axis=1)
    tau_h = (2.0 * omega * np.cos(turns) + 3.0 * np.sin(turns)).sum(axis=1)
    parameters = {f"operator.segment[{i}].amplitude": float(i in (2, 5)) for i in range(1, 17)}
    parameters |= {"operator.segment[2].frequency": 0.5, "operator.segment[5].frequency": 2.0}
    columns = {"plant__dq": dq, "controller__tau_h": tau_h, "operator__f_profile[1]": tau_h + 4.0 * dq}
    run = recording(time=time, parameters=parameters, **columns)
    who = {"controller": "controller", "plant": "plant", "operator": "operator", "after": 10.0}
    found = impedance.impedance_of(run, **who)
    assert found.robot == pytest.approx(2j * omega + 3.0, rel=1e-9)
    assert found.held == pytest.approx(2j * omega + 7.0, rel=1e-9)
    assert impedance.apparent_mass(run, **who, frequency=2.1) == pytest.approx(2.0)
    assert impedance.least_resistance(run, **who) == pytest.approx(3.0)
    assert impedance.least_conductance(run, **who) == pytest.approx(3.0 / math.hypot(3.0, 2.0 * omega[1]))
