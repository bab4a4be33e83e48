"""Rows in a process beside a cluster's worker: an FMU that ends its process costs its own row, and no worker.

The worker sends a task and then chunks of rows, as pickles; each is answered by what it has come to. Where one ends the
process, its rows are sent again, each alone. The process ends when its input does, so that it never outlives the
worker, and when nothing has come for a minute.
"""

import os
import pickle
import queue
import subprocess
import sys
import tempfile
import threading
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import replace
from typing import IO, Any

from exo import extraction
from exo.errors import ExoError
from exo.runs import Outcome
from exo.scenario import Value
from exo.sweep import work
from exo.sweep.store import Done
from exo.sweep.work import ENDED, Chunk, Kept, Task, run_chunk

#: How often a row may end its process.
ATTEMPTS = 2
#: How long a process that was told to end may take (s).
GONE_S = 2.0
#: How long it waits for a chunk (s).
IDLE_S = 60.0
#: What a process that is gone makes of its pipes.
BROKEN = (OSError, EOFError, pickle.UnpicklingError)


class _EndedError(Exception):
    """The process has ended with what it was asked."""


#: The process of this thread.
_OPEN = threading.local()


def run_chunk_apart(task: Task, chunk: Chunk, archives: Mapping[str, bytes]) -> Kept:
    """As `run_chunk`, of a task whose archives come with it, in the process that belongs to this thread."""
    if getattr(_OPEN, "id", None) != task.id:
        close()
        # Workers end without a word: what they leave is removed by the next one.
        extraction.sweep()
        try:
            _OPEN.place = extraction.Place()
            folder = _OPEN.place.folder
            for name, data in archives.items():
                (folder / name).write_bytes(data)
        except OSError as error:
            said = error.strerror or error
            raise ExoError(f"a worker cannot write its FMUs to {tempfile.gettempdir()}: {said}") from error
        _OPEN.apart, _OPEN.id = Apart(replace(task, fmu_dir=folder)), task.id
    return _OPEN.apart.run(chunk)  # type: ignore[no-any-return]


def close() -> None:
    """Ends this thread's process and frees its folder."""
    _OPEN.id = None
    for name, end in (("apart", "close"), ("place", "close")):
        if (found := getattr(_OPEN, name, None)) is not None:
            setattr(_OPEN, name, None)
            getattr(found, end)()


class Apart:
    """A process that runs rows of one task; `close` ends it."""

    def __init__(self, task: Task) -> None:
        self._task = task
        self._process: subprocess.Popen[bytes] | None = None
        self._names: list[str] = []

    def run(self, chunk: Chunk) -> Kept:
        """As `run_chunk`; a row that ends the process twice is a failed row. ExoError as `run_chunk`."""
        if len(chunk) > 1:
            with suppress(_EndedError):
                return self._asked(chunk)
        done = [one for row in chunk for one in self._alone(row)]
        return self._names, done

    def _alone(self, row: tuple[int, Mapping[str, Value]]) -> list[Done]:
        for _ in range(ATTEMPTS):
            with suppress(_EndedError):
                _, done = self._asked([row])
                return done
        return [Done(row[0], Outcome({}, ENDED), 0.0)]

    def _asked(self, chunk: Chunk) -> Kept:
        process = self._process
        if process is None or process.poll() is not None:
            process = self._begin()
        try:
            _send(process.stdin, chunk)
            answer = _received(process.stdout)
        except BROKEN as error:
            self.close()
            # It has not closed what it had open.
            extraction.sweep()
            raise _EndedError from error
        if isinstance(answer, BaseException):
            raise answer
        self._names, done = answer
        return self._names, done

    def _begin(self) -> subprocess.Popen[bytes]:
        self.close()
        command = [sys.executable, "-c", f"from {__name__} import main; main()"]
        try:
            process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, env=_environment())
            self._process = process
            _send(process.stdin, self._task)
            if _received(process.stdout) is None:
                return process
            said = "it answers in another way"
        except BROKEN as error:
            said = " ".join(str(error).split()) or type(error).__name__
        self.close()
        raise ExoError(f"a worker cannot begin a process for its rows: {said}; expected one that runs exo")

    def close(self) -> None:
        """Ends the process."""
        process, self._process = self._process, None
        if process is None:
            return
        process.kill()
        with suppress(subprocess.TimeoutExpired):
            process.wait(GONE_S)
        for stream in (process.stdin, process.stdout):
            with suppress(OSError):
                if stream is not None:
                    stream.close()


def _environment() -> dict[str, str]:
    """A worker's, but for what Dask sets there: with it, memory is given back after each row and asked for again before
    the next, which takes time."""
    return {name: value for name, value in os.environ.items() if name != "MALLOC_TRIM_THRESHOLD_"}


def _send(stream: IO[bytes] | None, what: Any) -> None:
    assert stream is not None
    pickle.dump(what, stream)
    stream.flush()


def _received(stream: IO[bytes] | None) -> Any:
    assert stream is not None
    return pickle.load(stream)


def main() -> None:
    """The process: a task comes first, then chunks of its rows."""
    answers = os.fdopen(os.dup(1), "wb")
    # What an FMU prints is no answer.
    os.dup2(2, 1)
    came: queue.SimpleQueue[Any] = queue.SimpleQueue()
    threading.Thread(target=_read, args=(came,), daemon=True).start()
    task = came.get()
    _send(answers, None)
    while True:
        try:
            chunk: Chunk = came.get(timeout=IDLE_S)
        except queue.Empty:
            work.close()
            # The thread that reads holds the input: Python could not end in order.
            os._exit(0)
        answer: Any
        try:
            answer = run_chunk(task, chunk)
        except Exception as error:
            answer = error
        _send(answers, answer)


def _read(came: "queue.SimpleQueue[Any]") -> None:
    try:
        while True:
            came.put(_received(sys.stdin.buffer))
    except (EOFError, OSError):
        # The worker is gone, or has enough: what the process is at is of no use.
        os._exit(0)
