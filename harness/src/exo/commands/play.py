"""`exo play`."""

import secrets
import shlex
import threading
import webbrowser
from pathlib import Path
from typing import Annotated

import typer

from exo import loop
from exo.commands.options import FmuDir
from exo.errors import ExoError
from exo.screen import console, sentences

#: They take the terminal, and know no scripts.
TEXT_BROWSERS = {"www-browser", "links", "elinks", "lynx", "w3m"}


def play(
    bench: Annotated[str, typer.Argument(metavar="testbed|arm", help="What is played with.")] = "testbed",
    *,
    port: Annotated[int, typer.Option(min=0, max=65535, help="Port of this machine; 0 takes a free one.")] = 0,
    browser: Annotated[bool, typer.Option("--browser/--no-browser", help="Opens the page in a browser.")] = True,
    engine: Annotated[
        str | None, typer.Option("--engine", metavar="fmpy|native", help="What makes the steps; else the faster one.")
    ] = None,
    out: Annotated[Path, typer.Option("--out", help="Folder for runs that are saved.")] = Path("played"),
    fmu_dir: FmuDir = None,
) -> None:
    """A page on which one pushes the handle with the mouse while the FMUs answer in real time; Ctrl-C ends it.

    The page is for this machine only, and for whoever knows its address.
    """
    with sentences():
        # A web server is not loaded for the other commands.
        from exo.fmu import find_fmu_dir  # noqa: PLC0415
        from exo.play import bench as benches  # noqa: PLC0415
        from exo.play import server  # noqa: PLC0415
        from exo.play.live import Live  # noqa: PLC0415

        chosen = benches.named(bench)
        stepped = loop.fastest() if engine is None else loop.named(engine)
        if out.exists() and not out.is_dir():
            raise ExoError(f"--out {out}: is no folder; expected a folder, or a name for a new one")
        with server.bind(port) as bound, Live(chosen, fmu_dir=find_fmu_dir(fmu_dir), engine=stepped) as live:
            live.begun()
            token = secrets.token_urlsafe(24)
            address = server.address(bound, token)
            console.print(f"{chosen.title}: {address}", markup=False)
            console.print(f"engine {stepped}; saved runs go to {out}; Ctrl-C ends it", markup=False)
            if browser:
                # Some return only when the browser is left.
                threading.Thread(target=_open, args=(address,), name="browser", daemon=True).start()
            server.serve(live, bound, token=token, out=out, run_options=_run_options(fmu_dir))


def _open(address: str) -> None:
    """Opens the address in a window; says so, where there is none to be had."""
    try:
        found = webbrowser.get()
        opened = Path(getattr(found, "name", "")).name not in TEXT_BROWSERS and found.open(address)
    except (webbrowser.Error, OSError):
        opened = False
    if not opened:
        console.print("no browser has opened; open the address yourself", markup=False)


def _run_options(fmu_dir: Path | None) -> str:
    return "" if fmu_dir is None else f" --fmu-dir {shlex.quote(str(fmu_dir))}"
