"""The description's head: names, capabilities, default experiment, log categories."""

from collections import Counter
from collections.abc import Iterator
from math import isfinite

from exo.validate.archive import DESCRIPTION
from exo.validate.description import Description, number, place
from exo.validate.rule import Finding, error, warning

COSIMULATION = error("head-co-simulation", "the FMU offers co-simulation")
IDENTIFIER = error("head-model-identifier", "modelIdentifier is a C identifier")
GUID = error("head-guid", "the guid is not empty")
STATE = error("head-state", "an FMU state that can be serialized can also be got and set")
MEMORY = warning("head-memory", "canNotUseMemoryManagementFunctions is true: importers may give no allocator")
EXPERIMENT = warning("head-experiment", "DefaultExperiment gives startTime, stopTime, tolerance and stepSize")
EXPERIMENT_VALUES = error("head-experiment-values", "times are finite and in order, tolerance and stepSize positive")
CATEGORIES = error("head-log-categories", "log categories have names, and no two the same")

TRUE = ("true", "1")


def findings(description: Description) -> Iterator[Finding]:
    """All of this module's rules."""
    root = description.root
    if not root.get("guid", "").strip():
        yield GUID.at(place(root, "fmiModelDescription"), "an empty guid", "a text that identifies the interface")
    slave = description.first("CoSimulation")
    if slave is None:
        only = "model exchange only" if description.first("ModelExchange") is not None else "no interface"
        yield COSIMULATION.at(place(root, "fmiModelDescription"), only, "CoSimulation; model exchange is not checked")
    else:
        where = place(slave, "CoSimulation")
        if description.identifier is None:
            yield IDENTIFIER.at(where, f"modelIdentifier {slave.get('modelIdentifier')!r}", "a C identifier")
        if slave.get("canSerializeFMUstate") in TRUE and slave.get("canGetAndSetFMUstate") not in TRUE:
            yield STATE.at(where, "canSerializeFMUstate without canGetAndSetFMUstate", "both")
        if slave.get("canNotUseMemoryManagementFunctions") not in TRUE:
            yield MEMORY.at(where, "canNotUseMemoryManagementFunctions false", "true")
    yield from _experiment(description)
    names = [category.get("name", "") for category in description.all("LogCategories/Category")]
    for name, times in Counter(names).items():
        if times > 1 or not name:
            yield CATEGORIES.at(f"{DESCRIPTION} LogCategories", f"{name!r} {times} times", "each name once")


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
