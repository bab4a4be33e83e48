"""A study's pictures: what came out over what was varied."""

from contextlib import suppress
from pathlib import Path
from typing import Any

import matplotlib as mpl
import numpy as np
import pyarrow as pa
from matplotlib import colors, pyplot
from matplotlib.patches import Patch
from matplotlib.tri import Triangulation
from numpy.typing import NDArray

from exo.errors import ExoError
from exo.looks import BLUE, VERMILLION
from exo.plots import STYLE
from exo.sweep.study import Figure, Study

mpl.use("Agg")

#: Inches and dots per inch: 900 px wide, as the report's figures.
SIZE, DPI = (7.5, 5.0), 120
#: Points up to which each is drawn large.
FEW = 500
#: Of many points, in which each has a median.
PARTS = 25
#: Of a map that says no or yes.
YES_OR_NO = ("#dceefa", "#f8c98b")

Array = NDArray[np.float64]


def draw(figure: Figure, study: Study, table: pa.Table, folder: Path) -> Path:
    """Draws one figure into `<folder>/<id>.png`. ExoError, if no row has what it draws, or it cannot be written."""
    path = folder / f"{figure.id}.png"
    for name, value in figure.where.items():
        table = table.filter(pa.array(_numbers(table, name) == value))
    wanted = [name for name in (figure.x, figure.y, figure.color, figure.contour) if name is not None]
    columns = {name: _numbers(table, name) for name in wanted}
    good = np.all([np.isfinite(column) for column in columns.values()], axis=0)
    for axis, drawn in (("x", figure.x), ("y", figure.y)):
        # What is 0 or below has no place on a logarithmic axis.
        if drawn is not None and axis in study.logarithmic(figure):
            good &= columns[drawn] > 0.0
    if not good.any():
        raise ExoError(f"{study.id}: figure {figure.id}: no row has {', '.join(wanted)}")
    columns = {name: column[good] for name, column in columns.items()}
    with mpl.rc_context(STYLE):  # type: ignore[arg-type]
        drawing, axes = pyplot.subplots(figsize=SIZE, dpi=DPI, layout="constrained")
        {"map": _map, "scatter": _scatter, "histogram": _histogram, "front": _front}[figure.kind](
            axes, study, figure, columns
        )
        left_out = len(good) - int(good.sum())
        note = f"{len(good)} runs" + (f", {left_out} of them without these numbers" if left_out else "")
        axes.set_axisbelow(True)
        axes.set_title(figure.title, loc="left", fontsize=11)
        axes.set_title(note, loc="right", fontsize=8, color="0.4")
        axes.set_xlabel(figure.x_label or _label(study, figure.x))
        if figure.y is not None and figure.kind != "histogram":
            axes.set_ylabel(figure.y_label or _label(study, figure.y))
        for name, scale in (("x", axes.set_xscale), ("y", axes.set_yscale)):
            if name in study.logarithmic(figure):
                scale("log")
        try:
            drawing.savefig(path)
        except OSError as error:
            raise ExoError(f"{path}: cannot be written: {error.strerror or error}") from error
        finally:
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


def _map(axes: Any, study: Study, figure: Figure, columns: dict[str, Array]) -> None:
    assert figure.y is not None
    assert figure.color is not None
    x, y, z = columns[figure.x], columns[figure.y], columns[figure.color]
    norm = colors.LogNorm() if "color" in study.logarithmic(figure) else None
    yes_or_no = set(np.unique(z)) <= {0.0, 1.0}
    colormap: Any = colors.ListedColormap(YES_OR_NO) if yes_or_no else "viridis"
    if norm is not None and not (z > 0.0).all():
        # What is 0 has no logarithm: it gets the color of the smallest number.
        z = np.maximum(z, z[z > 0.0].min(initial=1.0))
    across, up = np.unique(x), np.unique(y)
    if len(across) * len(up) == len(z) and min(len(across), len(up)) > 1:
        grid = np.full((len(up), len(across)), np.nan)
        grid[np.searchsorted(up, y), np.searchsorted(across, x)] = z
        edges = [_edges(points, log=name in study.logarithmic(figure)) for name, points in (("x", across), ("y", up))]
        drawn = axes.pcolormesh(*edges, grid, norm=norm, cmap=colormap)
        lines = np.full_like(grid, np.nan)
        lines[np.searchsorted(up, y), np.searchsorted(across, x)] = columns[figure.contour or figure.color]
        if figure.limit is not None and np.nanmin(lines) < figure.limit < np.nanmax(lines):
            _limit(
                axes, axes.contour(across, up, lines, levels=[figure.limit], colors=VERMILLION, linewidths=2), figure
            )
    else:
        size = 24 if len(z) <= FEW else 6
        drawn = axes.scatter(x, y, c=z, s=size, norm=norm, cmap=colormap)
        of = columns[figure.contour or figure.color]
        if figure.limit is not None and len(of) > 3 and of.min() < figure.limit < of.max():
            # Points on one straight line span no triangle: no line divides them.
            triangles = None
            with suppress(RuntimeError, ValueError):
                triangles = Triangulation(x, y)
            if triangles is not None:
                line = axes.tricontour(triangles, of, levels=[figure.limit], colors=VERMILLION, linewidths=2)
                _limit(axes, line, figure)
    axes.grid(visible=False)
    if yes_or_no:
        name = figure.color_label or _label(study, figure.color)
        patches = [
            Patch(color=color, label=f"{name}: {word}") for color, word in zip(YES_OR_NO, ("no", "yes"), strict=True)
        ]
        axes.legend(handles=patches, loc="upper left", fontsize=8)
    else:
        axes.figure.colorbar(drawn, ax=axes, label=figure.color_label or _label(study, figure.color))


