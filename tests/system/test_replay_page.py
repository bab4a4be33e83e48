"""The replay in a browser: what is drawn is what was recorded, by mouse, by key, by the bus, with and without WebGL."""

import json
import shutil
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from exo import experiment as experiments
from exo import loop, replay, scenario
from exo.experiment import Experiment

from browser import until

WEB = Path(__file__).resolve().parents[2] / "harness" / "src" / "exo" / "web"
WEBGL = ("--use-angle=swiftshader", "--enable-unsafe-swiftshader")
NO_WEBGL = ("--disable-3d-apis",)
ARMS = ("standard_17.5kg", "passive_bounded_17.5kg")
MASSES = ("standard_5_0.5", "passive_bounded_5_0.5")


def run(name: str, *cases: str, fmu_dir: Path, **changed: Any) -> Experiment:
    """Some cases of a built-in scenario, without figures and verdicts."""
    full = scenario.load(name)
    chosen = tuple(case for case in full.cases if case.id in cases)
    data = full.model_copy(update={"cases": chosen, "figures": (), "ratios": (), "metrics": (), **changed})
    return experiments.run(scenario=data, fmu_dir=fmu_dir, engine=loop.fastest())


@pytest.fixture(scope="module")
def payload(fmu_dir: Path) -> Experiment:
    """Experiment 3 until the payload is in the air, standard law and proposed law."""
    return run("arm_payload", *ARMS, fmu_dir=fmu_dir, duration=12.0)


@pytest.fixture(scope="module")
def wall(fmu_dir: Path) -> Experiment:
    """The wall, standard law and proposed law."""
    return run("wall", *MASSES, fmu_dir=fmu_dir, duration=45.0)


@pytest.fixture(scope="module")
def both(fmu_dir: Path) -> Experiment:
    """Both arms until the payload is in the air."""
    return run("arm_both", "unequal", fmu_dir=fmu_dir, duration=9.0)


@dataclass(frozen=True)
class Opened:
    """A page with a replay, and what it has complained of and asked for."""

    page: Any
    complaints: list[str]
    requests: list[str]

    def state(self) -> Any:
        """What is drawn now."""
        return self.page.evaluate("handle.state()")

    def at(self, time: float) -> Any:
        """What is drawn at an instant that somebody else has set."""
        return self.page.evaluate(f"(bus.set({time}, 'plots'), handle.state())")

    def text(self) -> str:
        """What can be read."""
        return str(self.page.inner_text("body")).replace("\u00a0", " ")


Opening = Callable[..., Opened]


@pytest.fixture(scope="module")
def start() -> Iterator[Callable[..., Any]]:
    """Starts browsers by their switches, each once."""
    path = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
    if path is None:
        pytest.skip("no browser: neither chromium nor chromium-browser nor google-chrome is on the PATH")
    tool = pytest.importorskip("playwright.sync_api", reason="playwright is not installed").sync_playwright
    with tool() as playwright:
        started: dict[tuple[str, ...], Any] = {}

        def browser(*switches: str) -> Any:
            if switches not in started:
                arguments = ["--no-sandbox", "--disable-background-networking", *switches]
                started[switches] = playwright.chromium.launch(executable_path=path, args=arguments)
            return started[switches]

        yield browser
        for one in started.values():
            one.close()


