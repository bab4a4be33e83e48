"""Figures: what all panels share stands once beside them, and panels and curves run over axes.

A figure hands `x_range`, `y_range`, `y_label`, `marks`, `mark_label`, `bands`, `curves` and what a curve can say down
to its panels, a panel what a curve can say to its curves. Axes in a panel's `title` or `y_label` make panels, all
others make curves.
"""

from typing import Any

from exo.expansion.axes import Axes, texts
from exo.expansion.entries import Entry, over_axes

OF_A_CURVE = ("case", "column", "label", "color", "dashed")
#: `label` of a figure is the paper's label, `title` its own.
SHARED = (
    "x_range",
    "y_range",
    "y_label",
    "marks",
    "mark_label",
    "bands",
    "curves",
    "case",
    "column",
    "color",
    "dashed",
)


def expand(data: Any, *, axes: Axes, where: str) -> list[Entry]:
    """All figures with all panels and curves."""
    found = []
    for figure, _, place in over_axes(data, axes=axes, where=where):
        rows = figure.get("panels")
        if isinstance(rows, list) and all(isinstance(row, dict) for row in rows):
            shared = {key: figure.pop(key) for key in SHARED if key in figure}
            figure["panels"] = [one for row in rows for one in _panels(shared | row, axes, f"{place}.panels")]
        found.append(figure)
    return found


def _panels(row: Entry, axes: Axes, where: str) -> list[Entry]:
    over = row.pop("over", {})
    found = []
    for bound in axes.each(texts(row, ("title", "y_label")), over=over, where=where):
        panel = axes.fill(row, bound, where=where)
        common = {key: panel.pop(key) for key in OF_A_CURVE if key in panel}
        curves = panel.get("curves", [{}] if common else None)
        if isinstance(curves, list) and all(isinstance(curve, dict) for curve in curves):
            panel["curves"] = [
                axes.fill(common | curve, one, where=where)
                for curve in curves
                for one in axes.each(common | curve, over=over, where=where)
            ]
        if isinstance(panel.get("bands"), dict) and "case" in common:
            panel["bands"] = {"case": common["case"]} | panel["bands"]
        found.append(panel)
    return found