def _edges(points: Array, *, log: bool) -> Array:
    """Edges of cells around the points, half way between them."""
    at = np.log(points) if log else points
    between = 0.5 * (at[1:] + at[:-1])
    edges = np.concatenate([[2.0 * at[0] - between[0]], between, [2.0 * at[-1] - between[-1]]])
    return np.exp(edges) if log else edges


def _limit(axes: Any, contour: Any, figure: Figure) -> None:
    name = figure.contour_label or f"{figure.contour or figure.color_label or figure.color} = {figure.limit:g}"
    # On a plate of its own: the line crosses all colors.
    for text in axes.clabel(contour, fmt=lambda _: name, fontsize=9, inline=False):
        text.set(color="black", bbox={"facecolor": "white", "edgecolor": "none", "alpha": 0.85, "pad": 1.5})


def _scatter(axes: Any, study: Study, figure: Figure, columns: dict[str, Array]) -> None:
    assert figure.y is not None
    x, y = columns[figure.x], columns[figure.y]
    size = 24 if len(x) <= FEW else 5
    if figure.color is None:
        axes.scatter(x, y, s=size, color=BLUE, alpha=0.6, linewidths=0)
    else:
        norm = colors.LogNorm() if "color" in study.logarithmic(figure) else None
        drawn = axes.scatter(x, y, c=columns[figure.color], s=size, norm=norm, cmap="viridis")
        axes.figure.colorbar(drawn, ax=axes, label=figure.color_label or _label(study, figure.color))
    if figure.kind == "scatter" and len(x) > FEW:
        # On white, so that it is seen before any color.
        at, middle = _medians(x, y)
        for color, width in (("white", 5), ("black", 2)):
            label = "median" if color == "black" else None
            axes.plot(at, middle, color=color, linewidth=width, label=label)
        axes.legend(loc="best", fontsize=8)
    if figure.limit is not None:
        axes.axhline(figure.limit, color=VERMILLION)
        if figure.contour_label:
            axes.annotate(
                figure.contour_label,
                (0.01, figure.limit),
                xycoords=("axes fraction", "data"),
                xytext=(0, 4),
                textcoords="offset points",
                color=VERMILLION,
            )


def _medians(x: Array, y: Array) -> tuple[Array, Array]:
    """Medians of y, and of x, in parts of as many points each, by ascending x."""
    parts = np.array_split(np.argsort(x, kind="stable"), PARTS)
    return np.array([np.median(x[part]) for part in parts]), np.array([np.median(y[part]) for part in parts])


def _histogram(axes: Any, study: Study, figure: Figure, columns: dict[str, Array]) -> None:
    x = columns[figure.x]
    bins: Any = "auto"
    if "x" in study.logarithmic(figure) and (x > 0.0).all() and x.max() > x.min():
        bins = np.geomspace(x.min(), x.max(), 40)
    axes.hist(x, bins=bins, color=BLUE, alpha=0.55)
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


def _front(axes: Any, study: Study, figure: Figure, columns: dict[str, Array]) -> None:
    assert figure.y is not None
    x, y = columns[figure.x], columns[figure.y]
    _scatter(axes, study, figure, columns)
    signs = [-1.0 if name in figure.larger else 1.0 for name in ("x", "y")]
    best = front(signs[0] * x, signs[1] * y)
    axes.plot(x[best], y[best], color=VERMILLION, marker="o", markersize=4, label="no other run is better in both")
    axes.legend(loc="best", fontsize=8)


def front(x: Array, y: Array) -> NDArray[np.intp]:
    """Positions of the points that no other one beats in both, small being good, by ascending x."""
    order = np.lexsort((y, x))
    lowest = np.minimum.accumulate(y[order])
    first = np.concatenate([[True], y[order][1:] < lowest[:-1]])
    return np.asarray(order[first], dtype=np.intp)
