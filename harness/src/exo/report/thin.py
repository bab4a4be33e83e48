"""As few points of a signal as show it: its line stays where it was, and every peak is among the points.

MinMaxLTTB takes of each bin of ticks the extremes, and of these the points that keep the largest triangles. How many
points a signal needs depends on how lively it is: their number is doubled until the line lies close.
"""

from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray
from tsdownsample import MinMaxLTTBDownsampler

#: How far the line through the points may lie from the signal, as a share of the signal's range.
CLOSE = 1.0 / 500.0
FEWEST, MOST = 128, 2048

Window = tuple[float, float]


def thin(time: NDArray[np.float64], values: NDArray[np.float64], windows: Iterable[Window]) -> NDArray[np.intp]:
    """Indices of the points to keep, ascending: of all, and more of each window (s) that a panel shows.

    `time` (s) and `values`, shape (n,), are finite. First, last, smallest and largest point of each window are kept.
    """
    picked = [_close(time, values, 0)]
    for left, right in windows:
        first, last = np.searchsorted(time, [left, right])
        inside = slice(int(first), min(int(last) + 1, len(time)))
        if inside.stop - inside.start > 0 and inside != slice(0, len(time)):
            picked.append(_close(time[inside], values[inside], inside.start))
    return np.unique(np.concatenate(picked))


def _close(time: NDArray[np.float64], values: NDArray[np.float64], start: int) -> NDArray[np.intp]:
    ends = [0, len(values) - 1, int(values.argmin()), int(values.argmax())]
    allowed = CLOSE * float(np.ptp(values))
    count, found = FEWEST, np.unique(ends)
    while count <= MOST:
        if len(values) <= count:
            found = np.arange(len(values))
            break
        chosen = MinMaxLTTBDownsampler().downsample(np.ascontiguousarray(values), n_out=count)
        found = np.unique(np.concatenate([chosen.astype(np.intp), ends]))
        if np.abs(np.interp(time, time[found], values[found]) - values).max() <= allowed:
            break
        count *= 2
    return (found + start).astype(np.intp)
