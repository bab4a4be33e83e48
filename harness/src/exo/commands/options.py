"""Options and texts that several commands take, and how far a long one is."""

from pathlib import Path
from typing import Annotated

import typer
from rich.progress import BarColumn, MofNCompleteColumn, Progress, ProgressColumn, TextColumn, TimeElapsedColumn

from exo.errors import ScenarioError
from exo.screen import console

Out = Annotated[Path, typer.Option("--out", help="Folder for the results.")]
FmuDir = Annotated[
    Path | None, typer.Option("--fmu-dir", help="Folder of the archives; else $EXO_FMU_DIR or target/fmu.")
]
Signals = Annotated[
    str, typer.Option(metavar="all|none|SCENARIO,…", help="Whose signals are written, every tick as Parquet.")
]
EngineOption = Annotated[
    str, typer.Option("--engine", metavar="fmpy|native", help="What makes the steps: the numbers are equal.")
]
Csv = Annotated[bool, typer.Option("--csv", help="Write signals and the figures' data as CSV, too.")]
AsJson = Annotated[bool, typer.Option("--json", help="As JSON.")]


def parse_settings(settings: list[str]) -> dict[str, str]:
    """`name=value` texts as a dictionary."""
    parsed = {}
    for text in settings:
        name, equals, value = text.partition("=")
        if not equals or not name.strip() or not value.strip():
            raise ScenarioError(f"--set {text}: expected <component>.<parameter>=<value>")
        parsed[name.strip()] = value.strip()
    return parsed


def progress_bar(*more: ProgressColumn) -> Progress:
    """How far a long command is; nothing where no one watches."""
    columns = (TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), TimeElapsedColumn())
    return Progress(*columns, *more, console=console, transient=True, disable=not console.is_terminal)
