"""The first sentence and the first picture of the page: the wall that is let go, and the wall that is not.

They are of the scenario `wall` as it comes with the harness, so the page has them where that was run as it is.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import pyarrow as pa

from exo.paper import Published
from exo.report import figures, thin
from exo.report.section import Section
from exo.scenario import Figure

SCENARIO, FIGURE, METRIC, COLUMN = "wall", "release", "release_delay", "plant.q"
LAWS = {"standard": "standard_5_0.5", "ours": "passive_bounded_5_0.5"}
#: Place of the axes in the picture, in its own units.
LEFT, RIGHT, TOP, BOTTOM = 10.0, 470.0, 70.0, 262.0
#: Between two numbers below the picture (s).
EVERY = 5.0


@dataclass(frozen=True, kw_only=True)
class Story:
    """Delays (s) until the mass leaves the wall, and the picture's lines and places; keys are those of `LAWS`."""

    delay: dict[str, float]
    #: What the paper's own testbed has taken.
    paper: Published | None
    #: Positions over time, as an SVG path.
    lines: dict[str, str]
    #: Abscissas: of the pull, of where each mass leaves the wall, of seconds since the pull.
    pull: float
    leaves: dict[str, float]
    ticks: tuple[tuple[float, float], ...]
    #: Ordinate of the wall.
    wall: float


def tell(sections: Sequence[Section]) -> Story | None:
    """The story, where the page has what it is of, and as the scenario says it."""
    section = next((one for one in sections if one.id == SCENARIO), None)
    if section is None or section.run["overrides"]:
        return None
    found = {law: row for law, case in LAWS.items() for row in section.rows if row.id == f"{METRIC}/{case}"}
    figure = next((one for one in section.scenario.figures if one.id == FIGURE), None)
    metric = next((one for one in section.scenario.metrics if one.id == METRIC), None)
    if figure is None or not figure.panels or metric is None or set(found) != set(LAWS):
        return None
    delay = {law: row.value for law, row in found.items() if row.value is not None}
    after = metric.arguments.get("after")
    if set(delay) != set(LAWS) or not isinstance(after, int | float):
        return None
    return _drawn(section, figure, float(after), delay, found["standard"].paper)


def _drawn(
    section: Section, figure: Figure, pull: float, delay: dict[str, float], paper: Published | None
) -> Story | None:
    panel = figure.panels[0]
    if panel.x_range is None or panel.y_range is None or not panel.marks:
        return None
    (first, last), (low, high) = panel.x_range, panel.y_range

    def x(time: float) -> float:
        return LEFT + (RIGHT - LEFT) * (time - first) / (last - first)

    def y(position: float) -> float:
        return BOTTOM - (BOTTOM - TOP) * (min(max(position, low), high) - low) / (high - low)

    table = figures.table(section.folder / "figures" / f"{figure.id}.parquet")
    time = table.column(0).to_numpy()
    lines = {}
    for law, case in LAWS.items():
        names = [one.name for one in table.schema if _is(one, case)]
        if not names:
            return None
        values = table.column(names[0]).to_numpy()
        shown = (time >= first) & (time <= last)
        t, q = time[shown], values[shown]
        # Beyond the picture's edge a line would say that the mass stands there.
        inside = np.flatnonzero(q < low)
        end = int(inside[0]) + 1 if len(inside) else len(q)
        points = [(x(t[k]), y(q[k])) for k in thin.thin(t[:end], q[:end])]
        lines[law] = "M" + "L".join(f"{a:.1f} {b:.1f}" for a, b in points)
    return Story(
        delay=delay,
        paper=paper,
        lines=lines,
        pull=x(pull),
        leaves={law: x(pull + seconds) for law, seconds in delay.items()},
        ticks=tuple((float(s), x(pull + s)) for s in np.arange(0.0, last - pull, EVERY)),
        wall=y(panel.marks[0]),
    )


def _is(described: pa.Field, case: str) -> bool:
    said = described.metadata or {}
    return bool((said.get(b"case"), said.get(b"column")) == (case.encode(), COLUMN.encode()))
