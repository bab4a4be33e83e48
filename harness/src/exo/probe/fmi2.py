"""The functions of FMI 2.0 for co-simulation."""

import ctypes
import sys
from collections.abc import Sequence
from ctypes import CFUNCTYPE, Structure, byref, c_char_p, c_double, c_int, c_size_t, c_void_p
from typing import Any

from exo.probe.library import GOOD, Library, Tell, Variable, reference

VALUES: dict[str, Any] = {"Real": c_double, "Integer": c_int, "Boolean": c_int, "String": c_char_p}
LOGGER = CFUNCTYPE(None, c_void_p, c_char_p, c_int, c_char_p, c_char_p)
ALLOCATE = CFUNCTYPE(c_void_p, c_size_t, c_size_t)
FREE = CFUNCTYPE(None, c_void_p)
FINISHED = CFUNCTYPE(None, c_void_p, c_int)


class Callbacks(Structure):
    """fmi2CallbackFunctions"""

    _fields_ = (
        ("logger", LOGGER),
        ("allocateMemory", ALLOCATE),
        ("freeMemory", FREE),
        ("stepFinished", FINISHED),
        ("componentEnvironment", c_void_p),
    )


class Library2(Library):
    """A library of FMI 2.0."""

    def __init__(self, library: ctypes.CDLL, tell: Tell, task: dict[str, Any]) -> None:
        super().__init__(library, tell, task)
        libc = ctypes.CDLL("msvcrt" if sys.platform == "win32" else None)
        libc.calloc.restype, libc.calloc.argtypes = c_void_p, (c_size_t, c_size_t)
        libc.free.restype, libc.free.argtypes = None, (c_void_p,)
        log = LOGGER(lambda _, __, ___, category, message: self.keep(category, message))
        self.callbacks = Callbacks(log, ALLOCATE(libc.calloc), FREE(libc.free), FINISHED(), None)

    def instantiate(
        self, token: bytes | None = None, *, logging: bool = False, event_mode: bool = False, early: bool = False
    ) -> c_void_p | None:
        """An instance, or None when the FMU refuses; FMI 2.0 has neither event mode nor early return here."""
        del event_mode, early
        component = self.call(
            "Instantiate",
            c_char_p(b"validated"),
            c_int(1),
            c_char_p(self.task["guid"].encode() if token is None else token),
            c_char_p(self.task["resources"].encode()),
            byref(self.callbacks),
            c_int(0),
            c_int(logging),
            returns=c_void_p,
        )
        return None if component is None else c_void_p(component)

    def enter(self, instance: c_void_p, start: float, stop: float | None = None) -> int:
        """Goes to initialization mode."""
        end = (c_int(stop is not None), c_double(stop or 0.0))
        answer = int(self.call("SetupExperiment", instance, c_int(0), c_double(0.0), c_double(start), *end))
        entered = int(self.call("EnterInitializationMode", instance))
        return answer if answer not in GOOD else entered

    def step(self, instance: c_void_p, time: float, size: float, *, states_are_left: bool = False) -> int:
        """One communication step."""
        return int(self.call("DoStep", instance, c_double(time), c_double(size), c_int(not states_are_left)))

    def get(self, instance: c_void_p, variable: Variable) -> list[Any] | None:
        """A variable's value, None when the FMU refuses."""
        value = VALUES[variable.kind]()
        answer = self.call(f"Get{variable.kind}", instance, reference(variable), c_size_t(1), byref(value))
        if answer not in GOOD:
            return None
        return [(value.value or b"").decode("utf-8", "replace") if variable.kind == "String" else value.value]

    def set(self, instance: c_void_p, variable: Variable, values: Sequence[Any]) -> int:
        """Sets a variable."""
        value = VALUES[variable.kind](values[0])
        return int(self.call(f"Set{variable.kind}", instance, reference(variable), c_size_t(1), byref(value)))
