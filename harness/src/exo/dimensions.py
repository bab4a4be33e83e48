"""Whether an output and the input that takes it are in one unit. FMI's conversion of units is not done: what differs is
refused, because a run with a torque where a position belongs ends without an error.
"""

from math import isclose
from typing import Any

from exo.fmu import Archive, unit_of
from exo.validate.si import BASE, Meaning, meaning

#: Files write factors as decimals, some with ten digits.
TOLERANCE = 1e-9
#: An angle counts as a number: FMUs differ in whether `rad` has an exponent.
ANGLE = BASE.index("rad")


def differ(source: Archive, output: Any, target: Archive, variable: Any) -> bool:
    """Whether the units are certainly two: both are declared, and their definitions, or their names, say different
    things. A unit that means nothing to anybody is taken as it is."""
    given, wanted = unit_of(output), unit_of(variable)
    if not given or not wanted or given == wanted:
        return False
    a, b = _meaning(source, given), _meaning(target, wanted)
    if a is None or b is None:
        return False
    same = _without_angle(a) == _without_angle(b)
    return not (same and _close(a.factor, b.factor) and _close(a.offset, b.offset))


def names_differ(a: str, b: str) -> bool:
    """Whether two names of units certainly mean different ones."""
    first, second = meaning(a), meaning(b)
    if a == b or first is None or second is None:
        return False
    return _without_angle(first) != _without_angle(second) or not _close(first.factor, second.factor)


def _meaning(archive: Archive, name: str) -> Meaning | None:
    """What the FMU's definition says, else what the name says."""
    for unit in archive.description.unitDefinitions or ():
        if unit.name == name and unit.baseUnit is not None:
            base = unit.baseUnit
            exponents = tuple(int(getattr(base, key) or 0) for key in BASE)
            return Meaning(exponents, float(base.factor or 1.0), float(base.offset or 0.0))
    return meaning(name)


def _without_angle(of: Meaning) -> tuple[int, ...]:
    return tuple(power for place, power in enumerate(of.exponents) if place != ANGLE)


def _close(a: float, b: float) -> bool:
    return isclose(a, b, rel_tol=TOLERANCE, abs_tol=TOLERANCE if 0.0 in (a, b) else 0.0)
