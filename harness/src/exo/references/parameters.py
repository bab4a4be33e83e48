"""SSP parameter sets (`.ssv`) as start values of an FMU."""

from collections.abc import Mapping
from typing import Any

from exo.errors import close_matches
from exo.references.variables import Place, place, size, starts, unit, value
from exo.references.xml import children, local, located, parse
from exo.validate import references as rules
from exo.validate.rule import Finding

#: Values by variable; of a vector all its elements.
Values = dict[str, Any]


def read(data: bytes, where: str, variables: Mapping[str, Any]) -> tuple[Values, list[Finding]]:
    """The start values that can be set, and what is wrong with the others."""
    root, found = parse(data, where)
    if root is None:
        return {}, found
    if local(root) != "ParameterSet":
        return {}, [rules.PARAMETER.at(located(where, root), local(root), "the root ParameterSet of SSP")]
    values: Values = {}
    for parameters in children(root, "Parameters"):
        for parameter in children(parameters, "Parameter"):
            found += _one(parameter, where, variables, values)
    return values, found


def _one(parameter: Any, where: str, variables: Mapping[str, Any], values: Values) -> list[Finding]:
    name, at = parameter.get("name", ""), located(where, parameter)
    meant = place(name, variables)
    if meant is None:
        near = close_matches(name, variables)
        return [rules.UNKNOWN.at(at, f"no variable {name!r}", f"a variable of the FMU{near}")]
    content = next((child for child in parameter if local(child) not in ("", "Annotations")), None)
    text = None if content is None else content.get("value")
    if content is None or text is None:
        return [rules.PARAMETER.at(at, f"{name} without a value", f"a {meant.variable.type}")]
    if not _settable(meant.variable):
        what = f"a {meant.variable.variability} {meant.variable.causality}"
        return [rules.PARAMETER.at(at, f"{name}, {what}", "a parameter, an input or an exact start value")]
    try:
        _put(values, meant, text)
    except ValueError as expected:
        return [rules.PARAMETER.at(at, f"{name} = {text!r}", str(expected))]
    stated, own = content.get("unit"), unit(meant.variable)
    if stated is not None and stated != own:
        return [rules.UNIT.at(at, f"{name} in {stated!r}", f"{own!r}, which the description has" if own else "no unit")]
    return []


def _put(values: Values, meant: Place, text: str) -> None:
    variable = meant.variable
    parts = [text] if variable.type in ("String", "Binary") else text.split()
    if len(parts) != meant.size:
        raise ValueError(f"{meant.size} values" if meant.size > 1 else f"a {variable.type}")
    converted = [_item(variable, part) for part in parts]
    if meant.element is not None:
        values.setdefault(variable.name, starts(variable))[meant.element] = converted[0]
    else:
        values[variable.name] = converted if size(variable) > 1 or variable.shape else converted[0]


def _item(variable: Any, text: str) -> Any:
    """An Enumeration may be told by its item's name."""
    if variable.type == "Enumeration":
        for item in getattr(variable.declaredType, "items", None) or ():
            if item.name == text:
                return int(item.value)
    return value(variable.type, text)


def _settable(variable: Any) -> bool:
    if variable.causality in ("parameter", "structuralParameter", "input"):
        return True
    return variable.variability != "constant" and variable.initial in ("exact", "approx")
