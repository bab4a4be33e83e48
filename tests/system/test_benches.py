"""How `cargo xtask bench` makes its table: verdicts, turns, document, picture, the FMI floor. No time is judged."""

import json
import os
import re
import socket
import subprocess
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from benches import __main__ as command
from benches import c_loop, document, floor, instructions, lifetime, machine, native, peers, picture, sweeps
from benches.row import Bench, NotRun, Row, Sheet, small
from benches.turns import Times, in_turns, pinned, quarters
from fmpy import simulate_fmu
from matplotlib import image

from exo.fmu import Archive, Instance
from exo.loop import Part

ROOT = Path(__file__).parents[2]


@pytest.fixture(scope="module")
def bench(fmu_dir: Path, tmp_path_factory: pytest.TempPathFactory) -> Bench:
    return Bench(fmu_dir=fmu_dir, work=tmp_path_factory.mktemp("bench"), rounds=1)


ROWS = (
    Row(name="a / b", value=0.05, limit=0.25, aim=0.1, spread=(0.04, 0.06), told="1 µs / 20 µs"),
    Row(name="own", value=90.0, limit=120.0, aim=60.0, unit="ns"),
    Row(name="share", value=0.7, limit=0.8, aim=0.9, least=True),
    Row(name="floor", value=7.0),
)


def test_a_row_says_what_has_become_of_limit_and_aim() -> None:
    assert [row.verdict for row in ROWS] == ["aim reached", "met", "MISSED", ""]
    assert [row.share for row in ROWS[:3]] == pytest.approx([0.2, 0.75, 8 / 7])
    assert Row(name="x", value=0.8, limit=0.8, aim=0.9, least=True).verdict == "met"
    assert [small(one) for one in (1 / 15.2, 0.25, 0.9, 42.0)] == ["1/15.2", "1/4", "0.9", "42"]


def test_what_is_compared_takes_turns_and_one_disturbed_round_does_not_count() -> None:
    order: list[str] = []

    def took(name: str, seconds: float) -> Any:
        def once() -> float:
            order.append(name)
            # The machine is ten times as slow in the third round, for both.
            return seconds * (10.0 if 4 <= len(order) - 2 < 6 else 1.0)

        return once

    times = in_turns({"a": took("a", 1.0), "b": took("b", 4.0)}, 5)
    assert order == ["a", "b", "a", "b", "b", "a", "a", "b", "b", "a", "a", "b"]
    assert times.ratio("a", "b") == 0.25
    assert times.median("a") == 1.0
    assert max(times.seconds["a"]) == 10.0
    # A round that only one of them lost is no median either.
    assert Times({"a": [1.0, 9.0, 1.0], "b": [2.0, 2.0, 2.0]}).ratio("a", "b") == 0.5
    assert quarters([4.0, 1.0, 2.0, 3.0, 100.0]) == (2.0, 4.0)


@pytest.mark.skipif(not hasattr(os, "sched_setaffinity"), reason="this system pins no process")
def test_what_is_pinned_has_one_core_and_gets_the_others_back() -> None:
    before = os.sched_getaffinity(0)
    with pinned():
        assert len(os.sched_getaffinity(0)) == 1
    assert os.sched_getaffinity(0) == before


def test_the_document_has_each_row_its_verdict_and_what_was_not_run() -> None:
    found = [
        *ROWS,
        Sheet(title="More", about="Figures.", header=("what", "ns"), lines=[("x", "1")]),
        NotRun(name="OMSimulator", reason="no program OMSimulator on PATH"),
    ]
    text = document.of(found, {"processor": "one", "cores": "2"})
    assert "| a / b | 1/20 | 1/25 to 1/16.7 | ≤ 1/4 | ≤ 1/10 | aim reached | 1 µs / 20 µs |" in text
    assert "| own | 90 ns |  | ≤ 120 ns | ≤ 60 ns | met |  |" in text
    assert "| share | 0.7 |  | ≥ 0.8 | ≥ 0.9 | MISSED |  |" in text
    assert text.index("## Ratios with a limit") < text.index("| share") < text.index("## Other ratios")
    assert text.index("## Other ratios") < text.index("| floor | 7 |") < text.index("## More")
    assert "* OMSimulator: no program OMSimulator on PATH" in text
    for block in re.findall(r"(?:^\|.*\n)+", text, re.MULTILINE):
        assert len({line.count("|") for line in block.splitlines()}) == 1, block


