"""The numbers of a figure of panels as a table: a column a curve, and one for what colours the bands behind it.

Each column says in its field's metadata what it is, so that nobody takes its name apart: `case` and `column`, the run
and its signal, and `unit` as FMI writes it.
"""

from collections.abc import Mapping
from typing import Any

import numpy as np
import pyarrow as pa

from exo.errors import ScenarioError
from exo.profile import SAME_INSTANT
from exo.recording import Recording
from exo.scenario import Figure


def printed(unit: str) -> str:
    """A unit as people write it: FMI's `N.m` is N·m, and what has none is 1."""
    return unit.replace(".", "·") or "1"


def table(*, figure: Figure, recordings: Mapping[str, Recording]) -> pa.Table:
    """Time (s) in front; where a case has no tick, its columns have NaN. ScenarioError: durations differ."""
    runs = {case: recordings[case] for case in figure.cases}
    lengths = {round(len(run.time) * run.step / SAME_INSTANT) for run in runs.values()}
    if len(lengths) > 1:
        raise ScenarioError(f"figure {figure.id}: its curves must have one duration")
    # Cases with other steps have other instants: a curve is empty where it has none.
    instants = {case: np.round(run.time / SAME_INSTANT).astype(np.int64) for case, run in runs.items()}
    every = np.unique(np.concatenate(list(instants.values())))
    finest = max(runs.values(), key=lambda run: len(run.time))
    made = _Columns(figure.x_label, finest.time if len(every) == len(finest.time) else every * SAME_INSTANT)

    def add(title: str, label: str, case: str, column: str) -> None:
        run, values = runs[case], runs[case][column]
        if len(run.time) < len(every):
            values = np.full(len(every), np.nan)
            values[np.searchsorted(every, instants[case])] = run[column]
        name = ", ".join(part for part in (title, label) if part)
        made.add(name, values, case=case, column=column, unit=run.units.get(column, ""))

    for panel in figure.panels:
        for curve in panel.curves:
            add(panel.title, curve.label or curve.column, curve.case, curve.column)
        if panel.bands:
            add(panel.title, panel.bands.column, panel.bands.case, panel.bands.column)
    return made.table()


class _Columns:
    """Columns whose names stand once: panels without a title may have curves of one label and one unit."""

    def __init__(self, name: str, time: Any) -> None:
        self._columns: dict[str, tuple[Any, dict[str, str]]] = {name: (pa.array(time), {"unit": "s"})}

    def add(self, name: str, values: Any, *, case: str, column: str, unit: str) -> None:
        said = {"case": case, "column": column, "unit": unit}
        names = [f"{one} [{printed(unit)}]" for one in (name, f"{name}, {case}, {column}")]
        free = next((one for one in names if one not in self._columns or self._columns[one][1] == said), names[-1])
        self._columns[free] = (pa.array(values), said)

    def table(self) -> pa.Table:
        fields = [pa.field(name, array.type, metadata=said) for name, (array, said) in self._columns.items()]
        return pa.table([array for array, _ in self._columns.values()], schema=pa.schema(fields))
