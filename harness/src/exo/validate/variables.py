"""Variables: names, references, start values, bounds, types."""

import re
from collections import Counter, defaultdict
from collections.abc import Iterator
from itertools import count
from math import isfinite, isnan

from exo.validate.description import Description, Variable, listed, number, place
from exo.validate.rule import Finding, error, warning

CASE = warning("variable-case", "names stay unique when case is folded")
NAME = error("variable-name", "names are neither empty nor padded with blanks, and have no control characters")
ARRAY = warning("variable-array", "the elements of an array are numbered from 1 without a gap and share kind and unit")
DESCRIBED = warning("variable-description", "every variable has a description")
EXPLICIT = error("variable-variability", "all kinds but Real give their variability: the default is continuous")
INITIAL = error("variable-input-initial", "inputs and the independent variable have no attribute initial")
TIME = warning("variable-independent", "there is no independent variable: it is legal, but importers log errors for it")
MULTIPLE = error(
    "variable-multiple-set", "canHandleMultipleSetPerTimeInstant stands at inputs only, and only with model exchange"
)
REFERENCE = error("variable-reference", "valueReference is an unsigned 32-bit number")
ALIAS = error(
    "variable-alias",
    "of the variables that share a reference one at most has a start value, and all are constant or none",
)
ALIAS_UNIT = error("variable-alias-unit", "variables that share a reference share their unit")
START_KIND = error("variable-start-kind", "a start value is of the variable's kind")
START_FINITE = error("variable-start-finite", "a start value is finite")
START_RANGE = error("variable-start-range", "a start value lies within min and max")
START_ITEM = error("variable-start-item", "an Enumeration's start value is one of its items")
START_CALCULATED = error("variable-start-calculated", "a calculated variable has no start value, not even an empty one")
BOUNDS = error("variable-bounds", "min is at most max")
NOMINAL = error("variable-nominal", "nominal is not zero")
DISPLAY = error("variable-display-unit", "a displayUnit stands beside a unit")
TYPE = error("variable-type", "declaredType names a SimpleType of the same kind")
TYPE_NAME = error("type-name", "names of types differ from each other and from the variables' names")
TYPE_ITEMS = error("type-items", "items of an Enumeration differ in name and value")

INTEGER = re.compile(r"\s*[+-]?[0-9]{1,20}\s*")
ELEMENT = re.compile(r"(?P<array>.+)\[(?P<index>[0-9]{1,9})\](?P<rest>[^\[\]]*)")


def findings(description: Description) -> Iterator[Finding]:
    """All of this module's rules."""
    model_exchange = description.first("ModelExchange") is not None
    for variable in description.variables:
        yield from _names(variable)
        yield from _attributes(variable, model_exchange=model_exchange)
        yield from _values(description, variable)
        yield from _type(description, variable)
    yield from _folded(description)
    yield from _arrays(description)
    yield from _aliases(description)
    yield from _types(description)


def _names(variable: Variable) -> Iterator[Finding]:
    name = variable.name
    if not name or name != name.strip() or not name.isprintable():
        yield NAME.at(variable.where, repr(name), "a name without control characters")
    if not variable.own.get("description", "").strip():
        yield DESCRIBED.at(variable.where, "no description", "a sentence")


def _attributes(variable: Variable, *, model_exchange: bool) -> Iterator[Finding]:
    own = variable.own
    if variable.kind not in ("Real", "") and "variability" not in own:
        yield EXPLICIT.at(
            variable.where, f"{variable.kind} without variability", "constant, fixed, tunable or discrete"
        )
    if variable.causality in ("input", "independent") and "initial" in own:
        yield INITIAL.at(variable.where, f"initial {own['initial']}", f"none for causality {variable.causality}")
    if variable.causality == "independent":
        yield TIME.at(variable.where, "causality independent", "no such variable")
    if "canHandleMultipleSetPerTimeInstant" in own:
        if variable.causality != "input":
            yield MULTIPLE.at(variable.where, f"causality {variable.causality}", "input")
        elif not model_exchange:
            yield MULTIPLE.at(variable.where, "there is no ModelExchange", "no canHandleMultipleSetPerTimeInstant")
    reference = own.get("valueReference", "")
    if not INTEGER.fullmatch(reference) or not 0 <= int(reference) < 1 << 32:
        yield REFERENCE.at(variable.where, f"valueReference {reference!r}", "0 to 4294967295")


def _values(description: Description, variable: Variable) -> Iterator[Finding]:
    start, kind = variable.type.get("start"), variable.kind
    if start is not None and variable.initial == "calculated":
        yield START_CALCULATED.at(variable.where, f"start {start!r}", "none, as initial is calculated")
    low, high = number(variable.type.get("min")), number(variable.type.get("max"))
    if low is not None and high is not None and not low <= high:
        yield BOUNDS.at(variable.where, f"min {low:.17g}, max {high:.17g}", "min ≤ max")
    if number(variable.type.get("nominal")) == 0.0:
        yield NOMINAL.at(variable.where, "nominal 0", "the magnitude of the variable")
    if start is None or kind in ("String", ""):
        return
    if kind == "Boolean":
        if start.strip() not in ("true", "false", "0", "1"):
            yield START_KIND.at(variable.where, f"start {start!r}", "true or false")
        return
    value = number(start)
    if value is None or (kind != "Real" and not INTEGER.fullmatch(start)):
        yield START_KIND.at(variable.where, f"start {start!r}", f"a value of kind {kind}")
    elif not isfinite(value):
        yield START_FINITE.at(variable.where, f"start {start}", "a finite number")
    elif kind != "Real" and not -(1 << 31) <= int(start) < 1 << 31:
        yield START_KIND.at(variable.where, f"start {start}", "a 32-bit integer")
    else:
        if (low is not None and value < low) or (high is not None and value > high):
            yield START_RANGE.at(variable.where, f"start {start}", _range(low, high))
        if kind == "Enumeration" and int(value) not in description.items(variable):
            yield START_ITEM.at(variable.where, f"start {start}", f"one of {listed(description.items(variable))}")


