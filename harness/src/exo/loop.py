"""The loop over coupled FMUs: per step and component copy the wired inputs, set, step, get.

Two engines make the same calls with the same values in the same order, so that their numbers are equal bit for bit:

* `fmpy`: this file's loop, by ctypes. The reference; needs nothing but Python.
* `native`: the same in machine code (`harness/native`), installed by `cargo xtask native`. It lets other threads run
  meanwhile.
"""

from collections.abc import Mapping
from ctypes import c_double, c_int, c_size_t, c_void_p, cast
from dataclasses import dataclass
from functools import cached_property
from importlib import import_module
from time import perf_counter
from typing import Any, Literal, get_args

import numpy as np
from numpy.typing import NDArray

from exo import __version__
from exo.errors import ExoError, FmuError
from exo.fmu import DTYPES, Instance, Kind, References
from exo.pace import Pace

Engine = Literal["fmpy", "native"]
ENGINES: tuple[Engine, ...] = get_args(Engine)
#: What `_run_native` hands over and gets back; `INTERFACE` of `harness/native/src/python.rs` is the same number.
INTERFACE = 1


class Part:
    """One component in the loop: its instance and its buffers by kind, one row per communication point."""

    def __init__(self, instance: Instance, *, inputs: list[str], outputs: list[str], steps: int) -> None:
        archive = instance.archive
        for name in inputs:
            variable = archive.variable(name)
            if variable.causality != "input" and variable.variability != "tunable":
                what = f"a {variable.variability} {variable.causality}"
                raise FmuError(f"{archive.path.name}: {name}: only inputs and tunables can be wired, this is {what}")
        self.instance = instance
        self.inputs = {kind: refs for kind, refs in instance.references(inputs).items() if refs}
        self.outputs = {kind: refs for kind, refs in instance.references(outputs).items() if refs}
        self.resize(steps)

    def resize(self, steps: int) -> None:
        """Buffers for this number of steps, all zero."""
        self.u = _rows(self.inputs, steps)
        self.y = _rows(self.outputs, steps + 1)

    def read_row(self, row: int) -> None:
        """Reads all outputs into a row."""
        for kind, buffer in self.y.items():
            self.instance.read(self.outputs[kind], buffer[row])

    def write_row(self, row: int) -> None:
        """Sets all wired inputs from a row."""
        for kind, buffer in self.u.items():
            self.instance.write(self.inputs[kind], buffer[row])

    def input(self, name: str) -> tuple[Kind, int]:
        """Kind and column of a wired input."""
        return next((kind, refs.names.index(name)) for kind, refs in self.inputs.items() if name in refs.names)

    def output(self, name: str, kind: Kind) -> int:
        """Column of an output that must be of this kind."""
        variable = self.instance.archive.variable(name)
        if kind not in self.outputs or name not in self.outputs[kind].names:
            article, what = "an" if kind == "Integer" else "a", f"{variable.causality} of type {variable.type}"
            file = self.instance.archive.path.name
            raise FmuError(f"{file}: {name}: expected {article} {kind} output, this is {what}")
        return self.outputs[kind].names.index(name)

    @property
    def recorded(self) -> list[str]:
        """Names of the outputs and wired inputs that the buffers hold."""
        return [name for refs in (*self.outputs.values(), *self.inputs.values()) for name in refs.names]

    def column(self, name: str) -> NDArray[Any]:
        """A recorded column: an output that is discrete in time belongs to the tick that step k ran, a continuous one
        to the instant t_k at which the step began. KeyError, if it is not recorded."""
        discrete = self.instance.archive.variable(name).variability == "discrete"
        for rows, references in ((slice(1, None) if discrete else slice(-1), self.outputs), (slice(None), self.inputs)):
            buffers = self.y if references is self.outputs else self.u
            for kind, refs in references.items():
                if name in refs.names:
                    column = buffers[kind][rows, refs.names.index(name)].copy()
                    return column.astype(bool) if kind == "Boolean" else column
        raise KeyError(name)


