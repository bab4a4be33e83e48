"""A loaded library: calls that are told before they are made, and what both versions of the standard have in common."""

import ctypes
from collections.abc import Callable, Sequence
from ctypes import byref, c_char_p, c_int, c_size_t, c_uint, c_void_p
from dataclasses import dataclass, field
from typing import Any, ClassVar

STATUS = ("OK", "Warning", "Discard", "Error", "Fatal", "Pending")
#: Statuses after which an instance goes on: OK and Warning.
GOOD = (0, 1)
#: Log messages that are kept.
MAX_MESSAGES = 10_000

Tell = Callable[[dict[str, Any]], None]


@dataclass(frozen=True)
class Variable:
    """What the task says of a variable."""

    index: int
    #: As in the names of fmi?Get… functions.
    kind: str
    reference: int
    #: Number of its elements.
    count: int = 1
    name: str = ""
    #: Start values and bounds of a floating-point input or parameter.
    start: tuple[float, ...] = ()
    low: float | None = None
    high: float | None = None
    scale: float = 1.0


@dataclass
class Step:
    """What fmi3DoStep says beside its status."""

    event: bool = False
    terminate: bool = False
    early: bool = False
    last: float = 0.0


@dataclass
class Library:
    """The functions of one library. A call is told before it is made, unless the last one was of the same function."""

    library: ctypes.CDLL
    tell: Tell
    #: What the task says of the FMU: token, resources, interface.
    task: dict[str, Any]
    last_call: str = ""
    statuses: set[tuple[str, int]] = field(default_factory=set)
    #: Category and text of each log message.
    messages: list[tuple[str | None, str]] = field(default_factory=list)
    last_step: Step = field(default_factory=Step)

    #: Beginning of the functions' names, the type of their Booleans, and how they spell the FMU state.
    prefix: ClassVar[str] = "fmi2"
    boolean: ClassVar[Any] = c_int
    state: ClassVar[str] = "state"
    deserialize: ClassVar[str] = "DeSerialize"

    def call(self, name: str, *arguments: Any, returns: Any = c_int) -> Any:
        """Calls a function; a status that is not OK is a fact when it comes for the first time."""
        name = f"{self.prefix}{name}"
        if name != self.last_call:
            self.tell({"call": name})
            self.last_call = name
        function = getattr(self.library, name)
        function.restype = returns
        result = function(*arguments)
        if returns is c_int and result != 0 and (name, result) not in self.statuses:
            self.statuses.add((name, result))
            self.tell({"status": [name, status(result)]})
        return result

    def text(self, name: str) -> str:
        """What a function without arguments returns."""
        return (self.call(name, returns=c_char_p) or b"").decode("utf-8", "replace")

    def keep(self, category: bytes | None, message: bytes | None) -> None:
        """Keeps a log message."""
        if len(self.messages) < MAX_MESSAGES:
            named = None if category is None else category.decode("utf-8", "replace")
            self.messages.append((named, (message or b"").decode("utf-8", "replace")))

    def instantiate(
        self, token: bytes | None = None, *, logging: bool = False, event_mode: bool = False, early: bool = False
    ) -> c_void_p | None:
        """An instance, or None when the FMU refuses; `token` in place of the description's."""
        raise NotImplementedError

    def enter(self, instance: c_void_p, start: float, stop: float | None = None) -> int:
        """Goes to initialization mode."""
        raise NotImplementedError

    def step(self, instance: c_void_p, time: float, size: float, *, states_are_left: bool = False) -> int:
        """One communication step."""
        raise NotImplementedError

    def get(self, instance: c_void_p, variable: Variable) -> list[Any] | None:
        """A variable's values, None when the FMU refuses."""
        raise NotImplementedError

    def set(self, instance: c_void_p, variable: Variable, values: Sequence[Any]) -> int:
        """Sets a variable."""
        raise NotImplementedError

    def read(self, instance: c_void_p, variable: Variable) -> Any:
        """The value of a scalar, the values of an array; None when the FMU refuses."""
        values = self.get(instance, variable)
        return values if values is None or len(values) != 1 else values[0]

    def exit(self, instance: c_void_p) -> int:
        """Leaves initialization mode."""
        return int(self.call("ExitInitializationMode", instance))

    def terminate(self, instance: c_void_p) -> int:
        """Ends a run."""
        return int(self.call("Terminate", instance))

    def reset(self, instance: c_void_p) -> int:
        """Back to where instantiating has led."""
        return int(self.call("Reset", instance))

    def free(self, instance: c_void_p | None) -> None:
        """Gives an instance back."""
        self.call("FreeInstance", instance, returns=None)

    def debug_logging(self, instance: c_void_p, on: bool, categories: Sequence[str]) -> int:
        """Switches log categories."""
        names = (c_char_p * max(len(categories), 1))(*(name.encode() for name in categories))
        pointer = names if categories else None
        return int(self.call("SetDebugLogging", instance, self.boolean(on), c_size_t(len(categories)), pointer))

    def get_state(self, instance: c_void_p) -> tuple[int, c_void_p]:
        """Status and a copy of the FMU state."""
        state = c_void_p()
        return int(self.call(f"GetFMU{self.state}", instance, byref(state))), state

    def set_state(self, instance: c_void_p, state: c_void_p) -> int:
        """Puts a copied state back."""
        return int(self.call(f"SetFMU{self.state}", instance, state))

    def free_state(self, instance: c_void_p, state: c_void_p) -> int:
        """Gives a copied state back."""
        return int(self.call(f"FreeFMU{self.state}", instance, byref(state)))

    def serialized(self, instance: c_void_p, state: c_void_p) -> tuple[int, bytes]:
        """Status and the bytes of a copied state."""
        size = c_size_t()
        answer = int(self.call(f"SerializedFMU{self.state}Size", instance, state, byref(size)))
        if answer not in GOOD:
            return answer, b""
        buffer = ctypes.create_string_buffer(max(size.value, 1))
        answer = int(self.call(f"SerializeFMU{self.state}", instance, state, buffer, size))
        return answer, buffer.raw[: size.value]

    def deserialized(self, instance: c_void_p, data: bytes) -> tuple[int, c_void_p]:
        """Status and a state of these bytes."""
        state = c_void_p()
        buffer = ctypes.create_string_buffer(data, max(len(data), 1))
        name = f"{self.deserialize}FMU{self.state}"
        return int(self.call(name, instance, buffer, c_size_t(len(data)), byref(state))), state


def reference(variable: Variable) -> Any:
    """The value reference as C takes it."""
    return byref(c_uint(variable.reference))


def status(number: int) -> str:
    """The name of a status."""
    return STATUS[number] if 0 <= number < len(STATUS) else str(number)
