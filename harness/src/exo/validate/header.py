"""The description's head: names, capabilities, default experiment, log categories."""

from collections import Counter
from collections.abc import Iterator
from math import inf, isfinite

from exo.validate.archive import DESCRIPTION
from exo.validate.description import Description, place
from exo.validate.rule import Finding, error, warning
from exo.validate.variable import number
from exo.validate.versions import FMI3

COSIMULATION = error("head-co-simulation", "the FMU offers co-simulation, or scheduled execution of FMI 3.0")
NAME = error("head-model-name", "modelName is not empty")
IDENTIFIER = error("head-model-identifier", "modelIdentifier is a C identifier")
GUID = error("head-guid", "the guid, in FMI 3.0 the instantiationToken, is not empty")
STATE = error("head-state", "an FMU state that can be serialized can also be got and set")
MEMORY = warning(
    "head-memory", "canNotUseMemoryManagementFunctions is true: importers may give no allocator", only="2.0"
)
EXPERIMENT = warning("head-experiment", "DefaultExperiment gives startTime, stopTime, tolerance and stepSize")
EXPERIMENT_VALUES = error("head-experiment-values", "times are finite and in order, tolerance and stepSize positive")
CATEGORIES = error("head-log-categories", "log categories have names, and no two the same")
FIXED_STEP = error("head-fixed-step", "fixedInternalStepSize is finite and positive", only="3.0")
STEP = warning(
    "head-step-size",
    "without canHandleVariableCommunicationStepSize, the description says a step size that works",
    only="3.0",
)
EARLY = error(
    "head-early-return", "canReturnEarlyAfterIntermediateUpdate stands beside providesIntermediateUpdate", only="3.0"
)
EVENT_MODE = warning("head-event-mode", "an FMU with Clocks and co-simulation has event mode", only="3.0")


def findings(description: Description) -> Iterator[Finding]:
    """All of this module's rules."""
    root, version = description.root, description.version
    if not description.token.strip():
        value = f"an empty {version.token}"
        yield GUID.at(place(root, "fmiModelDescription"), value, "a text that identifies the interface")
    if not root.get("modelName", "").strip():
        yield NAME.at(place(root, "fmiModelDescription"), "an empty modelName", "the model's name")
    interface = description.interface
    if interface is None:
        only = "model exchange only" if description.first("ModelExchange") is not None else "no interface"
        expected = f"{' or '.join(version.interfaces)}; model exchange is not checked"
        yield COSIMULATION.at(place(root, "fmiModelDescription"), only, expected)
    else:
        where = place(interface, str(interface.tag))
        if description.identifier is None:
            yield IDENTIFIER.at(where, f"modelIdentifier {interface.get('modelIdentifier')!r}", "a C identifier")
        if description.capability(version.serialize) and not description.capability(version.get_state):
            yield STATE.at(where, f"{version.serialize} without {version.get_state}", "both")
        if version is FMI3:
            yield from _steps(description, where)
        elif not description.capability("canNotUseMemoryManagementFunctions"):
            yield MEMORY.at(where, "canNotUseMemoryManagementFunctions false", "true")
    yield from _experiment(description)
    names = [category.get("name", "") for category in description.all("LogCategories/Category")]
    for name, times in Counter(names).items():
        if times > 1 or not name:
            yield CATEGORIES.at(f"{DESCRIPTION} LogCategories", f"{name!r} {times} times", "each name once")


def _steps(description: Description, where: str) -> Iterator[Finding]:
    """What an FMI 3.0 interface says of its steps."""
    interface = description.interface
    if interface is None or interface.tag != "CoSimulation":
        return
    fixed = interface.get("fixedInternalStepSize")
    size = number(fixed)
    if size is not None and not 0.0 < size < inf:
        yield FIXED_STEP.at(where, f"fixedInternalStepSize {fixed}", "a finite number above 0")
    experiment = description.first("DefaultExperiment")
    told = fixed is not None or (experiment is not None and "stepSize" in experiment.attrib)
    if not told and not description.capability("canHandleVariableCommunicationStepSize"):
        yield STEP.at(where, "no step size", "fixedInternalStepSize, or stepSize in DefaultExperiment")
    early = "canReturnEarlyAfterIntermediateUpdate"
    if description.capability(early) and not description.capability("providesIntermediateUpdate"):
        yield EARLY.at(where, f"{early} without providesIntermediateUpdate", "both")
    if any(v.kind == "Clock" for v in description.variables) and not description.capability("hasEventMode"):
        yield EVENT_MODE.at(where, "Clocks, but no hasEventMode", "hasEventMode true: Clocks tick in event mode only")


def _experiment(description: Description) -> Iterator[Finding]:
    element = description.first("DefaultExperiment")
    if element is None:
        yield EXPERIMENT.at(DESCRIPTION, "no DefaultExperiment", "startTime, stopTime, tolerance, stepSize")
        return
    where = place(element, "DefaultExperiment")
    for key in ("startTime", "stopTime", "tolerance", "stepSize"):
        if key not in element.attrib:
            yield EXPERIMENT.at(where, f"no {key}", "a value")
        value = number(element.get(key))
        if value is not None and not isfinite(value):
            yield EXPERIMENT_VALUES.at(where, f"{key} {element.get(key)}", "a finite number")
        elif value is not None and key in ("tolerance", "stepSize") and value <= 0.0:
            yield EXPERIMENT_VALUES.at(where, f"{key} {element.get(key)}", "a positive number")
    start, stop = number(element.get("startTime", "0")), number(element.get("stopTime"))
    if start is not None and stop is not None and stop <= start:
        yield EXPERIMENT_VALUES.at(where, f"stopTime {stop:g}", f"later than startTime {start:g}")
