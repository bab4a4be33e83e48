"""Numbers from recordings: pure functions, found by name from a scenario's `function`.

All quantities are keyword-only and SI. A window takes the ticks after ≤ t < before. What does not happen is NaN, and a
NaN fails every check.
"""

import inspect
import math
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import least_squares

from exo import forms, theory
from exo.errors import ScenarioError, close_matches
from exo.profile import SAME_INSTANT
from exo.recording import Recording
from exo.tuning import region
from exo.tuning.machine import Gains, Machine

Function = Callable[..., float]
REGISTRY: dict[str, Function] = {}


def metric(function: Function) -> Function:
    """Registers a function under its name."""
    REGISTRY[function.__name__] = function
    return function


def evaluate(*, recording: Recording, function: str, arguments: Mapping[str, Any], owner: str) -> float:
    """Calls a registered function; unknown names and wrong arguments are errors that name `owner`."""
    check(function=function, arguments=arguments, owner=owner)
    return float(REGISTRY[function](recording, **arguments))


def check(*, function: str, arguments: Mapping[str, Any], owner: str) -> None:
    """Whether the function exists and takes these arguments."""
    if function not in REGISTRY:
        raise ScenarioError(f"{owner}: unknown function {function}{close_matches(function, REGISTRY)}")
    try:
        inspect.signature(REGISTRY[function]).bind(None, **arguments)
    except TypeError as error:
        raise ScenarioError(f"{owner}: {function}: {error}") from error


def window(time: NDArray[np.float64], *, after: float | None, before: float | None) -> NDArray[np.bool_]:
    """Mask of the ticks after ≤ t < before."""
    mask = np.ones(len(time), dtype=bool)
    if after is not None:
        mask &= time >= after - SAME_INSTANT
    if before is not None:
        mask &= time < before - SAME_INSTANT
    return mask


def _values(run: Recording, column: str, after: float | None, before: float | None) -> NDArray[Any]:
    return run[column][window(run.time, after=after, before=before)]


@metric
def maximum(run: Recording, *, column: str, after: float | None = None, before: float | None = None) -> float:
    """Largest value."""
    return float(np.max(_values(run, column, after, before)))


@metric
def minimum(run: Recording, *, column: str, after: float | None = None, before: float | None = None) -> float:
    """Least value."""
    return float(np.min(_values(run, column, after, before)))


@metric
def max_abs(run: Recording, *, column: str, after: float | None = None, before: float | None = None) -> float:
    """Largest magnitude."""
    return float(np.max(np.abs(_values(run, column, after, before))))


@metric
def mean(run: Recording, *, column: str, after: float | None = None, before: float | None = None) -> float:
    """Mean value."""
    return float(np.mean(_values(run, column, after, before)))


@metric
def peak_to_peak(run: Recording, *, column: str, after: float | None = None, before: float | None = None) -> float:
    """Largest less smallest value."""
    return float(np.ptp(_values(run, column, after, before)))


@metric
def rise(run: Recording, *, column: str, after: float, before: float, above_mean: tuple[float, float]) -> float:
    """Largest value in the window less the mean over `above_mean` (s, s)."""
    return float(np.max(_values(run, column, after, before)) - np.mean(_values(run, column, *above_mean)))


@metric
def leaving_delay(
    run: Recording, *, position: str, margin: float, after: float, above_mean: tuple[float, float]
) -> float:
    """Time from `after` to the first position more than `margin` above its mean over `above_mean` (s, s)."""
    bound = np.mean(_values(run, position, *above_mean)) + margin
    free = window(run.time, after=after, before=None) & (run[position] > bound)
    return float(run.time[np.argmax(free)] - after) if free.any() else math.nan


@metric
def mean_rate(run: Recording, *, column: str, first: float, last: float) -> float:
    """(x(last) − x(first))/(last − first), both instants being ticks."""
    k = [int(np.argmax(window(run.time, after=instant, before=None))) for instant in (first, last)]
    return float((run[column][k[1]] - run[column][k[0]]) / (run.time[k[1]] - run.time[k[0]]))


