"""`exo ssp`."""

from contextlib import ExitStack
from pathlib import Path
from typing import Annotated

import typer

from exo.commands.options import FmuDir
from exo.fmu import Archive, find_fmu_dir
from exo.screen import console, sentences
from exo.systems import closed, container, form, ssp
from exo.systems import system as systems
from exo.systems.system import RECIPES


def write_ssp(
    out: Annotated[Path, typer.Option("--out", help="Folder for the archives.")] = Path("target/ssp"),
    fmu_dir: FmuDir = None,
    bound: Annotated[
        list[str] | None,
        typer.Option(
            "--set", help="Parameter set that the SSP archives bind, as wall-standard_10_0.5; may be repeated."
        ),
    ] = None,
    inline: Annotated[
        bool, typer.Option("--inline", help="Parameter values inside the descriptions, no files.")
    ] = False,
    fmi3_dir: Annotated[
        Path | None, typer.Option("--fmi3-dir", help="Folder of FMI 3.0 archives; else fmi3 in that of the others.")
    ] = None,
) -> None:
    """Writes the coupled systems: SSP 1.0; in ssp2 SSP 2.0, with a variant for each parameter set; containers."""
    with sentences(), ExitStack() as stack:
        folder = find_fmu_dir(fmu_dir)
        defaults = systems.defaults(bound or ())
        for name in RECIPES:
            system = systems.load(name, default=defaults.get(name))
            alone = closed.load(name, default=defaults.get(name))
            files = sorted({*system.components.values(), *alone.components.values()})
            archives = {file: stack.enter_context(Archive(folder / file)) for file in files}
            forms = form.forms(out, files, twins=fmi3_dir, default_twins=folder / "fmi3", inline=inline)
            written = [
                ssp.write(system=one, archives=archives, folder=place, form=how)
                for place, how in forms.items()
                for one in (system, alone)
            ]
            for path in (*written, container.write(system=system, archives=archives, folder=out)):
                console.print(f"{path}  {path.stat().st_size // 1000} kB", markup=False)
