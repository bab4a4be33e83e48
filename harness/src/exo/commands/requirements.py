"""`exo requirements`."""

import json
from functools import cache
from pathlib import Path
from typing import Annotated, Any

import typer

from exo import folder, metrics_file, screen
from exo import requirements as required
from exo.commands.options import AsJson
from exo.errors import ExoError
from exo.requirements import PREFIX, Requirements
from exo.screen import sentences


def list_requirements(
    file: Annotated[
        Path | None, typer.Argument(help="A file of requirements; without it those of the project.")
    ] = None,
    *,
    results: Annotated[
        Path | None, typer.Option(help="Folder of results whose margins are shown; else results.")
    ] = None,
    as_json: AsJson = False,
) -> None:
    """Lists requirements, formulas and the smallest margins in the results; exit code 1 when one is broken."""
    with sentences():
        if results is not None and not results.is_dir():
            raise ExoError(f"--results {results}: no such folder; expected one that exo run has left")
        results = results or Path("results")
        data = required.built_in() if file is None else required.load(file)
        if file is not None:
            required.check(data, file, done=[one.parent.name for one in results.glob(f"*/{folder.METRICS}")])
        rows = list(_rows(data, results))
        if as_json:
            typer.echo(json.dumps(rows, indent=2, ensure_ascii=False))
        else:
            _print(data, rows)
    raise typer.Exit(1 if any(row["verdict"] == "fail" for row in rows) else 0)


def _print(data: Requirements, rows: list[dict[str, Any]]) -> None:
    for name, one in data.requirements.items():
        screen.console.print(f"[bold]{name}[/] ", end="")
        screen.console.print(f"{one.text} ({one.source})", markup=False)
        table = screen.table("", "scenario", "formula", "smallest margin", "unit", "in")
        for row in rows:
            if row["id"].partition(".")[0] == name:
                margin = "–" if row["verdict"] is None else screen.number(row["margin"])
                cells = (
                    f"  {row['verdict'] or 'not run'}",
                    row["scenario"],
                    row["formula"],
                    margin,
                    row["unit"],
                    row["case"],
                )
                screen.add(table, *cells)
        screen.print_table(table)


def _rows(data: Requirements, results: Path) -> Any:
    numbers = cache(_numbers)
    for name, requirement in data.requirements.items():
        for key, shown in requirement.shown.items():
            prefix = f"{PREFIX}{name}.{key}/"
            there = numbers(results / shown.scenario / folder.METRICS).items()
            every = {case: one for case, one in there if case.startswith(prefix)}
            # A margin of a formula that has been changed since is no margin of this one.
            found = {case: one for case, one in every.items() if one.get("because") == shown.formula}
            worst = min(found, key=lambda one: _badness(found[one])) if found else None
            yield {
                "id": f"{name}.{key}",
                "text": requirement.text,
                "source": requirement.source,
                "scenario": shown.scenario,
                "formula": shown.formula,
                "at": shown.at,
                "verdict": found[worst]["verdict"] if worst else None,
                "margin": found[worst]["value"] if worst else None,
                "unit": shown.unit,
                "case": worst.partition("/")[2] if worst else "",
            }


def _numbers(path: Path) -> dict[str, Any]:
    """The numbers of a scenario's metrics.json; nothing, where it has not run."""
    return metrics_file.numbers(path) if path.is_file() else {}


def _badness(result: dict[str, Any]) -> tuple[bool, float]:
    """Broken ones first; a margin that is undefined is smaller than all."""
    value = result["value"]
    return result["verdict"] != "fail", float("-inf") if value is None else float(value)
