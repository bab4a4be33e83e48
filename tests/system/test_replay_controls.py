"""The replay in a browser: how it is steered, by mouse, by key, by the bus, and what it says to a screen reader."""

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from contrast import faint
from exo.experiment import Experiment
from replays import MASSES, Opening, browsers, lifted, pages, pushed, scene


@pytest.fixture(scope="module")
def payload(fmu_dir: Path) -> Experiment:
    """Experiment 3 until the payload is in the air, standard law and proposed law."""
    return lifted(fmu_dir)


@pytest.fixture(scope="module")
def wall(fmu_dir: Path) -> Experiment:
    """The wall, standard law and proposed law."""
    return pushed(fmu_dir)


@pytest.fixture(scope="module")
def start() -> Iterator[Callable[..., Any]]:
    """Starts browsers by their switches, each once."""
    yield from browsers()


@pytest.fixture
def opened(start: Callable[..., Any], tmp_path: Path) -> Iterator[Opening]:
    """Opens a page with a scene or with a geometry to feed, and finds after the test that it had no complaint."""
    yield from pages(start, tmp_path)


def test_play_moves_time_and_pose_and_pause_stops_both(wall: Experiment, opened: Opening) -> None:
    page = opened(scene(wall))
    before = page.at(2.0)
    page.page.get_by_role("button", name="Play").click()
    page.page.wait_for_function("handle.state().time > 2.6")
    moved = page.state()
    assert moved["playing"]
    assert moved["views"][1]["q"] != before["views"][1]["q"]
    page.page.get_by_role("button", name="Pause").click()
    stopped = page.state()
    assert not stopped["playing"]
    page.page.wait_for_timeout(250)
    assert page.state()["time"] == stopped["time"]


def test_speed_is_that_of_the_clock_times_the_choice(wall: Experiment, opened: Opening) -> None:
    page = opened(scene(wall))
    page.page.get_by_label("Speed").select_option("4")
    passed = page.page.evaluate(
        """() => {
            bus.set(1, "plots");
            let waiting = [];
            window.requestAnimationFrame = (call) => waiting.push(call);
            handle.play();
            const clock = performance.now();
            for (let k = 1; k <= 40; k++) waiting.splice(0).forEach((call) => call(clock + 50 * k));
            return bus.time - 1;
        }"""
    )
    assert passed == pytest.approx(4.0 * 40 * 0.05, rel=0.01)


def test_the_button_of_the_story_plays_it_and_stops_at_its_end(wall: Experiment, opened: Opening) -> None:
    document = scene(wall)
    document["story"] = {"from": 20.0, "to": 20.6, "speed": 2.0}
    page = opened(document)
    page.page.get_by_role("button", name="Watch how it sticks").click()
    assert page.state()["speed"] == 2.0
    page.page.wait_for_function("!handle.state().playing")
    assert page.state()["time"] == pytest.approx(20.6)


def test_a_key_plays_steps_and_jumps(wall: Experiment, opened: Opening) -> None:
    page = opened(scene(wall))
    page.page.locator(".exo-replay").focus()
    press = page.page.keyboard.press
    page.at(5.0)
    press("ArrowRight")
    assert page.state()["time"] == pytest.approx(5.1)
    press("Shift+ArrowLeft")
    assert page.state()["time"] == pytest.approx(4.1)
    press("End")
    assert page.state()["time"] == pytest.approx(44.998)
    press("Home")
    assert page.state()["time"] == 0.0
    press("Space")
    assert page.state()["playing"]
    press("Space")
    assert not page.state()["playing"]
    # A choice of cases keeps its keys.
    page.at(5.0)
    page.page.get_by_label("First case").focus()
    press("ArrowRight")
    assert page.state()["time"] == 5.0


def test_two_laws_are_chosen_and_one_alone(wall: Experiment, opened: Opening) -> None:
    page = opened(scene(wall))
    assert [one["case"] for one in page.at(3.0)["views"]] == list(MASSES)
    page.page.get_by_label("First case").select_option(MASSES[1])
    assert [one["case"] for one in page.state()["views"]] == [MASSES[1], MASSES[1]]
    page.page.get_by_label("Second case").select_option("no second case")
    assert [one["case"] for one in page.at(4.0)["views"]] == [MASSES[1]]
    page.page.get_by_role("button", name="Compare with another case").click()
    assert [one["case"] for one in page.at(5.0)["views"]] == [MASSES[1], MASSES[0]]


