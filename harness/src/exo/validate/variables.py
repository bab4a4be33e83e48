"""Variables: names, references, attributes, types."""

import re
from collections import Counter, defaultdict
from collections.abc import Iterator
from itertools import count

from exo.validate.archive import DESCRIPTION
from exo.validate.description import Description, SimpleType, place
from exo.validate.rule import Finding, error, warning
from exo.validate.variable import Alias, Variable
from exo.validate.versions import FLOATS, FMI2

CASE = warning("variable-case", "names stay unique when case is folded")
NAME = error("variable-name", "names are neither empty nor padded with blanks, and have no control characters")
ARRAY = warning("variable-array", "the elements of an array are numbered from 1 without a gap and share kind and unit")
DESCRIBED = warning("variable-description", "every variable has a description")
NAME_ONCE = error("variable-name-once", "no two variables, and in FMI 3.0 no alias, have the same name")
EXPLICIT = error(
    "variable-variability", "all kinds but Real give their variability: the default is continuous", only="2.0"
)
INITIAL = error(
    "variable-input-initial", "the independent variable, and in FMI 2.0 every input, has no attribute initial"
)
TIME = warning(
    "variable-independent", "there is no independent variable: it is legal, but importers log errors for it", only="2.0"
)
ONE_TIME = error(
    "variable-time",
    "there is one independent variable: a continuous floating-point number, no array, without start value",
    only="3.0",
)
INTERMEDIATE = error(
    "variable-intermediate", "only continuous variables, and no Clocks, have intermediateUpdate", only="3.0"
)
MULTIPLE = error(
    "variable-multiple-set", "canHandleMultipleSetPerTimeInstant stands at inputs only, and only with model exchange"
)
REFERENCE = error("variable-reference", "valueReference is an unsigned 32-bit number")
REFERENCE_ONCE = error("variable-reference-once", "no two variables have the same valueReference", only="3.0")
ALIAS = error(
    "variable-alias",
    "of the variables that share a reference one at most has a start value, and all are constant or none",
    only="2.0",
)
ALIAS_UNIT = error("variable-alias-unit", "variables that share a reference share their unit", only="2.0")
DISPLAY = error("variable-display-unit", "a displayUnit stands beside a unit")
TYPE = error("variable-type", "declaredType names a type definition of the same kind")
TYPE_NAME = error("type-name", "names of types differ from each other and from the variables' names")
TYPE_ITEMS = error("type-items", "items of an Enumeration differ in name and value")

ELEMENT = re.compile(r"(?P<array>.+)\[(?P<index>[0-9]{1,9})\](?P<rest>[^\[\]]*)")


def findings(description: Description) -> Iterator[Finding]:
    """All of this module's rules."""
    model_exchange = description.first("ModelExchange") is not None
    for variable in description.variables:
        yield from _names(variable)
        yield from _attributes(variable, model_exchange=model_exchange)
        yield from _type(description, variable)
    yield from _folded(description)
    yield from _arrays(description)
    if description.version is FMI2:
        yield from _aliases(description)
    else:
        yield from _references(description)
        yield from _time(description)
    yield from _types(description)


def _names(variable: Variable) -> Iterator[Finding]:
    for named in variable.named:
        name = named.name
        if not name or name != name.strip() or not name.isprintable():
            yield NAME.at(named.where, repr(name), "a name without control characters")
    if not variable.own.get("description", "").strip():
        yield DESCRIBED.at(variable.where, "no description", "a sentence")