@metric
def jump(run: Recording, *, position: str, velocity: str, at: float, within: float) -> float:
    """How far the position gets, within some time after `at` (s), ahead of going on with the velocity it had then."""
    ticks = np.flatnonzero(window(run.time, after=at, before=at + within))
    since = run.time[ticks] - run.time[ticks[0]]
    return float(np.max(run[position][ticks] - run[position][ticks[0]] - run[velocity][ticks[0]] * since))


@metric
def growth_rate(run: Recording, *, column: str, after: float, before: float) -> float:
    """σ (1/s) of a swing c + exp(σ t) A sin(ω t + φ) fitted to the window by least squares."""
    shown = window(run.time, after=after, before=before)
    time, signal = run.time[shown] - after, run[column][shown]
    centered = signal - np.mean(signal)
    scaled = centered / np.max(np.abs(centered))
    crossings = int(np.count_nonzero(np.diff(np.signbit(scaled))))
    omega = math.pi * max(crossings, 1) / (before - after)

    def left(x: NDArray[np.float64]) -> NDArray[np.float64]:
        swing = x[3] * np.sin(x[2] * time) + x[4] * np.cos(x[2] * time)
        return np.asarray(x[0] + np.exp(x[1] * time) * swing - scaled)

    return float(least_squares(left, [0.0, 0.0, omega, 0.5, 0.5]).x[1])


@metric
def hand_growth_error(
    run: Recording, *, column: str, after: float, before: float, Lambda: float, damping: float = 0.0
) -> float:
    """Distance of the measured σ (1/s) from the closed form for a hand of stiffness k_h on an arm without friction, of
    mass `Lambda` (kg) along x, with `damping` (N·s/m) on top of D_n. Components are `controller`, `plant` and
    `operator`."""
    names = {"M_n": "Lambda_n[1]", "D_n": "D_n[1]", "K": "K[1]", "K_P": "K_P[1]", "alpha": "alpha", "T": "T"}
    gains = {name: run.parameter(f"controller.{key}") for name, key in names.items()}
    gains["D_n"] += damping
    loop = theory.Loop(M=Lambda, substep=run.parameter("plant.substep"), **gains)
    expected = theory.hand_growth_rate(loop=loop, k_h=run.parameter("operator.k_h"))
    return abs(growth_rate(run, column=column, after=after, before=before) - expected)


@metric
def lowest_change(run: Recording, *, column: str) -> float:
    """min x − x(0): below zero when the column ever falls under its start."""
    return float(np.min(run[column]) - run[column][0])


@metric
def max_abs_while(run: Recording, *, column: str, flag: str) -> float:
    """Largest magnitude at the ticks at which a Boolean is true; NaN when it never is."""
    values = run[column][run[flag] > 0.5]
    return float(np.max(np.abs(values))) if values.size else math.nan


@metric
def largest_step(run: Recording, *, columns: tuple[str, ...], after: float, before: float) -> float:
    """Largest change of any of the columns from one tick to the next, the later of which lies in the window."""
    later = np.flatnonzero(window(run.time, after=after, before=before))
    later = later[later > 0]
    return max(float(np.max(np.abs(run[column][later] - run[column][later - 1]))) for column in columns)


@metric
def ramp_excess(run: Recording, *, controller: str, after: float, before: float) -> float:
    """What a joint's torque step exceeds its bound by while the authority a rises over n ticks (N·m). With tau = a d
    tau_k − tau_{k−1} = (a_k − a_{k−1}) d_k + a_{k−1} (d_k − d_{k−1}): |step| ≤ |d_k|/n + a_{k−1} |d_k − d_{k−1}|."""
    later = np.flatnonzero(window(run.time, after=after, before=before))
    earlier = later - 1
    n = run.parameter(f"{controller}.engage_time") / run.parameter(f"{controller}.T")
    authority = run[f"{controller}.authority"][earlier]

    def excess(joint: int) -> float:
        tau, demand = run[f"{controller}.tau_a[{joint}]"], run[f"{controller}.tau_demand[{joint}]"]
        bound = np.abs(demand[later]) / n + authority * np.abs(demand[later] - demand[earlier])
        return float(np.max(np.abs(tau[later] - tau[earlier]) - bound))

    return max(excess(joint) for joint in (1, 2, 3))


