"""What a plot of the report shows of unusual signals: levels in the way, one point, no number, long and lively runs."""

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest
from playwright.sync_api import Browser, Locator

from reports import opened, told

from browser import chromium, shown, until
from commands import SHORT, exo

STEP = 0.002
LONG = "a_name_without_any_place_to_break_it_" * 4

#: Records where text is written on canvases: the box of each, in device px.
BOXES = """
window.boxes = [];
const draw = CanvasRenderingContext2D.prototype.fillText;
CanvasRenderingContext2D.prototype.fillText = function (text, x, y) {
    const { width } = this.measureText(text);
    const left = x - { left: 0, start: 0, center: width / 2, right: width, end: width }[this.textAlign];
    boxes.push({ text, left, top: y - 9, width, height: 10 });
    return draw.call(this, text, x, y);
};
"""

#: How many pixels of a box have the colour of the first curve, a blue that has no red in it.
BLUE = """(canvas, box) => {
    const { data } = canvas.getContext("2d").getImageData(box.left, box.top, Math.ceil(box.width), box.height);
    let count = 0;
    for (let k = 0; k < data.length; k += 4) count += data[k + 3] > 128 && data[k] < 60 && data[k + 2] > 120;
    return count;
}"""

Written = Callable[..., Path]


@pytest.fixture(scope="module")
def browser() -> Iterator[Browser]:
    """One for all tests."""
    with chromium() as found:
        yield found


@pytest.fixture
def written(tmp_path: Path, fmu_dir: Path) -> Written:
    """A page whose only curve has the values that are given, a step apart."""

    def write(values: Any, *, panel: str = "", label: str = "q") -> Path:
        path, out = tmp_path / "short.toml", tmp_path / "out"
        path.write_text(SHORT.replace('label = "q"', f'label = "{label}"') + panel, encoding="utf-8")
        exo("run", path, "--fmu-dir", fmu_dir, "--out", out)
        drawn = out / "short" / "figures" / "q.parquet"
        fields = list(pq.read_table(drawn).schema)
        columns = [np.arange(len(values)) * STEP, np.asarray(values, dtype=np.float64)]
        schema = pa.schema([field.with_type(pa.float64()) for field in fields], pq.read_table(drawn).schema.metadata)
        pq.write_table(pa.table(columns, schema=schema), drawn)
        exo("report", "--out", out)
        return out / "report.html"

    return write


def legend(section: Locator) -> str:
    """What is written above the plot."""
    return section.locator(".legend").inner_text()


@pytest.mark.parametrize("width", [390, 1400])
def test_the_name_of_a_level_lies_on_no_curve(width: int, browser: Browser, written: Written) -> None:
    # At rest on the level, then off it where a name at its end would stand.
    time = np.arange(500) * STEP
    values = np.where(time < 0.975, 0.3, 0.3 + 40.0 * (time - 0.975))
    values[time < 0.05] = 2.0
    file = written(values, panel='marks = [0.3]\nmark_label = "wall"\ny_range = [-1.5, 2.0]\n')
    page = browser.new_page(viewport={"width": width, "height": 900})
    page.add_init_script(BOXES)
    page.goto(file.as_uri())
    canvas = opened(page, "short").locator(".plot canvas")
    until(page, lambda: canvas.evaluate(BLUE, {"left": 0, "top": 0, "width": 300, "height": 160}) > 100)
    names = [box for box in page.evaluate("boxes") if box["text"] == "wall 0.3"]
    covered = canvas.evaluate(BLUE, names[-1])
    right = names[-1]["left"] + names[-1]["width"]
    inside = canvas.evaluate("one => one.width")
    page.close()
    assert covered == 0
    assert right < inside


def test_one_point_is_a_dot_at_its_instant(browser: Browser, written: Written) -> None:
    values = np.full(500, np.nan)
    values[77] = 3.0
    with shown(browser, written(values)) as page:
        section = opened(page, "short")
        canvas = section.locator(".plot canvas")
        whole = {"left": 0, "top": 0, "width": 1400, "height": 230}
        until(page, lambda: canvas.evaluate(BLUE, whole) > 8)
        plot = section.locator(".plot")
        plot.focus()
        page.keyboard.press("End")
        until(page, lambda: told(plot) == (0.154, {"q": "3 m"}))


def test_points_between_gaps_are_dots(browser: Browser, written: Written) -> None:
    values = np.full(500, np.nan)
    values[50:500:100] = 1.0
    with shown(browser, written(values)) as page:
        canvas = opened(page, "short").locator(".plot canvas")
        whole = {"left": 0, "top": 0, "width": 1400, "height": 230}
        # Five of some twenty pixels each.
        until(page, lambda: canvas.evaluate(BLUE, whole) > 40)


def test_a_curve_without_a_number_says_so(browser: Browser, written: Written) -> None:
    with shown(browser, written(np.full(500, np.nan))) as page:
        assert legend(opened(page, "short")) == "Nothing is drawn: no value is a number."


@pytest.mark.parametrize("width", [390, 800])
def test_a_long_name_stays_within_its_panel(width: int, browser: Browser, written: Written) -> None:
    with shown(browser, written(np.ones(500), label=LONG), width=width) as page:
        section = opened(page, "short")
        panel, name = (section.locator(one).bounding_box() or {} for one in (".panel", ".curve"))
        assert name["x"] + name["width"] <= panel["x"] + panel["width"] + 1
        assert LONG in legend(section)
        assert page.evaluate("document.documentElement.scrollWidth") <= width


def test_a_long_and_lively_run_says_how_far_its_line_is_off(browser: Browser, written: Written) -> None:
    values = np.random.default_rng(3).uniform(-1.0, 1.0, 50_000)
    with shown(browser, written(values)) as page:
        said = legend(opened(page, "short"))
    assert "Thinned, and off between its points: q by up to " in said
    off = float(said.partition("up to ")[2].split()[0])
    assert 1.0 < off <= 2.0
