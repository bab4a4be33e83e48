"""What FMUs log, kept apart by instance."""

from collections import deque
from ctypes import byref
from itertools import count
from typing import Any

from fmpy import calloc, free
from fmpy.fmi2 import (
    fmi2CallbackAllocateMemoryTYPE,
    fmi2CallbackFreeMemoryTYPE,
    fmi2CallbackFunctions,
    fmi2CallbackLoggerTYPE,
)
from fmpy.logging import addLoggerProxy

#: Where the messages of each living instance go. fmpy's proxy, which formats what the FMU logs (the logger is variadic
#: in C), knows one Python logger per process; the instances are told apart by the environment that they were given.
MESSAGES: dict[int, deque[tuple[str, str]]] = {}
ENVIRONMENTS = count(1)


def _log(environment: int, _instance: bytes, _status: int, category: bytes, message: bytes) -> None:
    if environment in MESSAGES:
        said = [(text or b"").decode(errors="replace") for text in (category, message)]
        MESSAGES[environment].append((said[0], said[1]))


_LOGGER = fmi2CallbackLoggerTYPE(_log)


def callbacks(environment: int) -> Any:
    """The callbacks of an instance whose messages go to `MESSAGES[environment]`."""
    made = fmi2CallbackFunctions()
    made.logger = _LOGGER
    made.allocateMemory = fmi2CallbackAllocateMemoryTYPE(calloc)
    made.freeMemory = fmi2CallbackFreeMemoryTYPE(free)
    made.componentEnvironment = environment
    addLoggerProxy(byref(made))
    return made