def _rows(references: Mapping[Kind, References], rows: int) -> dict[Kind, NDArray[Any]]:
    return {kind: np.zeros((rows, refs.count), dtype=DTYPES[kind]) for kind, refs in references.items()}


@dataclass(frozen=True)
class Wire:
    """A connection of variables of one kind; `ahead` = 1 when it carries what the source put out in this very step.
    `sign` is −1 where the input gets the output's negative."""

    kind: Kind
    target: Part
    input: int
    source: Part
    output: int
    ahead: int
    sign: int


@dataclass(frozen=True)
class _Call:
    """A Set or Get of a row per step."""

    name: str
    function: Any
    references: References
    #: Address of the row of step 0, and the bytes of a row.
    base: int
    size: int


@dataclass(frozen=True)
class Work:
    """What the loop does with a component in a step; holds as long as the part's buffers and wires are the same."""

    part: Part
    wires: list[Wire]
    writes: list[_Call]
    do_step: Any
    reads: list[_Call]

    @cached_property
    def addresses(self) -> tuple[Any, ...]:
        """For the native engine: `fmi2DoStep`, copies, writes, reads as numbers."""
        return _addresses(self)


def work(parts: list[Part], wires: list[Wire]) -> list[Work]:
    """What the loop does in a step, component by component."""
    return [_work(part, [wire for wire in wires if wire.target is part]) for part in parts]


def run(
    all_work: list[Work],
    *,
    steps: int,
    step: float,
    first: int = 0,
    engine: Engine = "fmpy",
    pace: Pace | None = None,
) -> None:
    """Makes the steps from number `first` to before number `steps`; step 0 begins at t = 0. With `pace` by the clock.

    FmuError names component, function and time of a call that fails.
    """
    if engine == "native":
        _run_native(all_work, first, steps, step, pace)
    else:
        _run(all_work, first, steps, step, pace)


def named(name: str) -> Engine:
    """The engine of this name. ExoError, if there is none or it is not installed."""
    for engine in ENGINES:
        if engine == name:
            if engine == "native":
                native()
            return engine
    raise ExoError(f"--engine {name}: expected one of {', '.join(ENGINES)}")


def fastest() -> Engine:
    """The native engine where it is installed. ExoError, if one is there that belongs to another harness."""
    try:
        native()
    except NotInstalledError:
        return "fmpy"
    return "native"


class NotInstalledError(ExoError):
    """An engine that is not there."""


def native() -> Any:
    """The module of the native engine. ExoError says how to get it, or one that belongs to this harness."""
    try:
        module = import_module("exo_native")
    except ModuleNotFoundError:
        raise NotInstalledError("engine native is not installed: `cargo xtask native` builds and installs it") from None
    except ImportError as error:
        told = " ".join(str(error).split())
        raise ExoError(f"engine native cannot be loaded: {told}; `cargo xtask native` builds and installs it") from None
    # A wheel without an interface is older than the check.
    found = getattr(module, "__version__", "unknown"), getattr(module, "INTERFACE", 0)
    if found != (__version__, INTERFACE):
        raise ExoError(
            f"engine native: the wheel exo-native {found[0]}, interface {found[1]}, is installed; "
            f"expected {__version__}, interface {INTERFACE}: `cargo xtask native` builds and installs it"
        )
    return module


def _run(all_work: list[Work], first: int, steps: int, step: float, pace: Pace | None) -> None:
    """The loop by ctypes.

    The C functions have no argument types here: a call with finished ctypes objects takes a third of the time of one
    that converts four numbers. The objects live as long as the loop; only addresses and the time change in them.
    """
    t, size_of_step, no_rollback = c_double(0.0), c_double(step), c_int(1)
    prepared = [_for_ctypes(work) for work in all_work]
    origin = perf_counter() - first * step
    for k in range(first, steps):
        t.value = k * step
        if pace is not None:
            pace.wait(k, origin + k * step)
        for part, component, copies, negatives, writes, do_step, reads in prepared:
            for target, at, width, source, output, stride in copies:
                target[k * width + at] = source[k * stride + output]
            for target, at, width, source, output, stride in negatives:
                target[k * width + at] = -source[k * stride + output]
            for name, call, references, count, address, base, size in writes:
                address.value = base + k * size
                if status := call(component, references, count, address):
                    raise _located(part.instance.fail(name, status), t.value)
            if status := do_step(component, t, size_of_step, no_rollback):
                raise _located(part.instance.fail("fmi2DoStep", status), t.value)
            for name, call, references, count, address, base, size in reads:
                address.value = base + k * size
                if status := call(component, references, count, address):
                    raise _located(part.instance.fail(name, status), t.value)
        if pace is not None:
            pace.ends(k)


