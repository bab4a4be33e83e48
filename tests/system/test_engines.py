"""The two engines give the same recordings bit for bit, and the same errors."""

import json
import os
import signal
import subprocess
import sys
import threading
from contextlib import ExitStack
from dataclasses import replace
from pathlib import Path
from time import perf_counter, sleep
from types import ModuleType
from typing import Any

import numpy as np
import pytest

from exo import __version__, loop, master
from exo.errors import ExoError, FmuError
from exo.fmu import Archive
from exo.pace import Deadlines
from exo.recording import Recording
from exo.scenario import Case, Coupling, Scenario, Segment, built_in, load

from commands import SHORT, exo

#: Steps of each case that are compared: enough for a force to act, few enough for every case of every scenario.
STEPS = 400


@pytest.fixture(scope="module")
def archives(fmu_dir: Path) -> Any:
    with ExitStack() as stack:
        yield {path.name: stack.enter_context(Archive(path)) for path in sorted(fmu_dir.glob("*.fmu"))}


def both(scenario: Scenario, case: Case, archives: dict[str, Archive], **changes: Any) -> list[Recording]:
    plan = replace(master.plan(scenario=scenario, case=case), **changes)
    return [master.simulate(plan=plan, archives=archives, engine=engine) for engine in loop.ENGINES]


def assert_equal(runs: list[Recording]) -> None:
    python, native = runs
    assert python.parameters == native.parameters
    assert list(python.columns) == list(native.columns)
    for name, column in python.columns.items():
        assert column.tobytes() == native.columns[name].tobytes(), name


@pytest.mark.parametrize("name", built_in())
def test_every_case_is_equal_bit_for_bit(name: str, archives: dict[str, Archive]) -> None:
    scenario = load(name)
    for case in scenario.cases:
        plan = master.plan(scenario=scenario, case=case)
        # The forces act where they act: what is cut is the end, and a long step makes the run reach them.
        runs = both(scenario, case, archives, duration=min(plan.duration, STEPS * plan.step))
        assert_equal(runs)
        moved = [
            name for name, column in runs[0].columns.items() if column.tobytes() != column[:1].tobytes() * len(column)
        ]
        assert moved, f"{case.id}: nothing changes"


@pytest.mark.parametrize("name", built_in())
def test_other_lengths_and_steps_are_equal_bit_for_bit(name: str, archives: dict[str, Archive]) -> None:
    """Lengths that the scenario has not, and steps that are no whole number of the controllers' periods, or a part."""
    scenario = load(name)
    case = scenario.cases[0]
    own = master.plan(scenario=scenario, case=case)
    for steps, step in ((37, own.step), (23, 3.0 * own.step), (41, 1.5 * own.step), (74, 0.5 * own.step)):
        assert_equal(both(scenario, case, archives, duration=steps * step, step=step))


def test_a_run_beyond_its_scenario_is_equal_bit_for_bit(archives: dict[str, Archive]) -> None:
    scenario = load("gain_study")
    own = master.plan(scenario=scenario, case=scenario.cases[0])
    runs = both(scenario, scenario.cases[0], archives, duration=own.duration + 37 * own.step)
    assert_equal(runs)
    assert runs[0].time[-1] > own.duration


@pytest.mark.parametrize(("name", "case"), [("wall", "passive_bounded_5_0.5"), ("arm_contact", "passive_bounded")])
@pytest.mark.parametrize("coupling", ["zero_delay", "one_sample_delay", "exchange_at_once"])
def test_whole_runs_are_equal_in_every_coupling(
    name: str, case: str, coupling: Coupling, archives: dict[str, Archive]
) -> None:
    scenario = load(name)
    chosen = next(one for one in scenario.cases if one.id == case)
    assert_equal(both(scenario, chosen, archives, coupling=coupling))


