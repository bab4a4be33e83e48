"""The plots of the report's page in a browser: what one clicks, drags and types does what it says."""

from collections.abc import Iterator
from importlib import resources
from pathlib import Path

import numpy as np
import pyarrow.parquet as pq
import pytest
from playwright.sync_api import Browser

from exo import experiment, loop, report, results
from exo.scenario import load
from exo.selection import narrowed
from reports import opened, ranges, told

from browser import chromium, shown, until
from commands import SHORT, exo


@pytest.fixture(scope="module")
def file(fmu_dir: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A page of time plots: the wall under each law."""
    out = tmp_path_factory.mktemp("page")
    wall = narrowed(load("wall"), cases=["*_5_0.5"])
    results.write(experiment=experiment.run(scenario=wall, fmu_dir=fmu_dir, engine=loop.fastest()), out=out)
    return report.write(out=out, scenarios=["wall"])


@pytest.fixture(scope="module")
def browser() -> Iterator[Browser]:
    """One for all tests."""
    with chromium() as found:
        yield found


def test_an_experiment_without_numbers_is_there_and_a_gap_is_no_line(
    browser: Browser, tmp_path: Path, fmu_dir: Path
) -> None:
    path, out = tmp_path / "short.toml", tmp_path / "out"
    before, _, after = SHORT.partition("[[metrics]]")
    path.write_text(before + after[after.index("[[figures]]") :], encoding="utf-8")
    exo("run", path, "--fmu-dir", fmu_dir, "--out", out)
    drawn = out / "short" / "figures" / "q.parquet"
    table = pq.read_table(drawn)
    values = table.column(1).to_numpy().copy()
    values[200:300] = np.nan
    pq.write_table(table.set_column(1, table.schema.field(1), [values]), drawn)
    exo("report", "--out", out)
    with shown(browser, out / "report.html") as page:
        assert "nothing is judged" in page.inner_text("h1")
        assert page.inner_text("#short summary .badge") == "info"
        plot = opened(page, "short").locator(".plot")
        assert page.locator("#short .own-verdicts table").count() == 0

        def inked(instant: float) -> bool:
            """Whether the curve's colour stands anywhere above the instant (s)."""
            return bool(
                plot.locator("canvas").evaluate(
                    """(canvas, share) => {
                        const over = canvas.parentElement.querySelector(".u-over");
                        const scale = canvas.width / canvas.clientWidth;
                        const x = Math.round(scale * (over.offsetLeft + share * over.clientWidth));
                        const height = Math.round(scale * (over.offsetTop + over.clientHeight));
                        const { data } = canvas.getContext("2d").getImageData(x - 1, 0, 3, height);
                        for (let k = 0; k < data.length; k += 4) {
                            if (data[k + 3] > 60 && data[k + 2] - data[k] > 60) return true;
                        }
                        return false;
                    }""",
                    instant / 0.998,
                )
            )

        until(page, lambda: inked(0.2))
        assert inked(0.8)
        assert not inked(0.5)
        for key, value in (("0.2", True), ("0.5", False), ("0.8", True)):
            page.locator("#short .timebar input").fill(key)
            until(page, lambda key=key: told(plot)[0] == pytest.approx(float(key), abs=2e-3))
            assert ("–" not in told(plot)[1]["q"]) == value
        page.locator("#search").fill("nowhere to be found")
        until(page, lambda: not page.locator("#short").is_visible())


def test_all_plots_show_the_instant_under_the_mouse(browser: Browser, file: Path) -> None:
    with shown(browser, file) as page:
        plots = opened(page, "wall").locator(".plot").all()
        area = plots[0].locator(".u-over")
        area.hover(position={"x": 0.25 * (area.bounding_box() or {})["width"], "y": 40})
        until(page, lambda: told(plots[0])[0] > 20.0)
        instants = {told(plot)[0] for plot in plots}
        assert len(instants) == 1
        # A quarter of the way from 19.5 s to 42 s; q of the standard law still at the wall, the other off it.
        assert instants.pop() == pytest.approx(25.125, abs=0.1)
        q = told(plots[0])[1]
        assert float(q["standard"].split()[0]) == pytest.approx(0.3, abs=1e-3)
        assert float(q["passive_bounded"].split()[0]) < 0.0
        assert q["standard"].endswith(" m")
        assert told(plots[1])[1]["standard"].endswith(" N")
        places = [plot.locator(".u-cursor-x").evaluate("line => line.getBoundingClientRect().left") for plot in plots]
        assert places[0] == pytest.approx(places[1], abs=1.5)
        # The slider moves them, too, and says where they are.
        page.locator("#wall .timebar input").fill("30")
        until(page, lambda: {told(plot)[0] for plot in plots} == {30.0})
        assert page.inner_text("#wall .timebar output") == "t = 30.0 s"


def test_a_drag_zooms_all_plots_and_a_double_click_shows_all_again(browser: Browser, file: Path) -> None:
    with shown(browser, file) as page:
        plots = opened(page, "wall").locator(".plot").all()
        home = ranges(plots)
        assert home == [("19.5", "42")] * 2
        area = plots[1].locator(".u-over")
        area.scroll_into_view_if_needed()
        box = area.bounding_box() or {}
        y = box["y"] + box["height"] / 2

        def drag(first: float, last: float) -> None:
            page.mouse.move(box["x"] + first * box["width"], y)
            page.mouse.down()
            page.mouse.move(box["x"] + last * box["width"], y, steps=4)
            page.mouse.up()

        drag(0.2, 0.4)
        zoomed = [(float(a), float(b)) for a, b in ranges(plots)]
        assert zoomed[0] == zoomed[1] == (pytest.approx(24.0, abs=0.1), pytest.approx(28.5, abs=0.1))
        page.keyboard.down("Shift")
        drag(0.5, 0.25)
        page.keyboard.up("Shift")
        shifted = [(float(a), float(b)) for a, b in ranges(plots)]
        assert shifted[0] == (pytest.approx(25.125, abs=0.15), pytest.approx(29.625, abs=0.15))
        page.mouse.dblclick(box["x"] + 100, y)
        assert ranges(plots) == home
        page.get_by_role("button", name="Zoom in").click()
        page.get_by_role("button", name="Reset").or_(page.get_by_role("button", name="Show everything again")).click()
        assert ranges(plots) == home


def test_a_click_on_a_law_hides_it_in_every_panel_and_a_double_click_shows_it_alone(
    browser: Browser, file: Path
) -> None:
    with shown(browser, file) as page:
        section = opened(page, "wall")

        def shown_laws() -> list[set[str]]:
            return [
                {one.get_attribute("data-label") or "" for one in panel.locator('.curve[aria-pressed="true"]').all()}
                for panel in section.locator(".panel").all()
            ]

        def orange() -> int:
            """Pixels in the colour of the law passive, vermillion."""
            return int(
                section.locator(".uplot canvas").first.evaluate(
                    """canvas => {
                      const data = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data;
                      const is = (i) => data[i] > 180 && data[i + 2] < 60 && data[i + 3] > 200;
                      let count = 0;
                      for (let i = 0; i < data.length; i += 4) count += is(i);
                      return count;
                    }"""
                )
            )

        every = {"standard", "passive", "passive_applied", "passive_bounded"}
        assert shown_laws() == [every, every]
        assert orange() > 20
        section.locator('.curve[data-label="passive"]').first.click()
        assert shown_laws() == [every - {"passive"}] * 2
        until(page, lambda: orange() == 0)
        section.locator('.curve[data-label="standard"]').last.dblclick()
        assert shown_laws() == [{"standard"}] * 2
        section.locator('.curve[data-label="standard"]').last.dblclick()
        assert shown_laws() == [every] * 2


def test_the_keys_alone_open_a_section_and_move_and_zoom(browser: Browser, file: Path) -> None:
    with shown(browser, file) as page:
        page.locator("#wall summary").first.focus()
        page.keyboard.press("Enter")
        plot = page.locator("#wall .plot").first
        plot.wait_for()
        for _ in range(80):
            page.keyboard.press("Tab")
            if plot.evaluate("one => one === document.activeElement"):
                break
        assert plot.evaluate("one => one === document.activeElement")
        assert plot.get_attribute("role") == "slider"
        assert "q [m]" in (plot.get_attribute("aria-label") or "")
        page.keyboard.press("Home")
        until(page, lambda: told(plot)[0] == 19.5)
        for key in ("ArrowRight", "ArrowRight", "Shift+ArrowRight"):
            page.keyboard.press(key)
        until(page, lambda: told(plot)[0] == pytest.approx(19.5 + 12 * 22.5 / 200))
        page.keyboard.press("+")
        first, last = (float(x) for x in ranges([plot])[0])
        assert last - first == pytest.approx(22.5 / 2)
        page.keyboard.press("PageDown")
        assert float(ranges([plot])[0][0]) == pytest.approx(first + 22.5 / 4)
        page.keyboard.press("Escape")
        assert ranges([plot]) == [("19.5", "42")]


def test_the_bus_tells_everyone_once_and_ends_with_its_subscription(browser: Browser, tmp_path: Path) -> None:
    script = (resources.files("exo") / "web" / "timebus.js").read_text(encoding="utf-8")
    empty = tmp_path / "empty.html"
    empty.write_text("<!doctype html><title>t</title>", encoding="utf-8")
    with shown(browser, empty) as page:
        heard = page.evaluate(
            "() => {"
            + script
            + """
            const bus = createTimeBus([1, 5]);
            const heard = [];
            const stop = bus.subscribe((t, source) => heard.push(["a", t, source]));
            bus.subscribe((t, source) => { heard.push(["b", t, source]); bus.set(3, "b"); });
            const first = bus.time;
            bus.set(9, "mouse");
            bus.set(NaN, "mouse");
            stop();
            bus.set(2, "keys");
            return { first, heard, range: bus.range, last: bus.time };
            }"""
        )
    assert heard["first"] == 1
    assert heard["range"] == [1, 5]
    assert heard["heard"][:2] == [["a", 5, "mouse"], ["b", 5, "mouse"]]
    assert heard["heard"][2:4] == [["a", 3, "b"], ["b", 3, "b"]]
    assert [one for one in heard["heard"][4:] if one[0] == "a"] == []
    assert heard["last"] == 3


#: Records what is written on canvases, and where it begins (device px).
HEARD = """
window.heard = [];
const draw = CanvasRenderingContext2D.prototype.fillText;
CanvasRenderingContext2D.prototype.fillText = function (text, x, ...others) {
    const width = this.measureText(text).width;
    heard.push([text, x - { left: 0, start: 0, center: width / 2, right: width, end: width }[this.textAlign]]);
    return draw.call(this, text, x, ...others);
};
"""


@pytest.mark.parametrize("factor", [1.0, -1.5e7, 2.25e12, 1.25e-9, -1.25e30])
def test_what_stands_beside_an_axis_is_not_cut_whatever_its_size(
    factor: float, browser: Browser, tmp_path: Path, fmu_dir: Path
) -> None:
    path, out = tmp_path / "short.toml", tmp_path / "out"
    path.write_text(SHORT, encoding="utf-8")
    exo("run", path, "--fmu-dir", fmu_dir, "--out", out)
    drawn = out / "short" / "figures" / "q.parquet"
    table = pq.read_table(drawn)
    values = table.column(1).to_numpy() * factor
    pq.write_table(table.set_column(1, table.schema.field(1), [values]), drawn)
    exo("report", "--out", out)
    page = browser.new_page()
    page.add_init_script(HEARD)
    page.goto((out / "report.html").as_uri())
    opened(page, "short")
    heard = page.evaluate("heard")
    page.close()
    assert len(heard) > 8
    assert [text for text, begin in heard if begin < 0.0] == []
    beyond = max(abs(float(text.replace("−", "-"))) for text, _ in heard if text)
    assert beyond >= 0.2 * np.abs(values).max()
