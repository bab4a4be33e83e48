"""Sweeps: every row once, whatever is killed; the same numbers here and on a cluster."""

import json
import os
import re
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Iterator
from concurrent.futures.process import BrokenProcessPool
from math import log10
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest

from exo import sweep
from exo.errors import ExoError
from exo.runs import FAILURE
from exo.sweep import cluster as cluster_of
from exo.sweep import local, pictures, store, study
from exo.sweep.pictures import front

from commands import exo

WALL = """
id = "small"
title = "Time to let go"
scenario = "wall"
cases = ["passive_bounded_5_0.5"]
metrics = ["release_delay", "tank"]
[axes."controller.K"]
values = [10.0, 20.0, 30.0]
[axes."controller.M_n"]
low = 2.0
high = 8.0
scale = "log"
count = 2
[[figures]]
id = "map"
title = "Time to let go"
kind = "map"
x = "controller.K"
y = "controller.M_n"
color = "release_delay"
limit = 0.4
"""
#: Long enough to be killed in the middle.
LONG = WALL.replace("values = [10.0, 20.0, 30.0]", "low = 5.0\nhigh = 50.0\ncount = 150").replace('"small"', '"long"')


@pytest.fixture
def file(tmp_path: Path) -> Path:
    path = tmp_path / "study.toml"
    path.write_text(WALL)
    return path


def numbers(table: pa.Table) -> dict[str, list[Any]]:
    """All columns but the time that rows took."""
    return {name: table[name].to_pylist() for name in table.column_names if name != store.SECONDS}


def test_a_grid_has_every_point_once_and_a_picture(file: Path, fmu_dir: Path, tmp_path: Path, monkeypatch: Any) -> None:
    """Also where a machine that was switched off has left an empty part; and no file of an FMU stays behind."""
    parts, temporary = tmp_path / "out" / "small" / "parts", tmp_path / "temporary"
    parts.mkdir(parents=True)
    for name in ("00000000.parquet", ".00000001.parquet.half"):
        (parts / name).write_bytes(b"")
    temporary.mkdir()
    monkeypatch.setenv("TMPDIR", str(temporary))
    monkeypatch.setattr(tempfile, "tempdir", str(temporary))
    told: list[sweep.Progress] = []
    done = sweep.sweep(file, out=tmp_path / "out", workers=2, fmu_dir=fmu_dir, tell=told.append)
    assert done.failed == 0
    assert done.table[store.ROW].to_pylist() == list(range(6))
    points = zip(done.table["controller.K"].to_pylist(), done.table["controller.M_n"].to_pylist(), strict=True)
    assert Counter(points) == Counter((K, M) for K in (10.0, 20.0, 30.0) for M in (2.0, 8.0))
    assert [path.name for path in done.pictures] == ["map.png"]
    assert done.pictures[0].stat().st_size > 10_000
    assert [told[0].done, told[-1].done] == [0, 6]
    assert not list(parts.iterdir())
    assert not list(temporary.glob("exo-*"))


def test_a_pool_that_breaks_as_rows_are_sent_loses_none(
    file: Path, fmu_dir: Path, tmp_path: Path, monkeypatch: Any
) -> None:
    plain, calls = local.ProcessPoolExecutor.submit, []

    def submit(*arguments: Any) -> Any:
        calls.append(arguments)
        if len(calls) == 2:
            raise BrokenProcessPool("a worker was killed")
        return plain(*arguments)

    monkeypatch.setattr(local.ProcessPoolExecutor, "submit", submit)
    done = sweep.sweep(file, out=tmp_path / "out", workers=1, fmu_dir=fmu_dir)
    assert done.failed == 0
    assert done.table[store.ROW].to_pylist() == list(range(6))


