"""Sweeps on a Dask cluster: the same numbers as here, whatever is lost."""

import os
import re
import signal
import socket
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from typing import Any

import pytest

from exo import extraction, sweep
from exo.errors import ExoError
from exo.sweep import apart, store, study, work
from exo.sweep import cluster as cluster_of
from exo.sweep.chunks import Queue

from commands import exo
from sweeping import DEADLY, LONG, LONG_ROWS, assert_one_row_is_deadly, numbers


@pytest.fixture(scope="module")
def cluster(tmp_path_factory: pytest.TempPathFactory) -> Any:
    """Two workers, in which some rows end their process; the cluster gives up what a lost worker had."""
    distributed, dask = pytest.importorskip("distributed"), pytest.importorskip("dask")
    folder = tmp_path_factory.mktemp("deadly")
    (folder / "sitecustomize.py").write_text(DEADLY)
    with (
        pytest.MonkeyPatch.context() as patch,
        dask.config.set({"distributed.scheduler.allowed-failures": 0}),
    ):
        patch.setenv("PYTHONPATH", str(folder))
        with distributed.LocalCluster(
            n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None, silence_logs=50
        ) as local:
            yield local


def test_a_row_that_ends_its_process_is_a_failed_row_and_costs_no_worker(
    cluster: Any, study_file: Path, fmu_dir: Path, tmp_path: Path
) -> None:
    before = [worker.pid for worker in cluster.workers.values()]
    address = cluster.scheduler_address
    assert_one_row_is_deadly(sweep.sweep(study_file, out=tmp_path / "out", scheduler=address, fmu_dir=fmu_dir))
    assert [worker.pid for worker in cluster.workers.values()] == before


def test_all_workers_begin_with_the_first_rows(
    cluster: Any, study_file: Path, fmu_dir: Path, tmp_path: Path, monkeypatch: Any
) -> None:
    """Dask alone sends them where the FMUs are; another worker would come when that one has much to do."""
    distributed = pytest.importorskip("distributed")
    plain, sent = distributed.Client.submit, []

    def submit(client: Any, function: Any, *arguments: Any, **settings: Any) -> Any:
        if function is apart.run_chunk_apart:
            sent.append((settings.get("workers"), settings.get("allow_other_workers")))
        return plain(client, function, *arguments, **settings)

    monkeypatch.setattr(distributed.Client, "submit", submit)
    sweep.sweep(study_file, out=tmp_path / "out", scheduler=cluster.scheduler_address, fmu_dir=fmu_dir)
    first, second = (worker.worker_address for worker in cluster.workers.values())
    assert sorted(sent[:4]) == sorted(2 * [([first], True), ([second], True)])
    assert set(sent[4:]) == {(None, None)}


def test_each_worker_gets_a_row_before_any_gets_two() -> None:
    assert cluster_of._places({"a": 3, "b": 1, "c": 2}) == ["a", "b", "c", "a", "c", "a"]
    assert cluster_of._places({}) == []


#: A process beside a worker that waits for a tenth of a second.
IDLE = "from exo.sweep import apart; apart.IDLE_S = 0.1; apart.main()"


def test_a_process_that_nobody_asks_ends_in_order(
    study_file: Path, fmu_dir: Path, tmp_path: Path, monkeypatch: Any
) -> None:
    """Its folder is gone, and nothing stands in the worker's log."""
    monkeypatch.setenv("TMPDIR", str(tmp_path))
    found, scenario = study.load(study_file)
    task = work.Task("t", scenario, found.cases, found.metrics, None, None, fmu_dir, {}, False)
    pipe: Any = subprocess.PIPE
    process = subprocess.Popen([sys.executable, "-c", IDLE], stdin=pipe, stdout=pipe, stderr=pipe)
    with process:
        apart._send(process.stdin, task)
        assert apart._received(process.stdout) is None
        apart._send(process.stdin, [(0, found.rows()[0])])
        _, (done,) = apart._received(process.stdout)
        assert done.outcome.error is None
        assert process.wait(60.0) == 0
        assert process.stderr.read() == b""
    assert not list(tmp_path.glob("exo-*"))


