"""Sweeps: every row once, whatever is killed."""

import errno
import hashlib
import os
import signal
import subprocess
import sys
import time
from concurrent.futures.process import BrokenProcessPool
from pathlib import Path
from typing import Any

import pytest

from exo import sweep, trial
from exo.errors import ExoError
from exo.runs import Outcome
from exo.sweep import local, store, study, work
from exo.sweep.chunks import Queue

from sweeping import DEADLY, LONG, LONG_ROWS, WALL, assert_one_row_is_deadly, numbers


def command(file: Path, out: Path, fmu_dir: Path, *more: str) -> subprocess.Popen[str]:
    arguments = ["sweep", str(file), "--out", str(out), "--fmu-dir", str(fmu_dir), *more]
    return subprocess.Popen(
        [sys.executable, "-m", "exo", *arguments],
        text=True,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        start_new_session=True,
        # A job in the background has SIGINT ignored, one of nohup SIGHUP, and their children, too.
        preexec_fn=_hear,  # noqa: PLW1509  one thread here
    )


def _hear() -> None:
    for one in (signal.SIGINT, signal.SIGHUP):
        signal.signal(one, signal.SIG_DFL)


def wait_for_parts(folder: Path, count: int, process: subprocess.Popen[str]) -> None:
    began = time.monotonic()
    while len(list(folder.glob("parts/[0-9]*.parquet"))) < count:
        assert process.poll() is None, process.communicate()
        assert time.monotonic() - began < 120, "no part in two minutes"
        time.sleep(0.02)


@pytest.fixture(scope="module")
def whole(fmu_dir: Path, tmp_path_factory: pytest.TempPathFactory) -> sweep.Swept:
    """The long study, run in one go."""
    folder = tmp_path_factory.mktemp("whole")
    (folder / "long.toml").write_text(LONG)
    return sweep.sweep(folder / "long.toml", out=folder / "out", workers=2, fmu_dir=fmu_dir)


@pytest.mark.skipif(sys.platform == "win32", reason="signals")
@pytest.mark.parametrize(
    ("how", "code"), [(signal.SIGKILL, -9), (signal.SIGINT, 130), (signal.SIGHUP, 129), (signal.SIGTERM, 143)]
)
def test_a_killed_sweep_goes_on_with_every_row_once(
    how: int, code: int, whole: sweep.Swept, fmu_dir: Path, tmp_path: Path
) -> None:
    file, out = tmp_path / "long.toml", tmp_path / "out"
    file.write_text(LONG)
    killed = command(file, out, fmu_dir, "--workers", "2")
    wait_for_parts(out / "long", 3, killed)
    if how == signal.SIGKILL:
        os.kill(killed.pid, how)
    else:  # Ctrl-C goes to all of a terminal's processes, and so does that it closes
        os.killpg(killed.pid, how)
    _, said = killed.communicate(timeout=60)
    wait_for_the_last_of(killed.pid)
    assert killed.returncode == code, said
    assert "Traceback" not in said
    assert "resource_tracker" not in said or how == signal.SIGKILL
    before = store.Store.done(_store(out / "long"))
    assert 0 < len(before) < LONG_ROWS
    told: list[sweep.Progress] = []
    done = sweep.sweep(file, out=out, workers=2, fmu_dir=fmu_dir, tell=told.append)
    assert told[0].kept_before == len(before)
    assert done.table[store.ROW].to_pylist() == list(range(LONG_ROWS))
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


def test_a_file_system_without_locks_is_not_taken_for_another_sweep(
    study_file: Path, fmu_dir: Path, tmp_path: Path, monkeypatch: Any
) -> None:
    def lock(*_: Any, **__: Any) -> None:
        raise OSError(errno.ENOLCK, os.strerror(errno.ENOLCK))

    monkeypatch.setattr("exo.sweep.store.folder.lock", lock)
    with pytest.raises(ExoError, match=r"small: cannot be locked: No locks available; expected --out on another file"):
        sweep.sweep(study_file, out=tmp_path / "out", workers=1, fmu_dir=fmu_dir)


