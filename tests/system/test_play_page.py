"""The page of `exo play` in a browser: by mouse, keys and knobs, with a run that is saved."""

import shutil
import threading
from collections.abc import Callable, Iterator
from contextlib import suppress
from pathlib import Path
from time import monotonic, sleep
from typing import Any

import pytest

from contrast import faint
from exo import loop, selection
from exo.play import bench as benches
from exo.play import server
from exo.play.live import Live

WEBGL = ("--use-angle=swiftshader", "--enable-unsafe-swiftshader")


@pytest.fixture(scope="module")
def browser() -> Iterator[Any]:
    """A browser that asks nothing of its own."""
    path = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
    if path is None:
        pytest.skip("no browser: neither chromium nor chromium-browser nor google-chrome is on the PATH")
    tool = pytest.importorskip("playwright.sync_api", reason="playwright is not installed").sync_playwright
    with tool() as playwright:
        started = playwright.chromium.launch(
            executable_path=path, args=["--no-sandbox", "--disable-background-networking", *WEBGL]
        )
        yield started
        started.close()


@pytest.fixture
def opened(browser: Any, fmu_dir: Path, tmp_path: Path) -> Iterator[Callable[..., Any]]:
    """Opens a bench in a page, and finds after the test that the page had no complaint and asked nobody else."""
    complaints: list[str] = []
    requests: list[str] = []
    ends: list[Callable[[], None]] = []
    origins: list[str] = []

    def open_page(kind: str, *, width: int = 1000, dark: bool = False) -> Any:
        bound = server.bind(0)
        live = Live(benches.named(kind), fmu_dir=fmu_dir, engine=loop.fastest()).__enter__()
        live.begun()
        running = server.server(live, token="tests", out=tmp_path / "played")
        thread = threading.Thread(target=lambda: running.run(sockets=[bound]))
        thread.start()
        page = browser.new_page(
            viewport={"width": width, "height": 900}, color_scheme="dark" if dark else "light", reduced_motion="reduce"
        )
        page.on("console", lambda said: complaints.append(said.text) if said.type in ("error", "warning") else None)
        page.on("pageerror", lambda error: complaints.append(str(error)))
        page.on("request", lambda request: requests.append(request.url))
        address = server.address(bound, "tests")
        origins.append(address)

        def end() -> None:
            page.close()
            running.should_exit = True
            thread.join(timeout=10)
            live.__exit__()
            bound.close()

        ends.append(end)
        page.goto(address)
        until(page, "state.time > 0.1")
        return page

    yield open_page
    for end in ends:
        end()
    # Of the software WebGL, not of the page.
    assert [text for text in complaints if "GPU stall due to ReadPixels" not in text] == []
    assert [url for url in requests if not url.startswith(("data:", "blob:", "about:"))] == origins


def until(page: Any, test: str, *, within: float = 90.0) -> Any:
    """The state of the page when `test`, in JavaScript about `state`, is true.

    The page's policy forbids the browser's own way to wait, which evaluates a text.
    """
    end = monotonic() + within
    while monotonic() < end:
        found = page.evaluate(
            f"(() => {{ const state = exoPlay.state(); return state && ({test}) ? state : null; }})()"
        )
        if found:
            return found
        sleep(0.03)
    return pytest.fail(f"not within {within} s: {test}; the state: {page.evaluate('exoPlay.state()')}")


def drag(page: Any, *, right: float, down: float = 0.0) -> None:
    """Takes the drawing in its middle and leads it by shares of its width and height; does not let go.

    On a machine with much to do the page may hear nothing for three seconds, and lets go itself: it is taken again.
    """
    place = page.locator("#grip .er-draw")
    place.scroll_into_view_if_needed()
    box = place.bounding_box()
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    for _ in range(5):
        page.mouse.move(x, y)
        page.mouse.down()
        page.mouse.move(x + right * box["width"], y + down * box["height"], steps=5)
        with suppress(pytest.fail.Exception):
            until(page, "state.target !== null", within=15.0)
            return
        page.mouse.up()
    pytest.fail("the run has heard of no hand, five times")


