"""As few points of a signal as show it: its line stays where it was, and every peak is among the points.

MinMaxLTTB takes of each bin of ticks the extremes, and of these the points that keep the largest triangles. Where the
line through them is still off, the tick that lies farthest from it is added: a signal that rests needs few points, a
lively one many, and a jump its own two.
"""

import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

#: How far the line through the points may lie from the signal, as a share of the signal's range.
CLOSE = 1.0 / 4000.0
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
    chosen = thinner.downsample(np.ascontiguousarray(values), n_out=FEWEST).astype(np.intp)
    found = np.union1d(chosen, [0, len(values) - 1, values.argmin(), values.argmax()])
    allowed = CLOSE * float(np.ptp(values))
    while len(found) < MOST:
        off = np.abs(np.interp(time, time[found], values[found]) - values)
        far = np.flatnonzero(off > allowed)
        if not len(far):
            break
        # Of each gap the tick that lies farthest from the line; if they are too many, the worst of them.
        gap = np.searchsorted(found, far)
        order = np.lexsort((off[far], gap))
        worst = far[order[np.append(np.diff(gap[order]) > 0, True)]]
        worst = worst[np.argsort(-off[worst], kind="stable")][: MOST - len(found)]
        found = np.union1d(found, worst)
    return found.astype(np.intp) + start
