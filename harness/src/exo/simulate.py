"""The master: wires FMUs, steps them in order, records every tick.

Each component has one row of outputs per communication point: row 0 after initialization, row k+1 after step k. An
input of step k reads its source from row k or from row k+1; this alone is what a coupling decides:

* `zero_delay`: the components step one after the other, and each sees what those before it have just put out: the
  plant gets the torque of this tick, the controller the position at t_k. Row k+1 of components before it, row k of the
  others.
* `one_sample_delay`: the same, except that the scenario's `delayed` inputs read row k: the torque comes one tick later,
  and the first one is what the controller shows after initialization, zero.
* `exchange_at_once`: all outputs are read, all inputs are set, all components step. Row k for every connection.
"""

from collections.abc import Mapping
from contextlib import ExitStack
from ctypes import c_double, c_int, c_size_t, c_void_p
from dataclasses import dataclass
from time import perf_counter, thread_time
from typing import Any

import numpy as np
from numpy.typing import NDArray

from exo import profile
from exo.errors import ExoError, FmuError, ScenarioError
from exo.fmu import DTYPES, Archive, Instance, Kind, References, choices
from exo.recording import Recording
from exo.scenario import MINUS, PROFILE, Case, Coupling, Scenario, Segment, Value

#: A profile's value from which on the Boolean input that it drives is true.
TRUE_FROM = 0.5


@dataclass(frozen=True, kw_only=True)
class Plan:
    """A case with everything that the scenario and the command line contribute."""

    components: Mapping[str, str]
    parameters: Mapping[str, Value]
    inputs: Mapping[str, str]
    delayed: tuple[str, ...]
    profiles: Mapping[str, tuple[Segment, ...]]
    coupling: Coupling
    duration: float
    step: float

    @property
    def steps(self) -> int:
        """Number of macro steps."""
        return round(self.duration / self.step)


def plan(*, scenario: Scenario, case: Case, overrides: Mapping[str, Value] | None = None) -> Plan:
    """Merges scenario, case and overrides, the later before the earlier."""
    parameters = {
        f"{name}.{key}": value for name, part in scenario.components.items() for key, value in part.parameters.items()
    }
    return Plan(
        components={name: part.archive for name, part in scenario.components.items()},
        parameters=parameters | case.parameters | dict(overrides or {}),
        inputs=scenario.inputs | case.inputs,
        delayed=scenario.delayed,
        profiles=scenario.profiles | case.profiles,
        coupling=case.coupling or scenario.coupling,
        duration=case.duration or scenario.duration,
        step=case.step or scenario.step,
    )


class Part:
    """One component in the loop: its instance and its buffers by kind, one row per communication point."""

    def __init__(self, instance: Instance, inputs: list[str], steps: int) -> None:
        archive = instance.archive
        for name in inputs:
            variable = archive.variable(name)
            if variable.causality != "input" and variable.variability != "tunable":
                what = f"a {variable.variability} {variable.causality}"
                raise FmuError(f"{archive.path.name}: {name}: only inputs and tunables can be wired, this is {what}")
        self.instance = instance
        self.inputs = {kind: refs for kind, refs in instance.references(inputs).items() if refs}
        self.outputs = {kind: refs for kind, refs in instance.references(archive.names("output")).items() if refs}
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

    def columns(self) -> dict[str, NDArray[Any]]:
        """Recorded columns: an output that is discrete in time belongs to the tick that step k ran, a continuous one to
        the instant t_k at which the step began."""
        found: dict[str, NDArray[Any]] = {}
        for kind, buffer in self.y.items():
            for j, name in enumerate(self.outputs[kind].names):
                discrete = self.instance.archive.variable(name).variability == "discrete"
                column = np.ascontiguousarray(buffer[1:, j] if discrete else buffer[:-1, j])
                found[name] = column.astype(bool) if kind == "Boolean" else column
        for kind, buffer in self.u.items():
            for j, name in enumerate(self.inputs[kind].names):
                column = np.ascontiguousarray(buffer[:, j])
                found[name] = column.astype(bool) if kind == "Boolean" else column
        return found


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


