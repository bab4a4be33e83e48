"""Figures, and the numbers in them as tables with the same labels."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import matplotlib as mpl
import numpy as np
import pyarrow as pa
from matplotlib import rcsetup
from matplotlib.figure import Figure as Canvas

from exo import poses, theory
from exo.errors import ScenarioError
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
    "axes.prop_cycle": rcsetup.cycler(color=["#1f4e9c", "#c0392b", "#2e8b57", "#8e6c1d", "#6a3d9a"]),
}
#: Of the values 0, 1, … behind a panel: from nothing to a fault.
BAND_COLORS = ("#e8e8e8", "#c6dbef", "#ccebc5", "#decbe4", "#fed9a6", "#ffffcc", "#fbb4ae")
#: A line needs no more points than a picture has columns, twice over; data files keep every tick.
PLOTTED_POINTS = 4000


def draw(*, figure: Figure, recordings: Mapping[str, Recording], path: Path) -> None:
    """Writes the figure as PNG."""
    with mpl.rc_context(STYLE):  # type: ignore[arg-type]
        canvas = Canvas(layout="constrained")
        if figure.kind == "frequency_response":
            _frequency_response(canvas, recordings)
        elif figure.poses:
            poses.draw(canvas=canvas, poses=figure.poses, run=recordings[figure.poses.case])
        else:
            _panels(canvas, figure, recordings)
        canvas.suptitle(figure.title, fontsize=11)
        canvas.savefig(path, metadata={"Software": None}, bbox_inches="tight")


def _panels(canvas: Canvas, figure: Figure, recordings: Mapping[str, Recording]) -> None:
    rows = -(-len(figure.panels) // figure.columns)
    width = {1: 7.0, 2: 9.5}.get(figure.columns, 3.2 * figure.columns)
    canvas.set_size_inches(width, 2.25 * rows + 0.6)
    grid = canvas.subplots(rows, figure.columns, squeeze=False)
    for position, axes in enumerate(grid.flat):
        if position >= len(figure.panels):
            axes.set_visible(False)
            continue
        _panel(axes, figure.panels[position], recordings, topmost=position < figure.columns)
        if position + figure.columns >= len(figure.panels):
            axes.set_xlabel(figure.x_label)


def _panel(axes: Any, panel: Panel, recordings: Mapping[str, Recording], *, topmost: bool) -> None:
    for curve in panel.curves:
        run = recordings[curve.case]
        left, right = panel.x_range or (0.0, run.time[-1])
        shown = window(run.time, after=left, before=right)
        time, values = _thinned(run.time[shown], np.asarray(run[curve.column][shown], dtype=np.float64))
        look = {"color": curve.color} if curve.color else {}
        axes.plot(time, values, "--" if curve.dashed else "-", label=curve.label, **look)
        axes.set_xlim(left, right)
    if panel.bands:
        _bands(axes, panel.bands, recordings[panel.bands.case], labelled=topmost)
    for mark in panel.marks:
        axes.axhline(mark, color="#555555", linestyle=":", linewidth=0.9)
    axes.set_ylabel(panel.y_label)
    axes.set_title(panel.title)
    if panel.y_range:
        axes.set_ylim(*panel.y_range)
    if len(panel.curves) > 1:
        axes.legend(loc="best", ncols=min(len(panel.curves), 3))


def _bands(axes: Any, bands: Bands, run: Recording, *, labelled: bool) -> None:
    """One band per stretch of one value; `labelled`: with each value's label above the panel."""
    values = run[bands.column]
    starts = np.concatenate([[0], np.flatnonzero(np.diff(values)) + 1])
    ends = np.append(run.time[starts[1:]], run.time[-1])
    shown: dict[int, Any] = {}
    for start, end in zip(starts, ends, strict=True):
        value = int(values[start])
        shown[value] = axes.axvspan(
            run.time[start], end, color=BAND_COLORS[value % len(BAND_COLORS)], linewidth=0.0, zorder=0
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


def _thinned(time: Any, values: Any) -> tuple[Any, Any]:
    """Smallest and largest value of each bin, so that a thinned line shows the same peaks."""
    if len(time) <= PLOTTED_POINTS:
        return time, values
    size = -(-2 * len(time) // PLOTTED_POINTS)
    starts = np.arange(0, len(time), size)
    lows, highs = np.minimum.reduceat(values, starts), np.maximum.reduceat(values, starts)
    return np.repeat(time[starts], 2), np.column_stack([lows, highs]).reshape(-1)


def data(*, figure: Figure, recordings: Mapping[str, Recording]) -> pa.Table:
    """The figure's numbers, one column a curve, labelled as in the figure."""
    if figure.kind == "frequency_response":
        return pa.table(response_table(recordings))
    if figure.poses:
        return pa.table(poses.table(poses=figure.poses, run=recordings[figure.poses.case]))
    columns: dict[str, Any] = {}
    for panel in figure.panels:
        for curve in panel.curves:
            run = recordings[curve.case]
            if columns and len(columns[figure.x_label]) != len(run.time):
                raise ScenarioError(f"figure {figure.id}: its curves must have one duration")
            columns[figure.x_label] = run.time
            name = ", ".join(part for part in (panel.title, curve.label or curve.column) if part)
            unit = run.units.get(curve.column, "")
            columns[f"{name} [{unit or '1'}]"] = run[curve.column]
    return pa.table(columns)


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
    for name, look in (("continuous", "-"), ("sampled", "--")):
        curve = np.array([theory.RESPONSES[name](loop=loop, omega=w) for w in omega])
        magnitude.loglog(omega, np.abs(curve), look, label=f"{name}, closed form")
        phase.semilogx(omega, np.angle(curve), look)
    measured = list(response_table(recordings).values())
    magnitude.loglog(measured[0], measured[1], "ko", markersize=4, label="measured on the FMUs")
    phase.semilogx(measured[0], measured[2], "ko", markersize=4)
    magnitude.loglog(omega, 1.0 / np.abs(loop.M_n * 1j * omega + loop.D_n), ":", label=r"$1/(M_n s + D_n)$")
    magnitude.set_ylabel(r"$|\dot{Q}/T_H|$ [m/(N·s)]")
    phase.set_ylabel("phase [rad]")
    phase.set_xlabel("ω [rad/s]")
    magnitude.legend()
