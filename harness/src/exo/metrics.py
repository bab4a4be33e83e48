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

from exo import theory
from exo.errors import ScenarioError, close_matches
from exo.profile import SAME_INSTANT
from exo.recording import Recording

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
def max_abs(run: Recording, *, column: str, after: float | None = None, before: float | None = None) -> float:
    """Largest magnitude."""
    return float(np.max(np.abs(_values(run, column, after, before))))


@metric
def mean(run: Recording, *, column: str, after: float | None = None, before: float | None = None) -> float:
    """Mean value."""
    return float(np.mean(_values(run, column, after, before)))


@metric
def lowest_change(run: Recording, *, column: str) -> float:
    """min x − x(0): below zero when the column ever falls under its start."""
    return float(np.min(run[column]) - run[column][0])


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


def loop_of(run: Recording, *, controller: str, plant: str) -> theory.Loop:
    """The loop's parameters, as the FMUs held them."""
    names = {name: f"{controller}.{name}" for name in ("M_n", "D_n", "K", "K_P", "alpha", "T")}
    names |= {"M": f"{plant}.M", "substep": f"{plant}.substep"}
    return theory.Loop(**{name: run.parameter(key) for name, key in names.items()})


@metric
def response_error(
    run: Recording, *, theory_of: str, part: str, controller: str, plant: str, profile: str, after: float
) -> float:
    """Distance of the measured dq/τ_h from a closed form at the frequency of the profile's one sine.

    `theory_of`: `sampled` or `continuous`. `part`: `relative` |H/H₀ − 1|, `magnitude` ||H/H₀| − 1|, `phase` |arg H/H₀|
    (rad). The steady state is fitted over t ≥ after, by when the slow mode, about exp(−t D_n/M_n), must have died out.
    """
    measured, omega = measured_response(
        run, force=f"{controller}.tau_h", velocity=f"{plant}.dq", profile=profile, after=after
    )
    loop = loop_of(run, controller=controller, plant=plant)
    quotient = measured / theory.RESPONSES[theory_of](loop=loop, omega=omega)
    return {
        "relative": abs(quotient - 1.0),
        "magnitude": abs(abs(quotient) - 1.0),
        "phase": abs(math.atan2(quotient.imag, quotient.real)),
    }[part]
