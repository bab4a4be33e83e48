"""A study's pictures: what came out over what was varied."""

from pathlib import Path
from typing import Any

import matplotlib as mpl
import numpy as np
import pyarrow as pa
from matplotlib import colors, pyplot, ticker
from numpy.typing import NDArray

from exo.errors import ExoError
from exo.looks import BLUE, GREEN, VERMILLION
from exo.plots import STYLE
from exo.sweep.study import Figure, Study

mpl.use("Agg")

#: Inches and dots per inch: 900 px wide, as the report's figures.
SIZE, DPI = (7.5, 5.0), 120
#: Points up to which each is drawn large.
FEW = 500

Array = NDArray[np.float64]


def draw(figure: Figure, study: Study, table: pa.Table, folder: Path) -> Path:
    """Draws one figure into `<folder>/<id>.png`. ExoError, if no row has what it draws."""
    path = folder / f"{figure.id}.png"
    wanted = [name for name in (figure.x, figure.y, figure.color) if name is not None]
    columns = {name: _numbers(table, name) for name in wanted}
    good = np.all([np.isfinite(column) for column in columns.values()], axis=0)
    if not good.any():
        raise ExoError(f"{study.id}: figure {figure.id}: no row has {', '.join(wanted)}")
    columns = {name: column[good] for name, column in columns.items()}
    with mpl.rc_context(STYLE):  # type: ignore[arg-type]
        drawing, axes = pyplot.subplots(figsize=SIZE, dpi=DPI, layout="constrained")
        {"map": _map, "scatter": _scatter, "histogram": _histogram, "front": _front}[figure.kind](axes, figure, columns)
        left_out = len(good) - int(good.sum())
        note = f"{len(good)} runs" + (f", {left_out} of them without these numbers" if left_out else "")
        axes.set_title(figure.title, loc="left", fontsize=11)
        axes.set_title(note, loc="right", fontsize=8, color="0.4")
        axes.set_xlabel(figure.x_label or _label(study, figure.x))
        if figure.y is not None and figure.kind != "histogram":
            axes.set_ylabel(figure.y_label or _label(study, figure.y))
        for name, scale in (("x", axes.set_xscale), ("y", axes.set_yscale)):
            if name in figure.log:
                scale("log")
        drawing.savefig(path)
        pyplot.close(drawing)
    return path


def _label(study: Study, name: str) -> str:
    axis = study.axes.get(name)
    return axis.label if axis is not None and axis.label else name


def _numbers(table: pa.Table, name: str) -> Array:
    column = table[name]
    if not (pa.types.is_floating(column.type) or pa.types.is_integer(column.type) or pa.types.is_boolean(column.type)):
        raise ExoError(f"column {name}: holds {column.type}; expected numbers to draw")
    return np.asarray(column.to_numpy(), dtype=np.float64)


def _map(axes: Any, figure: Figure, columns: dict[str, Array]) -> None:
    assert figure.y is not None
    assert figure.color is not None
    x, y, z = columns[figure.x], columns[figure.y], columns[figure.color]
    norm = colors.LogNorm() if "color" in figure.log else None
    if norm is not None and not (z > 0.0).all():
        # What is 0 has no logarithm: it gets the color of the smallest number.
        z = np.maximum(z, z[z > 0.0].min(initial=1.0))
    across, up = np.unique(x), np.unique(y)
    if len(across) * len(up) == len(z) and min(len(across), len(up)) > 1:
        grid = np.full((len(up), len(across)), np.nan)
        grid[np.searchsorted(up, y), np.searchsorted(across, x)] = z
        drawn = axes.pcolormesh(across, up, grid, shading="nearest", norm=norm, cmap="viridis")
        if figure.limit is not None and np.nanmin(grid) < figure.limit < np.nanmax(grid):
            _limit(axes, axes.contour(across, up, grid, levels=[figure.limit], colors=VERMILLION, linewidths=2), figure)
    else:
        size = 24 if len(z) <= FEW else 6
        drawn = axes.scatter(x, y, c=z, s=size, norm=norm, cmap="viridis")
        if figure.limit is not None and len(z) > 3 and z.min() < figure.limit < z.max():
            _limit(axes, axes.tricontour(x, y, z, levels=[figure.limit], colors=VERMILLION, linewidths=2), figure)
    axes.figure.colorbar(drawn, ax=axes, label=figure.color_label or figure.color)


def _limit(axes: Any, contour: Any, figure: Figure) -> None:
    axes.clabel(contour, fmt=ticker.FuncFormatter(lambda value, _: f"{figure.color_label or figure.color} = {value:g}"))


def _scatter(axes: Any, figure: Figure, columns: dict[str, Array]) -> None:
    assert figure.y is not None
    x, y = columns[figure.x], columns[figure.y]
    size = 24 if len(x) <= FEW else 5
    if figure.color is None:
        axes.scatter(x, y, s=size, color=BLUE, alpha=0.6, linewidths=0)
    else:
        norm = colors.LogNorm() if "color" in figure.log else None
        drawn = axes.scatter(x, y, c=columns[figure.color], s=size, norm=norm, cmap="viridis")
        axes.figure.colorbar(drawn, ax=axes, label=figure.color_label or figure.color)
    if figure.limit is not None:
        axes.axhline(figure.limit, color=VERMILLION)


def _histogram(axes: Any, figure: Figure, columns: dict[str, Array]) -> None:
    x = columns[figure.x]
    bins: Any = "auto"
    if "x" in figure.log and (x > 0.0).all() and x.max() > x.min():
        bins = np.geomspace(x.min(), x.max(), 40)
    axes.hist(x, bins=bins, color=BLUE)
    low, middle, high = np.percentile(x, [5.0, 50.0, 95.0])
    for value, name in ((low, "5 %"), (middle, "median"), (high, "95 %")):
        axes.axvline(value, color=VERMILLION, linewidth=1)
        axes.annotate(
            f"{name}\n{value:.3g}",
            (value, 1.0),
            xycoords=("data", "axes fraction"),
            xytext=(3, -4),
            textcoords="offset points",
            va="top",
            fontsize=8,
            color=VERMILLION,
        )
    axes.set_ylabel("runs")


def _front(axes: Any, figure: Figure, columns: dict[str, Array]) -> None:
    assert figure.y is not None
    x, y = columns[figure.x], columns[figure.y]
    _scatter(axes, figure, columns)
    best = front(x, y)
    axes.plot(x[best], y[best], color=GREEN, marker="o", markersize=4, label="no other run is better in both")
    axes.legend(loc="upper right", fontsize=8)


def front(x: Array, y: Array) -> NDArray[np.intp]:
    """Positions of the points that no other one beats in both, small being good, by ascending x."""
    order = np.lexsort((y, x))
    lowest = np.minimum.accumulate(y[order])
    first = np.concatenate([[True], y[order][1:] < lowest[:-1]])
    return np.asarray(order[first], dtype=np.intp)
