"""The run behind the page of `exo play`: repeated bit for bit, sticking and letting go as the laws do."""

import re
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from time import perf_counter, process_time, sleep
from typing import Any

import numpy as np
import pytest
from typer.testing import CliRunner

from exo import experiment as experiments
from exo import loop, selection
from exo.cli import app
from exo.coupled import Coupled
from exo.errors import ExoError
from exo.play import bench as benches
from exo.play import live as lives
from exo.play import messages, saved
from exo.play.contact import LONG
from exo.play.hand import Hand
from exo.play.live import Live, State


def wait(live: Live, until: Callable[[State], Any], *, within: float = 60.0) -> State:
    """The first state that is seen to satisfy `until`."""
    end = perf_counter() + within
    while perf_counter() < end:
        state = live.state
        if state is not None and until(state):
            return state
        sleep(0.001)
    pytest.fail(f"not within {within} s; the last state: {live.state}")


def played(kind: str, fmu_dir: Path, *, clock: bool = False, **settings: Any) -> Live:
    """A run that has nobody at its handle yet."""
    return Live(benches.named(kind), fmu_dir=fmu_dir, engine=loop.fastest(), clock=clock, settings=settings or None)


def halted(live: Live) -> State:
    """The state of a run that makes no step any more."""
    live.pause(True)
    return wait(live, lambda state: state.status == "paused")


def later(live: Live, by: float) -> State:
    """The state `by` s of the run later."""
    begin = live.state.time if live.state else 0.0
    return wait(live, lambda state: state.time >= begin + by)


def lead(live: Live) -> None:
    """A scripted hand: it leads, the gain is changed under way, the law before the run that counts."""
    testbed = live.bench.kind == "testbed"
    live.begun()
    live.set("law", "passive_bounded" if testbed else "passive")
    wait(live, lambda state: state.run > 1 and state.values)
    live.hand(target=[0.45] if testbed else [0.5, 0.1, -0.3])
    later(live, 0.3)
    live.set("K", 41.7 if testbed else 512.3)
    later(live, 0.2)
    if not testbed:
        live.switch("vacuum", True)
    live.hand(stiffness=431.0)
    later(live, 0.3)
    live.hand(target=None, push=[-3.3] if testbed else [1.0, 2.0, -3.0])
    later(live, 0.3)


@pytest.mark.parametrize("kind", ["testbed", "arm"])
def test_exo_run_repeats_what_was_played_bit_for_bit(kind: str, fmu_dir: Path, tmp_path: Path) -> None:
    with played(kind, fmu_dir) as live:
        lead(live)
        state = halted(live)
        columns = live.columns()
        path = saved.write(live.tables(), tmp_path, "by-hand")
    [data] = selection.load([str(path)])
    done = experiments.run(scenario=data, fmu_dir=fmu_dir, engine=loop.fastest())
    [recording] = done.recordings.values()
    assert data.id == "by-hand"
    assert len(recording.time) == round(state.time / live.bench.step) > 400
    assert done.passed
    for name in live.bench.shown:
        found = np.asarray(recording[name], dtype=np.float64)
        assert np.array_equal(columns[name], found), name
    # It was no run in which nothing happens.
    assert np.ptp(columns[live.bench.position[0]]) > 0.05
    gain = recording.profiles["K"][0].points
    assert {value for _, value in gain} == ({30.0, 41.7} if kind == "testbed" else {1000.0, 512.3})


def push_and_pull(live: Live) -> State:
    """Five seconds against the wall, then a pull; the state two seconds later, or when it is free before."""
    live.begun()
    live.hand(push=[5.0])
    wait(live, lambda state: state.time > 6.0 and state.word == "touches")
    live.hand(push=[-5.0])
    turned = wait(live, lambda state: state.force[0] == -5.0)
    return wait(live, lambda state: state.time > turned.time + 2.0 or state.let_go)


def test_the_standard_law_sticks(fmu_dir: Path) -> None:
    with played("testbed", fmu_dir, law="standard") as live:
        state = push_and_pull(live)
    assert (state.word, state.let_go) == ("sticks", None)
    assert state.stuck > 1.9
    assert state.values["controller.q_n"] > 5.0  # behind a wall at 0.3 m


def test_the_bounded_law_lets_go(fmu_dir: Path) -> None:
    with played("testbed", fmu_dir, law="passive_bounded") as live:
        state = push_and_pull(live)
    assert state.let_go is not None
    # docs/specification.md: lets go after 0.1 to 0.45 s.
    assert state.stuck < min(LONG, 0.45)


