"""`exo references`, `exo record`."""

import json
from contextlib import ExitStack
from pathlib import Path
from typing import Annotated

import typer

from exo import screen
from exo.commands.options import AsJson, FmuDir
from exo.errors import FmuError
from exo.fmu import Archive, find_fmu_dir
from exo.references import replay
from exo.references import write as references
from exo.screen import console, sentences


def replay_references(
    fmus: Annotated[list[Path], typer.Argument(metavar="FMU…", help="FMI 2.0 or 3.0, with co-simulation.")],
    *,
    as_json: AsJson = False,
) -> None:
    """Replays the experiments that FMUs carry (FMI-LS-REF); exit code 1 when an output differs by too much."""
    with sentences():
        for path in fmus:
            if not path.is_file():
                raise FmuError(f"{path}: no such FMU")
        answers = [(path, replay.replay(path)) for path in fmus]
    if as_json:
        told = [{"fmu": str(path)} | answer.as_json() for path, answer in answers]
        typer.echo(json.dumps(told, indent=2, ensure_ascii=False))
    else:
        for path, answer in answers:
            screen.print_replay(path, answer)
    raise typer.Exit(1 if any(answer.failed for _, answer in answers) else 0)


def record_references(
    folder: Annotated[Path, typer.Argument(help="Has a folder for each FMU.")] = Path("modelDescription/references"),
    *,
    bless: Annotated[
        bool, typer.Option("--bless", help="Rewrites what differs, so that it is a diff to read.")
    ] = False,
    fmu_dir: FmuDir = None,
) -> None:
    """Records the references of this project's FMUs; without --bless, exit code 1 where the folder has others."""
    with sentences(), ExitStack() as stack:
        built = find_fmu_dir(fmu_dir)
        archives = {name: stack.enter_context(Archive(built / name)) for name in references.needed()}
        files = references.contents(archives)
        changed = references.write(files, folder) if bless else references.differences(files, folder)
    for name in changed:
        said = "written" if bless else "out of date: `cargo xtask references --bless`, then read the diff"
        console.print(f"{folder / name}: {said}", markup=False)
    console.print(f"{len(files)} files, {sum(map(len, files.values())) // 1000} kB", markup=False)
    raise typer.Exit(1 if changed and not bless else 0)
