"""Loads a library and runs one instance through one step."""

import ctypes
from typing import Any

from exo.probe.fmi2 import Library2
from exo.probe.fmi3 import Library3
from exo.probe.library import Library, Tell, Variable

#: Values of variables in one fact. Those that were read before a crash are lost.
TOLD_AT_ONCE = 1000
#: A guid that no FMU has.
OTHER_GUID = b"{00000000-0000-0000-0000-00000000e0e0}"


def opened(task: dict[str, Any], tell: Tell) -> Library | None:
    """The library of the task's version, None when the system refuses it, which is a fact."""
    try:
        library = ctypes.CDLL(task["library"])
    except OSError as problem:
        tell({"refused": str(problem)})
        return None
    return (Library3 if task.get("version") == "3.0" else Library2)(library, tell, task)


def load(task: dict[str, Any], tell: Tell) -> None:
    """Instantiates, initialises, reads, steps, reads again and frees."""
    fmu = opened(task, tell)
    if fmu is None:
        return
    tell({"version": fmu.text("GetVersion")})
    if fmu.prefix == "fmi2":
        tell({"types": fmu.text("GetTypesPlatform")})
    instance = fmu.instantiate()
    tell({"instantiated": instance is not None})
    if instance is None:
        return
    fmu.enter(instance, task["start"])
    _read_all(fmu, instance, "exact", task["exact"])
    fmu.exit(instance)
    _read_all(fmu, instance, "initialized", task["all"])
    fmu.step(instance, task["start"], task["step"])
    _read_all(fmu, instance, "stepped", task["all"])
    fmu.terminate(instance)
    fmu.free(instance)
    other = fmu.instantiate(OTHER_GUID)
    tell({"other guid accepted": other is not None})
    if other is not None:
        fmu.free(other)


def _read_all(fmu: Library, instance: ctypes.c_void_p, fact: str, variables: list[list[Any]]) -> None:
    """Reads variables one by one and tells index and value of many at a time: writing takes longer than reading."""
    for first in range(0, len(variables), TOLD_AT_ONCE):
        part = [Variable(*given) for given in variables[first : first + TOLD_AT_ONCE]]
        fmu.tell({fact: [[variable.index, fmu.read(instance, variable)] for variable in part]})