def test_a_screen_reader_is_told_what_is_seen_and_when_it_sticks(payload: Experiment, opened: Opening) -> None:
    page = opened(scene(payload))
    page.at(6.0)
    assert page.page.get_by_role("group", name="Replay: Arm, experiment 3").count() == 1
    page.at(9.0)
    pictures = [one.get_attribute("aria-label") for one in page.page.get_by_role("img").all()]
    assert pictures[0].startswith("At 9.0 s: The hand pulls away, but the payload sticks to the table")
    slider = page.page.get_by_role("slider", name="Time")
    assert slider.get_attribute("aria-valuetext") == "9.00 seconds of 12"
    heard = page.page.locator("[aria-live=polite]").inner_text()
    assert heard.startswith(("standard, 17.5 kg: The hand pulls away", "passive_bounded, 17.5 kg: The payload lets go"))
    unnamed = page.page.evaluate(
        "[...document.querySelectorAll('button, select, input')]"
        ".filter(one => !(one.ariaLabel || one.textContent.trim() || one.labels?.length)).length"
    )
    assert unnamed == 0


@pytest.mark.parametrize("dark", [False, True])
def test_text_stands_out_in_both_colour_schemes(
    dark: bool, wall: Experiment, payload: Experiment, opened: Opening
) -> None:
    scheme = "dark" if dark else "light"
    for experiment, time in ((wall, 30.0), (payload, 9.0)):
        page = opened(scene(experiment), dark=dark, color_scheme=scheme)
        page.at(time)
        page.page.wait_for_timeout(200)
        assert faint(page.page, skipped=".er-on") == {}


def test_it_plays_by_itself_only_if_asked_and_never_for_who_wants_less_motion(
    wall: Experiment, opened: Opening
) -> None:
    document = scene(wall)
    asked = opened(document, options="{autoplay: true}")
    asked.page.wait_for_function("handle.state().playing")
    still = opened(document, options="{autoplay: true}", reduced_motion="reduce")
    silent = opened(document)
    for one in (still, silent):
        one.page.wait_for_timeout(400)
        assert not one.state()["playing"]
        assert one.state()["time"] == 0.0


@pytest.mark.parametrize("which", ["wall", "payload"])
@pytest.mark.parametrize("width", [390, 1400])
def test_nothing_is_wider_than_the_screen(
    which: str, width: int, request: pytest.FixtureRequest, opened: Opening
) -> None:
    page = opened(scene(request.getfixturevalue(which)), width=width)
    page.at(9.0)
    page.page.wait_for_timeout(200)
    assert page.page.evaluate("document.documentElement.scrollWidth") <= width
    outside = page.page.evaluate(
        """[...document.querySelectorAll(".er-svg text, .er-tag")].filter((one) => {
            const [a, b] = [one.getBoundingClientRect(), one.closest(".er-draw").getBoundingClientRect()];
            return a.width && (a.left < b.left - 1 || a.right > b.right + 1);
        }).map((one) => one.textContent)"""
    )
    assert outside == []


def test_what_is_disposed_of_leaves_nothing_behind(payload: Experiment, opened: Opening) -> None:
    page = opened(scene(payload))
    listening = page.page.evaluate(
        """() => {
            let count = 0;
            const counted = { ...bus, range: bus.range, subscribe(listener) {
                const stop = bus.subscribe(listener);
                count += 1;
                return () => ((count -= 1), stop());
            } };
            const another = exoReplay.mount(place, given, counted);
            const before = count;
            another.dispose();
            return [before > 0, count];
        }"""
    )
    assert listening == [True, 0]
    page.page.evaluate("handle.dispose()")
    assert page.page.evaluate("place.childElementCount") == 0


def test_a_scene_of_another_version_and_a_case_that_is_not_there_are_refused(wall: Experiment, opened: Opening) -> None:
    page = opened(scene(wall))
    refused = "(run) => { try { run(); } catch (error) { return error.message; } }"
    answer = page.page.evaluate(f"({refused})(() => exoReplay.mount(place, {{ version: 7 }}, bus))")
    assert answer == "exoReplay: expected a scene of version 1, got 7"
    answer = page.page.evaluate(f"({refused})(() => handle.show(['pasive']))")
    assert answer == f"exoReplay: no case pasive; expected one of {', '.join(MASSES)}"
