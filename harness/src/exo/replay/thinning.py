"""Which instants of a run are kept, so that straight lines between them show what happened."""

from collections.abc import Iterable, Sequence

import numpy as np
from numpy.typing import NDArray

#: Frames a second that a screen shows; what is shorter is no motion that an eye follows.
FRAMES = 50.0


def kept(
    *,
    time: NDArray[np.float64],
    columns: Sequence[tuple[NDArray[np.float64], float]],
    events: Iterable[NDArray[np.bool_]] = (),
    peaks: Iterable[NDArray[np.float64]] = (),
    coarser: float = 1.0,
) -> NDArray[np.intp]:
    """Ticks to keep, ascending; the first and the last one are among them.

    `columns` are values and the distance from the straight line that is allowed to each, times `coarser`. Where one of
    the `events` changes, the ticks on both sides stay, the first and the last change of a frame; so does in each
    frame that has a change the largest of each of the `peaks`.
    """
    step = float(time[1] - time[0])
    frame = max(1, round(1.0 / (FRAMES * step)))
    fixed = _instants(events, peaks, frame, len(time))
    candidates = np.unique(np.concatenate([np.arange(0, len(time), frame), [len(time) - 1], fixed])).astype(np.intp)
    must = np.isin(candidates, fixed)
    scaled = np.column_stack([values[candidates] / (tolerance * coarser) for values, tolerance in columns])
    return candidates[straightened(time[candidates], scaled, must)]


def _instants(
    events: Iterable[NDArray[np.bool_]], peaks: Iterable[NDArray[np.float64]], frame: int, count: int
) -> NDArray[np.intp]:
    found: set[int] = set()
    for event in events:
        changes = np.flatnonzero(np.diff(event.astype(np.int8))) + 1
        bins = changes // frame
        first = np.flatnonzero(np.diff(bins, prepend=-1))
        last = np.append(first[1:] - 1, len(changes) - 1) if len(changes) else first
        for tick in changes[np.union1d(first, last)]:
            found |= {int(tick) - 1, int(tick)}
    for values in peaks:
        for begin in {tick // frame * frame for tick in list(found)}:
            found.add(begin + int(np.argmax(np.abs(values[begin : min(begin + frame, count)]))))
    return np.array(sorted(found), dtype=np.intp)


def straightened(time: NDArray[np.float64], scaled: NDArray[np.float64], must: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Ramer, Douglas and Peucker's choice for all columns at once: which rows stay, so that no value is farther than 1
    from the straight line between the rows that stay."""
    stay = must.copy()
    stay[[0, -1]] = True
    ends = np.flatnonzero(stay)
    # Rows that are not settled, and between which of those that stay each of them lies.
    rows = np.flatnonzero(~stay)
    after = np.searchsorted(ends, rows)
    begin, end = ends[after - 1], ends[after]
    while len(rows):
        share = ((time[rows] - time[begin]) / (time[end] - time[begin]))[:, None]
        line = scaled[begin] + share * (scaled[end] - scaled[begin])
        distance = np.max(np.abs(scaled[rows] - line), axis=1)
        starts = np.flatnonzero(np.diff(begin, prepend=-1))
        lengths = np.diff(starts, append=len(rows))
        worst = np.maximum.reduceat(distance, starts)
        hits = np.flatnonzero((distance > 1.0) & (distance == np.repeat(worst, lengths)))
        _, first = np.unique(begin[hits], return_index=True)
        # Of each stretch the row that splits it; -1 where all are near enough.
        splits = np.full(len(starts), -1)
        splits[worst > 1.0] = rows[hits[first]]
        stay[rows[hits[first]]] = True
        middle = np.repeat(splits, lengths)
        left = rows < middle
        begin, end = np.where(left, begin, middle), np.where(left, middle, end)
        unsettled = (middle >= 0) & (rows != middle)
        rows, begin, end = rows[unsettled], begin[unsettled], end[unsettled]
    return stay