def simulate(*, plan: Plan, archives: Mapping[str, Archive]) -> Recording:
    """Runs one case. `archives` are the opened FMUs by archive name."""
    time = np.arange(plan.steps, dtype=np.float64) * np.float64(plan.step)
    _check_names(plan, archives)
    with ExitStack() as stack:
        parts: dict[str, Part] = {}
        for name, archive in plan.components.items():
            inputs = [key.split(".", 1)[1] for key in plan.inputs if key.split(".", 1)[0] == name]
            instance = stack.enter_context(Instance(archives[archive], name))
            parts[name] = Part(instance, inputs, plan.steps)
        wires = _wire(plan, parts, time)
        _initialize(plan, parts, wires)
        parameters = {
            f"{name}.{key}": value
            for name, part in parts.items()
            for key, value in part.instance.values(part.instance.archive.names("parameter")).items()
        }
        started = perf_counter(), thread_time()
        _run(list(parts.values()), wires, plan)
        wall_time, cpu_time = perf_counter() - started[0], thread_time() - started[1]
        for part in parts.values():
            part.instance.terminate()
        columns = {f"{name}.{key}": c for name, part in parts.items() for key, c in part.columns().items()}
    units = {key: _unit(archives[plan.components[key.split(".", 1)[0]]], key.split(".", 1)[1]) for key in columns}
    return Recording(
        time=time,
        columns=columns,
        units=units,
        parameters=parameters,
        choices=_choices(plan, archives, parameters),
        profiles=plan.profiles,
        wall_time=wall_time,
        cpu_time=cpu_time,
    )


def _choices(
    plan: Plan, archives: Mapping[str, Archive], parameters: Mapping[str, float | int | bool]
) -> dict[str, str]:
    """Names of the items that the enumeration parameters have."""
    found = {}
    for key, value in parameters.items():
        component, name = key.split(".", 1)
        items = choices(archives[plan.components[component]].variable(name))
        for item, number in items.items():
            if number == value:
                found[key] = item
    return found


def _unit(archive: Archive, name: str) -> str:
    variable = archive.variable(name)
    return str(variable.unit or getattr(variable.declaredType, "unit", None) or "")


def _check_names(plan: Plan, archives: Mapping[str, Archive]) -> None:
    for key, value in plan.parameters.items():
        component, name = key.split(".", 1)
        if component not in plan.components:
            raise ScenarioError(f"{key}: no component {component} (known: {', '.join(plan.components)})")
        archives[plan.components[component]].start_value(name, value)


def _wire(plan: Plan, parts: dict[str, Part], time: NDArray[np.float64]) -> list[Wire]:
    """Fills the profile columns of all inputs and returns the other connections."""
    order = list(parts)
    profiles = {name: profile.evaluate(segments=segments, time=time) for name, segments in plan.profiles.items()}
    wires = []
    for key, origin in plan.inputs.items():
        (to, name), (component, output) = key.split(".", 1), origin.removeprefix(MINUS).split(".", 1)
        kind, column = parts[to].input(name)
        sign = -1 if origin.startswith(MINUS) else 1
        if component == PROFILE:
            values = sign * profiles[output]
            parts[to].u[kind][:, column] = _of_kind(values, kind)
            continue
        stepped_before = order.index(component) < order.index(to)
        late = plan.coupling == "exchange_at_once" or (plan.coupling == "one_sample_delay" and key in plan.delayed)
        source, ahead = parts[component], int(stepped_before and not late)
        wires.append(Wire(kind, parts[to], column, source, source.output(output, kind), ahead, sign))
    return wires


def _of_kind(values: NDArray[np.float64], kind: Kind) -> NDArray[Any]:
    """A profile as an input of this kind takes it: a Boolean is true from a half on, an Integer the nearest one."""
    match kind:
        case "Boolean":
            return values >= TRUE_FROM
        case "Integer":
            return np.rint(values)
        case _:
            return values


