"""Start values and bounds: of the variable's kind, in range, as many as there are elements."""

import re
from collections.abc import Iterator
from math import isfinite, isnan

from exo.validate.description import Description, listed, place
from exo.validate.rule import Finding, error
from exo.validate.variable import Variable, number
from exo.validate.versions import FLOATS, FMI2

START_KIND = error("variable-start-kind", "a start value is of the variable's kind")
START_FINITE = error("variable-start-finite", "a start value is finite")
START_RANGE = error("variable-start-range", "a start value lies within min and max")
START_ITEM = error("variable-start-item", "an Enumeration's start value is one of its items")
START_CALCULATED = error("variable-start-calculated", "a calculated variable has no start value, not even an empty one")
START_COUNT = error(
    "variable-start-count",
    "an array has one start value, or one for each element; an attribute start is not empty",
    only="3.0",
)
BOUNDS = error("variable-bounds", "min is at most max")
NOMINAL = error("variable-nominal", "nominal is not zero")

INTEGER = re.compile(r"\s*[+-]?[0-9]{1,20}\s*")
HEX = re.compile(r"(?:[0-9A-Fa-f]{2})*")


def findings(description: Description) -> Iterator[Finding]:
    """All of this module's rules."""
    for variable in description.variables:
        yield from _calculated(variable)
        low, high = bounds(variable)
        if low is not None and high is not None and not low <= high:
            yield BOUNDS.at(variable.where, f"min {low:.17g}, max {high:.17g}", "min ≤ max")
        if number(variable.type.get("nominal")) == 0.0:
            yield NOMINAL.at(variable.where, "nominal 0", "the magnitude of the variable")
        starts = variable.starts or ()
        size = description.size(variable)
        if variable.starts == ():
            yield START_COUNT.at(variable.where, "an empty start", "a value")
        if starts and size is not None and len(starts) not in (1, size):
            yield START_COUNT.at(variable.where, f"{len(starts)} start values", f"1 or {size}")
        for start in starts:
            found = list(_start(description, variable, start))
            yield from found
            if found:  # of an array, the first element that is wrong
                break
    yield from _types(description)


def bounds(variable: Variable) -> tuple[float | None, float | None]:
    """min and max."""
    return number(variable.type.get("min")), number(variable.type.get("max"))


def _calculated(variable: Variable) -> Iterator[Finding]:
    calculated = variable.initial == "calculated"
    if variable.version is not FMI2:
        calculated = calculated or variable.causality == "independent"
    if variable.starts is not None and calculated and variable.kind != "Clock":
        value = ", ".join(map(repr, variable.starts))
        yield START_CALCULATED.at(variable.where, f"start {value}", "none, as initial is calculated")


def _start(description: Description, variable: Variable, start: str) -> Iterator[Finding]:
    kind = variable.kind
    if kind == "Binary" and not HEX.fullmatch(start.strip()):
        yield START_KIND.at(variable.where, f"start {start!r}", "pairs of hexadecimal digits")
    if kind in ("String", "Binary", "Clock", ""):
        return
    if kind == "Boolean":
        if start.strip() not in ("true", "false", "0", "1"):
            yield START_KIND.at(variable.where, f"start {start!r}", "true or false")
        return
    value = number(start)
    integral = kind not in FLOATS
    if value is None or (integral and not INTEGER.fullmatch(start)):
        yield START_KIND.at(variable.where, f"start {start!r}", f"a value of kind {kind}")
    elif not isfinite(value):
        yield START_FINITE.at(variable.where, f"start {start}", "a finite number")
    elif integral and not _holds(variable, int(start)):
        yield START_KIND.at(variable.where, f"start {start}", _width(variable))
    else:
        low, high = bounds(variable)
        if (low is not None and value < low) or (high is not None and value > high):
            yield START_RANGE.at(variable.where, f"start {start}", _range(low, high))
        if kind == "Enumeration" and int(value) not in description.items(variable):
            yield START_ITEM.at(variable.where, f"start {start}", f"one of {listed(description.items(variable))}")


def _holds(variable: Variable, value: int) -> bool:
    bits, signed = variable.version.bits(variable.kind) or (64, True)
    return -(1 << bits - 1) <= value < 1 << bits - 1 if signed else 0 <= value < 1 << bits


def _width(variable: Variable) -> str:
    bits, signed = variable.version.bits(variable.kind) or (64, True)
    return f"{'a' if signed else 'an unsigned'} {bits}-bit integer"


def _range(low: float | None, high: float | None) -> str:
    parts = [f"≥ {low:.17g}" if low is not None else "", f"≤ {high:.17g}" if high is not None else ""]
    return " and ".join(part for part in parts if part)


def _types(description: Description) -> Iterator[Finding]:
    for name, declared in description.types.items():
        for kind, given in declared.kinds.items():
            low, high = number(given.get("min")), number(given.get("max"))
            if kind == "Enumeration" or low is None or high is None:
                continue
            if not (low <= high or isnan(low) or isnan(high)):
                where = place(declared.element, f"type {name}")
                yield BOUNDS.at(where, f"min {low:.17g}, max {high:.17g}", "min ≤ max")
