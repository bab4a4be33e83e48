"""What can be wrong of a scenario with these FMUs, found before anything runs; and what may be a slip, as notes.

`exo.scenario` has checked what the file alone can show. Here the FMUs' variables are known, and what the command line
has changed.
"""

import os
import re
from collections.abc import Iterable, Iterator, Mapping
from typing import Any

from exo import derived, dimensions, metrics
from exo.errors import FmuError, ScenarioError, close_matches
from exo.fmu import Archive, unit_of
from exo.master import Plan
from exo.paper import lookup
from exo.profile import SAME_INSTANT
from exo.scenario import DERIVED, MINUS, PROFILE, Metric, Scenario

#: By how much a ratio of two times may miss a whole number.
WHOLE = 1e-9
#: Causalities whose values a recording has.
RECORDED = ("output", "parameter", "calculatedParameter")
#: Arguments of metrics that are instants or pairs of them (s).
INSTANTS = ("after", "before", "first", "last", "at", "above_mean", "moving")


def functions(scenario: Scenario) -> None:
    """Refuses wrong functions and arguments, unknown numbers of the paper, and ratios of metrics that are not there."""
    names = set()
    for metric in scenario.metrics:
        owner = f"{scenario.id}: metric {metric.id}"
        metrics.check(function=metric.function, arguments=metric.arguments, owner=owner, components=scenario.components)
        for key in metric.paper.values():
            lookup(key)
        names |= {f"{metric.id}/{case}" for case in metric.cases or (case.id for case in scenario.cases)}
    for ratio in scenario.ratios:
        if ratio.paper:
            lookup(ratio.paper)
        for name in ratio.of:
            if name not in names:
                raise ScenarioError(f"{scenario.id}: ratio {ratio.id}: no metric {name}{close_matches(name, names)}")


def check(
    *, scenario: Scenario, plans: Mapping[str, Plan], archives: Mapping[str, Archive], shortened: bool = False
) -> None:
    """All else that can be refused. `shortened`: a window without a tick is the command line's doing, and no error."""
    for name, plan in plans.items():
        one_run(plan=plan, archives=archives, owner=f"{scenario.id}: case {name}")
    memory(owner=scenario.id, plans=plans, archives=archives)
    computed = derived.columns(scenario.derived, owner=scenario.id)
    for metric in scenario.metrics:
        for case in metric.cases or tuple(plans):
            of = {name: archives[archive] for name, archive in plans[case].components.items()}
            owner = f"{scenario.id}: metric {metric.id}: case {case}"
            for name in _texts(metric.arguments.values()):
                if name.split(".", 1)[0] in (*of, DERIVED) and "." in name:
                    _recorded(name, plans[case], of, computed, owner)
            _unit(metric, of, owner)
            if not shortened and (window := empty_window(metric, plans[case])):
                raise ScenarioError(f"{owner}: {window}")
    for case, plan in plans.items():
        of = {name: archives[archive] for name, archive in plan.components.items()}
        for name in scenario.signals:
            _recorded(name, plan, of, computed, f"{scenario.id}: signals: case {case}")
    for figure in scenario.figures:
        drawn = [(one.case, one.column) for panel in figure.panels for one in panel.curves]
        drawn += [(one.bands.case, one.bands.column) for one in figure.panels if one.bands]
        for case, name in drawn:
            of = {component: archives[archive] for component, archive in plans[case].components.items()}
            _recorded(name, plans[case], of, computed, f"{scenario.id}: figure {figure.id}: case {case}")


def one_run(*, plan: Plan, archives: Mapping[str, Archive], owner: str) -> None:
    """Refuses parameters and wires of one run that its FMUs cannot take."""
    of = {name: archives[archive] for name, archive in plan.components.items()}
    _parameters(plan, of, owner)
    _wires(plan, of, owner)


def _unit(metric: Metric, of: Mapping[str, Archive], owner: str) -> None:
    """Refuses a number that would be told in another unit than that of the column that it is taken from."""
    if metric.function not in metrics.IN_ITS_UNIT:
        return
    given = metric.arguments.get("columns", metric.arguments.get("column", ()))
    for name in [given] if isinstance(given, str) else given:
        component, _, variable = str(name).partition(".")
        if component not in of or variable not in of[component].variables:
            continue  # a derived signal
        unit = unit_of(of[component].variable(variable))
        if dimensions.names_differ(unit, metric.unit):
            raise ScenarioError(f"{owner}: unit: got {metric.unit}, and {name} is in {unit}; expected {unit}")


