"""Scenes for the replay: what is kept of a run, where it is drawn, when a robot sticks."""

import hashlib
import json
from dataclasses import replace
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pinocchio
import pytest

from exo import experiment as experiments
from exo import loop, metrics, replay, scenario
from exo.errors import ScenarioError
from exo.experiment import Experiment
from exo.replay import packing, thinning
from exo.replay.laws import ABOUT
from exo.replay.scenery import MOST_BYTES, compressed_size
from exo.replay.sticking import episodes

from conftest import recording

WEB = Path(__file__).resolve().parents[2] / "harness" / "src" / "exo" / "web"


def run(name: str, *cases: str, fmu_dir: Path, **changed: Any) -> Experiment:
    """Some cases of a built-in scenario, without its figures."""
    full = scenario.load(name)
    data = full.model_copy(
        update={"cases": tuple(case for case in full.cases if case.id in cases), "figures": (), "ratios": (), **changed}
    )
    kept = tuple(m for m in full.metrics if m.paper) if "standard_5_0.5" in cases else ()
    data = data.model_copy(
        update={"metrics": tuple(m.model_copy(update={"cases": cases, "expected": {}}) for m in kept)}
    )
    given = {key: value for key, value in changed.items() if key in {"duration", "step"}}
    return experiments.run(scenario=data, fmu_dir=fmu_dir, engine=loop.fastest(), given=given)


@pytest.fixture(scope="module")
def wall(fmu_dir: Path) -> Experiment:
    """The wall: two laws, as in the paper's figure."""
    return run("wall", "standard_0.1_0.5", "standard_5_0.5", "passive_bounded_5_0.5", fmu_dir=fmu_dir)


@pytest.fixture(scope="module")
def payload(fmu_dir: Path) -> Experiment:
    """Experiment 3, until the payload is in the air."""
    return run("arm_payload", "standard_17.5kg", "passive_bounded_17.5kg", fmu_dir=fmu_dir, duration=14.0)


@pytest.fixture(scope="module")
def both(fmu_dir: Path) -> Experiment:
    """Both arms, until the payload is in the air."""
    return run("arm_both", "unequal", fmu_dir=fmu_dir, duration=9.0)


def frames(case: dict[str, Any]) -> dict[str, np.ndarray[Any, Any]]:
    """The columns of a case as numbers."""
    return {name: packing.unpack(column) for name, column in case["frames"].items()}


def handle(geometry: dict[str, Any], base: list[float], q: np.ndarray[Any, Any]) -> np.ndarray[Any, Any]:
    """The handle by pinocchio, from a scene's geometry: yaw about z, two pitches about −y."""
    model, axes = pinocchio.Model(), np.array([0.0, -1.0, 0.0])
    joint = 0
    for name, kind, at in (
        ("yaw", pinocchio.JointModelRZ(), base),
        ("shoulder", pinocchio.JointModelRevoluteUnaligned(axes), [geometry["A1"], 0.0, 0.0]),
        ("elbow", pinocchio.JointModelRevoluteUnaligned(axes), [geometry["L1"], 0.0, 0.0]),
    ):
        joint = model.addJoint(joint, kind, pinocchio.SE3(np.eye(3), np.array(at)), name)
    data = model.createData()
    pinocchio.forwardKinematics(model, data, q)
    return data.oMi[joint].act(np.array([geometry["handle"][0], 0.0, geometry["handle"][1]]))


@pytest.mark.parametrize("which", ["payload", "both"])
def test_from_a_scene_pinocchio_finds_the_hand_where_the_plant_had_it(
    which: str, request: pytest.FixtureRequest
) -> None:
    experiment: Experiment = request.getfixturevalue(which)
    document = replay.scene(experiment)
    assert document is not None
    for name, case in document["cases"].items():
        recorded, columns, geometry = experiment.recordings[name], frames(case), case["geometry"]
        ticks = np.rint(columns["t"] / recorded.step).astype(int)
        for side, base in enumerate(geometry["bases"]):
            prefix = "plant." if len(geometry["bases"]) == 1 else f"plant.{('left', 'right')[side]}."
            for frame in range(0, len(ticks), 20):
                q = np.array([columns[f"q:{side}:{k}"][frame] for k in (1, 2, 3)])
                p = [recorded[f"{prefix}p[{k}]"][ticks[frame]] for k in (1, 2, 3)]
                assert handle(geometry, base, q) == pytest.approx(p, abs=1e-6)


