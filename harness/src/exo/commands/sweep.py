"""`exo sweep`."""

from pathlib import Path
from typing import Annotated

import typer

from exo import loop, sweep
from exo.commands.options import FmuDir, progress_bar
from exo.screen import console, sentences


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
    with sentences(), progress_bar() as progress:
        task = progress.add_task(Path(study).stem, total=None)
        done = sweep.sweep(
            study,
            out=out,
            workers=workers,
            scheduler=scheduler,
            engine=loop.named(engine) if engine is not None else None,
            fmu_dir=fmu_dir,
            fresh=fresh,
            tell=lambda far: progress.update(task, completed=far.done, total=far.all),
        )
        failed = f", {done.failed} of them failed: column failure says why" if done.failed else ""
        console.print(f"{done.folder / 'runs.parquet'}: {done.table.num_rows} runs{failed}", markup=False)
        for path in done.pictures:
            console.print(str(path), markup=False)
