"""Runs an FMU's library through one step in a process of its own, before it is loaded into this one.

A library that is cut, or that ends its process, would take the harness and its results with it.
"""

from math import isfinite
from pathlib import Path
from typing import Any

from exo.errors import FmuError
from exo.fmu import Archive
from exo.validate import child
from exo.validate.rule import printable

#: Each is told before it is made: an instance is freed, or, of a wrong guid, refused.
LAST_CALLS = ("fmi2FreeInstance", "fmi2Instantiate")
#: What happened, by path, time of change and size: a file is tried once.
_ENDED: dict[tuple[str, int, int], str] = {}


def check(archive: Archive) -> None:
    """FmuError, if the library of the opened archive ends a process or does not answer.

    Its status codes are no matter here: the run that follows tells them.
    """
    key = _key(archive.path)
    if key not in _ENDED:
        _ENDED[key] = _ended(child.run(_task(archive)), folder=archive.folder)
    if _ENDED[key]:
        raise FmuError(f"{archive.path}: tried in a process of its own, its library {_ENDED[key]}")


def passed(path: Path) -> None:
    """An archive that another process of this machine has tried; `check` does not try it again.

    OSError, if it is gone.
    """
    _ENDED[_key(path)] = ""


def _key(path: Path) -> tuple[str, int, int]:
    status = path.stat()
    return str(path.resolve()), status.st_mtime_ns, status.st_size


def _ended(answer: child.Answer, *, folder: str) -> str:
    """How and where it ended before its time; empty when it did not."""
    if refused := answer.facts("refused"):
        return f"cannot be loaded: {printable(str(refused[0]).replace(f'{folder}/', ''))}"
    whole = bool(answer.facts("instantiated")) and answer.last_call in LAST_CALLS
    if not answer.ended and whole:
        return ""
    said = answer.output.strip().splitlines()
    # A process that came to an exit code has said why: a library that cannot be loaded, a function that is missing.
    why = f": {printable(said[-1].replace(f'{folder}/', ''))}" if said and "exit code" in answer.ended else ""
    return f"{answer.ended or 'ended with exit code 0'} in {answer.last_call}{why}"


def _task(archive: Archive) -> dict[str, Any]:
    experiment = archive.description.defaultExperiment
    step = _number(experiment.stepSize if experiment else None)
    return {
        "task": "load",
        "library": str(archive.library),
        "guid": str(archive.description.guid),
        "resources": (Path(archive.folder) / "resources").as_uri(),
        "start": _number(experiment.startTime if experiment else None),
        "step": step if 0.0 < step < 1e6 else 1e-3,
        "exact": [],
        "all": [],
    }


def _number(text: object) -> float:
    try:
        value = float(str(text))
    except ValueError:
        return 0.0
    return value if isfinite(value) else 0.0
