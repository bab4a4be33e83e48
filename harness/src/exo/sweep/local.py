"""A sweep on the processors of this machine: a process each. An FMU that ends its process costs its own row only."""

import multiprocessing
import os
import signal
import sys
import threading
from collections.abc import Iterator
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager, suppress
from types import ModuleType
from typing import Any

from exo import extraction
from exo.errors import ExoError
from exo.runs import Outcome
from exo.sweep.chunks import Queue
from exo.sweep.store import Done
from exo.sweep.work import ENDED, Chunk, Kept, Task, run_chunk

#: How often workers may fail to begin before a sweep gives up.
BEGINNINGS = 3
#: How long a worker that was killed may take to be gone (s).
GONE_S = 2.0
MAIN = "__main__"
#: Processes that a pool may have: Windows waits for no more at once; elsewhere more than these only take memory.
MOST = 61 if os.name == "nt" else max(64, 4 * (os.cpu_count() or 1))


def processors() -> int:
    """How many this process may use, and a pool may have."""
    here = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
    return min(here, MOST)


def run(task: Task, queue: Queue, *, workers: int) -> Iterator[Kept]:
    """Runs all rows of the queue; yields what each chunk has come to. ExoError, if no worker begins."""
    names: list[str] = []
    while len(queue):
        with _pool(workers, begin=1 if queue.alone else min(workers, len(queue))) as pool:
            running: dict[Future[Kept], Chunk] = {}
            try:
                for kept in _until_broken(pool, task, queue, running, workers):
                    names = kept[0]
                    yield kept
            except BrokenProcessPool:
                lost = queue.give_back(list(running.values()))
                if lost:
                    yield names, [Done(i, Outcome({}, ENDED), 0.0) for i in lost]
            finally:
                for future in running:
                    future.cancel()
                _end(pool)
        # Of the workers, which have not closed what they had open.
        extraction.sweep()


def _pool(workers: int, *, begin: int) -> ProcessPoolExecutor:
    """A pool of which `begin` workers have begun. ExoError, if they do not, however often."""
    told = ""
    for _ in range(BEGINNINGS):
        # A forked process would have this one's threads' locks.
        with _spawning():
            pool = ProcessPoolExecutor(workers, mp_context=multiprocessing.get_context("spawn"), initializer=_begin)
        try:
            # What is sent makes the processes: one each while none is idle. So all of them begin side by side.
            with _spawning():
                begun = [pool.submit(processors) for _ in range(begin)]
            for one in begun:
                one.result()
        except (BrokenProcessPool, OSError) as error:
            # One may have been killed as it began. The pool's own thread has ended when this returns.
            pool.shutdown(wait=True, cancel_futures=True)
            told = " ".join(str(error).split())
        except BaseException:
            _end(pool)
            raise
        else:
            return pool
    raise ExoError(f"--workers {workers}: no process begins: {told}; expected fewer, or more memory")


@contextmanager
def _spawning() -> Iterator[None]:
    """Of what begins meanwhile.

    The script that calls is hidden: a new process would run it again, with its sweep, where no `__main__` guards it.
    A terminal that closes is for this process to hear: the others, multiprocessing's tracker too, end with it.
    """
    script = sys.modules[MAIN]
    sys.modules[MAIN] = ModuleType(MAIN)
    masked = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGHUP}) if hasattr(signal, "pthread_sigmask") else None
    try:
        yield
    finally:
        if masked is not None:
            signal.pthread_sigmask(signal.SIG_SETMASK, masked)
        sys.modules[MAIN] = script


def _begin() -> None:
    # Ctrl-C goes to all processes of a terminal; the first one decides.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    threading.Thread(target=_end_with_parent, daemon=True).start()


def _end_with_parent() -> None:
    """A first process that is killed cannot end its workers."""
    parent = multiprocessing.parent_process()
    if parent is not None:
        parent.join()
        os._exit(1)


def _until_broken(
    pool: ProcessPoolExecutor, task: Task, queue: Queue, running: dict[Future[Kept], Chunk], workers: int
) -> Iterator[Kept]:
    while len(queue) or running:
        _fill(pool, task, queue, running, workers)
        ended, _ = wait(running, return_when=FIRST_COMPLETED)
        for future in ended:
            names, done = future.result()
            del running[future]
            queue.learn(done)
            # Before the rows are kept: no worker waits for that. A pool that is broken is told when they are.
            with suppress(BrokenProcessPool):
                _fill(pool, task, queue, running, workers)
            yield names, done


def _fill(
    pool: ProcessPoolExecutor, task: Task, queue: Queue, running: dict[Future[Kept], Chunk], workers: int
) -> None:
    """Sends chunks until each worker has one and another one waits."""
    while queue.admits(len(running), most=workers + 1):
        chunk = queue.next(among=workers)
        try:
            # This, too, may make a process.
            with _spawning():
                running[pool.submit(run_chunk, task, chunk)] = chunk
        except BrokenProcessPool:
            queue.wait_again(chunk)
            raise


def _end(pool: ProcessPoolExecutor) -> None:
    """Ends the workers now: what they are at is run again."""
    processes: dict[int, Any] = dict(getattr(pool, "_processes", None) or {})
    pool.shutdown(wait=False, cancel_futures=True)
    for process in processes.values():
        # Not SIGTERM, which an FMU may block: what is open is removed below.
        process.kill()
    # Their folders can be removed once they are gone.
    for process in processes.values():
        process.join(GONE_S)
