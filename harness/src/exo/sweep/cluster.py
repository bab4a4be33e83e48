"""A sweep on a cluster, by Dask: `--scheduler tcp://…`. Workers need exo and `distributed`; the FMUs come with rows.

A worker that is lost loses its chunks to others: Dask sends them again. A scheduler that is lost loses everything that
was under way: when it is there again, the rows that are not kept are sent anew.
"""

import time
from collections.abc import Iterator, Mapping
from importlib import metadata
from typing import Any

from exo.errors import ExoError
from exo.sweep.chunks import Queue
from exo.sweep.local import Kept
from exo.sweep.work import Chunk, Task, run_chunk

#: How long a scheduler may be away (s), and between two looks.
PATIENCE_S, LOOK_S = 60.0, 1.0
#: Chunks of a worker's thread that wait at the cluster.
AHEAD = 2
VERSION = metadata.version("exo")


def run(task: Task, queue: Queue, *, scheduler: str, archives: Mapping[str, bytes]) -> Iterator[Kept]:
    """Runs all rows of the queue; yields what each chunk has come to. ExoError, if there is no scheduler."""
    lost_at: float | None = None
    while len(queue):
        running: dict[Any, Chunk] = {}
        try:
            with _client(scheduler) as client:
                _check(client, scheduler)
                for kept in _all(client, task, queue, running, archives):
                    lost_at = None
                    yield kept
        except ExoError:
            raise
        except _lost() as error:
            for chunk in running.values():
                queue.wait_again(chunk)
            lost_at = lost_at or time.monotonic()
            if time.monotonic() - lost_at > PATIENCE_S:
                told = " ".join(str(error).split()) or type(error).__name__
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
        raise ExoError("--scheduler needs Dask: pip install 'exo[cluster]', or distributed") from error
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
        return distributed.Client(scheduler, timeout=10, set_as_default=False)
    except (ValueError, TypeError, AssertionError) as error:
        said = str(error) or "no address"
        raise ExoError(f"--scheduler {scheduler}: {said}; expected an address as tcp://10.0.0.1:8786") from error


def _check(client: Any, scheduler: str) -> None:
    """ExoError, if a worker has another exo, or none: it would end with each row that it gets."""

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


def _all(
    client: Any, task: Task, queue: Queue, running: dict[Any, Chunk], archives: Mapping[str, bytes]
) -> Iterator[Kept]:
    distributed = _dask()
    sent = client.scatter(dict(archives), broadcast=True, hash=False)
    ended = distributed.as_completed(loop=client.loop)
    while len(queue) or running:
        threads = max(1, sum(client.nthreads().values()))
        while len(queue) and len(running) < AHEAD * threads:
            chunk = queue.next()
            try:
                future = client.submit(run_chunk, task, list(chunk), sent, pure=False, retries=3)
            except BaseException:
                queue.wait_again(chunk)
                raise
            running[future] = chunk
            ended.add(future)
        future = next(ended)
        names, done = future.result()
        del running[future]
        queue.learn(done)
        yield names, done