def test_a_sweep_that_is_done_is_not_run_again_and_pictures_may_change(
    file: Path, fmu_dir: Path, tmp_path: Path
) -> None:
    first = sweep.sweep(file, out=tmp_path / "out", workers=1, fmu_dir=fmu_dir)
    file.write_text(WALL.replace("limit = 0.4", "limit = 0.3"))
    again = sweep.sweep(file, out=tmp_path / "out", workers=1, fmu_dir=fmu_dir)
    assert again.table.equals(first.table)  # the seconds, too
    file.write_text(WALL.replace("30.0]", "31.0]"))
    with pytest.raises(ExoError, match="another study: study, rows differ; expected another --out, or --fresh"):
        sweep.sweep(file, out=tmp_path / "out", workers=1, fmu_dir=fmu_dir)
    file.write_text(WALL)
    (first.folder / store.TABLE).write_bytes(b"half a table")
    with pytest.raises(ExoError, match=r"runs\.parquet: cannot be read; expected another --out, or --fresh"):
        sweep.sweep(file, out=tmp_path / "out", workers=1, fmu_dir=fmu_dir)
    file.write_text(WALL.replace("30.0]", "31.0]"))
    fresh = sweep.sweep(file, out=tmp_path / "out", workers=1, fmu_dir=fmu_dir, fresh=True)
    assert fresh.table["controller.K"].to_pylist()[-1] == 31.0


def command(file: Path, out: Path, fmu_dir: Path, *more: str) -> subprocess.Popen[str]:
    arguments = ["sweep", str(file), "--out", str(out), "--fmu-dir", str(fmu_dir), *more]
    return subprocess.Popen(
        [sys.executable, "-m", "exo.cli", *arguments],
        text=True,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        start_new_session=True,
        # A job in the background has SIGINT ignored, and its children, too.
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),  # noqa: PLW1509  one thread here
    )


def wait_for_parts(folder: Path, count: int, process: subprocess.Popen[str]) -> None:
    began = time.monotonic()
    while len(list(folder.glob("parts/[0-9]*.parquet"))) < count:
        assert process.poll() is None, process.communicate()
        assert time.monotonic() - began < 120, "no part in two minutes"
        time.sleep(0.02)


@pytest.mark.skipif(sys.platform == "win32", reason="signals")
@pytest.mark.parametrize("how", [signal.SIGKILL, signal.SIGINT])
def test_a_killed_sweep_goes_on_with_every_row_once(how: int, fmu_dir: Path, tmp_path: Path) -> None:
    file, out = tmp_path / "long.toml", tmp_path / "out"
    file.write_text(LONG)
    killed = command(file, out, fmu_dir, "--workers", "2")
    wait_for_parts(out / "long", 3, killed)
    if how == signal.SIGKILL:
        os.kill(killed.pid, how)
    else:  # Ctrl-C goes to all of a terminal's processes
        os.killpg(killed.pid, how)
    _, said = killed.communicate(timeout=60)
    wait_for_the_last_of(killed.pid)
    assert killed.returncode == (-9 if how == signal.SIGKILL else 130), said
    before = store.Store.done(_store(out / "long"))
    assert 0 < len(before) < 300
    told: list[sweep.Progress] = []
    done = sweep.sweep(file, out=out, workers=2, fmu_dir=fmu_dir, tell=told.append)
    assert told[0].kept_before == len(before)
    assert done.table[store.ROW].to_pylist() == list(range(300))
    whole = sweep.sweep(file, out=tmp_path / "whole", workers=2, fmu_dir=fmu_dir)
    assert numbers(done.table) == numbers(whole.table)


def wait_for_the_last_of(group: int) -> None:
    """Until no process of the group runs."""
    began = time.monotonic()
    while True:
        listed = subprocess.run(["ps", "-A", "-o", "pgid=,stat="], text=True, capture_output=True, check=True).stdout
        if not any(line.split()[0] == str(group) and "Z" not in line.split()[1] for line in listed.splitlines()):
            return
        assert time.monotonic() - began < 30, "workers run without the process that gave them rows"
        time.sleep(0.1)


def _store(folder: Path) -> Any:
    found = store.Store.__new__(store.Store)
    found.folder = folder
    return found


