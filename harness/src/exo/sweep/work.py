"""What a process does with rows: it opens the scenario once, then runs chunks of them."""

import hashlib
import threading
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from time import perf_counter

from exo import trial
from exo.errors import ExoError
from exo.loop import Engine
from exo.runs import Batch
from exo.scenario import Scenario, Value
from exo.sweep.store import Done

Chunk = Sequence[tuple[int, Mapping[str, Value]]]
#: Names of the numbers, and rows that have run.
Kept = tuple[list[str], list[Done]]
ENDED = "its process was ended twice; expected an FMU that returns, and enough memory for its run"


@dataclass(frozen=True)
class Task:
    """What all rows have in common."""

    #: Of this sweep alone.
    id: str
    scenario: Scenario
    cases: tuple[str, ...]
    metrics: tuple[str, ...]
    branch_at: float | None
    engine: Engine | None
    #: Where the archives lie; None: they come with each chunk.
    fmu_dir: Path | None
    #: SHA-256 of the archives by name, as they were when the sweep began.
    checksums: Mapping[str, str]
    #: Whether the sweep has tried their libraries on this machine.
    tried: bool


#: The scenario that this thread has open.
_OPEN = threading.local()


def run_chunk(task: Task, chunk: Chunk) -> Kept:
    """Runs rows; returns the numbers' names and what became of each row. ExoError, if the scenario does not open."""
    runs = _opened(task)
    done = []
    for number, row in chunk:
        began = perf_counter()
        outcome = runs.run(row)
        done.append(Done(number, outcome, perf_counter() - began))
    return runs.names, done


def _opened(task: Task) -> Batch:
    if getattr(_OPEN, "id", None) == task.id:
        return _OPEN.runs  # type: ignore[no-any-return]
    close()
    _check_archives(task)
    runs = Batch(
        task.scenario,
        cases=task.cases,
        metrics=task.metrics,
        branch_at=task.branch_at,
        engine=task.engine,
        fmu_dir=task.fmu_dir,
    )
    _OPEN.runs, _OPEN.id = runs.__enter__(), task.id
    return runs


def _check_archives(task: Task) -> None:
    """ExoError, if an archive is another one than at the beginning: a worker that begins later would mix their rows."""
    if task.fmu_dir is None:
        return
    for name, checksum in task.checksums.items():
        path = task.fmu_dir / name
        try:
            there = hashlib.sha256(path.read_bytes()).hexdigest()
        except OSError as error:
            raise ExoError(f"{path}: {error.strerror or error}; expected the FMU with which the sweep began") from error
        if there != checksum:
            raise ExoError(
                f"{path}: has changed since the sweep began; expected the same FMU, or --fresh with this one"
            )
        if task.tried:
            trial.passed(path)


def close() -> None:
    """Frees what this thread has open."""
    if getattr(_OPEN, "id", None) is not None:
        _OPEN.id = None
        _OPEN.runs.__exit__(None, None, None)