def test_the_wall_is_understood_with_the_mouse(opened: Callable[..., Any]) -> None:
    page = opened("testbed")
    assert "Push the mass into the wall, hold for five seconds, then pull back" in page.inner_text("#hint")
    page.select_option("#knob-law", "standard")
    drag(page, right=0.4)
    touched = until(page, "state.word === 'touches' && state.values['controller.q_n'] > 2")
    assert touched["target"][0] > 0.3
    # What is drawn follows, frame by frame.
    until(page, "Math.abs(exoPlay.drawn().q - 0.3) < 0.02")
    assert "Hold" in page.inner_text("#hint")
    box = page.locator("#grip").bounding_box()
    page.mouse.move(box["x"] + box["width"] * 0.3, box["y"] + 100, steps=3)
    until(page, "state.word === 'sticks'")
    assert page.inner_text("#word") == "Sticks"
    assert "behind the wall" in page.inner_text("#hint")
    assert "not passive" in page.inner_text("#tank-text")
    page.mouse.up()
    assert until(page, "state.target === null")
    assert page.evaluate("exoPlay.charts().times") > 20

    page.click("#repeat")
    until(page, "state.settings.law === 'passive_bounded' && state.repeats")
    let_go = until(page, "state.let_go !== null")
    assert let_go["stuck"] < 0.5
    assert "It came away" in page.inner_text("#hint")
    assert page.inner_text("#repeat") == "Same push with the standard law"


def test_keys_push_and_the_space_bar_lets_go(opened: Callable[..., Any]) -> None:
    page = opened("testbed", width=390, dark=True)
    page.keyboard.down("ArrowRight")
    until(page, "state.force[0] === 2.5 && state.values['plant.q'] > 0.02")
    page.keyboard.up("ArrowRight")
    until(page, "state.force[0] === 0")
    page.fill("#forces input", "-3")
    until(page, "state.force[0] === -3")
    page.focus("#grip")
    page.keyboard.press("Space")
    until(page, "state.force[0] === 0")


def test_knobs_act_and_a_run_is_saved(opened: Callable[..., Any], tmp_path: Path) -> None:
    page = opened("testbed")
    page.fill("#knob-K", "40")
    until(page, "state.settings.K === 40 && state.run === 1")
    page.fill("#knob-stiffness", "500")
    until(page, "state.stiffness === 500")
    page.click("#pause")
    until(page, "state.paused")
    assert page.inner_text("#pause") == "Go on"
    page.fill("#save-name", "../x")
    page.click("#save button")
    page.get_by_text("expected letters, digits").wait_for()
    page.fill("#save-name", "by-hand")
    page.click("#save button")
    page.locator("#saved code").wait_for()
    file = tmp_path / "played" / "by-hand.toml"
    assert page.inner_text("#saved code") == f"exo run {file}"
    [data] = selection.load([str(file)])
    assert data.id == "by-hand"
    page.click("#pause")
    page.click("#again")
    until(page, "state.run === 2 && !state.paused")


def test_the_arm_follows_the_mouse_in_three_dimensions(opened: Callable[..., Any]) -> None:
    page = opened("arm")
    before = until(page, "state.time > 0.2")["values"]
    drag(page, right=0.03, down=-0.1)
    after = until(page, f"state.values['plant.p[3]'] > {before['plant.p[3]']} + 0.03")["values"]
    assert page.evaluate("exoPlay.drawn()")["arms"][0]["hand"][2] == pytest.approx(after["plant.p[3]"], abs=0.05)
    page.mouse.up()
    page.check("#switch-vacuum")
    until(page, "state.switches.vacuum && state.target === null")