def test_two_sweeps_do_not_mix(fmu_dir: Path, tmp_path: Path) -> None:
    file, out = tmp_path / "long.toml", tmp_path / "out"
    file.write_text(LONG)
    first = command(file, out, fmu_dir, "--workers", "1")
    try:
        wait_for_parts(out / "long", 1, first)
        before = set((out / "long").glob("parts/[0-9]*"))
        for fresh in (False, True):
            with pytest.raises(ExoError, match="another sweep works here"):
                sweep.sweep(file, out=out, fmu_dir=fmu_dir, fresh=fresh)
        assert before <= set((out / "long").glob("parts/[0-9]*"))
        assert (out / "long" / store.STUDY).exists()
    finally:
        os.killpg(first.pid, signal.SIGKILL)
        first.communicate()


def test_a_row_that_fails_is_a_row_with_its_reason(file: Path, fmu_dir: Path, tmp_path: Path) -> None:
    file.write_text(WALL.replace("[10.0, 20.0, 30.0]", "[10.0, -1.0]"))
    done = sweep.sweep(file, out=tmp_path / "out", workers=2, fmu_dir=fmu_dir)
    assert done.failed == 2
    errors = done.table[FAILURE].to_pylist()
    assert errors[:2] == [None, None]
    assert all("K = -1" in text and "expected a value from" in text for text in errors[2:])


def test_a_worker_that_ends_costs_its_row_and_no_other(fmu_dir: Path, tmp_path: Path, monkeypatch: Any) -> None:
    file = tmp_path / "study.toml"
    file.write_text(WALL)
    (tmp_path / "sitecustomize.py").write_text(DEADLY)
    monkeypatch.setenv("PYTHONPATH", str(tmp_path))
    assert_one_row_is_deadly(sweep.sweep(file, out=tmp_path / "out", workers=2, fmu_dir=fmu_dir))


#: The rows with K = 20 end the process that runs them.
DEADLY = """
import os, exo.runs as runs
plain = runs.Batch.run
def run(self, row):
    if row.get('controller.K') == 20.0:
        os._exit(7)
    return plain(self, row)
runs.Batch.run = run
"""


def assert_one_row_is_deadly(done: sweep.Swept) -> None:
    errors = dict(zip(done.table["controller.K"].to_pylist(), done.table[FAILURE].to_pylist(), strict=True))
    assert done.failed == 2
    assert errors[10.0] is None
    assert errors[30.0] is None
    assert "its process was ended twice" in str(errors[20.0])


@pytest.fixture(scope="module")
def cluster() -> Any:
    distributed = pytest.importorskip("distributed")
    with distributed.LocalCluster(
        n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None, silence_logs=50
    ) as local:
        yield local


def test_a_cluster_finds_the_same_and_a_killed_worker_is_no_loss(cluster: Any, fmu_dir: Path, tmp_path: Path) -> None:
    file = tmp_path / "long.toml"
    file.write_text(LONG)
    here = sweep.sweep(file, out=tmp_path / "here", workers=2, fmu_dir=fmu_dir)
    killed: list[int] = []

    def kill(progress: sweep.Progress) -> None:
        if not killed and progress.done > 20:
            killed.append(next(iter(cluster.workers.values())).pid)
            os.kill(killed[0], signal.SIGKILL)

    there = sweep.sweep(file, out=tmp_path / "there", scheduler=cluster.scheduler_address, fmu_dir=fmu_dir, tell=kill)
    assert killed
    assert there.table[store.ROW].to_pylist() == list(range(300))
    assert numbers(there.table) == numbers(here.table)


@pytest.fixture
def threads() -> Iterator[str]:
    """A cluster of one thread of this process."""
    distributed = pytest.importorskip("distributed")
    size: Any = {"n_workers": 1, "threads_per_worker": 1, "processes": False}
    with distributed.LocalCluster(**size, dashboard_address=None, silence_logs=50) as local_cluster:
        yield local_cluster.scheduler_address


