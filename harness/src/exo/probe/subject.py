"""The FMU in a trial: instances that are started, fed and read the same way each time, and traces that are compared."""

from collections.abc import Sequence
from ctypes import c_float, c_void_p
from math import copysign, inf, nextafter
from struct import pack
from typing import Any

from exo.probe.library import GOOD, Library, Variable, status

#: Steps of a trace.
STEPS = 4
#: What an input is moved by, as a share of its magnitude.
SHARE = 0.01
#: Of single precision: the smallest normal number, and the last place of 1.
SMALLEST_SINGLE, EPSILON_SINGLE = 2.0**-126, 2.0**-23

#: Values of all outputs after each step.
Trace = list[list[Any]]


class SkipError(Exception):
    """This FMU cannot be judged by this trial, and why."""


class WrongError(Exception):
    """The rule is broken: what is there, and what was expected."""


class Subject:
    """One library and what the task says of its variables."""

    def __init__(self, fmu: Library, task: dict[str, Any]) -> None:
        self.fmu = fmu
        self.start_time: float = task["start"]
        self.size: float = task["step"]
        self.outputs = [Variable(*one) for one in task["outputs"]]
        #: What fmi?Reset must bring back: all but local variables.
        self.told = [Variable(*one) for one in task["told"]]
        self.inputs = [_with_floats(one) for one in task["inputs"]]
        self.parameters = [_with_floats(one) for one in task["parameters"]]

    def new(self, *, logging: bool = False, event_mode: bool = False, early: bool = False) -> c_void_p:
        """A fresh instance."""
        instance = self.fmu.instantiate(logging=logging, event_mode=event_mode, early=early)
        if instance is None:
            raise SkipError("there is no instance")
        return instance

    def started(
        self, *, stop: float | None = None, logging: bool = False, event_mode: bool = False, early: bool = False
    ) -> c_void_p:
        """A fresh instance that is ready to step."""
        instance = self.new(logging=logging, event_mode=event_mode, early=early)
        self.start(instance, stop=stop)
        return instance

    def start(self, instance: c_void_p, *, stop: float | None = None) -> None:
        """Initializes an instance."""
        self.plain("Initialization", max(self.fmu.enter(instance, self.start_time, stop), self.fmu.exit(instance)))

    def close(self, *instances: c_void_p) -> None:
        """Ends runs and gives the instances back."""
        for instance in instances:
            self.fmu.terminate(instance)
            self.fmu.free(instance)

    def plain(self, what: str, answer: int) -> None:
        """What must work before anything can be judged: `load-status` says when it does not."""
        if answer not in GOOD:
            raise SkipError(f"{what} returned {self.fmu.prefix}{status(answer)}")

    def must(self, what: str, answer: int) -> None:
        """What the rule says must work."""
        if answer not in GOOD:
            raise WrongError(f"{what} returned {self.fmu.prefix}{status(answer)}", f"{self.fmu.prefix}OK")

    def feed(self, instance: c_void_p, number: int, seed: int = 0) -> None:
        """Sets the inputs of a step: near their start values, other ones for each step and seed."""
        for variable in self.inputs:
            values = [_moved(variable, start, number + seed) for start in variable.start]
            self.plain(f"setting {variable.name}", self.fmu.set(instance, variable, values))

    def read(self, instance: c_void_p, variables: Sequence[Variable] | None = None) -> list[Any]:
        """The values of the outputs, or of others."""
        return [self.fmu.get(instance, one) for one in (self.outputs if variables is None else variables)]

    def run(
        self, instance: c_void_p, *, first: int = 0, steps: int = STEPS, seed: int = 0, states_are_left: bool = False
    ) -> Trace:
        """Steps of the usual size; the outputs after each."""
        trace = []
        for number in range(first, first + steps):
            self.feed(instance, number, seed)
            time = self.start_time + number * self.size
            self.plain("a step", self.fmu.step(instance, time, self.size, states_are_left=states_are_left))
            trace.append(self.read(instance))
            if self.fmu.last_step.terminate:
                break
        return trace

    def same(self, found: Trace, expected: Trace, when: str, variables: Sequence[Variable] | None = None) -> None:
        """Compares bit for bit."""
        named = self.outputs if variables is None else variables
        if len(found) != len(expected):
            raise WrongError(f"{len(found)} steps {when}", f"{len(expected)}")
        for number, (row, other) in enumerate(zip(found, expected, strict=True), start=1):
            for variable, value, wanted in zip(named, row, other, strict=True):
                if bits(value) != bits(wanted):
                    raise WrongError(f"{variable.name} is {said(value)} {when}, row {number}", said(wanted))


def bits(values: list[Any] | None) -> Any:
    """What is compared: 0 and -0 differ, a NaN is equal to itself."""
    if values is None:
        return None
    return [pack("d", value) if isinstance(value, float) else value for value in values]


def said(values: list[Any] | None) -> str:
    """Values for a reader."""
    if values is None:
        return "refused"
    return repr(values[0]) if len(values) == 1 else repr(values[:6])


def next_to(variable: Variable) -> list[float]:
    """Start values, each moved to the next number: another value that no law minds."""
    return [
        _next(variable.kind, one, -inf if variable.high is not None and one >= variable.high else inf)
        for one in variable.start
    ]


def _next(kind: str, value: float, towards: float) -> float:
    """The next number of the variable's own precision."""
    if kind != "Float32":
        return nextafter(value, towards)
    # Between one and two places of single precision, which it rounds to a neighbour.
    return c_float(value + copysign(max(abs(value), SMALLEST_SINGLE) * EPSILON_SINGLE, towards)).value


def _moved(variable: Variable, start: float, number: int) -> float:
    value = start + SHARE * max(abs(start), variable.scale) * (number % 5 + 1)
    if variable.high is not None and value > variable.high:
        value = start
    return value if variable.low is None or value >= variable.low else start


def _with_floats(given: list[Any]) -> Variable:
    index, kind, reference, count, name, start, low, high, scale = given
    return Variable(index, kind, reference, count, name, tuple(start), low, high, scale)