def _range(low: float | None, high: float | None) -> str:
    bounds = [f"≥ {low:.17g}" if low is not None else "", f"≤ {high:.17g}" if high is not None else ""]
    return " and ".join(bound for bound in bounds if bound)


def _type(description: Description, variable: Variable) -> Iterator[Finding]:
    if "displayUnit" in variable.type and "unit" not in variable.type:
        yield DISPLAY.at(variable.where, f"displayUnit {variable.type['displayUnit']} without unit", "a unit")
    name = variable.type.get("declaredType")
    if name is None:
        if variable.kind == "Enumeration":
            yield TYPE.at(variable.where, "no declaredType", "the Enumeration's type")
        return
    declared = description.types.get(name)
    if declared is None:
        yield TYPE.at(variable.where, f"declaredType {name}", "a SimpleType of this name")
    elif variable.kind not in declared.kinds:
        yield TYPE.at(variable.where, f"declaredType {name}", f"a SimpleType of kind {variable.kind}")


def _folded(description: Description) -> Iterator[Finding]:
    first: dict[str, Variable] = {}
    for variable in description.variables:
        other = first.setdefault(variable.name.casefold(), variable)
        if other is not variable:
            where = f"also {other.where}: {other.name}" if other.name != variable.name else f"also {other.where}"
            yield CASE.at(variable.where, where, "names that differ by more than case")


def _arrays(description: Description) -> Iterator[Finding]:
    arrays: dict[tuple[str, str], dict[int, Variable]] = defaultdict(dict)
    for variable in description.variables:
        if match := ELEMENT.fullmatch(variable.name):
            arrays[match["array"], match["rest"]][int(match["index"])] = variable
    for (array, rest), elements in arrays.items():
        where = elements[min(elements)].where
        missing = next(index for index in count(1) if index not in elements)
        if missing <= max(elements) or 0 in elements:
            wrong = "an element 0" if 0 in elements else f"no element {missing}"
            yield ARRAY.at(where, f"{array}[…]{rest}: {wrong}", f"1 to {max(elements)}")
        kinds = sorted({f"{v.kind} {v.type.get('unit', '')}".strip() for v in elements.values()})
        if len(kinds) > 1:
            yield ARRAY.at(where, f"{array}[…]{rest}: {', '.join(kinds)}", "one kind and unit")


def _aliases(description: Description) -> Iterator[Finding]:
    sets: dict[tuple[str, str], list[Variable]] = defaultdict(list)
    for variable in description.variables:
        # Integer and Enumeration are read by the same function, hence share references.
        kind = "Integer" if variable.kind == "Enumeration" else variable.kind
        sets[kind, variable.own.get("valueReference", "")].append(variable)
    for (_, reference), variables in sets.items():
        if len(variables) == 1:
            continue
        first, *others = variables
        where = f"{others[0].where}, an alias of {first.name} (reference {reference})"
        constant = [v.variability == "constant" for v in variables]
        starts = [v.name for v in variables if "start" in v.type and v.variability != "constant"]
        if any(constant) and not all(constant):
            yield ALIAS.at(where, "constant and not", "all constant or none")
        if len(starts) > 1:
            yield ALIAS.at(where, f"start values for {', '.join(starts)}", "one at most")
        units = {v.type.get("unit", "") for v in variables}
        if len(units) > 1:
            yield ALIAS_UNIT.at(where, f"units {', '.join(map(repr, sorted(units)))}", "one unit")


def _types(description: Description) -> Iterator[Finding]:
    variables = {variable.name for variable in description.variables}
    elements = description.all("TypeDefinitions/SimpleType")
    times = Counter(element.get("name", "") for element in elements)
    for element in elements:
        name = element.get("name", "")
        where = place(element, f"type {name}")
        if times[name] > 1 or name in variables:
            yield TYPE_NAME.at(where, name, "a name that no other type and no variable has")
        items = list(element.iterfind("Enumeration/Item"))
        for key in ("name", "value"):
            for text, often in Counter(item.get(key, "") for item in items).items():
                if often > 1:
                    yield TYPE_ITEMS.at(where, f"{often} items with {key} {text}", "one")
        real = next((child for child in element if child.tag in ("Real", "Integer")), None)
        if real is not None:
            low, high = number(real.get("min")), number(real.get("max"))
            if low is not None and high is not None and not (low <= high or isnan(low) or isnan(high)):
                yield BOUNDS.at(where, f"min {low:.17g}, max {high:.17g}", "min ≤ max")