def test_the_machine_is_told_without_its_name_and_folders() -> None:
    facts = machine.facts()
    assert {"date", "processor", "cores", "rustc", "cc"} <= set(facts)
    assert re.fullmatch(r"\d{4}-\d\d-\d\d", facts["date"])
    assert facts["rustc"].startswith("rustc 1.")
    told = " ".join(facts.values())
    assert socket.gethostname() not in told
    assert "/" not in told.replace("not there", "")
    assert machine.version("no-such-program") == "not there"


def test_the_bars_are_the_rows_shares_of_their_limits(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    drawn: list[Any] = []
    monkeypatch.setattr(
        picture,
        "Figure",
        lambda *a, **k: drawn.append(figure := import_module("matplotlib.figure").Figure(*a, **k)) or figure,
    )
    picture.draw(ROWS, tmp_path / "bars.png")
    axes = drawn[0].axes[0]
    assert [bar.get_width() for bar in axes.patches[:3]] == pytest.approx([0.2, 0.75, 8 / 7])
    assert [label.get_text() for label in axes.get_yticklabels()] == ["a / b", "own", "share"]
    assert [line.get_xdata()[0] for line in axes.lines if len(line.get_xdata())] == pytest.approx(
        [0.4, 0.5, 8 / 9, 1.0]
    )  # aims, the limit
    assert image.imread(tmp_path / "bars.png").std() > 0.05


def test_a_missed_limit_is_no_failure_and_a_provider_that_fails_is_named(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(command, "DOCS", tmp_path)
    monkeypatch.setattr(command, "find_fmu_dir", lambda: tmp_path)
    monkeypatch.setattr(floor, "measure", lambda _bench: iter(ROWS))
    assert command.main(["--only", "floor", "--write"]) == 0
    assert "MISSED" in capsys.readouterr().out
    assert "MISSED" in (tmp_path / "benchmarks.md").read_text()
    assert (tmp_path / "benchmarks.png").stat().st_size > 1000

    (tmp_path / "benchmarks.md").unlink()
    monkeypatch.setattr(lifetime, "measure", lambda _bench: iter([1 / 0]))
    assert command.main(["--only", "floor", "lifetime", "--write"]) == 1
    said = capsys.readouterr()
    assert "* lifetime: failed: ZeroDivisionError" in said.out
    assert "| share | 0.7 |" in said.out
    assert "lifetime failed; nothing was written" in said.err
    assert not (tmp_path / "benchmarks.md").exists()


def test_every_provider_is_there_and_told_in_the_packages_table() -> None:
    package = import_module("benches")
    for name in command.PROVIDERS:
        assert callable(import_module(f"benches.{name}").measure)
        assert f"`{name}`" in str(package.__doc__)
    assert {path.stem for path in (ROOT / "benches").glob("*.py")} >= set(command.PROVIDERS)


def test_the_floor_is_an_fmu_that_keeps_what_is_set_and_does_nothing(
    bench: Bench, fmu_dir: Path, tmp_path: Path
) -> None:
    floor.archives(bench, tmp_path)
    of = {path.name: path for path in (*fmu_dir.glob("*.fmu"), fmu_dir / floor.SMALLEST)}
    assert {path.name for path in tmp_path.glob("*.fmu")} == set(of)
    for path in sorted(tmp_path.glob("*.fmu")):
        with Archive(of[path.name]) as ours, Archive(path) as bottom:
            assert list(bottom.variables) == list(ours.variables)
    run = simulate_fmu(str(tmp_path / "Testbed.fmu"), stop_time=0.1, start_values={"tau_h": 3.0}, output=["q", "tau_h"])
    assert set(run["q"]) == {0.0}
    assert set(run["tau_h"]) == {3.0}
    with Archive(tmp_path / "Testbed.fmu") as archive, Instance(archive, "floor") as instance:
        part = Part(instance, inputs=["tau_h", "tau_a"], outputs=["q", "dq"], steps=5)
        part.u["Real"][:] = 1.0
        part.y["Real"][:] = 7.0
        assert c_loop.alone(c_loop.load(bench), part, 5, 0.002) >= 0.0
        assert np.array_equal(part.y["Real"][1:], np.zeros((5, 2)))  # each row was got
        instance.reset()
        assert instance.values(["tau_h"]) == {"tau_h": 0.0}
        with pytest.raises(Exception, match="fmi2GetFMUstate returned fmi2Error"):
            instance.get_state()


def test_a_source_that_does_not_compile_is_an_error(bench: Bench) -> None:
    with pytest.raises(subprocess.CalledProcessError):
        native.library(bench, "no_such_source")


def test_instructions_stand_beside_the_committed_and_the_floor(bench: Bench, tmp_path: Path) -> None:
    counted = {"A set": 100, "A step": 900, "A step, moving": 1000, "A get": 210}
    committed = {**counted, "A get": 200}
    row = instructions.beside_committed(counted, committed, "rustc 1", "rustc 1")
    assert isinstance(row, Row)
    assert (row.value, row.verdict, row.told) == (1.05, "met", "A get: 210 / 200")
    worse = instructions.beside_committed(counted | {"A get": 211}, committed, "rustc 1", "rustc 1")
    assert isinstance(worse, Row)
    assert worse.verdict == "MISSED"
    other = instructions.beside_committed(counted, committed, "rustc 2", "rustc 1")
    assert isinstance(other, NotRun)
    assert "rustc 2" in other.reason
    (row,) = instructions.beside_floor(counted, {"A set": 10, "A step": 1, "A get": 20})
    assert row.value == pytest.approx(1310 / 31)
    # What is not counted is told; what is handed over is read.
    assert [type(one) for one in instructions.measure(bench)] == [NotRun]
    file = tmp_path / "counted.json"
    file.write_text(json.dumps({"compiler": "rustc 0", "instructions": counted}))
    both = Bench(fmu_dir=bench.fmu_dir, work=tmp_path, counts={"fmu": file, "floor": file})
    assert [type(one) for one in instructions.measure(both)] == [NotRun, Row]


@pytest.mark.parametrize("name", ["Testbed.fmu", "fmi3/Testbed.fmu"])
def test_a_lifetime_has_all_its_figures_in_both_versions(bench: Bench, name: str) -> None:
    path = bench.fmu_dir / name
    found = lifetime.figures(native.program(bench, "lifetime", "-ldl"), path, 1)
    assert len(found) == len(lifetime.HEADER) - 1
    assert found[0] == path.stat().st_size / 1e3
    assert found[3] > 10 * found[4] > 0.0  # the first instance makes what the others find


def test_a_tool_that_is_not_there_is_named(bench: Bench, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(peers, "find_spec", lambda _name: None)
    monkeypatch.setattr(peers.shutil, "which", lambda _name: None)
    found = list(peers.measure(bench))
    assert all(isinstance(one, NotRun) for one in found)
    assert [one.name for one in found] == ["libcosim", "Ecos", "OMSimulator"]


def test_omsimulator_is_timed_by_its_command_line(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """By a program of that name that works as long as it is told to, as the tool itself is not on this machine."""
    program = tmp_path / "OMSimulator"
    program.write_text(
        "#!/usr/bin/env python3\nimport sys, time\n"
        "told = dict(word[2:].split('=') for word in sys.argv[1:-1])\n"
        "assert sys.argv[-1].endswith('.ssp') and set(told) == {'tempDir', 'resultFile', 'stopTime'}\n"
        "while time.process_time() < float(told['stopTime']) / 100: pass\n"
    )
    program.chmod(0o755)
    monkeypatch.setenv("PATH", f"{tmp_path}{os.pathsep}{os.environ['PATH']}")
    # 40 s of simulation are .4 s of work, 2 ms are none.
    assert peers.omsimulator(tmp_path / "x.ssp", tmp_path) == pytest.approx(0.4, abs=0.25)


def test_own_work_is_machine_time() -> None:
    began, worked = sweeps.machine_time(), os.times()
    while (now := os.times()).user + now.system - worked.user - worked.system < 0.4:
        pass
    assert sweeps.machine_time() - began >= 0.9 * 0.4 / (os.cpu_count() or 1)


def test_the_committed_table_is_one_that_the_command_writes() -> None:
    text = (ROOT / "docs" / "benchmarks.md").read_text()
    assert text.startswith(document.INTRODUCTION)
    assert f"| {' | '.join(document.HEADER)} |" in text
    for what in (
        "native engine / raw C loop",
        "MuJoCo implicitfast",
        "FMI floor",
        "Dask on",
        "runs an hour",
        "By the clock",
    ):
        assert what in text, what
    assert (ROOT / "docs" / "benchmarks.png").is_file()
    assert not re.search(r"/(home|root|work|tmp|Users)/", text)
