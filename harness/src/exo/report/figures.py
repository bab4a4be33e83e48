"""A section's figures: what each panel shows and how it looks, and the signals that they share, thinned.

The head of what is packed:

    range     [t0, t1] s, of all that is shown
    series    of each signal: case, column, unit, n, step (s), and off where its line lies off it; its block is n ticks
              (uint32, each as the distance from the one before) and n values (float32)
    figures   in the scenario's order; one that is no time plot is a picture: `still` is the number of its bytes
"""

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.parquet
from numpy.typing import NDArray

from exo.curves import printed
from exo.errors import ExoError
from exo.looks import BANDS, DASHES, SOLID, Look, looks
from exo.report import packed, thin
from exo.scenario import Bands, Figure

#: Case and column.
Key = tuple[str, str]
#: So many gaps of a signal are shown.
MOST_GAPS = 256
NOT_BOUND = (-math.inf, math.inf)


@dataclass
class Signal:
    """Ticks and values at them, shape (n,): tick k is at k·step (s). The windows are what panels show."""

    ticks: NDArray[np.int64]
    values: NDArray[np.float64]
    step: float
    unit: str
    windows: list[thin.Window] = field(default_factory=list)
    #: How far the line lies from the signal, in its unit, where it has needed more points than there may be.
    off: float = 0.0

    @property
    def time(self) -> NDArray[np.float64]:
        """Instants of the ticks (s)."""
        return np.asarray(self.ticks * self.step, dtype=np.float64)

    def thinned(self) -> "Signal":
        """With the points alone that show it."""
        gaps = np.flatnonzero(np.isnan(self.values))
        kept = [gaps.astype(np.intp)]
        off = 0.0
        # No line is drawn over a gap: what lies before it and behind it are thinned apart.
        for start, end in zip(np.append(0, gaps + 1), np.append(gaps, len(self.values)), strict=True):
            if end > start:
                piece = (self.time[start:end], self.values[start:end])
                chosen = thin.thin(*piece, self.windows)
                off = max(off, thin.farther(*piece, chosen, self.windows))
                kept.append(chosen + start)
        points = np.sort(np.concatenate(kept))
        return Signal(self.ticks[points], self.values[points], self.step, self.unit, self.windows, off)


def pack(folder: Path, figures: tuple[Figure, ...]) -> str:
    """Figures and signals of the results in `folder`, packed. ExoError: a figure's file is missing or none."""
    signals = {key: signal.thinned() for key, signal in _signals(folder, figures).items()}
    numbers = {key: i for i, key in enumerate(signals)}
    blocks = [block for signal in signals.values() for block in _blocks(signal)]
    shown: list[dict[str, Any]] = []
    for figure in figures:
        drawn: dict[str, Any] = {"id": figure.id, "title": figure.title, "label": figure.label}
        if figure.kind == "panels":
            drawn |= {"columns": figure.columns, "x": figure.x_label, "panels": list(_panels(figure, numbers))}
        else:
            blocks.append(_bytes(folder / f"{figure.id}.png"))
            drawn["still"] = len(blocks[-1])
        shown.append(drawn)
    instants = [float(signal.time[k]) for signal in signals.values() for k in (0, -1)]
    head = {
        "range": [min(instants, default=0.0), max(instants, default=0.0)],
        "series": [
            {"case": case, "column": column, "unit": one.unit, "n": len(one.ticks), "step": one.step}
            | ({"off": one.off} if one.off else {})
            for (case, column), one in signals.items()
        ],
        "figures": shown,
    }
    return packed.pack(head, blocks)


