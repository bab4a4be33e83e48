"""`exo report`: the page of the results that lie in a folder, without running anything."""

from pathlib import Path
from typing import Annotated

import typer

from exo import scenario
from exo.errors import ExoError, close_matches
from exo.folder import METRICS
from exo.report import write
from exo.screen import console, sentences


def report(
    names: Annotated[
        list[str] | None, typer.Argument(metavar="SCENARIO…", help="Ids of scenarios; else all with results in --out.")
    ] = None,
    *,
    against: Annotated[
        Path | None,
        typer.Option(help="Folder of earlier results to compare verdicts with; else those that the last run replaced."),
    ] = None,
    out: Annotated[Path, typer.Option("--out", help="Folder with the results; report.html is written there.")] = Path(
        "results"
    ),
) -> None:
    """Writes report.html from results that are there: one page to explore, which needs no network."""
    with sentences():
        path = write(out=out, scenarios=chosen(out, names or []), against=against)
        console.print(f"report: {path}", markup=False)


def chosen(out: Path, names: list[str]) -> list[str]:
    """The scenarios with results in `out`, those that come with the harness in its order; or `names` of them.

    ExoError: there are none, or not of this name.
    """
    if not out.is_dir():
        raise ExoError(f"--out {out}: no such folder; expected one with results of exo")
    found = sorted(path.parent.name for path in out.glob(f"[!.]*/{METRICS}"))
    if not found:
        raise ExoError(f"--out {out}: no results in it; expected what `exo run SCENARIO` leaves")
    for name in names:
        if name not in found:
            raise ExoError(f"{out / name}: no results of scenario {name}{close_matches(name, found)}")
    wanted = names or found
    known = list(scenario.built_in())
    return sorted(dict.fromkeys(wanted), key=lambda name: (name not in known, name))