def test_a_pool_that_breaks_as_rows_are_sent_loses_none(
    study_file: Path, fmu_dir: Path, tmp_path: Path, monkeypatch: Any
) -> None:
    plain, calls = local.ProcessPoolExecutor.submit, []

    def submit(*arguments: Any) -> Any:
        calls.append(arguments)
        if len(calls) == 3:  # the first one begins the pool
            raise BrokenProcessPool("a worker was killed")
        return plain(*arguments)

    monkeypatch.setattr(local.ProcessPoolExecutor, "submit", submit)
    done = sweep.sweep(study_file, out=tmp_path / "out", workers=1, fmu_dir=fmu_dir)
    assert done.failed == 0
    assert done.table[store.ROW].to_pylist() == list(range(6))


def test_a_worker_that_ends_costs_its_row_and_no_other(fmu_dir: Path, tmp_path: Path, monkeypatch: Any) -> None:
    file = tmp_path / "study.toml"
    file.write_text(WALL)
    (tmp_path / "sitecustomize.py").write_text(DEADLY)
    monkeypatch.setenv("PYTHONPATH", str(tmp_path))
    assert_one_row_is_deadly(sweep.sweep(file, out=tmp_path / "out", workers=2, fmu_dir=fmu_dir))


def test_a_row_that_may_end_its_process_runs_while_no_other_does() -> None:
    """Also the last of them, beside which the next rows would be blamed for it."""
    queue = Queue([{"K": float(i)} for i in range(9)], ())
    under_way = [queue.next(), queue.next()]
    assert queue.give_back(under_way) == []
    for _ in under_way:
        assert queue.admits(0, most=3)
        (row,) = queue.next()
        assert row[0] in (0, 1)
        assert not queue.admits(1, most=3)
    assert queue.admits(0, most=3)
    queue.next()
    assert queue.admits(1, most=3)


@pytest.mark.parametrize("how", ["a file", "standard input"])
def test_a_script_needs_no_guard_around_its_sweep(how: str, study_file: Path, fmu_dir: Path, tmp_path: Path) -> None:
    """A process that ran the script again would sweep again, and so on."""
    script = tmp_path / "script.py"
    script.write_text(
        "from pathlib import Path\nfrom exo.sweep import sweep\nprint('begins')\n"
        f"done = sweep({str(study_file)!r}, out=Path({str(tmp_path / 'out')!r}), workers=2, "
        f"fmu_dir=Path({str(fmu_dir)!r}))\nprint(done.table.num_rows, done.failed)\n"
    )
    arguments, text = ([str(script)], None) if how == "a file" else (["-"], script.read_text())
    answer = subprocess.run(
        [sys.executable, *arguments], input=text, text=True, capture_output=True, timeout=120, check=False
    )
    assert (answer.returncode, answer.stdout) == (0, "begins\n6 0\n"), answer.stderr


def test_a_worker_that_is_killed_as_it_begins_is_begun_again(
    study_file: Path, fmu_dir: Path, tmp_path: Path, monkeypatch: Any
) -> None:
    """As by a system that has too little memory for a moment. Nothing but the answer is printed, also at the end."""
    (tmp_path / "sitecustomize.py").write_text(
        "import os, signal, sys\n"
        "if 'spawn_main' in ' '.join(sys.orig_argv):\n"
        "    try:\n"
        f"        os.rmdir({str(tmp_path / 'deadly')!r})\n"
        "        os.kill(os.getpid(), signal.SIGKILL)\n"
        "    except OSError:\n"
        "        pass\n"
    )
    (tmp_path / "deadly").mkdir()
    monkeypatch.setenv("PYTHONPATH", str(tmp_path))
    process = command(study_file, tmp_path / "out", fmu_dir, "--workers", "2")
    said, errors = process.communicate(timeout=120)
    assert (process.returncode, errors) == (0, "")
    assert "6 runs\n" in said
    assert not (tmp_path / "deadly").exists()


def test_processes_that_cannot_begin_are_one_sentence(
    study_file: Path, fmu_dir: Path, tmp_path: Path, monkeypatch: Any
) -> None:
    (tmp_path / "sitecustomize.py").write_text("import os\nos._exit(7)\n")
    monkeypatch.setenv("PYTHONPATH", str(tmp_path))
    monkeypatch.setattr("exo.trial.check", lambda _archive: None)  # begins a process, too
    with pytest.raises(ExoError, match=r"--workers 2: no process begins: .*; expected fewer, or more memory"):
        sweep.sweep(study_file, out=tmp_path / "out", workers=2, fmu_dir=fmu_dir)