def test_of_a_chunk_the_row_that_ends_its_process_is_found_and_the_others_are_kept(
    study_file: Path, fmu_dir: Path, tmp_path: Path, monkeypatch: Any
) -> None:
    """Six rows at once: the process ends with the third, and each is sent again, alone."""
    (tmp_path / "sitecustomize.py").write_text(DEADLY)
    monkeypatch.setenv("PYTHONPATH", str(tmp_path))
    found, scenario = study.load(study_file)
    task = work.Task("t", scenario, found.cases, found.metrics, None, None, fmu_dir, {}, False)
    process = apart.Apart(task)
    try:
        names, done = process.run(list(enumerate(found.rows())))
    finally:
        process.close()
    assert names == ["release_delay", "tank"]
    assert [one.row for one in done] == [0, 1, 2, 3, 4, 5]
    ended = {one.row: one.outcome.error for one in done if one.outcome.error is not None}
    assert set(ended) == {2, 3}
    assert all("its process was ended twice" in reason for reason in ended.values())
    assert all(set(one.outcome.numbers) == set(names) for one in done if one.row not in ended)


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
    assert there.table[store.ROW].to_pylist() == list(range(LONG_ROWS))
    assert numbers(there.table) == numbers(here.table)


#: A worker that runs one row and is killed.
KILLED = """
import os, pathlib, signal, sys
from exo.sweep import apart, study, work
found, scenario = study.load(sys.argv[1])
task = work.Task("t", scenario, found.cases, found.metrics, None, None, None, {}, False)
names = ("Testbed.fmu", "TestbedController.fmu")
archives = {name: (pathlib.Path(sys.argv[2]) / name).read_bytes() for name in names}
_, done = apart.run_chunk_apart(task, [(0, found.rows()[0])], archives)
assert done[0].outcome.error is None, done
os.kill(os.getpid(), signal.SIGKILL)
"""


@pytest.mark.skipif(sys.platform == "win32", reason="signals")
def test_what_a_killed_worker_has_left_is_removed_by_the_next_one(
    study_file: Path, fmu_dir: Path, tmp_path: Path, monkeypatch: Any
) -> None:
    """The FMUs that came with its rows, too; and what somebody was ended at while he removed it."""
    temporary = tmp_path / "temporary"
    temporary.mkdir()
    command = [sys.executable, "-c", KILLED, str(study_file), str(fmu_dir)]
    killed = subprocess.run(command, env={**os.environ, "TMPDIR": str(temporary)}, check=False)
    assert killed.returncode == -signal.SIGKILL
    assert list(temporary.rglob("Testbed.fmu"))
    (temporary / "exo-fmu-half" / "fmu").mkdir(parents=True)
    monkeypatch.setattr(tempfile, "tempdir", str(temporary))
    began = time.monotonic()
    while list(temporary.iterdir()):
        # The process beside the worker ends when it sees that the worker is gone.
        assert time.monotonic() - began < 30.0, list(temporary.iterdir())
        extraction.sweep()
        time.sleep(0.1)


@pytest.fixture
def threads() -> Iterator[str]:
    """A cluster of one thread of this process."""
    distributed = pytest.importorskip("distributed")
    size: Any = {"n_workers": 1, "threads_per_worker": 1, "processes": False}
    with distributed.LocalCluster(**size, dashboard_address=None, silence_logs=50) as local_cluster:
        yield local_cluster.scheduler_address


def test_a_worker_with_another_exo_is_refused(
    threads: str, study_file: Path, fmu_dir: Path, tmp_path: Path, monkeypatch: Any
) -> None:
    has = cluster_of.VERSION
    monkeypatch.setattr(cluster_of, "VERSION", "99.0")
    with pytest.raises(ExoError, match=rf"worker .*: exo: {re.escape(has)}; expected 99\.0"):
        sweep.sweep(study_file, out=tmp_path / "out", scheduler=threads, fmu_dir=fmu_dir)