@pytest.fixture
def opened(start: Callable[..., Any], tmp_path: Path) -> Iterator[Opening]:
    """Opens a page with a scene or with a geometry to feed, and finds after the test that it had no complaint."""
    pages: list[Opened] = []

    def open_page(
        what: Any,
        *,
        width: int = 900,
        dark: bool = False,
        options: str = "{}",
        switches: tuple[str, ...] = WEBGL,
        **how: Any,
    ) -> Opened:
        mounted = "mount(place, given, bus, options)" if "cases" in what else "live(place, given, options)"
        file = tmp_path / "page.html"
        file.write_text(
            "<!doctype html><html lang='en'><meta charset='utf-8'><meta name='viewport' content='width=device-width'>"
            f"<title>replay</title><body style='margin:8px;background:{'#101418' if dark else '#ffffff'}'>"
            "<div id='place'></div>"
            f"<script>{(WEB / 'timebus.js').read_text(encoding='utf-8')}</script>"
            f"<script>{(WEB / 'replay' / 'replay.js').read_text(encoding='utf-8')}</script>"
            f"<script>const given = {json.dumps(what)}, options = {options}, place = document.getElementById('place');"
            f"const bus = createTimeBus(given.range); const handle = exoReplay.{mounted};</script>",
            encoding="utf-8",
        )
        page = start(*switches).new_page(viewport={"width": width, "height": 900}, **how)
        one = Opened(page, [], [])
        page.on("console", lambda said: one.complaints.append(said.text) if said.type in ("error", "warning") else None)
        page.on("pageerror", lambda error: one.complaints.append(str(error)))
        page.on("request", lambda request: one.requests.append(request.url))
        page.goto(file.as_uri())
        pages.append(one)
        return one

    yield open_page
    for one in pages:
        one.page.close()
        # Of the software WebGL, not of the page.
        assert [text for text in one.complaints if "GPU stall due to ReadPixels" not in text] == []
        assert all(url.startswith(("file:", "data:", "blob:")) for url in one.requests)
        assert len(one.requests) == 1


def scene(experiment: Experiment) -> dict[str, Any]:
    """The scene of an experiment that has one."""
    document = replay.scene(experiment)
    assert document is not None
    return document


def place(experiment: Experiment, case: str, name: str, time: float) -> list[float]:
    """A recorded vector at an instant."""
    recorded = experiment.recordings[case]
    tick = round(time / recorded.step)
    return [float(recorded[f"{name}[{k}]"][tick]) for k in (1, 2, 3)]