@metric
def ticks_until(run: Recording, *, column: str, value: float, after: float) -> float:
    """Number of ticks from `after` until the column first has this value."""
    since = np.flatnonzero(window(run.time, after=after, before=None))
    found = run[column][since] == value
    return float(np.argmax(found)) if found.any() else math.nan


@metric
def release_delay(run: Recording, *, position: str, wall: str, margin: float, after: float) -> float:
    """Time from `after` to the first q < wall − margin (s). `wall` names the parameter with the wall's position."""
    free = window(run.time, after=after, before=None) & (run[position] < run.parameter(wall) - margin)
    return float(run.time[np.argmax(free)] - after) if free.any() else math.nan


@metric
def max_spring_force(run: Recording, *, error: str, K: str, K_P: str) -> float:
    """max |K K_P e_nr| (N): what the spring between nominal and robot ever asks for."""
    return run.parameter(K) * run.parameter(K_P) * float(np.max(np.abs(run[error])))


@metric
def spring_share(run: Recording, *, controller: str) -> float:
    """max |K K_P e_nr| / f_max over axes and ticks: 1 when the bound is reached."""
    return max(
        max_spring_force(run, error=f"{controller}.e_nr[{i}]", K=f"{controller}.K[{i}]", K_P=f"{controller}.K_P[{i}]")
        / run.parameter(f"{controller}.f_max[{i}]")
        for i in (1, 2, 3)
    )


@metric
def drift_over_prediction(
    run: Recording, *, controller: str, axis: int, moving: tuple[float, float], loaded: tuple[float, float]
) -> float:
    """Velocity of the handle over `moving` (s, s) divided by −α f_a/(K D_n), f_a its mean over `loaded` (s, s): what
    eq:obs_dyn says of a nominal on which nothing acts but the reaction of a constant load."""
    value = {name: run.parameter(f"{controller}.{name}[{axis}]") for name in ("K", "D_n")}
    f_a = np.mean(_values(run, f"{controller}.f_a[{axis}]", *loaded))
    predicted = -run.parameter(f"{controller}.alpha") * f_a / (value["K"] * value["D_n"])
    return mean_rate(run, column=f"{controller}.p[{axis}]", first=moving[0], last=moving[1]) / float(predicted)


@metric
def joint_drift_over_prediction(run: Recording, *, controller: str, joint: int, moving: tuple[float, float]) -> float:
    """Velocity of a joint over `moving` (s, s) divided by −α τ_a/(K D_n), τ_a its mean meanwhile: what eq:obs_dyn says
    of a nominal in joint space on which nothing acts but the reaction of a constant load."""
    K, D_n = run.parameter(f"{controller}.joint.K"), run.parameter(f"{controller}.joint.D_n[{joint}]")
    tau_a = np.mean(_values(run, f"{controller}.tau_a[{joint}]", *moving))
    predicted = -run.parameter(f"{controller}.alpha") * tau_a / (K * D_n)
    return mean_rate(run, column=f"{controller}.q[{joint}]", first=moving[0], last=moving[1]) / float(predicted)


@metric
def bond_breaks(run: Recording, *, attached: str, vacuum: str) -> float:
    """How often a held payload was lost while the vacuum was on."""
    held = run[attached]
    return float(np.count_nonzero(held[:-1] & ~held[1:] & run[vacuum][1:]))


@metric
def residual_share(run: Recording, *, residual: str, works: tuple[str, ...]) -> float:
    """Largest residual of an energy balance over the throughput: the total variation of all works; NaN if none."""
    throughput = sum(float(np.sum(np.abs(np.diff(run[work])))) for work in works)
    return float(np.max(np.abs(run[residual]))) / throughput if throughput else math.nan