def test_a_worker_with_another_exo_is_refused(
    threads: str, file: Path, fmu_dir: Path, tmp_path: Path, monkeypatch: Any
) -> None:
    has = cluster_of.VERSION
    monkeypatch.setattr(cluster_of, "VERSION", "99.0")
    with pytest.raises(ExoError, match=rf"worker .*: exo: {re.escape(has)}; expected 99\.0"):
        sweep.sweep(file, out=tmp_path / "out", scheduler=threads, fmu_dir=fmu_dir)


def start(*arguments: str) -> subprocess.Popen[bytes]:
    program = [sys.executable, "-m", "distributed.cli.dask_" + arguments[0], *arguments[1:]]
    return subprocess.Popen(program, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


def test_a_scheduler_that_is_restarted_loses_no_row(fmu_dir: Path, tmp_path: Path, free_port: int) -> None:
    file = tmp_path / "long.toml"
    file.write_text(LONG)
    address = f"tcp://127.0.0.1:{free_port}"
    scheduler = ["scheduler", "--host", "127.0.0.1", "--port", str(free_port), "--no-dashboard"]
    processes = [start(*scheduler)]
    # Workers leave a scheduler that is gone; a cluster's manager starts them again.
    worker = ["worker", address, "--nworkers", "2", "--nthreads", "1", "--no-dashboard", "--death-timeout", "60"]
    processes.append(start(*worker))
    restarted: list[int] = []

    def restart(progress: sweep.Progress) -> None:
        if not restarted and progress.done > 20:
            restarted.append(progress.done)
            processes[0].kill()
            processes[0].wait()
            processes.append(start(*scheduler))
            processes.append(start(*worker))

    try:
        done = sweep.sweep(file, out=tmp_path / "out", scheduler=address, fmu_dir=fmu_dir, tell=restart)
    finally:
        for process in processes:
            process.kill()
            process.wait()
    assert restarted
    assert done.table[store.ROW].to_pylist() == list(range(300))
    assert done.failed == 0


@pytest.fixture
def free_port() -> int:
    with socket.socket() as one:
        one.bind(("127.0.0.1", 0))
        return int(one.getsockname()[1])


def test_no_scheduler_is_one_sentence(
    file: Path, fmu_dir: Path, tmp_path: Path, free_port: int, monkeypatch: Any
) -> None:
    monkeypatch.setattr("exo.sweep.cluster.PATIENCE_S", 0.0)
    answer = exo("sweep", file, "--out", tmp_path, "--fmu-dir", fmu_dir, "--scheduler", f"tcp://127.0.0.1:{free_port}")
    assert answer.exit_code == 2
    assert f"--scheduler tcp://127.0.0.1:{free_port}: lost:" in " ".join(answer.stderr.split())


@pytest.mark.parametrize("address", ["", "http://127.0.0.1:1", "tcp://127.0.0.1:port"])
def test_what_is_no_address_is_refused_at_once(address: str, file: Path, fmu_dir: Path, tmp_path: Path) -> None:
    answer = exo("sweep", file, "--out", tmp_path, "--fmu-dir", fmu_dir, "--scheduler", address)
    assert answer.exit_code == 2
    assert "expected an address as tcp://10.0.0.1:8786" in " ".join(answer.stderr.split())


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("[10.0, 20.0, 30.0]", "[10.0, true]", "expected values of one kind, got the number 10.0, the Boolean True"),
        ("cases", 'parameters = { "controller.K" = 5.0 }\ncases', "parameters.controller.K: is an axis, too"),
        ("count = 2", "count = 1000000000", "3000000000 runs; expected at most 10000000"),
        ('scenario = "wall"', 'scenario = "wal"', "close matches: wall"),
        ('cases = ["passive_bounded_5_0.5"]', 'cases = ["none"]', "no such case"),
        ('"release_delay", "tank"', '"release_delai"', "close matches: release_delay"),
        ('axes."controller.K"', 'axes."controller.k"', "no variable k"),
        ("count = 2", "", "a grid needs values, or low, high and count"),
        ("low = 2.0", "low = -2.0", "expected a number above 0 on a log scale"),
        ("low = 2.0", "low = 9.0", "expected two numbers, the lower first"),
        ("low = 2.0", "mean = 2.0", "expected one of: values; low and high; mean and deviation"),
        ('x = "controller.K"', 'x = "controller.D"', "no column controller.D"),
        ('kind = "map"', 'kind = "pie"', "figures.0.kind"),
        ('color = "release_delay"', "", "a map needs color"),
        ("[10.0, 20.0, 30.0]", '["10"]', "controller.K holds texts; expected numbers to draw"),
        ('title = "Time', 'titel = "Time', "titel"),
        ("[axes", '[sampling]\nmethod = "sobol"\nsamples = 100\n[axes', "expected a power of 2, as 64 or 128"),
        ("[axes", '[sampling]\nmethod = "random"\n[axes', "method random: expected samples"),
    ],
)
def test_a_wrong_study_is_refused_by_name(old: str, new: str, said: str, fmu_dir: Path, tmp_path: Path) -> None:
    file = tmp_path / "study.toml"
    assert old in WALL
    file.write_text(WALL.replace(old, new, 1))
    answer = exo("sweep", file, "--out", tmp_path / "out", "--fmu-dir", fmu_dir)
    assert answer.exit_code == 2
    assert said in " ".join(answer.stderr.split())
    assert "Traceback" not in answer.stderr


