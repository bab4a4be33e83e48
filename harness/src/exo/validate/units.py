"""Unit definitions: exponents and factors against what the units' names say."""

from collections import Counter
from collections.abc import Iterator
from math import isclose, pi

from lxml import etree

from exo.validate.archive import DESCRIPTION
from exo.validate.description import Description, place
from exo.validate.rule import Finding, Rule, error, warning
from exo.validate.si import BASE, Meaning, meaning, written
from exo.validate.variable import Variable, integers, number
from exo.validate.versions import FLOATS, FMI2

MISSING = warning("unit-missing", "every floating-point variable has a unit, 1 if it has no dimension")
NAMES = error("unit-name", "units have names, and no two the same; nor have the display units of one unit")
UNDEFINED = error("unit-undefined", "units of types are defined")
UNUSED = warning("unit-unused", "every unit is used")
NO_BASE = warning("unit-base", "every unit has base exponents: without them an importer cannot convert")
EXPONENTS = error("unit-exponents", "a unit's base exponents are those of its name")
RAD = warning("unit-rad", "the exponent of rad is that of the unit's name")
FACTOR = error("unit-factor", "factor and offset to base units are those of the unit's name")
DISPLAY = error("unit-display", "factor and offset of a display unit are those of the two names")
ANGLE = warning("unit-angle", "a unit with rad alone offers degrees for display")

#: Files write factors as decimals, some with ten digits.
TOLERANCE = 1e-9


def findings(description: Description) -> Iterator[Finding]:
    """All of this module's rules."""
    units = description.all("UnitDefinitions/Unit")
    defined = [unit.get("name", "") for unit in units]
    for name, times in Counter(defined).items():
        if times > 1 or not name:
            yield NAMES.at(f"{DESCRIPTION} UnitDefinitions", f"{name!r} {times} times", "each name once")
    known = frozenset(defined)
    used = {variable.type.get("unit", "") for variable in description.variables}
    for variable in description.variables:
        if variable.kind in FLOATS and "unit" not in variable.type and not _is_time(variable):
            yield MISSING.at(variable.where, f"{variable.kind} without unit", "a unit, or 1")
    for name, declared in description.types.items():
        for unit_name in (given["unit"] for given in declared.kinds.values() if "unit" in given):
            used.add(unit_name)
            if unit_name not in known:
                yield UNDEFINED.at(place(declared.element, f"type {name}"), unit_name, "a unit of UnitDefinitions")
    for unit in units:
        name = unit.get("name", "")
        where = place(unit, f"unit {name}")
        if name not in used:
            yield UNUSED.at(where, "used by no variable and no type", "units in use")
        yield from _base(where, name, unit)
        yield from _display(where, name, unit)


def _is_time(variable: Variable) -> bool:
    """The independent variable of FMI 3.0, which every FMU must have: in seconds, unless a unit says otherwise."""
    return variable.version is not FMI2 and variable.causality == "independent"


def _base(where: str, name: str, unit: etree._Element) -> Iterator[Finding]:
    base = unit.find("BaseUnit")
    if base is None:
        yield NO_BASE.at(where, "no BaseUnit", "BaseUnit with exponents")
        return
    said = meaning(name)
    if said is None:
        return
    given = tuple((integers(base.get(key)) or [0])[0] for key in BASE)
    if given[:-1] != said.exponents[:-1]:
        yield EXPONENTS.at(where, written(given), written(said.exponents))
    # A frequency may be counted in turns (factor 1) or in radians (factor 2π).
    cycles = name.endswith("Hz") and given[-1] == 1
    if given[-1] != said.exponents[-1] and not cycles:
        yield RAD.at(where, written(given), written(said.exponents))
    factor = said.factor * (2.0 * pi if cycles else 1.0)
    yield from _conversion(where, FACTOR, base, factor, said.offset)


def _display(where: str, name: str, unit: etree._Element) -> Iterator[Finding]:
    shown = [display.get("name", "") for display in unit.iterfind("DisplayUnit")]
    for text, times in Counter(shown).items():
        if times > 1 or not text:
            yield NAMES.at(where, f"display unit {text!r} {times} times", "each name once")
    said = meaning(name)
    for display in unit.iterfind("DisplayUnit"):
        other = meaning(display.get("name", ""))
        if said is None or other is None:
            continue
        at = place(display, f"display unit {display.get('name')} of {name}")
        if other.exponents != said.exponents:
            yield DISPLAY.at(at, written(other.exponents), f"a unit of {written(said.exponents)}")
            continue
        yield from _conversion(at, DISPLAY, display, *_between(said, other))
    if said == meaning("rad") and "deg" not in shown:
        yield ANGLE.at(where, f"display units {shown or 'none'}", "deg")


def _between(unit: Meaning, display: Meaning) -> tuple[float, float]:
    """display value = factor × unit value + offset, from base = factor_u × value + offset_u on both sides."""
    return unit.factor / display.factor, (unit.offset - display.offset) / display.factor


def _conversion(where: str, rule: Rule, element: etree._Element, factor: float, offset: float) -> Iterator[Finding]:
    given_factor = number(element.get("factor", "1"))
    given_offset = number(element.get("offset", "0"))
    if given_factor is None or not isclose(given_factor, factor, rel_tol=TOLERANCE):
        yield rule.at(where, f"factor {element.get('factor', '1')}", f"{factor:.17g}")
    if given_offset is None or not isclose(given_offset, offset, rel_tol=TOLERANCE, abs_tol=TOLERANCE):
        yield rule.at(where, f"offset {element.get('offset', '0')}", f"{offset:.17g}")
