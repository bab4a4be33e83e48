"""The master: wires FMUs, initializes them, lets them step in order, records every tick.

Each component has one row of outputs per communication point: row 0 after initialization, row k+1 after step k. An
input of step k reads its source from row k or from row k+1; this alone is what a coupling decides:

* `zero_delay`: the components step one after the other, and each sees what those before it have just put out: the
  plant gets the torque of this tick, the controller the position at t_k. Row k+1 of components before it, row k of the
  others.
* `one_sample_delay`: the same, except that the scenario's `delayed` inputs read row k: the torque comes one tick later,
  and the first one is what the controller shows after initialization, zero.
* `exchange_at_once`: all outputs are read, all inputs are set, all components step. Row k for every connection.
"""

from collections.abc import Collection, Iterator, Mapping
from contextlib import ExitStack
from dataclasses import dataclass
from time import perf_counter, thread_time
from types import TracebackType
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray

from exo import loop, profile
from exo.errors import ExoError, FmuError, ScenarioError
from exo.fmu import DTYPES, Archive, Instance, Kind, References, choices, unit_of
from exo.loop import Engine, Part, Wire, Work
from exo.pace import Pace
from exo.plan import Plan
from exo.recording import Recording
from exo.scenario import MINUS, PROFILE, Value

#: A profile's value from which on the Boolean input that it drives is true.
TRUE_FROM = 0.5


class NotKeptError(ExoError):
    """A column that the run could have recorded and was told not to."""

    def __init__(self, name: str) -> None:
        super().__init__(f"{name} is not kept")
        self.name = name


class Columns(Mapping[str, NDArray[Any]]):
    """Recorded columns, each taken from the buffers when it is first asked for. Valid until the next run."""

    def __init__(self, parts: Mapping[str, Part], names: Collection[str]) -> None:
        self._parts = parts
        self._names = names
        self._taken: dict[str, NDArray[Any]] = {}

    def __getitem__(self, name: str) -> NDArray[Any]:
        if name not in self._taken:
            if name not in self._names:
                raise KeyError(name)
            component, variable = name.split(".", 1)
            try:
                self._taken[name] = self._parts[component].column(variable)
            except KeyError:
                raise NotKeptError(name) from None
        return self._taken[name]

    def __contains__(self, name: object) -> bool:
        return name in self._names

    def __iter__(self) -> Iterator[str]:
        return iter(self._names)

    def __len__(self) -> int:
        return len(self._names)

    @property
    def taken(self) -> set[str]:
        """Names of the columns that somebody has asked for."""
        return set(self._taken)


@dataclass(frozen=True)
class Saved:
    """FMU states by component, the number of the step that comes next, and the parameters as they then were."""

    states: Mapping[str, int]
    next: int
    parameters: Mapping[str, float | int | bool]


