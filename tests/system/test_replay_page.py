"""The replay in a browser: what is drawn is what was recorded or fed, with and without WebGL."""

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from exo import replay
from exo.experiment import Experiment
from replays import (
    ARMS,
    MASSES,
    NO_WEBGL,
    Opened,
    Opening,
    browsers,
    carried,
    instants,
    lifted,
    pages,
    place,
    pushed,
    scene,
)

from browser import box_of, until


@pytest.fixture(scope="module")
def payload(fmu_dir: Path) -> Experiment:
    """Experiment 3 until the payload is in the air, standard law and proposed law."""
    return lifted(fmu_dir)


@pytest.fixture(scope="module")
def wall(fmu_dir: Path) -> Experiment:
    """The wall, standard law and proposed law."""
    return pushed(fmu_dir)


@pytest.fixture(scope="module")
def both(fmu_dir: Path) -> Experiment:
    """Both arms until the payload is in the air."""
    return carried(fmu_dir)


@pytest.fixture(scope="module")
def start() -> Iterator[Callable[..., Any]]:
    """Starts browsers by their switches, each once."""
    yield from browsers()


@pytest.fixture
def opened(start: Callable[..., Any], tmp_path: Path) -> Iterator[Opening]:
    """Opens a page with a scene or with a geometry to feed, and finds after the test that it had no complaint."""
    yield from pages(start, tmp_path)


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
    face = box_of(page.page, ".er-mass")
    barrier = box_of(page.page, ".er-wall")
    ghost = box_of(page.page, "rect.er-ghost")
    assert face["x"] + face["width"] == pytest.approx(barrier["x"], abs=4.0)
    assert ghost["x"] > barrier["x"] + barrier["width"]


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