def empty_window(metric: Metric, plan: Plan) -> str:
    """A sentence when no tick lies in the window that a metric's arguments name, or an instant after the last tick."""
    given = {key: value for key, value in metric.arguments.items() if key in INSTANTS}
    pairs = [value for value in given.values() if isinstance(value, list | tuple) and len(value) == 2]
    if {"after", "before"} & set(given):
        pairs.append((given.get("after", 0.0), given.get("before", plan.duration)))
    for after, before in pairs:
        first = max(0, -int(-(float(after) - SAME_INSTANT) // plan.step))
        if first >= plan.steps or first * plan.step >= float(before) - SAME_INSTANT:
            run = f"0 s ≤ t < {plan.duration:g} s, every {plan.step:g} s"
            return f"no tick in {after} s ≤ t < {before} s; the run has {run}"
    for key in ("first", "last", "at"):
        if key in given and float(given[key]) > plan.duration:
            return f"{key} = {given[key]} s lies behind the end of the run, {plan.duration:g} s"
    return ""


def timing(plans: Mapping[str, Plan], archives: Mapping[str, Archive]) -> list[str]:
    """Steps and sample periods that do not fit. A sampled FMU has its period as parameter T; it reads its inputs at
    communication points, so that its ticks fall on them only when the step divides T."""
    notes: dict[str, None] = {}
    for plan in plans.values():
        for component, archive in plan.components.items():
            variable = archives[archive].variables.get("T")
            if variable is None or variable.causality != "parameter" or variable.unit != "s":
                continue
            T = float(plan.parameters.get(f"{component}.T", variable.start or 0.0))
            if T > 0.0 and abs(T / plan.step - max(1.0, round(T / plan.step))) > WHOLE * T / plan.step:
                told = "sample_period" in archives[archive].names("output")
                what = f"{component}.sample_period is what it makes of it" if told else "it ticks between steps"
                notes[f"the step {plan.step:g} s does not divide {component}.T = {T:g} s: {what}"] = None
    return list(notes)


def unwired(plans: Mapping[str, Plan], archives: Mapping[str, Archive]) -> list[str]:
    """Inputs that nothing feeds and no case sets, arrays as one: they keep the FMUs' start values."""
    found: dict[str, None] = {}
    for plan in plans.values():
        for component, archive in plan.components.items():
            for name in archives[archive].names("input"):
                key = f"{component}.{name}"
                if key not in plan.inputs and key not in plan.parameters:
                    found[re.sub(r"\[\d+\]$", "", key)] = None
    return list(found)


def _parameters(plan: Plan, of: Mapping[str, Archive], owner: str) -> None:
    for key, value in plan.parameters.items():
        component, name = key.split(".", 1)
        if component not in of:
            raise ScenarioError(f"{owner}: {key}: no component {component}{close_matches(component, of)}")
        try:
            of[component].start_value(name, value)
        except FmuError as error:
            raise FmuError(f"{owner}: {error}") from error
        if key in plan.inputs:
            raise ScenarioError(
                f"{owner}: {key} = {value} has no effect, because it is wired to {plan.inputs[key]}; "
                "expected a value or a wire, not both"
            )


def _wires(plan: Plan, of: Mapping[str, Archive], owner: str) -> None:
    for key, source in plan.inputs.items():
        to, name = key.split(".", 1)
        variable = of[to].variable(name)
        if variable.causality != "input" and variable.variability != "tunable":
            what = f"a {variable.variability} {variable.causality}"
            raise FmuError(
                f"{owner}: {of[to].path.name}: {name}: only inputs and tunables can be wired, this is {what}"
            )
        component, output = source.removeprefix(MINUS).split(".", 1)
        if variable.type == "String":
            raise FmuError(f"{owner}: {key}: a String takes no wire and no signal; expected a text, which is held")
        if source.startswith(MINUS) and variable.type != "Real":
            raise FmuError(f"{owner}: {key}: {source}: only a Real has a negative, this is of type {variable.type}")
        if component == PROFILE:
            continue
        origin = of[component].variable(output)
        kinds = [_kind(one) for one in (origin, variable)]
        if origin.causality != "output" or kinds[0] != kinds[1]:
            article = "an" if kinds[1] == "Integer" else "a"
            raise FmuError(
                f"{owner}: {key}: {of[component].path.name}: {output}: expected {article} {kinds[1]} output, "
                f"this is {origin.causality} of type {origin.type}"
            )
        if dimensions.differ(of[component], origin, of[to], variable):
            raise FmuError(
                f"{owner}: {key} is in {unit_of(variable)}, {source} in {unit_of(origin)}; expected one unit, because "
                "nothing converts it"
            )


def _kind(variable: Any) -> str:
    return "Integer" if variable.type == "Enumeration" else str(variable.type)


def memory(*, owner: str, plans: Mapping[str, Plan], archives: Mapping[str, Archive]) -> None:
    """Refuses runs whose recordings, which are in memory at once, are more than there is."""
    if not hasattr(os, "sysconf"):
        return
    there = os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE")
    wanted = sum(
        plan.steps
        * 8
        * (1 + len(plan.inputs) + sum(len(archives[a].names("output")) for a in plan.components.values()))
        for plan in plans.values()
    )
    if wanted > there:
        raise ScenarioError(
            f"{owner}: the recordings of {len(plans)} cases take {wanted / 1e9:.3g} GB; expected at most the "
            f"{there / 1e9:.3g} GB of this machine: fewer cases, a shorter duration or a longer step"
        )


def _recorded(name: str, plan: Plan, of: Mapping[str, Archive], computed: list[str], owner: str) -> None:
    component, variable = name.split(".", 1)
    if component == DERIVED:
        if name not in computed:
            raise ScenarioError(
                f"{owner}: {name}: not among the scenario's derived signals{close_matches(name, computed)}"
            )
        return
    if component not in of:
        raise ScenarioError(f"{owner}: {name}: no component {component}{close_matches(component, of)}")
    if name in plan.inputs:
        return
    known = of[component].variables
    if variable not in known:
        raise ScenarioError(
            f"{owner}: {of[component].path.name}: no variable {variable}{close_matches(variable, known)}"
        )
    if known[variable].causality not in RECORDED:
        raise ScenarioError(f"{owner}: {name} is not recorded: expected an output, a parameter or a wired input")


def _texts(values: Iterable[Any]) -> Iterator[str]:
    for value in values:
        if isinstance(value, str):
            yield value
        elif isinstance(value, list | tuple):
            yield from _texts(value)
