"""FMUs that keep to the standard and are no pleasure: many runs of them, by both engines, in several threads."""

import os
import sys
import time
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest

import exo
from exo import loop, master
from exo.fmu import Archive, Instance
from exo.plan import plan
from exo.runs import FAILURE, Batch
from exo.scenario import Scenario, parse

from broken.parts import plain

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="the FMU in C is compiled for Linux")

ONE = """
id = "one"
title = "One FMU"
about = "A."
source = "here"
duration = 0.1
step = 0.01
[components.one]
archive = "broken.fmu"
[inputs]
"one.u" = "profile.u"
[[profiles.u]]
kind = "constant"
amplitude = 2.0
[[cases]]
id = "only"
[[metrics]]
id = "y"
title = "y"
unit = "rad"
function = "maximum"
arguments = { column = "one.y" }
source = "here"
"""


@pytest.fixture
def one() -> Scenario:
    return parse(text=ONE, origin="one.toml")


@contextmanager
def batch(one: Scenario, folder: Path, *macros: str, engine: loop.Engine = "native") -> Iterator[Batch]:
    plain(folder, *macros).write(folder)
    with Batch(one, engine=engine, fmu_dir=folder) as runs:
        yield runs


@pytest.mark.parametrize("engine", loop.ENGINES)
def test_an_fmu_that_refuses_a_reset_is_made_anew_and_runs_again(
    one: Scenario, engine: loop.Engine, tmp_path: Path
) -> None:
    """The only instance of its library: an instance made anew needs the library still loaded."""
    with batch(one, tmp_path, "-DNO_RESET", engine=engine) as runs:
        found = [runs.run({"profile.u.1.amplitude": amplitude}) for amplitude in (1.0, 2.0, 3.0)]
    assert [outcome.error for outcome in found] == [None] * 3
    assert [outcome.numbers["y"] for outcome in found] == [1.0, 2.0, 3.0]


@pytest.mark.parametrize("engine", loop.ENGINES)
def test_a_step_that_is_discarded_is_located(one: Scenario, engine: loop.Engine, tmp_path: Path) -> None:
    with batch(one, tmp_path, "-DDISCARD=0.05", engine=engine) as runs:
        error = runs.run({}).error
    assert error is not None
    assert error.startswith("one: case only: one: fmi2DoStep returned fmi2Discard")
    assert error.endswith("(step at t = 0.05 s)")


@pytest.mark.parametrize("engine", loop.ENGINES)
def test_messages_from_within_the_loop_arrive_whatever_their_bytes(
    one: Scenario, engine: loop.Engine, tmp_path: Path, capfd: Any
) -> None:
    """The native loop has let go of the interpreter when the FMU logs."""
    with batch(one, tmp_path, "-DCHATTER=200", "-DDISCARD=0.05", engine=engine) as runs:
        error = runs.run({}).error
    assert error is not None
    assert "line 199 \N{REPLACEMENT CHARACTER} of t = 0.05" in error
    assert "Exception ignored" not in capfd.readouterr().err


@pytest.mark.parametrize("engine", loop.ENGINES)
def test_a_step_that_takes_too_long_is_told_by_its_time_with_those_that_it_delays(
    one: Scenario, engine: loop.Engine, tmp_path: Path
) -> None:
    """Ten steps of 10 ms, of which the sixth takes 50 ms: it and the four after it end when the next one is due."""
    plain(tmp_path, "-DSLOW=0.05").write(tmp_path)
    of = plan(scenario=one, case=one.cases[0])
    with Archive(tmp_path / "broken.fmu") as archive:
        found = master.simulate(plan=of, archives={"broken.fmu": archive}, engine=engine, real_time=True).deadlines
    assert found is not None
    # What else is late is the machine's doing.
    assert {round(t, 9) for t in found.overruns_at} >= {0.05, 0.06, 0.07, 0.08, 0.09}
    assert found.overruns == len(found.overruns_at) >= 5
    assert found.busy_max >= 0.05
    assert found.late_max >= 0.04
    assert "overruns (at t = 0.0" in found.sentence()


def test_threads_load_libraries_and_the_working_directory_stays(fmu_dir: Path, monkeypatch: Any) -> None:
    """Where a load takes its time, another thread's must not take the folder of the library for where it was."""
    here = Path.cwd()
    plain, changed = os.chdir, []

    def slow(path: Any) -> None:
        plain(path)
        time.sleep(2e-3)

    monkeypatch.setattr(os, "chdir", slow)
    with Archive(fmu_dir / "Testbed.fmu") as archive, ThreadPoolExecutor(4) as threads:

        def load(number: int) -> None:
            with Instance(archive, f"plant{number}"):
                pass
            changed.append(Path.cwd())

        list(threads.map(load, range(20)))
    assert Path.cwd() == here
    assert len(changed) == 20


def test_batches_in_threads_find_what_each_finds_alone(fmu_dir: Path) -> None:
    def gain(K: float) -> dict[str, list[Any]]:
        case = ["passive_bounded_5_0.5"]
        return exo.batch("wall", {"controller.K": [K, 10.0]}, cases=case, fmu_dir=fmu_dir).to_pydict()  # type: ignore[no-any-return]

    gains = [5.0, 10.0, 20.0, 30.0]
    with ThreadPoolExecutor(4) as threads:
        together = list(threads.map(gain, gains))
    assert together == [gain(K) for K in gains]
    assert all(found[FAILURE] == [None, None] for found in together)
