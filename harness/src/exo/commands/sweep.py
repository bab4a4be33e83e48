"""`exo sweep`."""

from pathlib import Path
from time import perf_counter
from typing import Annotated

import typer
from rich.progress import TextColumn, TimeRemainingColumn

from exo import loop, sweep
from exo.commands.options import FmuDir, progress_bar
from exo.screen import console, errors, sentences
from exo.sweep import Progress

#: Between two lines of a sweep that goes into a log (s).
EVERY_S = 30.0


def run_sweep(
    study: Annotated[
        str, typer.Argument(help=f"A study: {', '.join(sweep.built_in())}, or a .toml file that says what varies.")
    ],
    *,
    workers: Annotated[int | None, typer.Option(help="Processes; else one for each processor.")] = None,
    scheduler: Annotated[
        str | None, typer.Option(metavar="ADDRESS", help="A Dask cluster in their place, as tcp://10.0.0.1:8786.")
    ] = None,
    engine: Annotated[
        str | None, typer.Option("--engine", metavar="fmpy|native", help="Else native, where it is installed.")
    ] = None,
    fresh: Annotated[bool, typer.Option("--fresh", help="Forgets what an earlier sweep has left.")] = False,
    out: Annotated[Path, typer.Option("--out", help="Folder for the results.")] = Path("results/sweeps"),
    fmu_dir: FmuDir = None,
) -> None:
    """Runs a study's rows, on all processors or a cluster; goes on where an earlier sweep was stopped."""
    name = Path(study).stem
    with sentences(), progress_bar(TextColumn("left"), TimeRemainingColumn()) as progress:
        task = progress.add_task(name, total=None)
        line = Line(name)

        def tell(far: Progress) -> None:
            progress.update(task, completed=far.done, total=far.all)
            if not console.is_terminal and (said := line.of(far, perf_counter())):
                errors.print(said, markup=False)

        done = sweep.sweep(
            study,
            out=out,
            workers=workers,
            scheduler=scheduler,
            engine=loop.named(engine) if engine is not None else None,
            fmu_dir=fmu_dir,
            fresh=fresh,
            tell=tell,
        )
        failed = (
            f", {done.failed} of them failed, see column failure; the first: {done.reasons[0]}" if done.failed else ""
        )
        console.print(f"{done.folder / 'runs.parquet'}: {done.table.num_rows} runs{failed}", markup=False)
        for path in done.pictures:
            console.print(str(path), markup=False)
    raise typer.Exit(1 if done.failed == done.table.num_rows else 0)


class Line:
    """How far a sweep is, for a log: now and then a line."""

    def __init__(self, name: str) -> None:
        self._name = name
        self._began: tuple[float, int] | None = None
        self._told = 0.0

    def of(self, far: Progress, now: float) -> str:
        """The line, where it is time for one, else nothing; `now` in s."""
        if self._began is None or self._began[1] == far.kept_before:
            # From the first rows on: before them workers began.
            self._began = now, far.done
            self._told = self._told or now
        began, before = self._began
        if now - self._told < EVERY_S or far.done in (before, far.all):
            return ""
        self._told = now
        left = (now - began) / (far.done - before) * (far.all - far.done)
        failed = f", {far.failed} of them failed" if far.failed else ""
        return f"{self._name}: {far.done} of {far.all} runs{failed}; about {_time(left)} left"


def _time(seconds: float) -> str:
    return f"{seconds:.0f} s" if seconds < 100.0 else f"{seconds / 60.0:.0f} min"
