"""When something happens: leaving a wall, reaching a state, losing a payload; and what a loss does to the hand."""

import math

import numpy as np

from exo.metrics.basic import values, window
from exo.metrics.registry import metric
from exo.recording import Recording


@metric
def release_delay(run: Recording, *, position: str, wall: str, margin: float, after: float) -> float:
    """Time from `after` to the first q < wall − margin (s). `wall` names the parameter with the wall's position."""
    free = window(run.time, after=after, before=None) & (run[position] < run.parameter(wall) - margin)
    return float(run.time[np.argmax(free)] - after) if free.any() else math.nan


@metric
def leaving_delay(
    run: Recording, *, position: str, margin: float, after: float, above_mean: tuple[float, float]
) -> float:
    """Time from `after` to the first position more than `margin` above its mean over `above_mean` (s, s)."""
    bound = np.mean(values(run, position, *above_mean)) + margin
    free = window(run.time, after=after, before=None) & (run[position] > bound)
    return float(run.time[np.argmax(free)] - after) if free.any() else math.nan


@metric
def return_delay(run: Recording, *, column: str, at: float) -> float:
    """Time (s) after `at` (s) until `column` is back at its first value, from either side. NaN if it stays away."""
    away = run[column] - run[column][0]
    since = window(run.time, after=at, before=None)
    back = since & (np.sign(away[np.argmax(since)]) * away <= 0.0)
    return float(run.time[np.argmax(back)] - at) if back.any() else math.nan


@metric
def ticks_until(run: Recording, *, column: str, value: float, after: float) -> float:
    """Number of ticks from `after` until the column first has this value."""
    since = np.flatnonzero(window(run.time, after=after, before=None))
    found = run[column][since] == value
    return float(np.argmax(found)) if found.any() else math.nan


@metric
def bond_breaks(run: Recording, *, attached: str, vacuum: str) -> float:
    """How often a held payload was lost while the vacuum was on."""
    held = run[attached]
    return float(np.count_nonzero(held[:-1] & ~held[1:] & run[vacuum][1:]))


@metric
def jump(run: Recording, *, position: str, velocity: str, at: float, within: float) -> float:
    """How far the position gets, within some time after `at` (s), ahead of going on with the velocity it had then."""
    ticks = np.flatnonzero(window(run.time, after=at, before=at + within))
    since = run.time[ticks] - run.time[ticks[0]]
    return float(np.max(run[position][ticks] - run[position][ticks[0]] - run[velocity][ticks[0]] * since))