@metric
def wall_curve_error(
    run: Recording,
    *,
    controller: str,
    plant: str,
    after: float,
    before: float,
    rest_speed: float,
    at_least: float,
    force: float,
) -> float:
    """Largest distance of e_nr from the closed form at the wall, as a share of F/(α K_P), F = `force`.

    The closed form holds while the mass rests at the wall, and a lightly damped nominal pulls it off again when it
    swings back. So the window is the longest stretch within after … before in which the mass touches the wall and is
    slower than `rest_speed` at every tick. e and de = dq_n − dq are taken from its first tick, and nothing is fitted.
    NaN when the stretch is shorter than `at_least` (s).
    """
    resting = window(run.time, after=after, before=before) & (run[f"{plant}.tau_e"] < 0.0)
    resting &= np.abs(run[f"{plant}.dq"]) < rest_speed
    ticks = longest_stretch(resting)
    if len(ticks) * run.step < at_least:
        return math.nan
    value = {name: run.parameter(f"{controller}.{name}") for name in ("M_n", "D_n", "K_P", "alpha")}
    e = run[f"{controller}.e_nr"][ticks]
    curve = theory.error_at_a_wall(
        time=run.time[ticks],
        f_h=run[f"{controller}.tau_h"][ticks],
        e=float(e[0]),
        de=float(run[f"{controller}.dq_n"][ticks[0]] - run[f"{plant}.dq"][ticks[0]]),
        **value,
    )
    return float(np.max(np.abs(e - curve))) / (force / (value["alpha"] * value["K_P"]))


def longest_stretch(mask: NDArray[np.bool_]) -> NDArray[np.intp]:
    """Indices of the longest uninterrupted run of True, the first of several."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], mask, [False]]).astype(np.int8)))
    if not len(edges):
        return np.arange(0)
    starts, ends = edges[::2], edges[1::2]
    longest = int(np.argmax(ends - starts))
    return np.arange(starts[longest], ends[longest])


def fit_phasor(*, time: NDArray[np.float64], signal: NDArray[np.float64], omega: float) -> complex:
    """P with signal ≈ Im(P exp(iωt)) in the least-squares sense."""
    basis = np.column_stack([np.sin(omega * time), np.cos(omega * time)])
    (a, b), *_ = np.linalg.lstsq(basis, signal, rcond=None)
    return complex(a, b)


def measured_response(
    run: Recording, *, force: str, velocity: str, profile: str, after: float
) -> tuple[complex, float]:
    """Velocity over force at the ticks (m/(N·s)) and the angular frequency (rad/s) of the profile's one sine, fitted
    over t ≥ after."""
    (sine,) = run.profiles[profile]
    omega = 2.0 * math.pi * sine.frequency
    steady = window(run.time, after=after, before=None)
    phasors = [fit_phasor(time=run.time[steady], signal=run[name][steady], omega=omega) for name in (velocity, force)]
    return phasors[0] / phasors[1], omega


RESPONSES = theory.RESPONSES | {"servo": forms.servo_response}


def comparator_of(run: Recording, *, k_h: float = 0.0) -> forms.Comparator:
    """The loop of a comparator, as the FMUs held it; components are `controller` and `plant`."""
    natural = run.parameter("controller.law") == 5
    return forms.Comparator(
        law="natural" if natural else "sliding_mode",
        M_n=run.parameter("controller.comparator.M" if natural else "controller.M_n"),
        H=run.parameter("controller.comparator.H"),
        **{name: run.parameter(f"controller.{name}") for name in ("D_n", "K", "K_P", "T")},
        **{name: run.parameter(f"plant.{name}") for name in ("M", "b", "substep")},
        k_h=k_h,
    )


@metric
def comparator_response_error(run: Recording, *, profile: str, after: float) -> float:
    """|H/H₀ − 1| of the measured dq/τ_h and the exact sampled loop of a comparator, at the profile's one sine."""
    measured, omega = measured_response(
        run, force="controller.tau_h", velocity="plant.dq", profile=profile, after=after
    )
    return abs(measured / forms.comparator_response(loop=comparator_of(run), omega=omega) - 1.0)


@metric
def model_error(run: Recording, *, profile: str, after: float) -> float:
    """|H (M_d iω + D_n) − 1|: how far the fundamental of the robot's motion is from the desired model's, which is
    1/(M_d s + D_n), with the robot's mass as M_d under `natural`."""
    measured, omega = measured_response(
        run, force="controller.tau_h", velocity="plant.dq", profile=profile, after=after
    )
    natural = run.parameter("controller.law") == 5
    mass = run.parameter("controller.comparator.M" if natural else "controller.M_n")
    return abs(measured * (mass * 1j * omega + run.parameter("controller.D_n")) - 1.0)