def test_the_same_push_is_repeated_under_another_law(fmu_dir: Path) -> None:
    with played("testbed", fmu_dir, law="standard") as live:
        push_and_pull(live)
        halted(live)
        before = live.tables()["profiles"]["x"][0]["points"]
        live.other("law", "passive_bounded")
        live.pause(False)
        state = wait(live, lambda state: state.run == 2 and state.let_go)
        assert state.repeats
        halted(live)
        after = live.tables()["profiles"]["x"][0]["points"]
        assert live.state is not None
        assert live.state.settings["law"] == "passive_bounded"
        ends = live.state.time
        times = np.arange(0.0, min(ends, before[-1][0]), 0.01)
        assert np.allclose(np.interp(times, *np.array(before).T), np.interp(times, *np.array(after).T), atol=1e-4)
        live.pause(False)
        live.hand(push=[1.0])
        assert not wait(live, lambda state: state.force == (1.0,)).repeats


def test_a_live_knob_acts_in_the_run_and_a_fixed_one_begins_another(fmu_dir: Path) -> None:
    with played("testbed", fmu_dir) as live:
        run = live.begun().run
        live.set("K", 12.0)
        assert later(live, 0.1).run == run
        live.set("mass", 9.0)
        wait(live, lambda state: state.run == run + 1 and state.values)
        number, geometry = live.geometry
        assert number == run + 1
        assert geometry is not None
        assert geometry["M"] == 9.0


def test_a_new_run_begins_within_a_third_of_a_second(fmu_dir: Path) -> None:
    with played("arm", fmu_dir, clock=True) as live:
        live.begun()
        taken = []
        for run in (2, 3, 4):
            began = perf_counter()
            live.again()
            wait(live, lambda state, run=run: state.run == run and state.values)
            taken.append(perf_counter() - began)
        # The other tests take the processor, too.
        assert min(taken) < 0.3


def test_a_paused_run_takes_next_to_no_processor_time_and_keeps_what_is_shown(fmu_dir: Path) -> None:
    with played("testbed", fmu_dir, clock=True) as live:
        live.begun()
        live.hand(push=[2.0])
        wait(live, lambda state: state.force == (2.0,))
        before = halted(live)
        used = process_time()
        sleep(0.5)
        assert process_time() - used < 0.1
        after = live.state
        assert after is not None
        assert (after.time, after.values, after.force) == (before.time, before.values, (2.0,))


def test_a_run_that_ends_says_so_and_can_be_saved(fmu_dir: Path) -> None:
    short = replace(benches.TESTBED, longest=0.4)
    with Live(short, fmu_dir=fmu_dir, engine=loop.fastest(), clock=False) as live:
        state = wait(live, lambda state: state.status == "ended")
        assert state.time == pytest.approx(0.4)
        assert live.tables()["duration"] == pytest.approx(0.4)
        live.again()
        wait(live, lambda state: state.run == 2)