def test_the_nominal_hand_of_each_arm_begins_at_its_hand(both: Experiment) -> None:
    document = replay.scene(both)
    assert document is not None
    case = document["cases"]["unequal"]
    columns = frames(case)
    for side, base in enumerate(case["geometry"]["bases"]):
        q = np.array([columns[f"q:{side}:{k}"][0] for k in (1, 2, 3)])
        p_n = [columns[f"p_n:{side}:{k}"][0] for k in (1, 2, 3)]
        assert handle(case["geometry"], base, q) == pytest.approx(p_n, abs=1e-3)


def test_the_time_of_sticking_is_the_release_delay_of_the_scenario(wall: Experiment) -> None:
    document = replay.scene(wall)
    assert document is not None
    arguments = {"position": "plant.q", "wall": "plant.wall.q", "margin": 0.001, "after": 20.25}
    for name, case in document["cases"].items():
        delay = metrics.evaluate(
            recording=wall.recordings[name], function="release_delay", arguments=arguments, owner=name
        )
        (found,) = [one for one in case["sticking"][0] if one["from"] > 15.0 and one["letGo"]]
        assert found["from"] == pytest.approx(20.25, abs=1e-9)
        assert found["to"] - found["from"] == pytest.approx(delay, abs=1e-9)


def test_a_scene_begins_with_the_standard_law_of_the_papers_figure_and_the_same_case_under_the_proposed_one(
    wall: Experiment,
) -> None:
    document = replay.scene(wall)
    assert document is not None
    assert document["pair"] == ["standard_5_0.5", "passive_bounded_5_0.5"]
    story = document["story"]
    assert story["from"] < 10.0
    assert story["to"] > 37.3
    assert (story["to"] - story["from"]) / story["speed"] <= 20.0


@pytest.mark.parametrize("which", ["wall", "payload", "both"])
def test_between_two_frames_nothing_is_farther_from_the_straight_line_than_an_eye_sees(
    which: str, request: pytest.FixtureRequest
) -> None:
    experiment: Experiment = request.getfixturevalue(which)
    document = replay.scene(experiment)
    assert document is not None
    for name, case in document["cases"].items():
        recorded, columns = experiment.recordings[name], frames(case)
        every = recorded.time[:: round(0.02 / recorded.step)]
        if document["kind"] == "testbed":
            wanted = {"q": ("plant.q", 2.1e-4), "q_n": ("controller.q_n", 3e-4), "tau_a": ("plant.tau_drive", 0.07)}
        elif len(case["geometry"]["bases"]) == 2:
            wanted = {f"q:1:{k}": (f"plant.right.q[{k}]", 3.1e-4) for k in (1, 2, 3)}
        else:
            wanted = {f"q:0:{k}": (f"plant.q_joint[{k}]", 3.1e-4) for k in (1, 2, 3)}
            wanted["tension:0"] = ("plant.tension", 0.0041 * np.abs(recorded["plant.tension"]).max() + 0.055)
        for column, (signal, tolerance) in wanted.items():
            shown = np.interp(every, columns["t"], columns[column])
            assert np.max(np.abs(shown - recorded[signal][:: round(0.02 / recorded.step)])) < tolerance, column


def test_the_instant_before_and_after_a_grip_and_the_peak_of_the_landing_are_kept(payload: Experiment) -> None:
    document = replay.scene(payload)
    assert document is not None
    name = "passive_bounded_17.5kg"
    recorded, case = payload.recordings[name], document["cases"][name]
    columns = frames(case)
    (grip,) = np.flatnonzero(np.diff(recorded["plant.attached"].astype(int))) + 1
    assert case["attached"] == [pytest.approx(recorded.time[grip])]
    kept = np.rint(columns["t"] / recorded.step).astype(int)
    assert {grip - 1, grip} <= set(kept)
    landing = int(np.argmax(recorded["plant.contact"]))
    frame = landing // 20 * 20
    peak = recorded["plant.f_e[3]"][frame : frame + 20].max()
    here = (kept >= frame) & (kept < frame + 20)
    assert columns["f_e:0:3"][here].max() == pytest.approx(peak, abs=0.006)