def sampled(method: str, seed: int = 1) -> study.Study:
    data = {
        "id": "s",
        "title": "s",
        "scenario": "wall",
        "sampling": {"method": method, "samples": 256, "seed": seed},
        "axes": {
            "a": {"low": 1.0, "high": 100.0, "scale": "log"},
            "b": {"mean": 5.0, "deviation": 2.0},
            "c": {"values": [1, 2, 4]},
        },
    }
    return study.Study.model_validate_json(json.dumps(data))


@pytest.mark.parametrize("method", ["random", "latin_hypercube", "sobol"])
def test_samples_are_spread_as_they_say_and_come_from_the_seed(method: str) -> None:
    rows = sampled(method).rows()
    assert rows == sampled(method).rows()
    assert rows != sampled(method, seed=2).rows()
    a, b, c = (sorted(float(row[key]) for row in rows) for key in "abc")
    loose = 0.2 if method == "random" else 0.03
    assert 1.0 <= a[0] <= a[-1] <= 100.0
    assert abs(a[128] / 10.0 - 1.0) < 5 * loose  # the median of the logarithm
    assert abs(sum(b) / 256 - 5.0) < 2.0 * loose
    assert abs(Counter(c)[2.0] / 256 - 1 / 3) < loose
    # Of each of 16 slices of the range a Latin hypercube and a Sobol sequence have their share.
    slices = Counter(int(8 * log10(x)) for x in a)
    if method != "random":
        assert set(slices.values()) == {16}


def test_a_front_has_what_no_other_point_beats() -> None:
    x, y = np.array([3.0, 1.0, 2.0, 2.0, 4.0, 1.0]), np.array([1.0, 5.0, 3.0, 2.0, 1.0, 6.0])
    assert [(x[i], y[i]) for i in front(x, y)] == [(1.0, 5.0), (2.0, 2.0), (3.0, 1.0)]


POINTS = {
    "a": [1.0, 2.0, 3.0, 4.0],
    "b": [1.0, 2.0, 3.0, 4.0],
    "z": [0.0, 0.4, 0.6, 0.9],
    "yes": [True, True, True, False],
}