def test_what_fails_in_the_run_is_a_sentence_and_the_next_run_goes_on(
    fmu_dir: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def fails(*_: Any, **__: Any) -> None:
        raise ZeroDivisionError("a slip")

    with played("testbed", fmu_dir) as live:
        live.begun()
        with monkeypatch.context() as patched:
            patched.setattr(lives.Contact, "look", fails)
            state = wait(live, lambda state: state.failed)
            assert state.status == "an error of exo itself: ZeroDivisionError: a slip"
        live.again()
        assert wait(live, lambda state: state.run == 2 and state.values).status == "running"


def test_an_fmu_that_refuses_its_parameters_is_a_sentence(fmu_dir: Path) -> None:
    with played("testbed", fmu_dir, mass=-1.0) as live, pytest.raises(ExoError, match=r"Testbed|plant"):
        live.begun()


def test_a_message_of_the_hand_acts_as_a_whole_or_not_at_all(fmu_dir: Path, tmp_path: Path) -> None:
    with played("testbed", fmu_dir) as live:
        live.begun()
        answer = messages.take(live, '{"hand": {"target": [0.1], "stiffness": 300, "push": "hard"}}', out=tmp_path)
        assert answer == {"error": "push = 'hard': expected 1 numbers (N)"}
        state = later(live, 0.05)
    assert (state.target, state.stiffness) == (None, 200.0)


def test_a_new_run_that_begins_paused_shows_nothing_of_the_one_before(fmu_dir: Path) -> None:
    with played("testbed", fmu_dir) as live:
        live.hand(push=[10.0])
        wait(live, lambda state: state.word == "touches")
        live.pause(True)
        live.again()
        state = wait(live, lambda state: state.run == 2 and state.status == "paused")
    assert (state.time, state.word, state.values["plant.q"], state.push) == (0.0, "free", 0.0, (0.0,))


def test_nothing_is_saved_before_something_is_played(fmu_dir: Path) -> None:
    live = played("testbed", fmu_dir)
    with pytest.raises(ExoError, match="nothing has been played yet"):
        live.tables()


def test_a_hand_pushes_no_harder_than_it_can() -> None:
    hand = Hand(axes=2, strongest=10.0, stiffness=1000.0)
    hand.aim([1.0, -0.001])
    # 1000 N/m · 1 m is cut to 10 N; 1000 N/m · 1 mm is not.
    assert hand.force([0.0, 0.0], [0.0, 0.0]) == pytest.approx([10.0, -1.0])
    hand.aim(None)
    assert hand.force([0.0, 0.0], [0.0, 0.0]) == [0.0, 0.0]


@pytest.mark.parametrize("target", [[0.1, 0.2], "left", [float("nan")], [1e9], [True], {}, [None], 3])
def test_a_hand_goes_nowhere_where_there_is_no_place(target: object) -> None:
    hand = Hand(axes=1, strongest=10.0, stiffness=100.0)
    with pytest.raises(ExoError, match=r"target = .*expected"):
        hand.aim(target)
    assert hand.target is None


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", "is no JSON"),
        ("[" * 3000, "is no JSON"),
        ("[]", "expected a JSON object with one key"),
        ('{"pause": true, "again": {}}', "one key"),
        ('{"paus": true}', r"no message 'paus' \(close matches: pause"),
        ('{"pause": 1}', "expected true or false"),
        ('{"set": {"name": "K", "to": 1e400}}', "expected a number from 1 to 60"),
        ('{"set": {"name": "K", "to": NaN}}', "expected a number from 1 to 60"),
        ('{"set": {"name": ["K"], "to": 3}}', "expected an object with name and to"),
        ('{"set": {"name": "k", "to": 3}}', r"no knob k .*K"),
        ('{"set": {"name": "law", "to": "steel"}}', "expected one of standard"),
        ('{"set": 5}', "expected an object with name and to"),
        ('{"switch": {"name": "light", "to": true}}', "expected one of none"),
        ('{"hand": {"foot": 1}}', "some of target, push, stiffness"),
        ('{"hand": {"push": [1000]}}', "expected numbers from -10 to 10 N"),
        ('{"hand": {"stiffness": 1e9}}', "expected 5 to 1000"),
        (f'{{"hand": {{"stiffness": 1{"0" * 400}}}}}', "expected 5 to 1000"),
        ('{"set": {"name": "\\ud800", "to": 1}}', "no knob"),
        ('{"save": "../out"}', "name '../out': expected letters, digits"),
        ('{"save": "CON"}', "Windows has a device"),
        ('{"save": 5}', "expected a name"),
        ('{"save": "early"}', "nothing has been played yet"),
        ("x" * 5000, "a message of 5000 letters; expected at most 4096"),
    ],
)
def test_garbage_is_answered_with_one_sentence(text: str, said: str, fmu_dir: Path, tmp_path: Path) -> None:
    answer = messages.take(played("testbed", fmu_dir), text, out=tmp_path)
    assert answer is not None
    [(key, sentence)] = answer.items()
    assert key == "error"
    assert "\n" not in sentence
    assert len(sentence) < 200
    assert re.search(said, sentence), sentence
    assert list(tmp_path.iterdir()) == []


def test_a_second_run_of_a_name_does_not_overwrite_the_first(fmu_dir: Path, tmp_path: Path) -> None:
    with played("testbed", fmu_dir) as live:
        live.begun()
        later(live, 0.05)
        answers = [messages.take(live, '{"save": "one"}', out=tmp_path / "my runs") for _ in range(2)]
    files = [tmp_path / "my runs" / name for name in ("one.toml", "one-2.toml")]
    assert [answer and answer["saved"] for answer in answers] == [str(file) for file in files]
    assert [data.id for data in selection.load([str(file) for file in files])] == ["one", "one-2"]
    assert answers[0] is not None
    assert answers[0]["command"] == f"exo run '{files[0]}'"


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["play", "leg"], "no bench leg"),
        (["play", "--fmu-dir", "nowhere"], "nowhere"),
        (["play", "--engine", "steam"], "--engine steam: expected one of fmpy, native"),
        (["play", "--out", "file"], "--out file: is no folder"),
    ],
)
def test_a_wrong_command_is_one_sentence_and_code_2(
    arguments: list[str], said: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "file").touch()
    result = CliRunner().invoke(app, [*arguments, "--no-browser"])
    assert result.exit_code == 2
    assert result.stderr.startswith("exo: ")
    assert said in result.stderr
    assert result.stderr.count("\n") == 1


def test_a_machine_that_cannot_keep_up_says_so_and_how_fast_it_is(
    fmu_dir: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    advance = Coupled.advance

    def slowly(self: Coupled, **more: Any) -> None:
        sleep(4 * lives.CHUNK_S)
        advance(self, **more)

    monkeypatch.setattr(Coupled, "advance", slowly)
    with played("testbed", fmu_dir, clock=True) as live:
        assert wait(live, lambda state: state.status == "slower than real time")
        state = wait(live, lambda state: state.speed < 1.0)
        assert state.speed < 0.3
    monkeypatch.undo()