def _initialize(plan: Plan, parts: dict[str, Part], wires: list[Wire]) -> None:
    for name, part in parts.items():
        for key, value in plan.parameters.items():
            component, parameter = key.split(".", 1)
            if component == name:
                part.instance.set_start(parameter, value)
        part.instance.setup_experiment(start_time=0.0, stop_time=plan.duration)
        part.instance.enter_initialization_mode()
    # Outputs after initialization depend on parameters and, through one more FMU at most, on each other.
    for _ in parts:
        for part in parts.values():
            part.read_row(0)
        for wire in wires:
            wire.target.u[wire.kind][0, wire.input] = wire.sign * wire.source.y[wire.kind][0, wire.output]
        for part in parts.values():
            part.write_row(0)
    for part in parts.values():
        part.instance.exit_initialization_mode()
        part.read_row(0)


def _run(parts: list[Part], wires: list[Wire], plan: Plan) -> None:
    """The loop: per component copy the wired inputs, set, step, get.

    The C functions have no argument types here: a call with finished ctypes objects takes a third of the time of one
    that converts four numbers. The objects live as long as the loop; only addresses and the time change in them.
    """
    t, step, no_rollback = c_double(0.0), c_double(plan.step), c_int(1)
    work = [_prepared(part, [w for w in wires if w.target is part]) for part in parts]
    for k in range(plan.steps):
        t.value = k * plan.step
        for part, component, copies, negatives, writes, do_step, reads in work:
            for target, at, width, source, output, stride in copies:
                target[k * width + at] = source[k * stride + output]
            for target, at, width, source, output, stride in negatives:
                target[k * width + at] = -source[k * stride + output]
            for name, call, references, count, address, base, size in writes:
                address.value = base + k * size
                if status := call(component, references, count, address):
                    raise _located(part.instance.fail(name, status), t.value)
            if status := do_step(component, t, step, no_rollback):
                raise _located(part.instance.fail("fmi2DoStep", status), t.value)
            for name, call, references, count, address, base, size in reads:
                address.value = base + k * size
                if status := call(component, references, count, address):
                    raise _located(part.instance.fail(name, status), t.value)


def _located(error: ExoError, t: float) -> ExoError:
    return FmuError(f"{error} (step at t = {t:.6g} s)")


def _prepared(part: Part, wires: list[Wire]) -> tuple[Any, ...]:
    """Everything that the loop needs of a component: flat views, and ctypes objects for the calls."""
    copies: list[tuple[Any, ...]] = []
    negatives: list[tuple[Any, ...]] = []
    for wire in wires:
        target, source = part.u[wire.kind], wire.source.y[wire.kind]
        width, stride = target.shape[1], source.shape[1]
        # `ahead` rows further on: part of the constant offset.
        offset = wire.ahead * stride + wire.output
        taken = negatives if wire.sign < 0 else copies
        taken.append((target.reshape(-1).data, wire.input, width, source.reshape(-1).data, offset, stride))
    writes = [_transfer(part.instance, "Set", part.inputs[kind], u, first_row=0) for kind, u in part.u.items()]
    reads = [_transfer(part.instance, "Get", part.outputs[kind], y, first_row=1) for kind, y in part.y.items()]
    component = c_void_p(part.instance.component)
    return part, component, copies, negatives, writes, part.instance.function("fmi2DoStep"), reads


def _transfer(
    instance: Instance, prefix: str, references: References, buffer: NDArray[Any], *, first_row: int
) -> tuple[Any, ...]:
    """One Set or Get call of a row per step: name, function, references, their number, address, first address, row
    size."""
    size = buffer.strides[0]
    base = buffer.ctypes.data + first_row * size
    name = f"fmi2{prefix}{references.kind}"
    addresses = c_void_p(references.address), c_size_t(references.count), c_void_p(base)
    return name, instance.function(name), *addresses, base, size
