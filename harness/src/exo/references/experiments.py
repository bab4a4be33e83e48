"""`*.exp`: experiments as MA-HS-Experiments has them, in both its forms.

The draft once had start time, stop time and step size at `Experiment`. Now they stand at its child
`TransientSimulation`, beside which there are kinds of analysis that are no simulation.
"""

from dataclasses import dataclass
from typing import Any

from exo.references.manifest import resolve
from exo.references.names import CSV_TYPE, SSV_TYPE
from exo.references.xml import children, local, located, number, parse
from exo.validate import references as rules
from exo.validate.rule import Finding

TRANSIENT = "TransientSimulation"
#: Named by the format; nothing says how they are run.
OTHERS = (
    "SteadyState",
    "ParameterOptimization",
    "SetPointOptimization",
    "SensitivityAnalysis",
    "TrajectoryOptimization",
    "Linearization",
)
TIMES = ("startTime", "stopTime", "stepSize")


@dataclass(frozen=True)
class File:
    """A file that an experiment needs."""

    type: str
    #: Path in the archive; None where the address is absolute.
    path: str | None
    source: str
    where: str


@dataclass(frozen=True)
class Experiment:
    """One experiment; what it does not state is None (times in s)."""

    name: str
    kind: str
    start: float | None
    stop: float | None
    step: float | None
    tolerance: float | None
    parameters: File | None
    stimuli: File | None
    references: File | None
    where: str


def read(data: bytes, where: str) -> tuple[list[Experiment], list[Finding]]:
    """The experiments that can be understood, and what is wrong with the others."""
    root, found = parse(data, where)
    if root is None:
        return [], found
    if local(root) != "Experiments":
        return [], [rules.EXPERIMENT.at(located(where, root), local(root), "the root Experiments")]
    if not root.get("name"):
        found.append(rules.EXPERIMENT.at(located(where, root), "Experiments without name", "a name"))
    experiments = []
    for element in children(root, "Experiment"):
        broken = _broken(element, where)
        found += broken
        if not broken:
            experiments.append(_experiment(element, where))
    if not children(root, "Experiment"):
        found.append(rules.EXPERIMENT.at(located(where, root), "no Experiment", "one at least"))
    names = [one.name for one in experiments]
    found += [
        rules.EXPERIMENT.at(one.where, f"a second experiment {one.name}", "a name of its own")
        for i, one in enumerate(experiments)
        if one.name in names[:i]
    ]
    return experiments, found


def _settings(element: Any) -> Any:
    """Where the times stand."""
    return next(iter(children(element, TRANSIENT)), element)


def _broken(element: Any, where: str) -> list[Finding]:
    def at(value: str, expected: str) -> Finding:
        return rules.EXPERIMENT.at(located(where, element), value, expected)

    found = []
    if not element.get("name"):
        found.append(at("Experiment without name", "a name"))
    kinds = [local(child) for child in element if local(child) in (TRANSIENT, *OTHERS)]
    if len(kinds) > 1:
        found.append(at(f"{' and '.join(kinds)}", "one kind of analysis"))
    stated = {name: _settings(element).get(name) for name in TIMES} | {"tolerance": element.get("tolerance")}
    values = {name: number(text) for name, text in stated.items()}
    found += [
        at(f"{name} {text!r}", "a finite number")
        for name, text in stated.items()
        if text is not None and values[name] is None
    ]
    start, stop, step, tolerance = (values[name] for name in (*TIMES, "tolerance"))
    if stop is not None and not stop > (start or 0.0):
        found.append(at(f"stopTime {stop:g} s", f"one after startTime, {start or 0.0:g} s"))
    if step is not None and not step > 0.0:
        found.append(at(f"stepSize {step:g} s", "one above 0"))
    if tolerance is not None and not tolerance >= 0.0:
        found.append(at(f"tolerance {tolerance:g}", "0 or more"))
    for name in ("Parameters", "Stimuli", "References"):
        there = children(element, name)
        if len(there) > 1:
            found.append(at(f"{len(there)} elements {name}", "one at most"))
        found += [at(f"{name} without source", "the file's address") for one in there if not one.get("source")]
    return found


def _experiment(element: Any, where: str) -> Experiment:
    def file(name: str, kind: str) -> File | None:
        for one in children(element, name):
            source = one.get("source")
            return File(one.get("type", kind), resolve(where, source), source, located(where, one))
        return None

    settings = _settings(element)
    return Experiment(
        name=element.get("name"),
        kind=next((local(child) for child in element if local(child) in OTHERS), TRANSIENT),
        start=number(settings.get("startTime")),
        stop=number(settings.get("stopTime")),
        step=number(settings.get("stepSize")),
        tolerance=number(element.get("tolerance")),
        parameters=file("Parameters", SSV_TYPE),
        stimuli=file("Stimuli", CSV_TYPE),
        references=file("References", CSV_TYPE),
        where=located(where, element),
    )
