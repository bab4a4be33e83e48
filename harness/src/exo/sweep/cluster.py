"""A sweep on a cluster, by Dask: `--scheduler tcp://…`. Workers need exo and `distributed`; the FMUs come with rows.

A worker that is lost loses its chunks to others: Dask sends them again. A scheduler that is lost loses everything that
was under way: when it is there again, the rows that are not kept are sent anew.
"""

import asyncio
import queue as queue_of
import threading
import time
from collections import deque
from collections.abc import Iterator, Mapping
from importlib import metadata
from typing import Any

from exo.errors import ExoError
from exo.sweep.apart import run_chunk_apart
from exo.sweep.chunks import Queue
from exo.sweep.work import Chunk, Kept, Task

#: How long a scheduler that was there, or the last worker, may be away (s), and between two looks.
PATIENCE_S, LOOK_S = 60.0, 1.0
#: How long a scheduler may take to answer, and a first worker to come (s).
ANSWER_S = 7.0
#: Between two looks at what has ended (s): short beside a chunk.
POLL_S = 0.01
#: How often in a row the cluster may give chunks up whose workers were lost again and again.
GIVEN_UP = 5
#: Chunks of a worker's thread that wait at the cluster.
AHEAD = 2
VERSION = metadata.version("exo")


def run(task: Task, queue: Queue, *, scheduler: str, archives: Mapping[str, bytes]) -> Iterator[Kept]:
    """Runs all rows of the queue; yields what each chunk has come to. ExoError, if scheduler or workers are missing."""
    lost_at: float | None = None
    was_there = False
    while len(queue):
        running: dict[Any, Chunk] = {}
        try:
            with _client(scheduler) as client:
                _check(client, scheduler)
                was_there = True
                # Data of a task are made again where all workers that had them are lost; what is scattered is not.
                sent = client.submit(dict, dict(archives), pure=False)
                for kept in _all(client, task, queue, running, sent):
                    lost_at = None
                    yield kept
        except ExoError:
            raise
        except _lost() as error:
            told = " ".join(str(error).split()) or type(error).__name__
            if not was_there:
                raise ExoError(
                    f"--scheduler {scheduler}: no Dask scheduler answers there: {told}; "
                    "expected the address that `dask scheduler` prints"
                ) from error
            for chunk in running.values():
                queue.wait_again(chunk)
            lost_at = lost_at or time.monotonic()
            if time.monotonic() - lost_at > PATIENCE_S:
                raise ExoError(
                    f"--scheduler {scheduler}: lost: {told}; what was finished is kept, the same command goes on"
                ) from error
            time.sleep(LOOK_S)
        except Exception as error:  # of a worker: of another version, without exo
            told = " ".join(str(error).split())
            raise ExoError(
                f"--scheduler {scheduler}: a worker failed: {type(error).__name__}: {told}; "
                f"expected workers that have exo {VERSION}"
            ) from error


def _dask() -> Any:
    try:
        import distributed  # noqa: PLC0415
    except ImportError as error:
        raise ExoError("--scheduler needs Dask: expected `pip install distributed`") from error
    return distributed


def _lost() -> tuple[type[BaseException], ...]:
    distributed = _dask()
    return (
        OSError,
        TimeoutError,
        distributed.comm.CommClosedError,
        distributed.client.CancelledError,
        distributed.client.FutureCancelledError,
    )


def _client(scheduler: str) -> Any:
    distributed = _dask()
    try:
        _reach(scheduler)
        return distributed.Client(scheduler, timeout=ANSWER_S, set_as_default=False)
    except (ValueError, TypeError, AssertionError) as error:
        said = str(error) or "no address"
        raise ExoError(f"--scheduler {scheduler}: {said}; expected an address as tcp://10.0.0.1:8786") from error


