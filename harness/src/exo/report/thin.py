"""As few points of a signal as show it: its line stays where it was, and every peak is among the points.

MinMaxLTTB takes of each bin of ticks the extremes, and of these the points that keep the largest triangles. Where the
line through them is still off, the tick that lies farthest from it is added: a signal that rests needs few points, a
lively one many, and a jump its own two. Of one that needs too many the line may lie farther off, by the same
everywhere; and where that is not enough, points are taken evenly: the extremes of each bin, so that what it ranges over
is true at every time.
"""

import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

#: How far the line through the points may lie from the signal, as a share of the signal's range.
CLOSE = 1.0 / 4000.0
#: So much farther it may lie where it needs more points than there may be.
FARTHER = (1.0, 4.0, 16.0)
FEWEST, MOST = 128, 4096

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Window:
    """What a panel shows of a signal: from `left` to `right` (s), and no more than from `low` to `high`."""

    left: float = -math.inf
    right: float = math.inf
    low: float = -math.inf
    high: float = math.inf


def thin(time: Array, values: Array, windows: Iterable[Window] = ()) -> NDArray[np.intp]:
    """Indices of the points to keep, ascending: of all, and more of what is seen in each window.

    `time` (s) and `values`, shape (n,), are finite. First, last, smallest and largest point of all, and of each window,
    are kept.
    """
    picked = [_close(time, values, 0)]
    for window in dict.fromkeys(windows):
        first = int(np.searchsorted(time, window.left))
        last = min(int(np.searchsorted(time, window.right, side="right")) + 1, len(time))
        if last > first:
            seen = values[first:last].clip(window.low, window.high)
            picked.append(_close(time[first:last], seen, first))
    return np.unique(np.concatenate(picked))


def _close(time: Array, values: Array, start: int) -> NDArray[np.intp]:
    # Not when `exo` starts.
    from tsdownsample import MinMaxLTTBDownsampler  # noqa: PLC0415

    if len(values) <= FEWEST:
        return np.arange(start, start + len(values))
    thinner: Any = MinMaxLTTBDownsampler()  # type: ignore[no-untyped-call]

    def even(count: int) -> NDArray[np.intp]:
        chosen = thinner.downsample(np.ascontiguousarray(values), n_out=count).astype(np.intp)
        return np.union1d(chosen, [0, len(values) - 1, values.argmin(), values.argmax()]).astype(np.intp)

    begin = even(FEWEST)
    for farther in FARTHER:
        found = _within(time, values, begin, farther * CLOSE * float(np.ptp(values)))
        if found is not None:
            return found + start
    return even(min(MOST, len(values))) + start


def _within(time: Array, values: Array, begin: NDArray[np.intp], allowed: float) -> NDArray[np.intp] | None:
    """From the points of `begin` on as many as keep the line within `allowed`; None, where MOST are too few."""
    found = begin
    while len(found) <= MOST:
        off = np.abs(np.interp(time, time[found], values[found]) - values)
        far = np.flatnonzero(off > allowed)
        if not len(far):
            return found
        # Of each gap the tick that lies farthest from the line.
        gap = np.searchsorted(found, far)
        order = np.lexsort((off[far], gap))
        found = np.union1d(found, far[order[np.append(np.diff(gap[order]) > 0, True)]]).astype(np.intp)
    return None


def farther(time: Array, values: Array, kept: NDArray[np.intp], windows: Iterable[Window] = ()) -> float:
    """How far, in its unit, the line through the points `kept` lies from what the windows show of a signal, at most;
    0 where it lies as close as it is meant to."""
    line = np.interp(time, time[kept], values[kept])
    most = 0.0
    for window in dict.fromkeys(windows) or (Window(),):
        seen = (time >= window.left) & (time <= window.right)
        shown = values[seen].clip(window.low, window.high)
        off = float(np.max(np.abs(line[seen].clip(window.low, window.high) - shown), initial=0.0))
        # Half as much again: a window's last points lie outside.
        if len(shown) and off > 1.5 * CLOSE * float(np.ptp(shown)):
            most = max(most, off)
    return most
