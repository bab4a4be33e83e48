"""Sweeps: a study's rows on all processors or a cluster, into one table and its pictures.

| module | what |
|---|---|
| `study` | the study as data: axes, samples, figures |
| `store` | the folder: parts, resumption, the table |
| `chunks` | which rows go to a worker at once |
| `work` | what a process does with rows |
| `local`, `cluster` | processes of this machine, and Dask |
| `apart` | a process beside each of the cluster's workers |
| `pictures` | maps, scatters, histograms, fronts |
"""

import hashlib
import uuid
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

import pyarrow as pa

from exo.errors import ExoError
from exo.fmu import find_fmu_dir
from exo.loop import Engine
from exo.runs import FAILURE, Batch
from exo.sweep import cluster, local
from exo.sweep.chunks import Queue
from exo.sweep.store import ROW, SECONDS, TABLE, Store
from exo.sweep.study import Study, built_in, check_figures, load
from exo.sweep.work import Kept, Task

__all__ = ["Progress", "Study", "Swept", "built_in", "load", "sweep"]


@dataclass(frozen=True)
class Progress:
    """How far a sweep is: rows of this run, and rows that an earlier one has left."""

    done: int
    all: int
    kept_before: int
    failed: int


@dataclass(frozen=True)
class Swept:
    """What a sweep has left."""

    folder: Path
    table: pa.Table
    pictures: tuple[Path, ...]

    @property
    def failed(self) -> int:
        """Rows without numbers."""
        return len(self.reasons)

    @property
    def reasons(self) -> list[str]:
        """Why rows have no numbers, in the rows' order."""
        return [str(reason) for reason in self.table[FAILURE].drop_null().to_pylist()]


def sweep(
    name: str | Path,
    *,
    out: Path = Path("results/sweeps"),
    workers: int | None = None,
    scheduler: str | None = None,
    engine: Engine | None = None,
    fmu_dir: Path | None = None,
    fresh: bool = False,
    tell: Callable[[Progress], None] = lambda _progress: None,
) -> Swept:
    """Runs a study, by id or file, or what is left of it; returns the table and the pictures that were drawn.

    `workers` are processes of this machine, all of it without; `scheduler` is the address of a Dask cluster in their
    place. `fresh` forgets what an earlier sweep has left. `tell` is told after each chunk of rows.
    ExoError names what is wrong with study, folder or cluster; a row that fails is a row with its reason.
    """
    study, scenario = load(name)
    rows = study.rows()
    folder = find_fmu_dir(fmu_dir)
    names = sorted({part.archive for part in scenario.components.values()})
    if workers is not None and not 1 <= workers <= local.MOST:
        raise ExoError(f"--workers {workers}: expected 1 to {local.MOST}")
    if workers is not None and scheduler is not None:
        raise ExoError(
            f"--workers {workers}, --scheduler {scheduler}: expected one of them: a cluster has its own workers"
        )
    # Opened here once, so that what is wrong with all rows is told before a worker begins.
    with Batch(
        scenario, cases=study.cases, metrics=study.metrics, branch_at=study.branch_at, engine=engine, fmu_dir=folder
    ) as runs:
        runs.check(rows[:1])
        taken = {ROW, FAILURE, SECONDS, *rows[0]} & set(runs.names)
        if taken:
            raise ExoError(
                f"{study.id}: a metric is called {', '.join(sorted(taken))}, as another column of the results"
            )
        check_figures(study, [ROW, *rows[0], *runs.names, SECONDS])
    archives = {name: (folder / name).read_bytes() for name in names}
    checksums = {name: hashlib.sha256(data).hexdigest() for name, data in archives.items()}
    with Store(out, study, scenario, rows, checksums, fresh=fresh) as store:
        before = store.done()
        queue = Queue(rows, before)
        task = Task(
            id=uuid.uuid4().hex,
            scenario=scenario,
            cases=study.cases,
            metrics=study.metrics,
            branch_at=study.branch_at,
            engine=engine,
            fmu_dir=folder.resolve() if scheduler is None else None,
            checksums=checksums,
            tried=scheduler is None,
        )
        chunks: Iterator[Kept]
        if scheduler is not None:
            chunks = cluster.run(task, queue, scheduler=scheduler, archives=archives)
        else:
            chunks = local.run(task, queue, workers=workers or local.processors())
        finished, failed = len(before), 0
        tell(Progress(finished, len(rows), len(before), failed))
        for measured, done in chunks:
            store.keep(done, measured or runs.names)
            finished += len(done)
            failed += sum(one.outcome.error is not None for one in done)
            tell(Progress(finished, len(rows), len(before), failed))
        table = store.finish()
        # Not above: the workers would wait for it.
        from exo.sweep import pictures  # noqa: PLC0415

        drawn, wrong = [], []
        reasons = table[FAILURE].drop_null()
        for figure in study.figures:
            try:
                drawn.append(pictures.draw(figure, study, table, store.folder))
            except ExoError as error:
                why = f"; {len(reasons)} of {table.num_rows} failed, the first: {reasons[0]}" if len(reasons) else ""
                wrong.append(f"{error}{why}; the runs are in {store.folder / TABLE}")
    if wrong:
        raise ExoError("\n".join(wrong))
    return Swept(store.folder, table, tuple(drawn))