def _reach(scheduler: str) -> None:
    """TimeoutError or OSError, if no scheduler shakes hands; ValueError, TypeError or AssertionError for what is no
    address. A `Client` waits for ever for a port that says nothing."""
    distributed, answers = _dask(), queue_of.SimpleQueue[BaseException | None]()

    async def shake() -> None:
        secrets = distributed.Security().get_connection_args("client")
        comm = await distributed.comm.connect(scheduler, timeout=ANSWER_S, **secrets)
        comm.abort()

    def ask() -> None:
        try:
            asyncio.run(shake())
            answers.put(None)
        except BaseException as error:
            answers.put(error)

    # In a thread that can be left behind.
    threading.Thread(target=ask, daemon=True).start()
    try:
        error = answers.get(timeout=ANSWER_S + LOOK_S)
    except queue_of.Empty:
        error = TimeoutError(f"silence for {ANSWER_S:g} s")
    if error is None:
        return
    if isinstance(error, (*_lost(), ValueError, TypeError, AssertionError)):
        raise error
    # Whatever another program's answer has been read as.
    raise OSError("what answers is another program") from error


def _check(client: Any, scheduler: str) -> None:
    """ExoError, if no worker comes, or one has another exo, or none: it would end with each row that it gets."""
    try:
        client.wait_for_workers(1, timeout=ANSWER_S)
    except TimeoutError as error:
        raise ExoError(
            f"--scheduler {scheduler}: has no worker; expected one or more, as `dask worker {scheduler}` begins"
        ) from error

    # A function within a function goes to the workers as code: they need no exo to run it.
    def version() -> str:
        from importlib import metadata  # noqa: PLC0415

        try:
            return metadata.version("exo")
        except metadata.PackageNotFoundError:
            return "none"

    for worker, has in client.run(version).items():
        if has != VERSION:
            raise ExoError(f"--scheduler {scheduler}: worker {worker}: exo: {has}; expected {VERSION}")


def _all(client: Any, task: Task, queue: Queue, running: dict[Any, Chunk], sent: Any) -> Iterator[Kept]:
    distributed, scheduler = _dask(), client.scheduler.address
    ended = distributed.as_completed(loop=client.loop)
    given_up = 0
    # Dask sends tasks where their data are, and to others when those have much to do: here all begin at once.
    begin = deque(AHEAD * _places(client.nthreads()))
    while len(queue) or running:
        threads = max(1, sum(client.nthreads().values()))
        while queue.admits(len(running), most=AHEAD * threads):
            chunk = queue.next(among=threads)
            wanted: dict[str, Any] = {"workers": [begin.popleft()], "allow_other_workers": True} if begin else {}
            try:
                future = client.submit(run_chunk_apart, task, list(chunk), sent, pure=False, retries=3, **wanted)
            except BaseException:
                queue.wait_again(chunk)
                raise
            running[future] = chunk
            ended.add(future)
        future = _next(client, scheduler, ended)
        try:
            names, done = future.result()
        except distributed.KilledWorker as error:
            given_up += 1
            if given_up > GIVEN_UP:
                raise ExoError(f"--scheduler {scheduler}: workers end again and again: {error}") from error
            queue.wait_again(running.pop(future))
            continue
        del running[future]
        given_up = 0
        queue.learn(done)
        yield names, done


def _places(threads: Mapping[str, int]) -> list[str]:
    """A worker for each of its threads; of each worker one, before any has two."""
    return [worker for i in range(max(threads.values(), default=0)) for worker, own in threads.items() if i < own]


def _next(client: Any, scheduler: str, ended: Any) -> Any:
    """The next chunk that has come to an end. ExoError, if no worker is left to run one."""
    looked = seen = time.monotonic()
    while not ended.has_ready():
        time.sleep(POLL_S)
        now = time.monotonic()
        if now - looked < LOOK_S:
            continue
        looked = now
        if client.nthreads():
            seen = now
        elif now - seen > PATIENCE_S:
            raise ExoError(
                f"--scheduler {scheduler}: no worker is left; what was finished is kept, the same command goes on "
                "where there are new ones"
            )
    return next(ended)