def test_a_failing_call_is_the_same_error_at_the_same_time(archives: dict[str, Archive]) -> None:
    scenario = load("wall")
    plan = master.plan(scenario=scenario, case=scenario.cases[0])
    force = next(source.removeprefix("profile.") for key, source in plan.inputs.items() if key == "plant.tau_h")
    # From half a second on it is infinite.
    broken = Segment(kind="table", amplitude=1e200, points=((0.0, 0.0), (0.499, 0.0), (0.5, 1e200)))
    said = []
    for engine in loop.ENGINES:
        with pytest.raises(FmuError) as caught:
            master.simulate(
                plan=replace(plan, profiles={**plan.profiles, force: (broken,)}), archives=archives, engine=engine
            )
        said.append(str(caught.value))
    assert said[0] == said[1]
    assert "fmi2SetReal returned fmi2Error" in said[0]
    assert "(step at t = 0.5 s)" in said[0]


def test_other_threads_run_meanwhile(archives: dict[str, Archive]) -> None:
    """The native loop lets go of the interpreter: a thread that counts gets on as if alone."""
    scenario = load("wall")
    plan = master.plan(scenario=scenario, case=scenario.cases[0])
    longest, ended = [0.0], threading.Event()

    def look() -> None:
        last = perf_counter()
        while not ended.is_set():
            now = perf_counter()
            longest[0] = max(longest[0], now - last)
            last = now

    thread = threading.Thread(target=look)
    thread.start()
    try:
        run = master.simulate(plan=replace(plan, duration=plan.duration * 40), archives=archives, engine="native")
    finally:
        ended.set()
        thread.join()
    assert run.wall_time > 0.2, "the run is long enough to be noticed"
    assert longest[0] < run.wall_time / 2


def test_an_engine_that_is_not_there_is_refused_before_anything_runs(tmp_path: Path, monkeypatch: Any) -> None:
    answer = exo("run", "wall", "--engine", "fast", "--out", tmp_path)
    assert answer.exit_code == 2
    assert "--engine fast: expected one of fmpy, native" in " ".join(answer.stderr.split())
    assert not list(tmp_path.iterdir())

    def missing(name: str) -> None:
        raise ImportError(name)

    monkeypatch.setattr(loop, "import_module", missing)
    with pytest.raises(ExoError, match="cargo xtask native"):
        loop.named("native")


def test_the_command_line_runs_with_it_and_says_so(tmp_path: Path) -> None:
    answer = exo("run", "wall", "--case", "passive_bounded_5_0.5", "--engine", "native", "--out", tmp_path)
    assert answer.exit_code == 0, answer.stderr
    assert '"engine": "native"' in (tmp_path / "wall" / "metrics.json").read_text()


@pytest.mark.parametrize("engine", loop.ENGINES)
def test_a_run_by_the_clock_takes_its_time_and_finds_the_same(
    engine: loop.Engine, archives: dict[str, Archive]
) -> None:
    scenario = load("wall")
    plan = replace(master.plan(scenario=scenario, case=scenario.cases[0]), duration=0.4)
    plain = master.simulate(plan=plan, archives=archives)
    paced = master.simulate(plan=plan, archives=archives, engine=engine, real_time=True)
    assert_equal([plain, paced])
    assert plain.deadlines is None
    found = paced.deadlines
    assert found is not None
    # The last step begins 199 periods after the first; how much later, the machine decides.
    assert paced.wall_time >= 199 * 0.002
    assert (found.steps, found.step) == (200, 0.002)
    assert 0.0 <= found.late_median <= found.late_99 <= found.late_max
    assert 0.0 < found.busy_median <= found.busy_99 <= found.busy_max


def test_an_overrun_is_a_step_that_ends_after_the_next_one_is_due() -> None:
    late, busy = np.array([0.0, 0.1, 0.9, 0.0]), np.array([0.2, 0.95, 0.05, 1.5])
    found = Deadlines.of(late, busy, 1.0)
    assert (found.overruns, found.overruns_at) == (2, (1.0, 3.0))
    assert "4 steps of 1000 ms by the clock: 2 overruns (at t = 1, 3 s); began" in found.sentence()
    quick = Deadlines.of(np.full(1000, 3.4e-7), np.full(1000, 2.0), 1.0)
    assert (quick.overruns, len(quick.overruns_at)) == (1000, 100)
    assert "1000 overruns (at t = 0, 1, 2, 3, 4, … s); began 0.34 µs late in the middle" in quick.sentence()


