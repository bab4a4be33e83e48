"""`exo export`."""

from fnmatch import fnmatchcase
from pathlib import Path
from typing import Annotated

import pyarrow as pa
import typer

from exo import export
from exo.api.run import read_run
from exo.errors import ExoError, close_matches
from exo.export import text
from exo.folder import signal_files
from exo.screen import console, sentences


def export_run(
    run: Annotated[Path, typer.Argument(metavar="RUN", help="A scenario's folder of results, or one Parquet file.")],
    *,
    form: Annotated[str, typer.Option("--format", metavar="csv|mdf4|matlab", help="What is written.")] = "csv",
    cases: Annotated[
        list[str] | None, typer.Option("--case", metavar="CASE", help="Only cases of this id or pattern.")
    ] = None,
    signals: Annotated[
        list[str] | None,
        typer.Option("--signal", metavar="NAME", help="Only signals of this name or pattern, as 'plant.*'."),
    ] = None,
    every: Annotated[int, typer.Option("--every", metavar="N", help="Only each Nth row, from the first one on.")] = 1,
    excel: Annotated[
        bool, typer.Option("--excel", help="CSV that Excel opens by a double click, in the system's language.")
    ] = False,
    decimal: Annotated[
        str | None, typer.Option("--decimal", metavar="point|comma", help="With comma, cells are separated by ;")
    ] = None,
    overwrite: Annotated[bool, typer.Option("--overwrite", help="Replaces files that are there.")] = False,
    out: Annotated[Path | None, typer.Option("--out", help="Folder; else export/<scenario>.")] = None,
) -> None:
    """Writes the signals of a run for other programs, a file for each case."""
    with sentences():
        ending = export.ending(form)
        if form != "csv" and (excel or decimal is not None):
            raise ExoError(f"--format {form}: has no --excel and no --decimal; expected them with csv")
        if every < 1:
            raise ExoError(f"--every {every}: expected 1 or more")
        separators = text.separators(excel=excel, decimal=decimal)
        files = _files(run, cases or [])
        folder = out if out is not None else Path("export") / (run.stem if run.is_file() else run.resolve().name)
        for case in files:
            target = folder / f"{case}{ending}"
            if target.exists() and not overwrite:
                raise ExoError(f"{target}: is there already; expected another --out, or --overwrite")
        for case, file in files.items():
            table = read_run(file).table(*(signals or ()))
            thinned = table.take(pa.array(range(0, table.num_rows, every))) if every > 1 else table
            path = export.write(thinned, folder / f"{case}{ending}", separators=separators)
            console.print(f"{path}  {path.stat().st_size // 1000} kB", markup=False)


def _files(run: Path, patterns: list[str]) -> dict[str, Path]:
    """The signals of the cases that match, by case."""
    if run.is_file():
        if patterns:
            raise ExoError(f"--case {patterns[0]}: {run} is one case; expected a folder of results, or no --case")
        return {run.stem: run}
    found = signal_files(run)
    for pattern in patterns:
        if not any(fnmatchcase(case, pattern) or case == pattern for case in found):
            raise ExoError(f"--case {pattern}: no such case of {run}{close_matches(pattern, found)}")
    return {
        case: file
        for case, file in found.items()
        if not patterns or any(fnmatchcase(case, pattern) or case == pattern for pattern in patterns)
    }