def start(*arguments: str) -> subprocess.Popen[bytes]:
    program = [sys.executable, "-m", "distributed.cli.dask_" + arguments[0], *arguments[1:]]
    return subprocess.Popen(program, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


def wait_for(port: int) -> None:
    """Until somebody listens."""
    began = time.monotonic()
    while True:
        with socket.socket() as one:
            if one.connect_ex(("127.0.0.1", port)) == 0:
                return
        assert time.monotonic() - began < 60.0, "no scheduler in a minute"
        time.sleep(0.1)


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
        wait_for(free_port)
        done = sweep.sweep(file, out=tmp_path / "out", scheduler=address, fmu_dir=fmu_dir, tell=restart)
    finally:
        for process in processes:
            process.kill()
            process.wait()
    assert restarted
    assert done.table[store.ROW].to_pylist() == list(range(LONG_ROWS))
    assert done.failed == 0


@pytest.fixture
def free_port() -> int:
    with socket.socket() as one:
        one.bind(("127.0.0.1", 0))
        return int(one.getsockname()[1])


@pytest.mark.parametrize("port", ["closed", "silent", "another program's"])
def test_no_scheduler_is_one_sentence_within_ten_seconds(port: str, free_port: int) -> None:
    with socket.socket() as silent:
        silent.bind(("127.0.0.1", 0))
        silent.listen()
        address = f"tcp://127.0.0.1:{free_port if port == 'closed' else silent.getsockname()[1]}"
        if port == "another program's":
            threading.Thread(target=answer_as_a_web_server, args=(silent,), daemon=True).start()
        task: Any = None
        began = time.monotonic()
        with pytest.raises(ExoError) as caught:
            list(cluster_of.run(task, Queue([{}], ()), scheduler=address, archives={}))
        assert time.monotonic() - began < 10.0
    said = str(caught.value)
    assert f"--scheduler {address}: no Dask scheduler answers there:" in said
    assert "expected the address that `dask scheduler` prints" in said


def test_a_cluster_without_workers_is_one_sentence(
    study_file: Path, fmu_dir: Path, tmp_path: Path, monkeypatch: Any
) -> None:
    distributed = pytest.importorskip("distributed")
    monkeypatch.setattr(cluster_of, "ANSWER_S", 1.0)
    size: Any = {"n_workers": 0, "processes": False}
    with distributed.LocalCluster(**size, dashboard_address=None, silence_logs=50) as empty:
        address = empty.scheduler_address
        with pytest.raises(ExoError, match=r"has no worker; expected one or more, as `dask worker"):
            sweep.sweep(study_file, out=tmp_path / "out", scheduler=address, fmu_dir=fmu_dir)


def test_a_cluster_whose_last_worker_goes_ends_the_sweep_and_keeps_what_is_finished(
    fmu_dir: Path, tmp_path: Path, monkeypatch: Any
) -> None:
    distributed = pytest.importorskip("distributed")
    monkeypatch.setattr(cluster_of, "PATIENCE_S", 0.5)
    monkeypatch.setattr(cluster_of, "LOOK_S", 0.1)
    file = tmp_path / "long.toml"
    file.write_text(LONG)
    size: Any = {"n_workers": 1, "threads_per_worker": 1, "processes": False}
    with distributed.LocalCluster(**size, dashboard_address=None, silence_logs=50) as one:

        def leave(progress: sweep.Progress) -> None:
            if progress.done:
                one.scale(0)

        with pytest.raises(ExoError, match="no worker is left; what was finished is kept"):
            sweep.sweep(file, out=tmp_path / "out", scheduler=one.scheduler_address, fmu_dir=fmu_dir, tell=leave)
    assert list((tmp_path / "out" / "long" / "parts").glob("*.parquet"))


def answer_as_a_web_server(listening: socket.socket) -> None:
    """Until the socket is closed."""
    with suppress(OSError):
        while True:
            came, _ = listening.accept()
            came.sendall(b"HTTP/1.1 400 Bad Request\r\nContent-Length: 0\r\n\r\n")


@pytest.mark.parametrize("address", ["", "http://127.0.0.1:1", "tcp://127.0.0.1:port"])
def test_what_is_no_address_is_refused_at_once(address: str, study_file: Path, fmu_dir: Path, tmp_path: Path) -> None:
    answer = exo("sweep", study_file, "--out", tmp_path, "--fmu-dir", fmu_dir, "--scheduler", address)
    assert answer.exit_code == 2
    assert "expected an address as tcp://10.0.0.1:8786" in " ".join(answer.stderr.split())