def test_the_command_line_tells_the_deadlines(tmp_path: Path) -> None:
    case = ("--case", "passive_bounded_5_0.5", "--duration", "0.2")
    answer = exo("run", "wall", *case, "--real-time", "--out", tmp_path)
    assert answer.exit_code == 0, answer.stderr
    assert "100 steps of 2 ms by the clock" in " ".join(answer.stdout.split())
    told = json.loads((tmp_path / "wall" / "metrics.json").read_text())["run"]["cases"]["passive_bounded_5_0.5"]
    assert told["deadlines"]["steps"] == 100


@pytest.mark.parametrize(
    "has",
    [
        {"__version__": "0.0.9", "INTERFACE": loop.INTERFACE},
        {"__version__": __version__, "INTERFACE": loop.INTERFACE + 1},
        {"__version__": __version__},
    ],
    ids=["another version", "another interface", "older than interfaces"],
)
def test_a_wheel_of_another_harness_is_refused_with_the_command_that_mends_it(
    has: dict[str, Any], fmu_dir: Path, tmp_path: Path, monkeypatch: Any
) -> None:
    """Also where native is only the engine that is taken by itself: the other one would be slow without a reason."""
    wheel = ModuleType("exo_native")
    vars(wheel).update(has)
    monkeypatch.setitem(sys.modules, "exo_native", wheel)
    (tmp_path / "short.toml").write_text(SHORT)
    answer = exo("run", tmp_path / "short.toml", "--engine", "native", "--fmu-dir", fmu_dir, "--out", tmp_path)
    said = " ".join(answer.stderr.split())
    assert answer.exit_code == 2
    assert f"the wheel exo-native {has['__version__']}, interface {has.get('INTERFACE', 0)}, is installed" in said
    assert f"expected {__version__}, interface {loop.INTERFACE}: `cargo xtask native` builds and installs it" in said
    with pytest.raises(ExoError, match="cargo xtask native"):
        loop.fastest()


def test_without_a_wheel_the_engine_is_fmpy(monkeypatch: Any) -> None:
    monkeypatch.setitem(sys.modules, "exo_native", None)
    assert loop.fastest() == "fmpy"
    with pytest.raises(ExoError, match="engine native is not installed: `cargo xtask native`"):
        loop.named("native")


@pytest.mark.skipif(sys.platform == "win32", reason="signals")
@pytest.mark.parametrize(("number", "code"), [(signal.SIGINT, 130), (signal.SIGTERM, 143)])
def test_a_run_by_the_clock_that_is_ended_leaves_the_results_that_were_there(
    number: int, code: int, fmu_dir: Path, tmp_path: Path
) -> None:
    (tmp_path / "short.toml").write_text(SHORT)
    (tmp_path / "temporary").mkdir()
    arguments = ["run", tmp_path / "short.toml", "--fmu-dir", fmu_dir, "--out", tmp_path / "out", "--engine", "native"]
    assert exo(*arguments).exit_code == 0
    before = contents(tmp_path / "out")
    process = subprocess.Popen(
        [sys.executable, "-m", "exo", *map(str, arguments), "--real-time", "--duration", "600"],
        stderr=subprocess.PIPE,
        text=True,
        env={**os.environ, "TMPDIR": str(tmp_path / "temporary")},
        # A job in the background has SIGINT ignored, and its children, too.
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler),  # noqa: PLW1509  one thread here
    )
    while len(list((tmp_path / "temporary").glob("exo-fmu-*"))) < 2:  # both archives are open
        assert process.poll() is None
        sleep(0.05)
    sleep(1.0)
    process.send_signal(number)
    _, said = process.communicate(timeout=60)
    assert process.returncode == code, said
    assert "Traceback" not in said
    assert contents(tmp_path / "out") == before


def contents(folder: Path) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in sorted(folder.rglob("*")) if path.is_file()}