@pytest.mark.parametrize("which", ["wall", "payload", "both"])
def test_a_case_is_small(which: str, request: pytest.FixtureRequest) -> None:
    document = replay.scene(request.getfixturevalue(which))
    assert document is not None
    json.dumps(document, allow_nan=False)
    for name, case in document["cases"].items():
        assert compressed_size(case) < 20_000, name


def test_a_case_that_shakes_without_end_is_thinned_until_it_fits(payload: Experiment) -> None:
    name = "passive_bounded_17.5kg"
    old = payload.recordings[name]
    random = np.random.default_rng(1)
    time = np.arange(0.0, 600.0, 0.01)
    columns = {key: np.resize(np.asarray(old.columns[key]), len(time)) for key in old.columns}
    columns |= {f"plant.q_joint[{k}]": random.uniform(-1.0, 1.0, len(time)) for k in (1, 2, 3)}
    columns |= {f"controller.p_n[{k}]": random.uniform(-1.0, 1.0, len(time)) for k in (1, 2, 3)}
    columns |= {f"plant.f_e[{k}]": random.uniform(-900.0, 900.0, len(time)) for k in (1, 2, 3)}
    shaking = replace(payload, recordings={name: replace(old, time=time, columns=columns)})
    document = replay.scene(shaking)
    assert document is not None
    assert compressed_size(document["cases"][name]) <= MOST_BYTES


def test_a_run_that_has_blown_up_is_left_out(wall: Experiment) -> None:
    names = list(wall.recordings)
    old = wall.recordings[names[0]]
    broken = replace(old, columns={**old.columns, "controller.q_n": np.full(len(old.time), np.nan)})
    document = replay.scene(replace(wall, recordings={**wall.recordings, names[0]: broken}))
    assert document is not None
    assert list(document["cases"]) == names[1:]


def test_where_there_is_no_plant_there_is_no_scene(wall: Experiment) -> None:
    name, old = next(iter(wall.recordings.items()))
    alone = replace(old, parameters={k: v for k, v in old.parameters.items() if not k.startswith("plant.")})
    assert replay.scene(replace(wall, recordings={name: alone})) is None
    assert replay.geometry(alone.parameters) is None


def test_a_case_that_has_not_run_is_named_with_those_that_are_like_it(wall: Experiment) -> None:
    with pytest.raises(ScenarioError, match=r"wall: no case standard_5_05.*standard_5_0\.5"):
        replay.scene(wall, ["standard_5_05"])


def test_geometry_comes_from_the_parameters_of_the_fmu(payload: Experiment, wall: Experiment) -> None:
    arm = replay.geometry(payload.recordings["standard_17.5kg"].parameters)
    assert arm is not None
    assert (arm["A1"], arm["L1"], arm["handle"], arm["pad"]) == (0.06, 0.32, [0.36, 0.0], [0.36, -0.12])
    assert (arm["table"], arm["wall"], arm["bases"]) == (-0.4171, None, [[0.0, 0.0, 0.0]])
    assert arm["payload"]["mass"] == 17.5
    assert arm["payload"]["weight"] == pytest.approx(17.5 * 9.81, rel=1e-3)
    assert np.prod(arm["payload"]["size"]) * 7850.0 == pytest.approx(17.5, rel=0.01)
    testbed = replay.geometry(wall.recordings["standard_5_0.5"].parameters)
    assert testbed == {"kind": "testbed", "M": 6.0, "wall": 0.3, "margin": 0.001}


def test_sticking_begins_when_the_hand_pulls_and_ends_when_it_stops_or_the_robot_comes_away() -> None:
    time = np.arange(12.0)
    near = np.array([0, 1, 1, 1, 1, 1, 1, 1, 1, 1, 0, 0], dtype=bool)
    pull = np.array([0, -1, -1, 1, 1, -1, -1, 1, 1, 1, 1, 1], dtype=float)
    gave_up, came_away = episodes(time=time, near=near, pull=pull, surface="wall")
    assert (gave_up.begin, gave_up.end, gave_up.let_go, gave_up.pressed) == (2.0, 5.0, False, 1.0)
    assert (came_away.begin, came_away.end, came_away.let_go, came_away.pressed) == (6.0, 10.0, True, 5.0)


