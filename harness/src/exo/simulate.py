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
from dataclasses import dataclass
from time import perf_counter, thread_time
from typing import Any

import numpy as np
from numpy.typing import NDArray

from exo import profile
from exo.errors import ScenarioError
from exo.fmu import Archive, Instance, Kind, choices
from exo.loop import Engine, Part, Wire, run
from exo.recording import Recording
from exo.scenario import PROFILE, Case, Coupling, Scenario, Segment, Value

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


def simulate(*, plan: Plan, archives: Mapping[str, Archive], engine: Engine = "fmpy") -> Recording:
    """Runs one case. `archives` are the opened FMUs by archive name; `engine` makes the steps (`exo.loop`)."""
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
        run(list(parts.values()), wires, steps=plan.steps, step=plan.step, engine=engine)
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
        (to, name), (component, output) = key.split(".", 1), origin.split(".", 1)
        kind, column = parts[to].input(name)
        if component == PROFILE:
            values = profiles[output]
            parts[to].u[kind][:, column] = _of_kind(values, kind)
            continue
        stepped_before = order.index(component) < order.index(to)
        late = plan.coupling == "exchange_at_once" or (plan.coupling == "one_sample_delay" and key in plan.delayed)
        source, ahead = parts[component], int(stepped_before and not late)
        wires.append(Wire(kind, parts[to], column, source, source.output(output, kind), ahead))
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
            wire.target.u[wire.kind][0, wire.input] = wire.source.y[wire.kind][0, wire.output]
        for part in parts.values():
            part.write_row(0)
    for part in parts.values():
        part.instance.exit_initialization_mode()
        part.read_row(0)