@pytest.mark.parametrize(
    ("settings", "columns", "drawn"),
    [
        ({"limit": 0.5}, {}, 4),
        ({"limit": 0.5}, {"b": [1.0] * 4}, 4),
        ({"limit": 0.5}, {"a": [1.0] * 4, "b": [1.0] * 4}, 4),
        ({"log": ["x"]}, {"a": [-1.0, -1.0, 2.0, 2.0], "b": [1.0, 2.0, 1.0, 2.0]}, 2),
        ({"where": {"yes": 1.0}}, {}, 3),
    ],
    ids=["a slope", "a line", "one point", "no logarithm", "a Boolean"],
)
def test_points_that_are_no_map_are_drawn_as_what_they_are(
    settings: dict[str, Any], columns: dict[str, Any], drawn: int, tmp_path: Path, monkeypatch: Any
) -> None:
    data = {"id": "f", "title": "f", "kind": "map", "x": "a", "y": "b", "color": "z", **settings}
    seen = []
    plain = pictures._map

    def look(axes: Any, of: Any, figure: Any, numbers: Any) -> None:
        seen.append(len(numbers["z"]))
        plain(axes, of, figure, numbers)

    monkeypatch.setattr(pictures, "_map", look)
    figure = study.Figure.model_validate_json(json.dumps(data))
    path = pictures.draw(figure, sampled("random"), pa.table({**POINTS, **columns}), tmp_path)
    assert seen == [drawn]
    assert path.stat().st_size > 5_000


def test_a_figure_that_cannot_be_drawn_leaves_the_others_and_says_where_the_runs_are(
    file: Path, fmu_dir: Path, tmp_path: Path
) -> None:
    nothing = '[[figures]]\nid = "none"\ntitle = "None"\nkind = "histogram"\nx = "tank"\nwhere = { tank = -7.0 }\n'
    file.write_text(WALL.replace("[[figures]]", nothing + "[[figures]]"))
    with pytest.raises(ExoError, match=r"figure none: no row has tank; the runs are in .*runs\.parquet"):
        sweep.sweep(file, out=tmp_path, workers=1, fmu_dir=fmu_dir)
    assert (tmp_path / "small" / "map.png").exists()


def test_the_table_opens_in_parquet_with_what_was_asked_for_beside_it(
    file: Path, fmu_dir: Path, tmp_path: Path
) -> None:
    done = sweep.sweep(file, out=tmp_path, workers=1, fmu_dir=fmu_dir)
    table = pq.read_table(done.folder / store.TABLE)
    assert table.column_names == [
        "row",
        "controller.K",
        "controller.M_n",
        "release_delay",
        "tank",
        "failure",
        "seconds",
    ]
    told = json.loads((done.folder / store.STUDY).read_text())
    assert told["study"]["sampling"]["seed"] == 1
    assert set(told["fmus"]) == {"Testbed.fmu", "TestbedController.fmu"}


@pytest.mark.parametrize("name", sweep.built_in())
def test_each_study_that_comes_along_runs_and_draws(name: str, fmu_dir: Path, tmp_path: Path) -> None:
    """A few of its runs: what it measures is there, and what it draws."""
    text = sweep.built_in()[name].read_text()
    small = re.sub(
        r"^samples = \d+$", "samples = 8", re.sub(r"^count = \d+$", "count = 3", text, flags=re.M), flags=re.M
    )
    shutil.copytree(sweep.built_in()[name].parent / "scenarios", tmp_path / "scenarios")
    (tmp_path / "study.toml").write_text(small)
    done = sweep.sweep(tmp_path / "study.toml", out=tmp_path / "out", workers=2, fmu_dir=fmu_dir)
    assert done.failed == 0, done.table[FAILURE].to_pylist()
    assert len(done.pictures) == len(sweep.load(name)[0].figures) > 0


def test_the_stability_map_is_where_exo_tune_puts_it(fmu_dir: Path, tmp_path: Path) -> None:
    """What grows is beyond the predicted limit, what decays is below, for three masses from 5 to 60 N·s/m."""
    text = sweep.built_in()["stability_map"].read_text()
    small = text.replace("count = 56", "count = 4").replace("count = 60", "count = 14")
    assert small.count("count = ") == 2
    (tmp_path / "study.toml").write_text(small)
    done = sweep.sweep(tmp_path / "study.toml", out=tmp_path / "out", workers=2, fmu_dir=fmu_dir)
    grows = np.array(done.table["grows"].to_pylist()) > 0.5
    share = np.array(done.table["limit_share"].to_pylist())
    assert 20 < grows.sum() < len(grows) - 20
    assert (grows == (share > 1.0)).all(), share[grows != (share > 1.0)]