def test_a_slider_that_is_held_stays_where_it_is_held_and_acts_when_it_is_let_go(opened: Callable[..., Any]) -> None:
    page = opened("testbed")
    box = page.locator("#knob-mass").bounding_box()
    middle = box["y"] + box["height"] / 2
    page.mouse.move(box["x"] + 0.3 * box["width"], middle)
    page.mouse.down()
    page.mouse.move(box["x"] + 0.6 * box["width"], middle, steps=4)
    held = page.input_value("#knob-mass")
    assert float(held) == pytest.approx(18.4, abs=1.0)
    until(page, f"state.time > {until(page, 'true')['time']} + 1.2")
    assert page.input_value("#knob-mass") == held
    page.mouse.up()
    assert until(page, "state.run === 2")["settings"]["mass"] == pytest.approx(float(held), abs=0.06)


def test_a_page_shows_what_another_one_has_set(opened: Callable[..., Any]) -> None:
    page = opened("testbed")
    page.focus("#knob-law")
    other = page.context.browser.new_page()
    other.goto(page.url)
    until(other, "state.time > 0")
    other.select_option("#knob-law", "passive_applied")
    until(page, "document.getElementById('knob-law').value === 'passive_applied' && state.settings.law !== 'standard'")
    other.fill("#forces input", "-2.5")
    until(page, "state.force[0] === -2.5 && document.querySelector('#forces input').value === '-2.5'")
    assert page.inner_text("#forces output") == "−2.5"
    other.close()
    until(page, "document.querySelector('#forces input').value === '0'")


def test_what_is_refused_is_said_at_the_top_of_the_window(opened: Callable[..., Any]) -> None:
    page = opened("testbed", width=390)
    page.evaluate("document.getElementById('knob-K').max = 100")
    page.locator("#charts").scroll_into_view_if_needed()
    page.fill("#knob-K", "90")
    page.get_by_text("K = 90: expected a number from 1 to 60 N·s/m").wait_for()
    assert page.locator("#refused").bounding_box()["y"] < 60
    assert page.inner_text("#saved") == ""


