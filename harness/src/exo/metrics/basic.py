"""What columns do in a window: extremes, means, rates, steps, and the residual of a balance."""

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from exo.metrics.registry import metric
from exo.profile import SAME_INSTANT
from exo.recording import Recording


def window(time: NDArray[np.float64], *, after: float | None, before: float | None) -> NDArray[np.bool_]:
    """Mask of the ticks after ≤ t < before."""
    mask = np.ones(len(time), dtype=bool)
    if after is not None:
        mask &= time >= after - SAME_INSTANT
    if before is not None:
        mask &= time < before - SAME_INSTANT
    return mask


def values(run: Recording, column: str, after: float | None, before: float | None) -> NDArray[Any]:
    """The column at the ticks of the window; all of it, not copied, without a window."""
    if after is None and before is None:
        return run[column]
    return run[column][window(run.time, after=after, before=before)]


@metric
def maximum(run: Recording, *, column: str, after: float | None = None, before: float | None = None) -> float:
    """Largest value."""
    return float(np.max(values(run, column, after, before)))


@metric
def minimum(run: Recording, *, column: str, after: float | None = None, before: float | None = None) -> float:
    """Least value."""
    return float(np.min(values(run, column, after, before)))


@metric
def max_abs(run: Recording, *, column: str, after: float | None = None, before: float | None = None) -> float:
    """Largest magnitude."""
    return float(np.max(np.abs(values(run, column, after, before))))


@metric
def max_abs_while(run: Recording, *, column: str, flag: str) -> float:
    """Largest magnitude at the ticks at which a Boolean is true; NaN when it never is."""
    values = run[column][run[flag] > 0.5]
    return float(np.max(np.abs(values))) if values.size else math.nan


@metric
def mean(run: Recording, *, column: str, after: float | None = None, before: float | None = None) -> float:
    """Mean value."""
    return float(np.mean(values(run, column, after, before)))


@metric
def peak_to_peak(run: Recording, *, column: str, after: float | None = None, before: float | None = None) -> float:
    """Largest less smallest value."""
    return float(np.ptp(values(run, column, after, before)))


@metric
def least_peak_to_peak(
    run: Recording, *, column: str, span: float, after: float | None = None, before: float | None = None
) -> float:
    """Least of largest less smallest value in any `span` (s) of the window."""
    spans = np.lib.stride_tricks.sliding_window_view(
        values(run, column, after, before), round(span / (run.time[1] - run.time[0]))
    )
    return float(np.min(np.ptp(spans, axis=1)))


@metric
def time_above(run: Recording, *, column: str, level: float) -> float:
    """Time at which the values are above `level`, s."""
    return float(np.sum(run[column] > level) * (run.time[1] - run.time[0]))


@metric
def rise(run: Recording, *, column: str, after: float, before: float, above_mean: tuple[float, float]) -> float:
    """Largest value in the window less the mean over `above_mean` (s, s)."""
    return float(np.max(values(run, column, after, before)) - np.mean(values(run, column, *above_mean)))


@metric
def mean_rate(run: Recording, *, column: str, first: float, last: float) -> float:
    """(x(last) − x(first))/(last − first), both instants being ticks."""
    k = [int(np.argmax(window(run.time, after=instant, before=None))) for instant in (first, last)]
    return float((run[column][k[1]] - run[column][k[0]]) / (run.time[k[1]] - run.time[k[0]]))


@metric
def lowest_change(run: Recording, *, column: str) -> float:
    """min x − x(0): below zero when the column ever falls under its start."""
    return float(np.min(run[column]) - run[column][0])


@metric
def largest_step(run: Recording, *, columns: tuple[str, ...], after: float, before: float) -> float:
    """Largest change of any of the columns from one tick to the next, the later of which lies in the window."""
    later = np.flatnonzero(window(run.time, after=after, before=before))
    later = later[later > 0]
    return max(float(np.max(np.abs(run[column][later] - run[column][later - 1]))) for column in columns)


@metric
def farthest(run: Recording, *, columns: tuple[str, ...], after: float, before: float | None = None) -> float:
    """Largest distance of a point, by its coordinates, from where it is at the first tick of the window."""
    track = np.array([values(run, column, after, before) for column in columns])
    return float(np.max(np.linalg.norm(track - track[:, :1], axis=0)))


@metric
def residual_share(run: Recording, *, residual: str, works: tuple[str, ...]) -> float:
    """Largest residual of an energy balance over the throughput: the total variation of all works; NaN if none."""
    throughput = sum(float(np.sum(np.abs(np.diff(run[work])))) for work in works)
    return float(np.max(np.abs(run[residual]))) / throughput if throughput else math.nan
