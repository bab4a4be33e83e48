"""The functions of FMI 3.0 for co-simulation and scheduled execution."""

import ctypes
from collections.abc import Sequence
from ctypes import (
    CFUNCTYPE,
    POINTER,
    byref,
    c_bool,
    c_char_p,
    c_double,
    c_float,
    c_int,
    c_size_t,
    c_uint,
    c_void_p,
)
from typing import Any

from exo.probe.library import GOOD, Library, Step, Tell, Variable, reference

VALUES: dict[str, Any] = {"Float32": c_float, "Float64": c_double, "Boolean": c_bool, "String": c_char_p}
VALUES |= {
    f"{kind}{bits}": getattr(ctypes, f"c_{kind.lower()}{bits}") for kind in ("Int", "UInt") for bits in (8, 16, 32, 64)
}
LOG = CFUNCTYPE(None, c_void_p, c_int, c_char_p, c_char_p)
INTERMEDIATE = CFUNCTYPE(None, c_void_p, c_double, c_bool, c_bool, c_bool, c_bool, POINTER(c_bool), POINTER(c_double))
CLOCK_UPDATE = CFUNCTYPE(None, c_void_p)
LOCK = CFUNCTYPE(None)
#: Rounds of fmi3UpdateDiscreteStates in one event.
MAX_ROUNDS = 100


class Library3(Library):
    """A library of FMI 3.0."""

    prefix = "fmi3"
    boolean = c_bool
    state = "State"
    deserialize = "Deserialize"

    def __init__(self, library: ctypes.CDLL, tell: Tell, task: dict[str, Any]) -> None:
        super().__init__(library, tell, task)
        self.early_returns = 0
        self.log = LOG(lambda _, __, category, message: self.keep(category, message))
        self.intermediate = INTERMEDIATE(self._intermediate)
        self.scheduler = (CLOCK_UPDATE(lambda _: None), LOCK(lambda: None), LOCK(lambda: None))

    def instantiate(
        self, token: bytes | None = None, *, logging: bool = False, event_mode: bool = False, early: bool = False
    ) -> c_void_p | None:
        """An instance of the interface that is run; `early`: it may return early, and is asked to."""
        common = (
            c_char_p(b"validated"),
            c_char_p(self.task["guid"].encode() if token is None else token),
            c_char_p(self.task["resources"].encode()),
            c_bool(False),
            c_bool(logging),
        )
        if self.task["interface"] == "ScheduledExecution":
            rest: tuple[Any, ...] = (None, self.log, *self.scheduler)
        else:
            callback = self.intermediate if early else INTERMEDIATE()
            rest = (c_bool(event_mode), c_bool(early), None, c_size_t(0), None, self.log, callback)
        instance = self.call(f"Instantiate{self.task['interface']}", *common, *rest, returns=c_void_p)
        return None if instance is None else c_void_p(instance)

    def enter(self, instance: c_void_p, start: float, stop: float | None = None) -> int:
        """Goes to initialization mode."""
        end = (c_bool(stop is not None), c_double(stop or 0.0))
        return int(self.call("EnterInitializationMode", instance, c_bool(False), c_double(0.0), c_double(start), *end))

    def step(self, instance: c_void_p, time: float, size: float, *, states_are_left: bool = False) -> int:
        """One communication step; in scheduled execution, one tick of the fastest clocks."""
        if self.task["interface"] == "ScheduledExecution":
            answers = [
                int(self.call("ActivateModelPartition", instance, c_uint(clock), c_double(time)))
                for clock in self.task["clocks"]
            ]
            return max(answers, default=0)
        event, terminate, early, last = c_bool(), c_bool(), c_bool(), c_double()
        outputs = (byref(event), byref(terminate), byref(early), byref(last))
        times = (c_double(time), c_double(size), c_bool(not states_are_left))
        answer = int(self.call("DoStep", instance, *times, *outputs))
        self.last_step = Step(event.value, terminate.value, early.value, last.value)
        return answer

    def handle_event(self, instance: c_void_p, *, enter: bool = True) -> tuple[int, bool]:
        """An event from step mode back to it: the worst status, and whether it came to an end."""
        answers = [int(self.call("EnterEventMode", instance))] if enter else []
        more = True
        for _ in range(MAX_ROUNDS):
            flags = [c_bool() for _ in range(5)]
            answers.append(int(self.call("UpdateDiscreteStates", instance, *map(byref, flags), byref(c_double()))))
            more = flags[0].value and not flags[1].value
            if not more or answers[-1] not in GOOD:
                break
        answers.append(int(self.call("EnterStepMode", instance)))
        return max(answers), not more

    def get(self, instance: c_void_p, variable: Variable) -> list[Any] | None:
        """A variable's values, None when the FMU refuses."""
        count = c_size_t(variable.count)
        if variable.kind == "Binary":
            sizes, pointers = (c_size_t * variable.count)(), (c_void_p * variable.count)()
            if self.call("GetBinary", instance, reference(variable), c_size_t(1), sizes, pointers, count) not in GOOD:
                return None
            return [
                ctypes.string_at(pointer, size).hex() if pointer and size else ""
                for pointer, size in zip(pointers, sizes, strict=True)
            ]
        values = (VALUES[variable.kind] * variable.count)()
        answer = self.call(f"Get{variable.kind}", instance, reference(variable), c_size_t(1), values, count)
        if answer not in GOOD:
            return None
        if variable.kind == "String":
            return [(value or b"").decode("utf-8", "replace") for value in values]
        return list(values)

    def set(self, instance: c_void_p, variable: Variable, values: Sequence[Any]) -> int:
        """Sets a variable that holds numbers."""
        array = (VALUES[variable.kind] * len(values))(*values)
        name = f"Set{variable.kind}"
        return int(self.call(name, instance, reference(variable), c_size_t(1), array, c_size_t(len(values))))

    def _intermediate(self, *arguments: Any) -> None:
        """Asks for an early return wherever the FMU allows it."""
        _, time, _, _, _, can_return, requested, at = arguments
        if can_return and requested and at:
            requested[0], at[0] = True, time
            self.early_returns += 1