def _attributes(variable: Variable, *, model_exchange: bool) -> Iterator[Finding]:
    own = variable.own
    is_2 = variable.version is FMI2
    if is_2 and variable.kind not in ("Real", "") and "variability" not in own:
        yield EXPLICIT.at(
            variable.where, f"{variable.kind} without variability", "constant, fixed, tunable or discrete"
        )
    if variable.causality in (("input", "independent") if is_2 else ("independent",)) and "initial" in own:
        yield INITIAL.at(variable.where, f"initial {own['initial']}", f"none for causality {variable.causality}")
    if is_2 and variable.causality == "independent":
        yield TIME.at(variable.where, "causality independent", "no such variable")
    if "canHandleMultipleSetPerTimeInstant" in own:
        if variable.causality != "input":
            yield MULTIPLE.at(variable.where, f"causality {variable.causality}", "input")
        elif not model_exchange:
            yield MULTIPLE.at(variable.where, "there is no ModelExchange", "no canHandleMultipleSetPerTimeInstant")
    if own.get("intermediateUpdate") in ("true", "1") and variable.variability != "continuous":
        yield INTERMEDIATE.at(
            variable.where, f"{variable.variability} with intermediateUpdate", "a continuous variable"
        )
    if variable.reference is None:
        yield REFERENCE.at(variable.where, f"valueReference {own.get('valueReference', '')!r}", "0 to 4294967295")


def _type(description: Description, variable: Variable) -> Iterator[Finding]:
    for shown, where in ((variable.type, variable.where), *((alias.own, alias.where) for alias in variable.aliases)):
        if "displayUnit" in shown and "unit" not in variable.type:
            yield DISPLAY.at(where, f"displayUnit {shown['displayUnit']} without unit", "a unit")
    name = variable.type.get("declaredType")
    if name is None:
        if variable.kind == "Enumeration":
            yield TYPE.at(variable.where, "no declaredType", "the Enumeration's type")
        return
    declared = description.types.get(name)
    if declared is None:
        yield TYPE.at(variable.where, f"declaredType {name}", "a type definition of this name")
    elif variable.kind not in declared.kinds:
        yield TYPE.at(variable.where, f"declaredType {name}", f"a type definition of kind {variable.kind}")


def _folded(description: Description) -> Iterator[Finding]:
    first: dict[str, Variable | Alias] = {}
    for named in (one for variable in description.variables for one in variable.named):
        other = first.setdefault(named.name.casefold(), named)
        if other is named:
            continue
        where = f"also {other.where}: {other.name}" if other.name != named.name else f"also {other.where}"
        yield CASE.at(named.where, where, "names that differ by more than case")
        if other.name == named.name:
            yield NAME_ONCE.at(named.where, f"also {other.where}", "another name")


def _references(description: Description) -> Iterator[Finding]:
    for variable in description.variables:
        first = description.by_reference.get(variable.reference) if variable.reference is not None else None
        if first is not None and first is not variable:
            yield REFERENCE_ONCE.at(variable.where, f"{variable.reference}, as {first.where}", "another valueReference")


def _time(description: Description) -> Iterator[Finding]:
    times = [v for v in description.variables if v.causality == "independent"]
    if len(times) != 1:
        names = ", ".join(v.name for v in times) or "none"
        yield ONE_TIME.at(f"{DESCRIPTION} ModelVariables", f"{len(times)} with causality independent: {names}", "one")
    for time in times:
        if time.kind not in FLOATS or time.dimensions or time.variability != "continuous" or time.starts is not None:
            shape = " array" if time.dimensions else ""
            value = f"{time.variability} {time.kind}{shape}{'' if time.starts is None else ' with start value'}"
            yield ONE_TIME.at(time.where, value, "a continuous Float64 or Float32 without start value")


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
    elements = description.type_elements
    times = Counter(element.get("name", "") for element in elements)
    for element in elements:
        name = element.get("name", "")
        where = place(element, f"type {name}")
        if times[name] > 1 or name in variables:
            yield TYPE_NAME.at(where, name, "a name that no other type and no variable has")
        declared = SimpleType(element, description.version)
        for key in ("name", "value"):
            for text, often in Counter(item.get(key, "") for item in declared.item_elements).items():
                if often > 1:
                    yield TYPE_ITEMS.at(where, f"{often} items with {key} {text}", "one")