def test_all_workers_begin_side_by_side_and_no_more_than_there_is_to_do(
    study_file: Path, fmu_dir: Path, tmp_path: Path, monkeypatch: Any
) -> None:
    """One after the other, the last of many would come when the work is done. What may be deadly runs alone."""
    plain, begun = local._pool, []

    def look(workers: int, *, begin: int) -> Any:
        pool = plain(workers, begin=begin)
        begun.append((begin, len(pool._processes)))
        return pool

    monkeypatch.setattr(local, "_pool", look)
    sweep.sweep(study_file, out=tmp_path / "few", workers=3, fmu_dir=fmu_dir)
    assert begun == [(3, 3)]
    (tmp_path / "sitecustomize.py").write_text(DEADLY)
    monkeypatch.setenv("PYTHONPATH", str(tmp_path))
    assert_one_row_is_deadly(sweep.sweep(study_file, out=tmp_path / "deadly", workers=3, fmu_dir=fmu_dir))
    assert set(begun[1:]) == {(3, 3), (1, 1)}
    begun.clear()
    study_file.write_text(WALL.replace("[10.0, 20.0, 30.0]", "[10.0]"))
    sweep.sweep(study_file, out=tmp_path / "two", workers=3, fmu_dir=fmu_dir)
    assert begun == [(2, 2)]


#: A sweep whose other workers begin with the first rows: until then the first one is idle.
LATE = """
import time
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from exo.sweep import sweep

print("begins", __name__)
if __name__ == "__main__":
    plain = ProcessPoolExecutor.submit

    def submit(pool, function, /, *arguments):
        future = plain(pool, function, *arguments)
        if function.__name__ == "processors":
            future.result()
            time.sleep(0.3)
        return future

    ProcessPoolExecutor.submit = submit
done = sweep(Path({study!r}), out=Path({out!r}), workers=3, fmu_dir=Path({fmu_dir!r}))
print(done.table.num_rows, done.failed)
"""


def test_a_worker_that_begins_late_runs_no_script_again(fmu_dir: Path, tmp_path: Path) -> None:
    study_file, script = tmp_path / "long.toml", tmp_path / "late.py"
    study_file.write_text(LONG)
    script.write_text(LATE.format(study=str(study_file), out=str(tmp_path / "out"), fmu_dir=str(fmu_dir)))
    answer = subprocess.run([sys.executable, script], text=True, capture_output=True, timeout=120, check=False)
    assert (answer.returncode, answer.stdout) == (0, f"begins __main__\n{LONG_ROWS} 0\n"), answer.stderr


def test_a_worker_of_this_machine_does_not_try_an_fmu_again_and_one_of_a_cluster_does(
    study_file: Path, fmu_dir: Path, monkeypatch: Any
) -> None:
    found, scenario = study.load(study_file)
    tried: list[str] = []
    monkeypatch.setattr(trial, "_ENDED", {})
    monkeypatch.setattr(trial, "_ended", lambda *_, **__: tried.append("one") or "")
    monkeypatch.setattr(trial.child, "run", lambda _task: None)
    for one, here in (("a", True), ("b", False)):
        archives = ("Testbed.fmu", "TestbedController.fmu")
        checksums = {name: hashlib.sha256((fmu_dir / name).read_bytes()).hexdigest() for name in archives}
        task = work.Task(one, scenario, found.cases, found.metrics, None, None, fmu_dir, checksums, here)
        trial._ENDED.clear()
        _, done = work.run_chunk(task, [(0, found.rows()[0])])
        work.close()
        assert done[0].outcome.error is None
        assert len(tried) == (0 if here else 2)


def test_the_last_chunks_are_short_so_that_no_worker_waits_long_for_another_one() -> None:
    """1,000 rows of 4 ms for two workers: half a second's worth at first, 20 ms' at the end, and every row once."""
    queue, sizes, rows = Queue([{"K": float(i)} for i in range(1000)], ()), [], []
    while len(queue):
        chunk = queue.next(among=2)
        queue.learn([store.Done(i, Outcome({}), 0.004) for i, _ in chunk])
        sizes.append(len(chunk))
        rows += [i for i, _ in chunk]
    assert rows == list(range(1000))
    assert max(sizes) == 125  # 0.5 s
    assert max(sizes[-4:]) <= 5  # 20 ms
    assert len(sizes) < 40  # a task costs a few ms
