"""What the process that runs a library is told of the FMU: files, times, variables, by the keys of `exo.probe`."""

from math import isfinite
from pathlib import Path
from typing import Any

from exo.validate.description import Description
from exo.validate.values import bounds
from exo.validate.variable import Variable, number
from exo.validate.versions import FLOATS, FMI2

#: Outputs that are compared, and inputs and parameters that are moved, at most.
MOST = 20_000


def of(description: Description, library: Path, resources: Path) -> dict[str, Any]:
    """The task for any run; what is done with it comes from the caller."""
    start, step = times(description)
    interface = "CoSimulation" if description.interface is None else str(description.interface.tag)
    # Clocked variables may be set before their Clock ticks and read after it: in scheduled execution, at each step.
    ticks = interface == "ScheduledExecution"
    variables = [v for v in description.variables if is_read(description, v, clocked=ticks)]
    outputs = [v for v in variables if v.causality == "output"]
    floats = [v for v in variables if v.kind in FLOATS]
    folder = resources.resolve()
    return {
        "version": description.version.name,
        "interface": interface,
        "library": str(library),
        "guid": description.token,
        # FMI 2.0 wants a URI, FMI 3.0 a path that ends with a separator.
        "resources": folder.as_uri() if description.version is FMI2 else f"{folder}/",
        "start": start,
        "step": step,
        "clocks": _clocks(description)[0],
        "once": description.capability("canBeInstantiatedOnlyOncePerProcess"),
        "variable step": description.capability("canHandleVariableCommunicationStepSize"),
        "early return": description.capability("canReturnEarlyAfterIntermediateUpdate"),
        "may return early": description.capability("mightReturnEarlyFromDoStep"),
        "categories": [category.get("name", "") for category in description.all("LogCategories/Category")],
        "outputs": [read(description, v) for v in outputs[:MOST]],
        "told": [read(description, v) for v in variables if v.causality not in ("local", "independent")][:MOST],
        "inputs": [_moved(description, v) for v in floats if v.causality == "input" and v.starts][:MOST],
        "parameters": [_moved(description, v) for v in floats if v.causality == "parameter" and v.starts][:MOST],
    }


def times(description: Description) -> tuple[float, float]:
    """Start time and step size of a run, in s."""
    experiment = description.first("DefaultExperiment")
    given = {} if experiment is None else {key: number(str(value)) for key, value in experiment.attrib.items()}
    start = given.get("startTime") or 0.0
    clocked = _clocks(description)[1]
    fixed = None if description.interface is None else number(description.interface.get("fixedInternalStepSize"))
    stop = given.get("stopTime")
    share = None if stop is None else (stop - start) / 100.0
    sizes = (clocked, given.get("stepSize"), fixed, share)
    step = next((size for size in sizes if size is not None and 0.0 < size < 1e6), 1e-3)
    return (start if isfinite(start) else 0.0), step


def is_read(description: Description, variable: Variable, *, clocked: bool = False) -> bool:
    """Whether it can be read at any time: Clocks cannot, and what they clock only when they tick."""
    readable = variable.kind not in ("", "Clock") and variable.reference is not None
    return readable and (clocked or not variable.clocked) and description.size(variable) is not None


def read(description: Description, variable: Variable) -> list[Any]:
    """A variable to be read: position, kind as in the functions' names, reference, number of elements, name."""
    kind = (
        {"2.0": "Integer", "3.0": "Int64"}[variable.version.name] if variable.kind == "Enumeration" else variable.kind
    )
    return [variable.index, kind, variable.reference, description.size(variable), variable.name]


def _moved(description: Description, variable: Variable) -> list[Any]:
    """A floating-point variable to be set near its start value, within its bounds."""
    size = description.size(variable) or 1
    starts = [number(text) or 0.0 for text in variable.starts or ()]
    nominal = number(variable.type.get("nominal"))
    scale = abs(nominal) if nominal is not None and isfinite(nominal) else 1.0
    return [*read(description, variable), (starts * size)[:size], *bounds(variable), scale]


def _clocks(description: Description) -> tuple[list[int], float | None]:
    """Of scheduled execution: references of the input Clocks with the shortest interval, by priority, and this one."""
    if description.interface is None or description.interface.tag != "ScheduledExecution":
        return [], None
    clocks = [
        (interval, number(v.type.get("priority")) or 0.0, v.reference)
        for v in description.variables
        if v.kind == "Clock" and v.causality == "input" and (interval := number(v.type.get("intervalDecimal")))
    ]
    shortest = min((interval for interval, _, _ in clocks), default=None)
    found = sorted(
        (priority, reference)
        for interval, priority, reference in clocks
        if interval == shortest and reference is not None
    )
    return [reference for _, reference in found], shortest