class Coupled:
    """The instances of a case, wired; each is freed at the end of `with`. Runs as often as it is started."""

    def __init__(self, plan: Plan, archives: Mapping[str, Archive], *, kept: Collection[str] | None = None) -> None:
        """`archives` are the opened FMUs by archive name.

        `kept` are the outputs, by `component.name`, that are recorded besides those that wires carry; None: all.
        """
        _check_names(plan, archives)
        self._archives = {name: archives[archive] for name, archive in plan.components.items()}
        self._kept = kept
        self._stack = ExitStack()
        self._plan = plan
        self._parts: dict[str, Part] = {}
        self._wires: list[Wire] = []
        #: What the loop does with both; None, where buffers or wires have changed since.
        self._work: list[Work] | None = None
        self._used = False
        self._next = 0
        self._parameters: dict[str, float | int | bool] = {}
        #: What stays from run to run: how parameters are read, which of them are choices, what can be recorded.
        self._read: list[tuple[Instance, References, list[str], NDArray[Any]]] = []
        self._items: dict[str, dict[int, str]] = {}
        self._units: dict[bool, dict[str, str]] = {}
        self._wired: tuple[Any, ...] | None = None
        self._wall_time = self._cpu_time = 0.0

    def __enter__(self) -> Self:
        with ExitStack() as stack:
            for name, archive in self._archives.items():
                inputs = [key.split(".", 1)[1] for key in self._plan.inputs if key.split(".", 1)[0] == name]
                outputs = [one for one in archive.names("output") if self._is_kept(f"{name}.{one}")]
                outputs += [key.split(".", 1)[1] for key in self._plan.recorded if key.split(".", 1)[0] == name]
                instance = stack.enter_context(Instance(archive, name))
                self._parts[name] = Part(instance, inputs=inputs, outputs=outputs, steps=self._plan.steps)
                for kind, refs in instance.references(archive.names("parameter")).items():
                    if refs:
                        buffer = np.zeros(refs.count, dtype=DTYPES[kind])
                        self._read.append((instance, refs, [f"{name}.{one}" for one in refs.names], buffer))
                for one in archive.names("parameter"):
                    items = choices(archive.variable(one))
                    if items:
                        self._items[f"{name}.{one}"] = {number: item for item, number in items.items()}
            self._stack = stack.pop_all()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._stack.__exit__(kind, error, trace)

    def _is_kept(self, name: str) -> bool:
        wired = {source.removeprefix(MINUS) for source in self._plan.inputs.values()}
        return self._kept is None or name in self._kept or name in wired

    def start(self, plan: Plan) -> None:
        """Sets parameters and inputs and initializes, after a reset if it has run before. `plan` differs from the first
        one in parameters, profiles, duration and step alone."""
        if self._used:
            for part in self._parts.values():
                part.instance.reset()
        if plan.steps != self._plan.steps:
            for part in self._parts.values():
                part.resize(plan.steps)
            self._work = None
        self._plan, self._used, self._next = plan, True, 0
        # Profiles stay in the buffers, wires lead to them.
        wired = (plan.steps, plan.step, plan.profiles, plan.coupling)
        if wired != self._wired:
            self._wires = _wire(plan, self._parts, self.time)
            self._wired, self._work = wired, None
        _initialize(plan, self._parts, self._wires)
        self._parameters = {}
        for instance, refs, names, buffer in self._read:
            instance.read(refs, buffer)
            values = buffer.astype(bool) if refs.kind == "Boolean" else buffer
            self._parameters.update(zip(names, values.tolist(), strict=True))
        self._wall_time = self._cpu_time = 0.0

    @property
    def time(self) -> NDArray[np.float64]:
        """The instants at which the steps begin (s)."""
        return np.arange(self._plan.steps, dtype=np.float64) * np.float64(self._plan.step)

    def advance(self, *, until: int | None = None, engine: Engine = "fmpy", pace: Pace | None = None) -> None:
        """Makes the steps up to number `until`, or all that are left; with `pace` by the clock."""
        end = self._plan.steps if until is None else min(until, self._plan.steps)
        began = perf_counter(), thread_time()
        if self._work is None:
            self._work = loop.work(list(self._parts.values()), self._wires)
        loop.run(self._work, first=self._next, steps=end, step=self._plan.step, engine=engine, pace=pace)
        self._wall_time += perf_counter() - began[0]
        self._cpu_time += thread_time() - began[1]
        self._next = end

    def save(self) -> "Saved":
        """The FMU states at the present step, to go on from with `restore`. FmuError, if an FMU has none."""
        states: dict[str, int] = {}
        for name, part in self._parts.items():
            if not self._archives[name].description.coSimulation.canGetAndSetFMUstate:
                self.free(Saved(states, self._next, dict(self._parameters)))
                raise FmuError(
                    f"{self._archives[name].path.name}: cannot save its state; expected canGetAndSetFMUstate"
                )
            states[name] = part.instance.get_state()
        return Saved(states, self._next, dict(self._parameters))

    def restore(self, saved: "Saved") -> None:
        """Back to what `save` has kept, of this very object. What was recorded before stays."""
        for name, part in self._parts.items():
            part.instance.set_state(saved.states[name])
        self._next = saved.next
        self._parameters = dict(saved.parameters)

    def free(self, saved: "Saved") -> None:
        """Gives back the memory of what `save` has kept."""
        for name, state in saved.states.items():
            self._parts[name].instance.free_state(state)

    def set(self, key: str, value: Value) -> None:
        """Sets a tunable parameter or an input, `component.name`, during a run."""
        component, name = key.split(".", 1)
        instance = self._parts[component].instance
        instance.set_start(name, value)
        if instance.archive.variable(name).causality == "parameter":
            self._parameters[key] = instance.values([name])[name]

    def feed(self, key: str, first: int, values: NDArray[np.float64]) -> None:
        """Gives an input that a profile feeds other values for the steps from number `first` on."""
        component, name = key.split(".", 1)
        kind, column = self._parts[component].input(name)
        self._parts[component].u[kind][first : first + len(values), column] = _of_kind(values, kind)

    def shown(self, key: str, point: int) -> float:
        """An output at communication point `point`: 0 is after initialization, k + 1 after step k."""
        component, name = key.split(".", 1)
        part = self._parts[component]
        for kind, refs in part.outputs.items():
            if name in refs.names:
                return float(part.y[kind][point, refs.names.index(name)])
        raise NotKeptError(key)

    def terminate(self) -> None:
        """fmi2Terminate of all."""
        for part in self._parts.values():
            part.instance.terminate()

    def recording(self, *, lazily: bool = False) -> Recording:
        """What has been recorded. `lazily`: columns are taken when they are asked for, before the next run."""
        if lazily not in self._units:
            self._units[lazily] = {
                key: unit_of(self._archives[key.split(".", 1)[0]].variable(key.split(".", 1)[1]))
                for key in self._names(everything=lazily)
            }
        units = self._units[lazily]
        columns: Mapping[str, NDArray[Any]] = Columns(self._parts, units)
        return Recording(
            time=self.time,
            columns=columns if lazily else dict(columns),
            units=units,
            parameters=self._parameters,
            choices={
                key: items[int(self._parameters[key])]
                for key, items in self._items.items()
                if self._parameters[key] in items
            },
            profiles=self._plan.profiles,
            wall_time=self._wall_time,
            cpu_time=self._cpu_time,
        )

    def _names(self, *, everything: bool) -> list[str]:
        """Names of the columns that are kept, or that could be."""
        if not everything:
            return [f"{name}.{key}" for name, part in self._parts.items() for key in part.recorded]
        outputs = [f"{name}.{key}" for name, archive in self._archives.items() for key in archive.names("output")]
        return list(dict.fromkeys([*outputs, *self._plan.inputs]))


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
    own: dict[str, dict[str, Value]] = {}
    for key, value in plan.parameters.items():
        component, variable = key.split(".", 1)
        own.setdefault(component, {})[variable] = value
    for name, part in parts.items():
        part.instance.set_starts(own.get(name, {}))
        part.instance.setup_experiment(start_time=0.0, stop_time=plan.steps * plan.step)
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