def _run_native(all_work: list[Work], first: int, steps: int, step: float, pace: Pace | None) -> None:
    """The loop in machine code: addresses go there, a failed call comes back."""
    # The instance is asked for each time: one that refuses a reset is made anew.
    components = [(work.part.instance.component, *work.addresses) for work in all_work]
    failed = native().run(components, first=first, steps=steps, step=step, pace=pace and pace.addresses)
    if failed is None:
        return
    component, what, number, status, k = failed
    work = all_work[component]
    names = {"write": work.writes, "read": work.reads}
    name = names[what][number].name if what in names else "fmi2DoStep"
    raise _located(work.part.instance.fail(name, status), k * step)


def _located(error: ExoError, t: float) -> ExoError:
    return FmuError(f"{error} (step at t = {t:.6g} s)")


def _work(part: Part, wires: list[Wire]) -> Work:
    writes = [_call(part.instance, "Set", part.inputs[kind], u, first_row=0) for kind, u in part.u.items()]
    reads = [_call(part.instance, "Get", part.outputs[kind], y, first_row=1) for kind, y in part.y.items()]
    return Work(part, wires, writes, part.instance.function("fmi2DoStep"), reads)


def _call(instance: Instance, prefix: str, references: References, buffer: NDArray[Any], *, first_row: int) -> _Call:
    size = buffer.strides[0]
    name = f"fmi2{prefix}{references.kind}"
    return _Call(name, instance.function(name), references, buffer.ctypes.data + first_row * size, size)


def _for_ctypes(work: Work) -> tuple[Any, ...]:
    """Flat views for the copies, and ctypes objects for the calls."""
    copies: list[tuple[Any, ...]] = []
    negatives: list[tuple[Any, ...]] = []
    for wire in work.wires:
        target, source = wire.target.u[wire.kind], wire.source.y[wire.kind]
        width, stride = target.shape[1], source.shape[1]
        # `ahead` rows further on: part of the constant offset.
        offset = wire.ahead * stride + wire.output
        taken = negatives if wire.sign < 0 else copies
        taken.append((target.reshape(-1).data, wire.input, width, source.reshape(-1).data, offset, stride))
    component = c_void_p(work.part.instance.component)
    writes, reads = ([_objects(call) for call in calls] for calls in (work.writes, work.reads))
    return work.part, component, copies, negatives, writes, work.do_step, reads


def _objects(call: _Call) -> tuple[Any, ...]:
    addresses = c_void_p(call.references.address), c_size_t(call.references.count), c_void_p(call.base)
    return call.name, call.function, *addresses, call.base, call.size


def _addresses(work: Work) -> tuple[Any, ...]:
    copies = []
    for wire in work.wires:
        target, source = wire.target.u[wire.kind], wire.source.y[wire.kind]
        to = target.ctypes.data + wire.input * target.itemsize
        origin = source.ctypes.data + wire.ahead * source.strides[0] + wire.output * source.itemsize
        copies.append((to, target.strides[0], origin, source.strides[0], target.itemsize, wire.sign < 0))
    writes, reads = (
        [(_address(c.function), c.references.address, c.references.count, c.base, c.size) for c in calls]
        for calls in (work.writes, work.reads)
    )
    return _address(work.do_step), copies, writes, reads


def _address(function: Any) -> int:
    return int(cast(function, c_void_p).value or 0)
