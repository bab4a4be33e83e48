"""The ratios against their limits as bars."""

from collections.abc import Sequence
from pathlib import Path

from matplotlib.figure import Figure

from benches.document import cells
from benches.row import Row
from exo.looks import BLACK, BLUE, GREEN, MARK, VERMILLION

COLORS = {"aim reached": GREEN, "met": BLUE, "MISSED": VERMILLION}
#: What is less than this share of its limit is drawn as this.
LEAST = 0.05


def draw(rows: Sequence[Row], path: Path) -> None:
    """Draws the rows that have a limit, the first one on top."""
    judged = [row for row in rows if row.limit is not None]
    figure = Figure(figsize=(10.0, 1.6 + 0.42 * len(judged)), layout="constrained")
    axes = figure.subplots()
    for place, row in enumerate(judged):
        share = max(row.share, LEAST)
        axes.barh(place, share, color=COLORS[row.verdict], height=0.62)
        if row.aim is not None and row.limit is not None:
            aim = row.limit / row.aim if row.least else row.aim / row.limit
            axes.plot([aim, aim], [place - 0.4, place + 0.4], color=BLACK, linewidth=2.0)
        _, value, _, limit, aimed, _, _ = cells(row)
        axes.annotate(
            f"{value}   (limit {limit}, aim {aimed})",
            (max(share, 1.0), place),
            xytext=(6, 0),
            textcoords="offset points",
            va="center",
            fontsize=8,
        )
    axes.axvline(1.0, **MARK, label="limit")
    axes.plot([], [], color=BLACK, linewidth=2.0, label="aim")
    for name, color in COLORS.items():
        axes.barh(0, 0.0, color=color, label=name.lower())
    axes.set_yticks(range(len(judged)), [row.name for row in judged], fontsize=8)
    axes.set_ylim(len(judged) - 0.4, -0.6)
    axes.set_xlim(0.0, 1.75 * max([1.0, *(row.share for row in judged)]))
    axes.set_xlabel("in units of the limit: shorter is better", fontsize=9)
    figure.legend(loc="outside upper center", ncols=5, fontsize=8, frameon=False)
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)
    figure.savefig(path, dpi=110, metadata={"Software": None})