def test_a_page_too_many_says_so_and_comes_in_when_another_is_closed(
    opened: Callable[..., Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(server, "TABS", 1)
    page = opened("testbed")
    late = page.context.browser.new_page()
    late.goto(page.url)
    late.get_by_text("1 pages are open, as many as there may be. Close one of them.").wait_for()
    page.goto("about:blank")
    until(late, "state.time > 0")
    assert not late.is_visible("#lost")
    late.close()


def test_a_mass_that_has_left_the_drawing_says_where_it_is(opened: Callable[..., Any]) -> None:
    page = opened("testbed")
    page.fill("#forces input", "-10")
    # What is drawn comes after what is told.
    text = "(document.querySelector('.er-place')?.textContent ?? '')"
    place = f"Number({text}.replace(/[^−.0-9]/g, '').replace('−', '-'))"
    until(page, f"state.values['plant.q'] < -12 && {place} < -11")
    said = page.locator(".er-place").text_content()
    assert said.startswith("mass at −")
    assert said.endswith("\u00a0m")
    assert page.evaluate(place) > -60
    assert "−10" in page.locator(".er-tick + text").all_text_contents()


def test_lines_of_a_chart_have_the_colours_of_the_drawing_and_differ_without_them(opened: Callable[..., Any]) -> None:
    page = opened("testbed")
    page.fill("#forces input", "3")
    until(page, "state.force[0] === 3")
    mark = "getComputedStyle(document.querySelectorAll('#charts .u-legend')[{0}].querySelectorAll('.u-marker')[{1}])"
    colour, style = mark + ".borderTopColor", mark + ".borderTopStyle"
    assert page.evaluate(colour.format(0, 0)) == "rgb(0, 114, 178)"
    drawn = "getComputedStyle(document.querySelector('.er-mass')).fill"
    assert page.evaluate(drawn) == "rgb(0, 114, 178)"
    assert [page.evaluate(style.format(1, i)) for i in (0, 1)] == ["solid", "dashed"]


def test_a_screen_reader_hears_what_happens_and_not_every_number(opened: Callable[..., Any]) -> None:
    page = opened("testbed")
    # Where nothing happens, no region that is read aloud changes while the run goes on: but for whether it keeps up.
    page.evaluate(
        "window.heard = []; new MutationObserver((seen) => heard.push(...seen.map((one) => one.target.nodeName + "
        "(one.target.id ?? '')))).observe(document.body, { subtree: true, childList: true, characterData: true })"
    )
    until(page, f"state.time > {until(page, 'true')['time']} + 1.0")
    assert page.evaluate("heard.includes('SPANtime')")
    live = (
        "heard.filter((name) => [...document.querySelectorAll('[role=status], [role=alert], [aria-live], output')]"
        ".some((one) => one.id !== 'status' && one.ariaLive !== 'off' && one.nodeName + one.id === name))"
    )
    assert page.evaluate(live) == []
    assert page.evaluate("document.querySelectorAll('output').length") > 4
    assert page.evaluate("document.getElementById('tank').ariaValueText") == page.inner_text("#tank-text")


def test_the_handle_stays_below_the_mouse_from_however_far_it_is_seen(opened: Callable[..., Any]) -> None:
    page = opened("arm")
    before = until(page, "state.time > 0.2")["values"]["plant.p[3]"]

    def led() -> float:
        drag(page, right=0.0, down=-0.1)
        # The last of its steps is told with a frame.
        told, target = None, until(page, "state.target !== null")["target"]
        while told != target:
            page.wait_for_timeout(500)
            told, target = target, until(page, "state.target !== null")["target"]
        page.mouse.up()
        until(page, "state.target === null")
        return float(target[2]) - before

    near = led()
    page.click("#again")
    until(page, "state.run === 2 && state.time > 0.1")
    for _ in range(2):
        page.get_by_role("button", name="Farther").click()
    assert led() == pytest.approx(1.25**2 * near, rel=0.05)


def test_a_handle_that_is_pushed_far_away_stays_in_the_picture(opened: Callable[..., Any]) -> None:
    """The camera steps back, unless somebody has moved it, or the mouse leads the handle."""
    page = opened("arm")
    page.get_by_role("button", name="Names").click()

    handle = page.locator(".er-tag", has_text="handle")
    handle.wait_for(state="visible")
    for _ in range(2):
        page.get_by_role("button", name="Closer").click()
    page.keyboard.down("ArrowUp")
    until(page, "state.values['plant.p[3]'] > 0.55")
    page.keyboard.up("ArrowUp")
    handle.wait_for(state="hidden")
    page.get_by_role("button", name="Side").click()
    handle.wait_for(state="visible")


@pytest.mark.parametrize("dark", [False, True])
def test_text_stands_out_whatever_happens(dark: bool, opened: Callable[..., Any]) -> None:
    page = opened("testbed", dark=dark)
    assert faint(page, skipped=".er-on") == {}
    page.fill("#forces input", "10")
    until(page, "state.word === 'touches' && state.values['controller.q_n'] > 1")
    assert faint(page, skipped=".er-on") == {}
    page.fill("#forces input", "-10")
    until(page, "state.word === 'sticks'")
    assert faint(page, skipped=".er-on") == {}
    page.click("#repeat")
    until(page, "state.let_go !== null")
    assert faint(page, skipped=".er-on") == {}


def test_without_scripts_a_sentence_says_what_is_missing(opened: Callable[..., Any]) -> None:
    page = opened("testbed")
    context = page.context.browser.new_context(java_script_enabled=False)
    other = context.new_page()
    other.goto(page.url)
    assert other.get_by_text("Scripts are off, and this page cannot do without them").is_visible()
    context.close()


@pytest.mark.parametrize("width", [390, 800, 1400])
def test_nothing_is_cut_off(width: int, opened: Callable[..., Any]) -> None:
    page = opened("testbed", width=width, dark=width == 800)
    assert page.evaluate("document.documentElement.scrollWidth") == width
    controls = "[...document.querySelectorAll('button, input, select')]"
    unnamed = f"{controls}.filter((one) => !(one.labels?.length || one.textContent.trim() || one.ariaLabel)).length"
    assert page.evaluate(unnamed) == 0
    assert page.evaluate("getComputedStyle(document.body).backgroundColor") == (
        "rgb(20, 24, 30)" if width == 800 else "rgb(255, 255, 255)"
    )
