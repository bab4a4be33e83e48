"""Clocks of FMI 3.0, and attributes that lead from one variable to another: clocks, previous, derivative."""

from collections.abc import Iterator

from exo.validate.description import Description
from exo.validate.rule import Finding, error
from exo.validate.variable import Variable, integers, number
from exo.validate.versions import FLOATS

CLOCKS = error(
    "clock-reference",
    "the attribute clocks lists value references of Clocks, at discrete or tunable variables",
    only="3.0",
)
CAUSALITY = error(
    "clock-causality", "a Clock is input, output or local, and discrete; an output Clock is triggered", only="3.0"
)
INTERVAL = error(
    "clock-interval",
    "a Clock's interval fits its intervalVariability: constant needs one, aperiodic and triggered have none",
    only="3.0",
)
PREVIOUS = error(
    "previous-reference",
    "previous leads from a clocked discrete variable to another discrete one of its kind, not an input, once",
    only="3.0",
)
DERIVATIVE = error(
    "derivative-reference", "derivative leads from a float variable to another one of the same size", only="3.0"
)

PERIODIC = ("constant", "fixed", "tunable")
#: Attributes that say or refine an interval.
TIMES = ("intervalDecimal", "intervalCounter", "resolution", "shiftDecimal", "shiftCounter")


def findings(description: Description) -> Iterator[Finding]:
    """All of this module's rules."""
    seen: dict[int, Variable] = {}
    for variable in description.variables:
        if variable.clocked:
            yield from _clocks(description, variable)
        if variable.kind == "Clock":
            yield from _clock(variable)
        if "previous" in variable.own:
            yield from _previous(description, variable, seen)
        if "derivative" in variable.own:
            yield from _derivative(description, variable)


def _clocks(description: Description, variable: Variable) -> Iterator[Finding]:
    references = integers(variable.own["clocks"])
    if not references:
        yield CLOCKS.at(variable.where, f"clocks {variable.own['clocks']!r}", "value references of Clocks")
    for reference in references or ():
        clock = description.by_reference.get(reference)
        if clock is None or clock.kind != "Clock" or clock is variable:
            other = "no variable" if clock is None else f"{clock.kind} {clock.name}"
            yield CLOCKS.at(variable.where, f"clocks: {reference} is {other}", "another variable, a Clock")
    if variable.variability not in ("discrete", "tunable"):
        yield CLOCKS.at(variable.where, f"a clocked variable is {variable.variability}", "discrete or tunable")


def _clock(variable: Variable) -> Iterator[Finding]:
    given = variable.type
    kind = given.get("intervalVariability", "")
    if variable.causality not in ("input", "output", "local") or variable.variability != "discrete":
        value = f"{variable.variability} with causality {variable.causality}"
        yield CAUSALITY.at(variable.where, value, "discrete, and input, output or local")
    elif variable.causality == "output" and kind != "triggered":
        yield CAUSALITY.at(variable.where, f"an output Clock is {kind or 'nothing'}", "triggered")
    for wrong, expected in _interval(variable, kind):
        yield INTERVAL.at(variable.where, wrong, expected)


def _interval(variable: Variable, kind: str) -> Iterator[tuple[str, str]]:
    """What is wrong with a Clock's interval, and what is expected."""
    given = variable.type
    if kind not in PERIODIC:
        for name in TIMES:
            # Those of a default that says nothing may stand.
            if name in given and not (name.startswith("shift") and number(given[name]) == 0.0):
                yield f"{name} {given[name]} at a Clock that is {kind or 'nothing'}", "no such attribute"
        return
    if kind == "constant" and "intervalDecimal" not in given:
        yield "constant without intervalDecimal", "intervalDecimal"
    for name in ("intervalDecimal", "intervalCounter", "resolution"):
        value = number(given.get(name))
        if value is not None and not value > 0.0:
            yield f"{name} {given[name]}", "above 0"
    for name in ("shiftDecimal", "shiftCounter"):
        value = number(given.get(name))
        if value is not None and not value >= 0.0:
            yield f"{name} {given[name]}", "0 or more"
        needed = name.replace("shift", "interval")
        if value is not None and value > 0.0 and needed not in given:
            yield f"{name} without {needed}", needed
    if "intervalCounter" in given:
        if given.get("supportsFraction") not in ("true", "1"):
            yield "intervalCounter without supportsFraction", "supportsFraction true"
        if "resolution" not in given:
            yield "intervalCounter without resolution", "resolution"


def _previous(description: Description, variable: Variable, seen: dict[int, Variable]) -> Iterator[Finding]:
    references = integers(variable.own["previous"]) or []
    before = description.by_reference.get(references[0]) if len(references) == 1 else None
    if before is None or before is variable:
        other = "no variable" if before is None else "itself"
        yield PREVIOUS.at(variable.where, f"previous {variable.own['previous']} is {other}", "another variable")
        return
    if not variable.clocked or variable.variability != "discrete" or variable.kind == "Clock":
        value = f"a {variable.variability} {variable.kind}{'' if variable.clocked else ' without clocks'}"
        yield PREVIOUS.at(variable.where, value, "a clocked discrete variable that is no Clock")
    if before.kind != variable.kind or before.variability != "discrete" or before.causality == "input":
        value = f"{before.name} is a {before.variability} {before.kind} with causality {before.causality}"
        yield PREVIOUS.at(variable.where, value, f"a discrete {variable.kind} that is no input")
    other_user = seen.setdefault(references[0], variable)
    if other_user is not variable:
        yield PREVIOUS.at(variable.where, f"previous {before.name}, as {other_user.name}", "another variable")


def _derivative(description: Description, variable: Variable) -> Iterator[Finding]:
    references = integers(variable.own["derivative"]) or []
    base = description.by_reference.get(references[0]) if len(references) == 1 else None
    if base is None or base is variable or base.kind not in FLOATS:
        other = "no variable" if base is None else f"{base.kind} {base.name}"
        yield DERIVATIVE.at(variable.where, f"derivative {variable.own['derivative']} is {other}", "a float variable")
    elif description.size(base) != description.size(variable):
        value = f"{description.size(variable)} elements, {base.name} has {description.size(base)}"
        yield DERIVATIVE.at(variable.where, value, "as many as its variable")
