"""Figures, and the numbers in them as tables with the same labels."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import matplotlib as mpl
import numpy as np
import pyarrow as pa
from matplotlib import rcsetup
from matplotlib.figure import Figure as Canvas

from exo import curves, handfigures, poses, theory
from exo.looks import BANDS, BLACK, BLUE, CYCLE, MARK, VERMILLION, Look, looks
from exo.metrics.basic import window
from exo.metrics.loops import loop_of
from exo.metrics.response import measured_response
from exo.recording import Recording
from exo.scenario import Bands, Figure, Panel

STYLE: dict[str, Any] = {
    "font.family": "serif",
    "mathtext.fontset": "dejavuserif",
    "font.size": 9.0,
    "axes.titlesize": 9.5,
    "axes.grid": True,
    "grid.color": "#dddddd",
    "grid.linewidth": 0.6,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "lines.linewidth": 1.2,
    "legend.framealpha": 0.85,
    "legend.edgecolor": "none",
    "legend.fontsize": 8.0,
    "savefig.dpi": 130,
    "axes.prop_cycle": rcsetup.cycler(color=list(CYCLE)),
}
#: Of a legend: width of a letter, and of what stands before the letters.
INCH_A_LETTER, INCH_A_HANDLE = 0.066, 0.52
#: Height of a row of a legend.
INCH_A_ROW = 0.18
#: A line needs no more points than a picture has columns, twice over; data files keep every tick.
PLOTTED_POINTS = 4000


def draw(*, figure: Figure, recordings: Mapping[str, Recording], path: Path) -> None:
    """Writes the figure as PNG."""
    with mpl.rc_context(STYLE):  # type: ignore[arg-type]
        canvas = Canvas(layout="constrained")
        if figure.kind == "frequency_response":
            _frequency_response(canvas, recordings)
        elif figure.kind == "impedance":
            handfigures.draw_impedance(canvas, recordings)
        elif figure.kind == "hand_limits":
            handfigures.draw_limits(canvas, recordings)
        elif figure.poses:
            poses.draw(canvas=canvas, poses=figure.poses, run=recordings[figure.poses.case])
        else:
            _panels(canvas, figure, recordings)
        canvas.suptitle(figure.title, fontsize=11)
        canvas.savefig(path, metadata={"Software": None}, bbox_inches="tight")


def _panels(canvas: Canvas, figure: Figure, recordings: Mapping[str, Recording]) -> None:
    rows = -(-len(figure.panels) // figure.columns)
    width = {1: 7.0, 2: 9.5}.get(figure.columns, 3.2 * figure.columns)
    grid = canvas.subplots(rows, figure.columns, squeeze=False)
    found = looks(figure)
    drawn = []
    for position, (axes, panel) in enumerate(zip(grid.flat, figure.panels, strict=False)):
        beside = figure.panels[position + 1 : position + 2] if (position + 1) % figure.columns else ()
        told_there = bool(beside) and (beside[0].marks, beside[0].mark_label) == (panel.marks, panel.mark_label)
        lines = _panel(axes, panel, [found[position, j] for j in range(len(panel.curves))], recordings)
        _marks(axes, panel, labelled=not told_there)
        if panel.bands:
            _bands(axes, panel.bands, recordings[panel.bands.case], labelled=position < figure.columns)
        if len(lines) > 1 or not all(curve.label in panel.y_label for curve in panel.curves):
            drawn.append((axes, lines))
        if position + figure.columns >= len(figure.panels):
            axes.set_xlabel(figure.x_label)
    for axes in grid.flat[len(figure.panels) :]:
        axes.set_visible(False)
    legends = {tuple(line.get_label() for line in lines) for _, lines in drawn}
    if len(drawn) > 1 and len(legends) == 1:
        lines = drawn[0][1]
        canvas.legend(handles=lines, loc="outside lower center", ncols=columns(lines, width=width))
        highest = 0
    else:
        highest = max((above(axes, lines, width=width / figure.columns) for axes, lines in drawn), default=0)
    canvas.set_size_inches(width, (2.25 + INCH_A_ROW * highest) * rows + 0.6)


def _panel(axes: Any, panel: Panel, found: Sequence[Look], recordings: Mapping[str, Recording]) -> list[Any]:
    lines = []
    for curve, look in zip(panel.curves, found, strict=True):
        run = recordings[curve.case]
        left, right = panel.x_range or (0.0, run.time[-1])
        shown = window(run.time, after=left, before=right)
        time, values = thinned(run.time[shown], np.asarray(run[curve.column][shown], dtype=np.float64))
        lines += axes.plot(time, values, label=curve.label, **look.style)
        axes.set_xlim(left, right)
    axes.set_ylabel(panel.y_label)
    axes.set_title(panel.title)
    if panel.y_range:
        axes.set_ylim(*panel.y_range)
    return lines


def _marks(axes: Any, panel: Panel, *, labelled: bool) -> None:
    """The marks; `labelled`: with what they are on the right of the axes, where they cover nothing."""
    for mark in panel.marks:
        axes.axhline(mark, zorder=1.5, **MARK)
        if labelled:
            text = f"{panel.mark_label} {mark:g}".strip().replace("-", "−")
            place = {"xy": (1.0, mark), "xycoords": axes.get_yaxis_transform(), "va": "center", "ha": "left"}
            axes.annotate(text, xytext=(3, 0), textcoords="offset points", fontsize=7.5, color=MARK["color"], **place)


def columns(lines: Sequence[Any], *, width: float) -> int:
    """How many entries of a legend fit beside each other on `width` (inch)."""
    longest = max(len(str(line.get_label())) for line in lines)
    return max(1, min(len(lines), int(width / (INCH_A_LETTER * longest + INCH_A_HANDLE))))


def above(axes: Any, lines: Sequence[Any], *, width: float) -> int:
    """A legend above the axes, where it covers nothing, and their title above it; answers its rows."""
    across = columns(lines, width=0.9 * width)
    rows = -(-len(lines) // across)
    place = {"loc": "lower center", "bbox_to_anchor": (0.5, 1.0), "borderaxespad": 0.1}
    axes.legend(handles=lines, ncols=across, frameon=False, **place)
    if axes.get_title():
        axes.set_title(axes.get_title(), pad=72.0 * INCH_A_ROW * rows + 7.0)
    return rows


def _bands(axes: Any, bands: Bands, run: Recording, *, labelled: bool) -> None:
    """One band per stretch of one value; `labelled`: with each value's label above the panel."""
    values = run[bands.column]
    starts = np.concatenate([[0], np.flatnonzero(np.diff(values)) + 1])
    ends = np.append(run.time[starts[1:]], run.time[-1])
    shown: dict[int, Any] = {}
    for start, end in zip(starts, ends, strict=True):
        value = int(values[start])
        color, hatch = BANDS[value % len(BANDS)]
        shown[value] = axes.axvspan(
            run.time[start], end, facecolor=color, edgecolor="#ffffff", hatch=hatch, linewidth=0.0, zorder=0
        )
    if not labelled:
        return
    ordered = sorted(shown)
    legend = axes.legend(
        [shown[value] for value in ordered],
        [bands.labels[value] for value in ordered],
        loc="lower left",
        bbox_to_anchor=(0.0, 1.0),
        ncols=len(ordered),
        borderaxespad=0.2,
    )
    axes.add_artist(legend)  # a later legend does not replace it
    legend.set_clip_on(False)