def instants(document: dict[str, Any], case: str, count: int = 12) -> list[float]:
    """Some instants of a case that were kept."""
    column = document["cases"][case]["frames"]["t"]
    time = np.cumsum(column["steps"]) * column["unit"]
    return [float(t) for t in time[:: max(1, len(time) // count)]]


def test_the_hand_that_is_drawn_is_the_hand_that_was_recorded(payload: Experiment, opened: Opening) -> None:
    document = scene(payload)
    page = opened(document)
    for row, case in enumerate(ARMS):
        for time in instants(document, case):
            (arm,) = page.at(time)["views"][row]["arms"]
            assert arm["hand"] == pytest.approx(place(payload, case, "plant.p", time), abs=1e-6)
            assert arm["pad"] == pytest.approx(place(payload, case, "plant.p_pad", time), abs=1e-6)


def test_both_hands_that_are_drawn_are_those_that_were_recorded(both: Experiment, opened: Opening) -> None:
    document = scene(both)
    page = opened(document)
    for time in instants(document, "unequal", 8):
        left, right = page.at(time)["views"][0]["arms"]
        assert left["hand"] == pytest.approx(place(both, "unequal", "plant.left.p", time), abs=1e-6)
        assert right["hand"] == pytest.approx(place(both, "unequal", "plant.right.p", time), abs=1e-6)


def test_the_nominal_hand_is_drawn_where_the_law_has_it_or_named_with_its_distance(
    payload: Experiment, opened: Opening
) -> None:
    page = opened(scene(payload))
    ((arm,), (other,)) = (one["arms"] for one in page.at(9.0)["views"])
    hand, nominal = (np.array(place(payload, ARMS[0], name, 9.0)) for name in ("plant.p", "controller.p_n"))
    distance = float(np.linalg.norm(nominal - hand))
    assert distance > 0.6
    assert arm["away"] == pytest.approx(distance, abs=2e-3)
    drawn = np.array(arm["nominal"]) - hand
    assert np.cross(drawn, nominal - hand) == pytest.approx(np.zeros(3), abs=1e-3)
    assert other["nominal"] == pytest.approx(place(payload, ARMS[1], "controller.p_n", 9.0), abs=1e-3)
    until(page.page, lambda: f"nominal hand, {distance:.3f} m away" in page.text())


def test_the_payload_is_lifted_with_the_pad_and_stays_where_the_standard_law_sticks(
    payload: Experiment, opened: Opening
) -> None:
    document = scene(payload)
    page = opened(document)
    thickness = document["cases"][ARMS[0]]["geometry"]["payload"]["size"][2]
    before = page.at(1.0)["views"]
    lying = before[1]["payload"]
    assert lying[2] == pytest.approx(-0.4171 - thickness / 2, abs=5e-3)
    after = page.at(11.5)["views"]
    assert after[0]["payload"] == pytest.approx(before[0]["payload"], abs=5e-3)
    pad = place(payload, ARMS[1], "plant.p_pad", 11.5)
    assert pad[2] > 0.0
    assert after[1]["payload"] == pytest.approx([pad[0], pad[1], pad[2] - thickness / 2], abs=1e-3)


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


def test_the_wall_story_can_be_read_off(wall: Experiment, opened: Opening) -> None:
    page = opened(scene(wall))
    page.at(15.0)
    assert page.text().count("The hand presses the mass against the wall.") == 2
    page.at(30.0)
    text = page.text()
    assert "The hand pulls away, but the mass sticks to the wall: 9.75 s." in text
    assert "The nominal mass is 42 m behind the wall, so the drive pushes with 12.5 N." in text
    assert "hand pulls 5.0 N" in text
    assert "admittance filter alone, no reaction on the nominal; sticks to walls" in text
    assert "was stuck 0.33 s" in text
    page.at(37.4)
    assert "lets go after 17.04 s" in page.text()
    assert page.page.locator(".er-badge").all_inner_texts() == ["lets go", "free"]
    marks = page.page.locator(".er-marks span")
    assert marks.all_inner_texts() == ["hand turns", "lets go"]
    left = marks.evaluate_all("all => all.map(one => parseFloat(one.style.left))")
    assert left == pytest.approx([100 * 20.25 / 44.998, 100 * 37.294 / 44.998], abs=0.02)


def test_the_mass_and_the_nominal_mass_are_where_they_were_recorded(wall: Experiment, opened: Opening) -> None:
    document = scene(wall)
    page = opened(document)
    for row, case in enumerate(MASSES):
        recorded = wall.recordings[case]
        for time in instants(document, case):
            drawn, tick = page.at(time)["views"][row], round(time / recorded.step)
            assert drawn["q"] == pytest.approx(recorded["plant.q"][tick], abs=1e-6)
            assert drawn["q_n"] == pytest.approx(recorded["controller.q_n"][tick], abs=1e-4)
    # Seen from the page: the mass touches the wall, its ghost is behind it.
    page.at(30.0)
    face = page.page.locator(".er-mass").first.bounding_box()
    barrier = page.page.locator(".er-wall").first.bounding_box()
    ghost = page.page.locator("rect.er-ghost").first.bounding_box()
    assert face["x"] + face["width"] == pytest.approx(barrier["x"], abs=4.0)
    assert ghost["x"] > barrier["x"] + barrier["width"]


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


def colours(page: Opened) -> int:
    """Number of colours in the picture of the first view."""
    return int(
        page.page.evaluate(
            """() => {
                const canvas = document.querySelector(".er-canvas");
                const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
                return new Set(new Uint32Array(data.buffer)).size;
            }"""
        )
    )


def picture(page: Opened) -> bytes:
    """The picture of the first view, once it is drawn."""
    page.page.evaluate("new Promise(requestAnimationFrame).then(() => new Promise(requestAnimationFrame))")
    return bytes(page.page.locator(".er-canvas").first.screenshot())


@pytest.mark.parametrize("dark", [False, True])
def test_the_arm_is_seen_and_the_camera_goes_round_it(payload: Experiment, opened: Opening, dark: bool) -> None:
    page = opened(scene(payload), dark=dark, device_scale_factor=1)
    page.at(9.0)
    corner = picture(page)
    assert colours(page) > 500
    seen = {corner}
    for preset in ("Side", "Front", "Above"):
        button = page.page.get_by_role("button", name=preset)
        button.click()
        assert button.get_attribute("aria-pressed") == "true"
        seen.add(picture(page))
    assert len(seen) == 4
    box = page.page.locator(".er-stage").first.bounding_box()
    page.page.mouse.move(box["x"] + 150, box["y"] + 100)
    page.page.mouse.down()
    page.page.mouse.move(box["x"] + 230, box["y"] + 120)
    page.page.mouse.up()
    assert picture(page) not in seen
    assert page.page.evaluate("document.querySelector('.exo-replay').classList.contains('er-dark')") is dark


def test_without_webgl_a_sentence_says_so_and_the_arm_is_seen_from_the_side(
    payload: Experiment, opened: Opening
) -> None:
    document = scene(payload)
    page = opened(document, switches=NO_WEBGL)
    (arm,) = page.at(9.0)["views"][1]["arms"]
    assert "This browser offers no WebGL" in page.text()
    assert page.page.locator(".er-canvas").count() == 0
    assert arm["hand"] == pytest.approx(place(payload, ARMS[1], "plant.p", 9.0), abs=1e-3)
    before = page.page.locator(".er-link").nth(1).get_attribute("points")
    page.at(11.0)
    assert page.page.locator(".er-link").nth(1).get_attribute("points") != before


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


def states(experiment: Experiment, case: str, every: int) -> list[dict[str, Any]]:
    """What a live page would get of the testbed."""
    recorded = experiment.recordings[case]
    names = {"q": "plant.q", "q_n": "controller.q_n", "tau_h": "plant.tau_h", "tau_a": "plant.tau_drive"}
    columns = {key: recorded[name][::every].tolist() for key, name in names.items()}
    return [
        {"time": time, **{key: column[i] for key, column in columns.items()}}
        for i, time in enumerate(recorded.time[::every].tolist())
    ]


def test_a_live_testbed_sticks_and_lets_go_when_the_recorded_one_does(wall: Experiment, opened: Opening) -> None:
    case = MASSES[0]
    page = opened(replay.geometry(wall.recordings[case].parameters), options="{title: 'Standard law'}")
    fed = states(wall, case, 10)
    heard = page.page.evaluate("(states) => states.map((state) => handle.update(state).kind)", fed)
    for one in (
        one for side in [scene(wall)["cases"][case]["sticking"][0]] for one in side if one["to"] - one["from"] > 0.1
    ):
        stuck = [state["time"] for state, kind in zip(fed, heard, strict=True) if kind == "sticks"]
        within = [time for time in stuck if one["from"] - 0.03 <= time <= one["to"] + 0.03]
        assert within[0] == pytest.approx(one["from"], abs=0.021)
        assert within[-1] == pytest.approx(one["to"], abs=0.041)
    after = page.page.evaluate("(state) => handle.update(state)", {**fed[-1], "time": 50.0})
    assert after["kind"] == "free"
    until(page.page, lambda: page.state()["q"] == pytest.approx(fed[-1]["q"]))
    page.page.evaluate("handle.dispose()")
    assert page.page.evaluate("place.childElementCount") == 0


def test_a_live_arm_follows_its_joints_and_takes_another_payload(payload: Experiment, opened: Opening) -> None:
    recorded = payload.recordings[ARMS[1]]
    geometry = replay.geometry(recorded.parameters)
    assert geometry is not None
    page = opened(geometry)
    for time in (0.0, 9.0):
        arm = {
            "q": place(payload, ARMS[1], "plant.q_joint", time),
            "p_n": place(payload, ARMS[1], "controller.p_n", time),
            "f_h": place(payload, ARMS[1], "plant.f_h", time),
        }
        page.page.evaluate("(state) => handle.update(state)", {"time": time, "attached": time > 5.0, "arms": [arm]})
        hand = pytest.approx(place(payload, ARMS[1], "plant.p", time), abs=1e-9)
        # There is no arm before the first frame.
        until(page.page, lambda hand=hand: [arm["hand"] for arm in page.state()["arms"]] == [hand])
    until(page.page, lambda: "payload 17.5 kg" in page.text())
    heavier = {**geometry, "payload": {**geometry["payload"], "mass": 25.0}}
    page.page.evaluate("(geometry) => handle.reshape(geometry)", heavier)
    until(page.page, lambda: "payload 25 kg" in page.text())
