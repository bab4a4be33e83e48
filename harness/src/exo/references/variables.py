"""Names of columns and parameters as variables of an FMU, 2.0 or 3.0.

A vector of FMI 3.0 has one name: a column of that name has all its elements in each cell, with blanks between them, as
fmpy and Reference-FMUs write it. A column `q[2]` is one element of `q`, and `segment[2].axis` one of `segment.axis`: so
what was written for the scalars of an FMI 2.0 archive also fits the vectors of its twin. Neither the layered standard
nor the format says which of the two it is.
"""

import re
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

INDICES = re.compile(r"\[(\d{1,9}(?:,\d{1,9})*)\]")
REALS = ("Real", "Float32", "Float64")
INTEGERS = ("Integer", "Int8", "UInt8", "Int16", "UInt16", "Int32", "UInt32", "Int64", "UInt64", "Enumeration")
NUMBERS = (*REALS, *INTEGERS, "Boolean")


@dataclass(frozen=True)
class Place:
    """A variable, or one element of it."""

    #: fmpy's.
    variable: Any
    #: Of the elements in C's order; None for all of them.
    element: int | None

    @property
    def size(self) -> int:
        """How many values it has."""
        return 1 if self.element is not None else size(self.variable)


def size(variable: Any) -> int:
    """How many values a variable has."""
    return int(np.prod(variable.shape)) if variable.shape else 1


def place(name: str, variables: Mapping[str, Any]) -> Place | None:
    """What a name means; None where the FMU has nothing of this name."""
    if name in variables:
        return Place(variables[name], None)
    variable = variables.get(INDICES.sub("", name))
    if variable is None:
        return None
    indices = [int(number) - 1 for numbers in INDICES.findall(name) for number in numbers.split(",")]
    shape = tuple(variable.shape or ())
    if len(indices) != len(shape) or not all(0 <= i < n for i, n in zip(indices, shape, strict=True)):
        return None
    return Place(variable, int(np.ravel_multi_index(indices, shape)))


def unit(variable: Any) -> str:
    """The variable's unit, or nothing."""
    return str(variable.unit or getattr(variable.declaredType, "unit", None) or "")


def nominal(variable: Any) -> float:
    """The nominal value that the description states, 0 where it states none."""
    try:
        return abs(float(str(variable.nominal).split()[0])) if variable.nominal is not None else 0.0
    except (ValueError, IndexError):
        return 0.0


def value(kind: str, text: str) -> float | int | bool | str:
    """Text as a value of a kind of variable; ValueError says what was expected."""
    stripped = text.strip()
    if kind == "Boolean":
        if stripped not in ("true", "false", "1", "0"):
            raise ValueError("true or false")
        return stripped in ("true", "1")
    if kind in INTEGERS:
        if not re.fullmatch(r"[+-]?\d{1,20}", stripped):
            raise ValueError("a whole number")
        return int(stripped)
    if kind in REALS:
        if not re.fullmatch(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?", stripped):
            raise ValueError("a finite number")
        return float(stripped)
    return text


def starts(variable: Any) -> list[Any]:
    """Start values, one an element; zeros where the description has none."""
    texts = str(variable.start).split() if variable.start is not None else []
    try:
        found = [value(variable.type, text) for text in texts]
    except ValueError:
        found = []
    count = size(variable)
    if len(found) == 1 and count > 1:
        found *= count
    return found if len(found) == count else [value(variable.type, "0")] * count