def thinned(time: Any, values: Any) -> tuple[Any, Any]:
    """The smallest and the largest value of each bin in the order in which they come: a thinned line shows the same
    peaks and never runs back, which would fill the gaps of its dash."""
    if len(time) <= PLOTTED_POINTS:
        return time, values
    size = -(-2 * len(time) // PLOTTED_POINTS)
    bins = np.pad(values, (0, -len(values) % size), mode="edge").reshape(-1, size)
    extremes = np.sort(np.column_stack([bins.argmin(axis=1), bins.argmax(axis=1)]), axis=1)
    picked = np.minimum((extremes + size * np.arange(len(bins))[:, None]).ravel(), len(time) - 1)
    return time[picked], values[picked]


def data(*, figure: Figure, recordings: Mapping[str, Recording]) -> pa.Table:
    """The figure's numbers, one column a curve, labelled as in the figure."""
    if figure.kind == "frequency_response":
        return pa.table(response_table(recordings))
    if figure.kind == "impedance":
        return pa.table(handfigures.impedance_table(recordings))
    if figure.kind == "hand_limits":
        return pa.table(handfigures.limits_table(recordings))
    if figure.poses:
        return pa.table(poses.table(poses=figure.poses, run=recordings[figure.poses.case]))
    return curves.table(figure=figure, recordings=recordings)


def response_table(recordings: Mapping[str, Recording]) -> dict[str, list[float]]:
    """Measured and closed-form dq/τ_h over frequency. Cases carry one sine each, as the scenario's metrics expect."""
    rows = []
    for run in recordings.values():
        after = run.time[-1] / 2.0
        H, omega = measured_response(run, force="controller.tau_h", velocity="plant.dq", profile="tau_h", after=after)
        loop = loop_of(run, controller="controller", plant="plant")
        forms = [H, *(theory.RESPONSES[name](loop=loop, omega=omega) for name in ("sampled", "continuous"))]
        rows.append([omega, *(f(h) for h in forms for f in (np.abs, np.angle))])
    names = [
        "ω [rad/s]",
        *(
            f"{what} {form}"
            for form in ("measured", "sampled, closed form", "continuous, closed form")
            for what in ("|dQ/T_H| [m/(N·s)]", "phase [rad]")
        ),
    ]
    return {
        name: [float(x) for x in column] for name, column in zip(names, zip(*sorted(rows), strict=True), strict=True)
    }


def _frequency_response(canvas: Canvas, recordings: Mapping[str, Recording]) -> None:
    canvas.set_size_inches(7.0, 5.2)
    magnitude, phase = canvas.subplots(2, 1, sharex=True)
    run = next(iter(recordings.values()))
    loop = loop_of(run, controller="controller", plant="plant")
    omega = np.geomspace(0.15, 25.0, 200)
    for name, color, look in (("continuous", BLUE, "-"), ("sampled", VERMILLION, "--")):
        curve = np.array([theory.RESPONSES[name](loop=loop, omega=w) for w in omega])
        magnitude.loglog(omega, np.abs(curve), look, color=color, label=f"{name}, closed form")
        phase.semilogx(omega, np.angle(curve), look, color=color)
    measured = list(response_table(recordings).values())
    magnitude.loglog(measured[0], measured[1], "o", color=BLACK, markersize=4, label="measured on the FMUs")
    phase.semilogx(measured[0], measured[2], "o", color=BLACK, markersize=4)
    nominal = 1.0 / np.abs(loop.M_n * 1j * omega + loop.D_n)
    magnitude.loglog(omega, nominal, ":", color="#444444", label=r"$1/(M_n s + D_n)$")
    magnitude.set_ylabel(r"$|\dot{Q}/T_H|$ [m/(N·s)]")
    phase.set_ylabel("phase [rad]")
    phase.set_xlabel("ω [rad/s]")
    above(magnitude, magnitude.get_lines(), width=7.0)