def _signals(folder: Path, figures: Iterable[Figure]) -> dict[Key, Signal]:
    """Each signal once, however many panels show it. A gap, which is no finite number, is one NaN at its first tick."""
    found: dict[Key, Signal] = {}
    for figure in figures:
        if figure.kind != "panels":
            continue
        path = folder / "figures" / f"{figure.id}.parquet"
        columns = table(path)
        time = columns.column(0).to_numpy()
        for described, column in zip(list(columns.schema)[1:], columns.columns[1:], strict=True):
            said = described.metadata or {}
            if not {b"case", b"column"} <= set(said):
                raise ExoError(
                    f"{path}: {described.name}: does not say of which case and column it is, as results of an earlier "
                    f"version: run `exo run {folder.name}` again"
                )
            key = (said[b"case"].decode(), said[b"column"].decode())
            values = column.to_numpy().astype(np.float64)
            there = np.isfinite(values)
            if key in found or not there.any():
                continue
            first, last = np.flatnonzero(there)[[0, -1]]
            kept = there | _gaps(there)
            kept[:first] = kept[last + 1 :] = False
            # A signal of one point: a step from zero to it.
            step = float(np.median(np.diff(time[there])) if last > first else abs(time[first]) or 1.0)
            ticks = np.round(time[kept] / step).astype(np.int64)
            shown = np.where(there, values, np.nan)[kept]
            found[key] = Signal(ticks, shown, step, printed(said.get(b"unit", b"").decode()))
        for panel in figure.panels:
            window = thin.Window(*(panel.x_range or NOT_BOUND), *(panel.y_range or NOT_BOUND))
            for curve in panel.curves:
                if (curve.case, curve.column) in found:
                    found[curve.case, curve.column].windows.append(window)
    return found


def _gaps(there: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Where a gap begins; of many gaps the longest ones."""
    edges = np.diff(there.astype(np.int8), prepend=1, append=1)
    begin, end = np.flatnonzero(edges < 0), np.flatnonzero(edges > 0)
    found = np.zeros(len(there), dtype=np.bool_)
    found[begin[np.argsort(begin - end, kind="stable")[:MOST_GAPS]]] = True
    return found


def _blocks(signal: Signal) -> tuple[bytes, bytes]:
    largest = float(np.finfo(np.float32).max)
    ticks = np.diff(signal.ticks, prepend=0).astype("<u4")
    return packed.numbers(ticks), packed.numbers(signal.values.clip(-largest, largest).astype("<f4"))


def _panels(figure: Figure, numbers: dict[Key, int]) -> Iterator[dict[str, Any]]:
    found = looks(figure)
    for i, panel in enumerate(figure.panels):
        curves = [
            {"s": numbers[curve.case, curve.column], "label": curve.label or curve.column, **_look(found[i, j])}
            # What has gaps lies over what has none.
            for j, curve in sorted(enumerate(panel.curves), key=lambda each: found[i, each[0]].rank)
            if (curve.case, curve.column) in numbers
        ]
        yield {
            "title": panel.title,
            "y": panel.y_label,
            "curves": curves,
            "xRange": panel.x_range,
            "yRange": panel.y_range,
            "marks": panel.marks,
            "markLabel": panel.mark_label,
            "bands": _bands(panel.bands, numbers) if panel.bands else None,
        }


def _look(look: Look) -> dict[str, Any]:
    dash = DASHES[look.rank % len(DASHES)]
    return {"color": look.color, "dash": [] if dash == SOLID else list(dash[1])}


def _bands(bands: Bands, numbers: dict[Key, int]) -> dict[str, Any] | None:
    number = numbers.get((bands.case, bands.column))
    if number is None:
        return None
    colors = [BANDS[i % len(BANDS)][0] for i in range(len(bands.labels))]
    return {"s": number, "labels": bands.labels, "colors": colors}


def table(path: Path) -> pa.Table:
    """A figure's numbers. ExoError: they are missing, or no Parquet file."""
    try:
        return pyarrow.parquet.read_table(path)
    except FileNotFoundError:
        raise ExoError(f"{path}: missing: run `exo run {path.parent.parent.name}` again") from None
    except pa.ArrowException as error:
        raise ExoError(f"{path}: cannot be read: {' '.join(str(error).split())}") from error


def _bytes(path: Path) -> bytes:
    try:
        return path.read_bytes()
    except FileNotFoundError:
        raise ExoError(f"{path}: missing: run `exo run {path.parent.name}` again") from None
