"""Arrays of FMI 3.0: what a dimension's size is."""

from collections.abc import Iterator
from math import prod

from exo.validate.description import Description
from exo.validate.rule import Finding, error
from exo.validate.variable import Dimension, Variable, integers

EITHER = error("dimension-size", "a Dimension has a start above 0 or a valueReference, not both", only="3.0")
REFERENCE = error(
    "dimension-reference",
    "a Dimension's valueReference is that of a UInt64 that is a structuralParameter or constant, and starts above 0",
    only="3.0",
)
TOTAL = error("dimension-total", "no array has more elements than any real FMU's, 2^28", only="3.0")
#: Two gigabytes of Float64. An importer that believed more would run out of memory.
MOST = 1 << 28
SCALAR = error("dimension-none", "Clocks and structural parameters have no Dimension", only="3.0")


def findings(description: Description) -> Iterator[Finding]:
    """All of this module's rules."""
    for variable in description.variables:
        if variable.dimensions and (variable.kind == "Clock" or variable.causality == "structuralParameter"):
            yield SCALAR.at(variable.where, f"{variable.kind}, {variable.causality}, with dimensions", "a scalar")
        for dimension in variable.dimensions:
            yield from _dimension(description, dimension)
        extents = [description.extent(dimension) for dimension in variable.dimensions]
        total = prod(extent for extent in extents if extent is not None)
        if total > MOST:
            yield TOTAL.at(variable.where, f"{total} elements", f"at most {MOST}")


def _dimension(description: Description, dimension: Dimension) -> Iterator[Finding]:
    if (dimension.start is None) == (dimension.reference is None):
        yield EITHER.at(
            dimension.where, "both" if dimension.start is not None else "neither", "start or valueReference"
        )
        return
    if dimension.start is not None:
        if not _positive(dimension.start):
            yield EITHER.at(dimension.where, f"start {dimension.start}", "at least 1")
        return
    keys = integers(dimension.reference) or []
    sizer = description.by_reference.get(keys[0]) if len(keys) == 1 else None
    if sizer is None or not _is_size(sizer):
        value = f"valueReference {dimension.reference}: {_said(sizer)}"
        yield REFERENCE.at(dimension.where, value, "a structuralParameter or a constant of type UInt64")
    elif not _positive(sizer.type.get("start", "")):
        value = f"{sizer.name} starts with {sizer.type.get('start', 'nothing')}"
        yield REFERENCE.at(dimension.where, value, "at least 1: no dimension is gone at the beginning")


def _is_size(variable: Variable) -> bool:
    return variable.kind == "UInt64" and (
        variable.causality == "structuralParameter" or variable.variability == "constant"
    )


def _said(variable: Variable | None) -> str:
    if variable is None:
        return "no variable"
    return f"{variable.name}, a {variable.variability} {variable.kind} with causality {variable.causality}"


def _positive(text: str) -> bool:
    found = integers(text) or []
    return len(found) == 1 and found[0] > 0
