"""The FMI 3.0 twins by the names of FMI 2.0: `q[2]` is the second element of the array `q`.

fmpy loads the libraries and calls them. Its `simulate_fmu` moves no inputs of different shapes, so they are set here.
"""

import re
from collections.abc import Mapping
from contextlib import ExitStack
from math import prod
from pathlib import Path
from types import TracebackType
from typing import Any, Self

import fmpy
import numpy as np
from fmpy.fmi3 import FMU3ScheduledExecution, FMU3Slave
from numpy.typing import NDArray

from exo.extraction import Extraction
from exo.master import TRUE_FROM, Plan
from exo.profile import evaluate
from exo.scenario import PROFILE

from foreign.record import Record
from foreign.runs import Clock, Outputs

#: Functions that get and set a type.
ACCESS = {"Float64": "Float64", "Int32": "Int32", "Boolean": "Boolean", "Enumeration": "Int64", "String": "String"}
#: Value reference of the clock of a sampled model.
CLOCK = 0xFFFF_FFFE


def place(name: str) -> tuple[str, int]:
    """`segment[2].axis` → the array `segment.axis`, element 1 from 0; a scalar is its own element 0."""
    index = re.search(r"\[(\d+)\]", name)
    return (name[: index.start()] + name[index.end() :], int(index[1]) - 1) if index else (name, 0)


def expanded(variable: Any) -> list[str]:
    """Names that FMI 2.0 has for the elements, as far as the name of the array tells: `tau_a[1]`, `tau_a[2]`, …"""
    count = prod(variable.shape) if variable.shape else 0
    return [f"{variable.name}[{i + 1}]" for i in range(count)] or [variable.name]


