"""As few points of a signal as show it: its line stays where it was, and every peak is among the points.

MinMaxLTTB takes of each bin of ticks the extremes, and of these the points that keep the largest triangles. How many
points a signal needs depends on how lively it is: their number is doubled until the line lies close.
"""

import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

#: How far the line through the points may lie from the signal, as a share of the signal's range.
CLOSE = 1.0 / 1000.0
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

    thinner: Any = MinMaxLTTBDownsampler()  # type: ignore[no-untyped-call]
    ends = [0, len(values) - 1, int(values.argmin()), int(values.argmax())]
    allowed = CLOSE * float(np.ptp(values))
    count, found = FEWEST, np.unique(ends)
    while count <= MOST:
        if len(values) <= count:
            found = np.arange(len(values))
            break
        chosen = thinner.downsample(np.ascontiguousarray(values), n_out=count)
        found = np.unique(np.concatenate([chosen.astype(np.intp), ends]))
        if np.abs(np.interp(time, time[found], values[found]) - values).max() <= allowed:
            break
        count *= 2
    return (found + start).astype(np.intp)