def test_who_comes_to_a_surface_with_a_hand_that_pulls_has_not_stuck_before() -> None:
    time = np.arange(5.0)
    near = np.array([0, 0, 1, 1, 0], dtype=bool)
    (one,) = episodes(time=time, near=near, pull=np.ones(5), surface="table")
    assert (one.begin, one.end) == (2.0, 4.0)
    assert episodes(time=time, near=near, pull=-np.ones(5), surface="table") == []


def test_of_a_line_with_corners_the_corners_stay() -> None:
    time = np.linspace(0.0, 10.0, 1001)
    line = np.interp(time, [0.0, 3.0, 5.0, 10.0], [0.0, 9.0, -4.0, 2.0])
    stay = thinning.straightened(time, line[:, None] / 1e-6, np.zeros(len(time), dtype=bool))
    assert np.flatnonzero(stay).tolist() == [0, 300, 500, 1000]


def test_a_change_between_frames_keeps_the_ticks_on_both_sides() -> None:
    time = np.arange(0.0, 2.0, 0.001)
    event = time >= 1.0077
    ticks = thinning.kept(time=time, columns=[(np.zeros(len(time)), 1.0)], events=[event])
    assert set(ticks) == {0, 1007, 1008, 1999}
    assert all(b > a for a, b in pairwise(ticks))


def test_a_packed_column_comes_back_within_half_its_unit() -> None:
    values = np.random.default_rng(2).uniform(-50.0, 50.0, 1000)
    packed = json.loads(json.dumps(packing.pack(values, unit=1e-4)))
    assert np.max(np.abs(packing.unpack(packed) - values)) <= 0.5001e-4


@pytest.mark.parametrize("value", [np.nan, np.inf, 1e13])
def test_what_is_no_number_that_a_browser_can_count_is_refused(value: float) -> None:
    with pytest.raises(ValueError, match=r"resolution 0\.0001"):
        packing.pack(np.array([0.0, value]), unit=1e-4)


def test_a_boolean_that_is_true_from_the_start_switches_at_the_first_instant() -> None:
    time = np.array([0.0, 1.0, 2.0, 3.0])
    assert packing.switches(np.array([True, True, False, True]), time) == [0.0, 2.0, 3.0]
    assert packing.switches(np.zeros(4, dtype=bool), time) == []


def test_the_plant_is_found_whatever_a_scenario_calls_it() -> None:
    named = recording(
        time=[0.0, 1.0], parameters={"law.K": 1.0, "rig.M": 2.0, "rig.F_c": 0.0, "rig.wall.q": 1e9, "rig.wall.k": 1.0}
    )
    assert replay.geometry(named.parameters) == {"kind": "testbed", "M": 2.0, "wall": None, "margin": 0.001}


def test_the_bundle_is_made_of_the_sources_beside_it() -> None:
    here = WEB / "replay"
    digest = hashlib.sha256()
    for file in sorted((here / "src").iterdir()):
        digest.update(f"{file.name}\n".encode() + file.read_bytes())
    first = (here / "replay.js").read_text(encoding="ascii")[:200]
    assert f"sources {digest.hexdigest()};" in first, "src/ has changed: `npm ci && npm run build` in exo/web/replay"
    assert "MIT" in (here / "three.LICENSE.txt").read_text(encoding="utf-8")


def test_each_law_is_told_in_the_words_of_the_readme() -> None:
    text = (Path(__file__).resolve().parents[2] / "docs/controllers.md").read_text(encoding="utf-8")
    table = text.partition("<!-- laws:")[2].partition("<!-- end -->")[0]
    rows = [[cell.strip() for cell in line.split("|")] for line in table.splitlines() if line.startswith("| ")][1:]
    assert {row[2].strip("`"): row[3] for row in rows} == ABOUT