class Twin:
    """One instance of an archive of FMI 3.0, for co-simulation or scheduled execution. Use with `with`."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self.description: Any = fmpy.read_model_description(str(path))
        self.variables = {v.name: v for v in self.description.modelVariables}
        self.outputs = [v for v in self.variables.values() if v.causality == "output" and v.type != "String"]
        #: The messages that it logged.
        self.messages: list[str] = []
        self._values: dict[str, list[Any]] = {}
        self._extraction = Extraction(path)

    def __enter__(self) -> Self:
        self._extraction.__enter__()
        scheduled = self.description.scheduledExecution
        kind = scheduled or self.description.coSimulation
        self.slave: Any = (FMU3ScheduledExecution if scheduled else FMU3Slave)(
            guid=self.description.guid,
            unzipDirectory=str(self._extraction.folder),
            modelIdentifier=kind.modelIdentifier,
            instanceName="twin",
        )
        self.slave.instantiate(
            loggingOn=True, logMessage=lambda _env, _status, _category, text: self.messages.append(text.decode())
        )
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.slave.freeInstance()
        self._extraction.close()

    def read(self, variables: list[Any]) -> dict[str, float]:
        """Values by the names of FMI 2.0, one call a type."""
        found: dict[str, float] = {}
        for kind, function in ACCESS.items():
            of_kind = [v for v in variables if v.type == kind]
            if of_kind:
                names = [name for v in of_kind for name in expanded(v)]
                get = getattr(self.slave, f"get{function}")
                values = get([v.valueReference for v in of_kind], nValues=len(names))
                found |= dict(zip(names, values, strict=True))
        return found

    def write(self, values: Mapping[str, Any]) -> None:
        """Sets variables by the names of FMI 2.0; an array is set whole, with what its other elements were set to."""
        touched = []
        for name, value in values.items():
            array, element = place(name)
            variable = self.variables[array]
            if array not in self._values:
                self._values[array] = list(self.read([variable]).values())
            whole = self._values[array]
            whole[element] = value
            touched.append(variable)
        for variable in dict.fromkeys(touched):
            setter = getattr(self.slave, f"set{ACCESS[variable.type]}")
            number = {"Float64": float, "Boolean": bool}.get(variable.type, int)
            setter([variable.valueReference], [number(value) for value in self._values[variable.name]])

    def initialize(self, end: float, values: Mapping[str, Any]) -> None:
        """Start time 0; `values` are set before."""
        self.write(values)
        self.slave.enterInitializationMode(startTime=0.0, stopTime=end)
        self.slave.exitInitializationMode()

    def step(self, t: float, step: float) -> None:
        """fmi3DoStep: no event, no early return, the whole step."""
        event, terminate, early, reached = self.slave.doStep(t, step)
        assert not any((event, terminate, early))
        assert abs(reached - (t + step)) <= 1e-9 * step + 1e-12 * t

    def activate(self, t: float) -> None:
        """fmi3ActivateModelPartition of the clock."""
        self.slave.activateModelPartition(CLOCK, t)


def outputs(rows: list[dict[str, float]]) -> Outputs:
    """Columns of rows of outputs."""
    return {name: np.array([row[name] for row in rows], dtype=np.float64) for name in rows[0]}


def by_twin(path: Path, record: Record, clock: Clock) -> Outputs:
    """The record through a twin: the outputs after each step, or after each activation of the clock."""
    first = {name: values[0] for name, values in record.inputs.items()}
    rows = []
    with Twin(path) as twin:
        advance = twin.step if twin.description.coSimulation else lambda t, _step: twin.activate(t)
        twin.initialize(record.end, record.settings | first)
        for k, (t, step) in enumerate(clock(record)):
            twin.write({name: values[k] for name, values in record.inputs.items()})
            advance(t, step)
            rows.append(twin.read(twin.outputs))
        twin.slave.terminate()
    return outputs(rows)


def system(plan: Plan, folder: Path) -> Outputs:
    """A case of a scenario with the twins, in the order of the harness at `zero_delay`: what that records."""
    assert plan.coupling == "zero_delay"
    time: NDArray[np.float64] = np.arange(plan.steps, dtype=np.float64) * np.float64(plan.step)
    given = {f"{PROFILE}.{name}": evaluate(segments=segments, time=time) for name, segments in plan.profiles.items()}
    with ExitStack() as stack:
        twins = {name: stack.enter_context(Twin(folder / archive)) for name, archive in plan.components.items()}
        last: dict[str, float] = {}

        def wired(to: str, k: int) -> dict[str, Any]:
            found: dict[str, Any] = {}
            for key, origin in plan.inputs.items():
                component, name = key.split(".", 1)
                if component == to:
                    value = given[origin][k] if origin in given else last[origin]
                    is_switch = twins[to].variables[place(name)[0]].type == "Boolean"
                    found[name] = value >= TRUE_FROM if is_switch else value
            return found

        def read(name: str) -> None:
            twin = twins[name]
            last.update({f"{name}.{key}": value for key, value in twin.read(twin.outputs).items()})

        for name, twin in twins.items():
            of_twin = {k.split(".", 1)[1]: v for k, v in plan.parameters.items() if k.split(".", 1)[0] == name}
            twin.write({key: number(twin, key, value) for key, value in of_twin.items()})
            twin.slave.enterInitializationMode(startTime=0.0, stopTime=plan.duration)
        for _ in twins:
            for name in twins:
                read(name)
            for name, twin in twins.items():
                twin.write(wired(name, 0))
        for name, twin in twins.items():
            twin.slave.exitInitializationMode()
            read(name)
        rows = [dict(last)]
        for k, t in enumerate(time):
            for name, twin in twins.items():
                twin.write(wired(name, k))
                twin.step(float(t), plan.step)
                read(name)
            rows.append(dict(last))
        discrete = {
            f"{name}.{key}": v.variability == "discrete"
            for name, twin in twins.items()
            for v in twin.outputs
            for key in expanded(v)
        }
    columns = outputs(rows)
    return {key: column[1:] if discrete[key] else column[:-1] for key, column in columns.items()}


def number(twin: Twin, name: str, value: Any) -> Any:
    """The number of an item that a scenario names."""
    variable = twin.variables[place(name)[0]]
    if isinstance(value, str):
        return next(int(item.value) for item in variable.declaredType.items if item.name == value)
    return value
