"""Pictures: nothing covers the data, no curve is hidden or told by colour alone, one signal looks alike everywhere."""

import re
from itertools import combinations
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure as Canvas
from matplotlib.legend import Legend

from exo import curves, plots, scenario
from exo.looks import CYCLE, LABELS, SIGNALS, looks, signal
from exo.recording import Recording
from exo.scenario import Figure

from conftest import recording

FIGURES = {
    f"{name}/{figure.id}": (figure, data)
    for name in scenario.built_in()
    for data in [scenario.load(name)]
    for figure in data.figures
}
PANELS = {key: figure for key, (figure, _) in FIGURES.items() if figure.kind == "panels"}


def waves(figure: Figure, *, duration: float) -> dict[str, Recording]:
    """Every curve of a figure over its whole range, so that whatever lies on the axes lies on data."""
    random = np.random.default_rng(1)
    time = np.linspace(0.0, duration, 601)
    columns = {curve.column for panel in figure.panels for curve in panel.curves}
    bands = {panel.bands.column: len(panel.bands.labels) for panel in figure.panels if panel.bands}
    found = {}
    for case in figure.cases:
        values = {column: np.sin(time + random.uniform(0.0, 6.0)) for column in columns}
        values |= {column: (np.arange(601) // 60) % count for column, count in bands.items()}
        found[case] = recording(time=time, **{name.replace(".", "__"): x for name, x in values.items()})
    return found


@pytest.fixture
def drawn(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Any:
    """A function that draws a figure and gives the canvas, laid out."""
    seen: list[Canvas] = []
    monkeypatch.setattr(Canvas, "savefig", lambda canvas, *_, **__: seen.append(canvas))

    def draw(key: str) -> Canvas:
        figure, data = FIGURES[key]
        longest = max(case.duration or data.duration for case in data.cases)
        plots.draw(figure=figure, recordings=waves(figure, duration=longest), path=tmp_path / "x.png")
        seen[-1].draw_without_rendering()
        return seen[-1]

    return draw


def overlap(a: Any, b: Any) -> float:
    """The area (pixels²) that two boxes share."""
    width = min(a.x1, b.x1) - max(a.x0, b.x0)
    height = min(a.y1, b.y1) - max(a.y0, b.y0)
    return float(max(width, 0.0) * max(height, 0.0))


@pytest.mark.parametrize("key", PANELS)
def test_nothing_covers_the_data_and_every_curve_and_limit_is_named(key: str, drawn: Any) -> None:
    figure, canvas = PANELS[key], drawn(key)
    axes = [one for one in canvas.axes if one.get_visible()]
    legends = {*canvas.legends, *(child for one in axes for child in one.get_children() if isinstance(child, Legend))}
    texts = [text for one in axes for text in (*one.texts, one.title) if text.get_text()]
    beside = [thing.get_window_extent() for thing in (*legends, *texts, canvas._suptitle)]
    for box in beside:
        # The legend's edge may touch the axes': a row of pixels.
        assert all(overlap(box, one.get_window_extent()) <= 1.5 * box.width for one in axes)
    for a, b in combinations(beside, 2):
        assert overlap(a, b) <= 0.05 * min(a.width * a.height, b.width * b.height)
    said = " ".join(text.get_text() for text in texts)
    for one, panel in zip(canvas.axes, figure.panels, strict=False):
        told = [text.get_text() for legend in (one.get_legend(), *canvas.legends) if legend for text in legend.texts]
        assert all(curve.label in told or curve.label in panel.y_label for curve in panel.curves)
        assert not panel.marks or panel.mark_label
        assert all(f"{panel.mark_label} {mark:g}".replace("-", "−") in said for mark in panel.marks)
        assert not re.search(r"N[. ]m", panel.y_label)


@pytest.mark.parametrize("key", PANELS)
def test_curves_of_a_panel_differ_in_colour_and_in_dash(key: str) -> None:
    figure = PANELS[key]
    found = looks(figure)
    for i, panel in enumerate(figure.panels):
        here = [found[i, j] for j in range(len(panel.curves))]
        for a, b in combinations(here, 2):
            assert a.color != b.color
            assert a.style["linestyle"] != b.style["linestyle"]
            # The one with gaps lies over the other.
            assert (a.style["zorder"] > b.style["zorder"]) == (a.rank > b.rank)


def test_a_signal_and_a_law_look_alike_in_all_figures() -> None:
    seen: dict[str, set[str]] = {}
    for figure in PANELS.values():
        found = looks(figure)
        for i, panel in enumerate(figure.panels):
            names = [signal(curve.column) for curve in panel.curves]
            for j, curve in enumerate(panel.curves):
                if curve.label in LABELS:
                    seen.setdefault(curve.label, set()).add(found[i, j].color)
                elif len(set(names)) == len(names) and names[j] in {"q", "q_n", "p", "p_n", "tau_a", "tau_h"}:
                    seen.setdefault(names[j], set()).add(found[i, j].color)
    assert {"q", "q_n", "p", "p_n", "tau_a", "tau_h", "standard", "passive_bounded"} <= set(seen)
    assert all(len(colors) == 1 for colors in seen.values()), seen
    assert seen["q"] == seen["p"] != seen["q_n"] == seen["p_n"]


def test_the_colours_are_those_that_colour_blind_readers_tell_apart() -> None:
    # Okabe and Ito, Color Universal Design, as printed there in RGB: all but sky blue and yellow.
    printed = {(0, 0, 0), (230, 159, 0), (0, 158, 115), (0, 114, 178), (213, 94, 0), (204, 121, 167)}
    assert {tuple(round(255 * x) for x in to_rgb(color)) for color in CYCLE} == printed
    assert len(CYCLE) == len(printed)


def test_a_thinned_line_keeps_the_peaks_and_never_runs_back() -> None:
    time = np.linspace(0.0, 60.0, 30001)
    values = np.sin(time)
    values[12345] = 7.0
    thin_time, thin = plots.thinned(time, values)
    assert len(thin) <= plots.PLOTTED_POINTS + 2
    assert (np.diff(thin_time) >= 0.0).all()
    assert thin.max() == 7.0
    assert thin.min() == values.min()
    assert np.isin(np.column_stack([thin_time, thin]).view(np.complex128), time + 1j * values).all()


def test_a_unit_of_fmi_is_printed_as_people_write_it() -> None:
    assert [curves.printed(unit) for unit in ("N.m", "N.s/m", "", "rad")] == ["N·m", "N·s/m", "1", "rad"]


def test_units_of_metrics_are_written_with_the_same_dot() -> None:
    units = {metric.unit for _, data in FIGURES.values() for metric in data.metrics}
    assert "N·m" in units
    assert not [unit for unit in units if "." in unit]


def test_looks_are_of_the_cycle() -> None:
    assert {look.color for look in (*SIGNALS.values(), *LABELS.values())} <= set(CYCLE)