@metric
def testbed_hand_growth_error(run: Recording, *, column: str, after: float, before: float) -> float:
    """Distance of the measured σ (1/s) from the closed form, for a hand of stiffness k_h on the frictionless testbed:
    laws of the paper's kind and comparators. Components are `controller`, `plant` and `operator`."""
    k_h = run.parameter("operator.k_h")
    if run.parameter("controller.law") in (5, 6):
        expected = forms.comparator_growth_rate(loop=comparator_of(run, k_h=k_h))
    else:
        expected = theory.hand_growth_rate(loop=loop_of(run, controller="controller", plant="plant"), k_h=k_h)
    return abs(growth_rate(run, column=column, after=after, before=before) - expected)


def loop_of(run: Recording, *, controller: str, plant: str) -> theory.Loop:
    """The loop's parameters, as the FMUs held them."""
    names = {name: f"{controller}.{name}" for name in ("M_n", "D_n", "K", "K_P", "alpha", "T")}
    names |= {"M": f"{plant}.M", "substep": f"{plant}.substep"}
    return theory.Loop(**{name: run.parameter(key) for name, key in names.items()})


def machine_of(run: Recording) -> Machine:
    """The frictionless testbed and the hand on it, as the FMUs held them."""
    return Machine(
        T=run.parameter("controller.T"),
        delay=int(run.parameter("controller.delay")),
        M_min=run.parameter("plant.M"),
        M_max=run.parameter("plant.M"),
        k_h=run.parameter("operator.k_h"),
        b_h=run.parameter("operator.b_h"),
        hand_delay=run.parameter("operator.delay"),
        substep=run.parameter("plant.substep"),
    )


@metric
def tick_growth(run: Recording, *, column: str, after: float, before: float) -> float:
    """σ = ln|λ|/T (1/s) of the larger of two modes: x_{k+2} = a x_{k+1} + b x_k over the window by least squares. It
    also sees what changes its sign from tick to tick, and what does not swing."""
    x = _values(run, column, after, before)
    x = x / np.max(np.abs(x))
    (a, b), *_ = np.linalg.lstsq(np.column_stack([x[1:-1], x[:-2]]), x[2:], rcond=None)
    return float(np.log(np.max(np.abs(np.roots([1.0, -a, -b])))) / run.step)


@metric
def tick_growth_error(run: Recording, *, column: str, after: float, before: float) -> float:
    """Distance of `tick_growth` from the closed form's σ, as a share of it. Components: controller, plant, operator."""
    machine = machine_of(run)
    loop = loop_of(run, controller="controller", plant="plant")
    expected = theory.growth_rate(loop=loop, hand=machine.hand, delay=machine.delay)
    return abs(tick_growth(run, column=column, after=after, before=before) / expected - 1.0)


@metric
def boundary_share(run: Recording) -> float:
    """The hand's stiffness over the predicted limit; K over its limit where there is no hand."""
    machine = machine_of(run)
    gains = Gains(**{name: run.parameter(f"controller.{name}") for name in ("M_n", "D_n", "K", "K_P", "alpha")})
    if machine.k_h:
        return machine.k_h / region.hand_limit(machine=machine, gains=gains, M=machine.M_min)
    interval = region.gain_interval(machine=machine, gains=gains, M=machine.M_min)
    return gains.K / interval.high if interval else math.nan


@metric
def response_error(
    run: Recording, *, theory_of: str, part: str, controller: str, plant: str, profile: str, after: float
) -> float:
    """Distance of the measured dq/τ_h from a closed form at the frequency of the profile's one sine.

    `theory_of`: `sampled`, `continuous` or `servo`. `part`: `relative` |H/H₀ − 1|, `magnitude` ||H/H₀| − 1|, `phase`
    |arg H/H₀| (rad). The steady state is fitted over t ≥ after, by when the slow mode, about exp(−t D_n/M_n), must have
    died out.
    """
    measured, omega = measured_response(
        run, force=f"{controller}.tau_h", velocity=f"{plant}.dq", profile=profile, after=after
    )
    loop = loop_of(run, controller=controller, plant=plant)
    quotient = measured / RESPONSES[theory_of](loop=loop, omega=omega)
    return {
        "relative": abs(quotient - 1.0),
        "magnitude": abs(abs(quotient) - 1.0),
        "phase": abs(math.atan2(quotient.imag, quotient.real)),
    }[part]
