"""Types, shapes and units: what fits to what."""

from math import isclose

from exo.systems.interface import Unit
from exo.validate.si import meaning, written

#: Types that hold the same values.
FAMILIES = {"Real": "Float64", "Integer": "Int32"}
RANGES = {f"{sign}Int{bits}": (sign, bits) for sign in ("", "U") for bits in (8, 16, 32, 64)}
#: Bits of the mantissa.
MANTISSA = {"Float64": 53, "Float32": 24}
TRANSFORMATIONS = (
    "LinearTransformation",
    "BooleanMappingTransformation",
    "IntegerMappingTransformation",
    "EnumerationMappingTransformation",
)

Shape = tuple[int | None, ...]


def family(kind: str) -> str:
    """The name that FMI 3.0 gives to the type."""
    return FAMILIES.get(kind, kind)


def same(a: str, b: str) -> bool:
    """Whether both types hold the same values. The item of an enumeration may be given as its number."""
    pair = {family(a), family(b)}
    return len(pair) == 1 or ("Enumeration" in pair and pair <= {"Enumeration", "Int32", "Int64"})


def lossless(given: str, wanted: str) -> bool:
    """Whether every value of one type is a value of the other."""
    first, second = family(given), family(wanted)
    if same(given, wanted):
        return True
    if first in RANGES and second in RANGES:
        (sign, bits), (wanted_sign, wanted_bits) = RANGES[first], RANGES[second]
        if sign == wanted_sign:
            return bits <= wanted_bits
        return sign == "U" and bits < wanted_bits
    if first in RANGES and second in MANTISSA:
        return RANGES[first][1] <= MANTISSA[second]
    return (first, second) == ("Float32", "Float64")


def fits(a: Shape, b: Shape) -> bool:
    """Whether two shapes can be one; None is a size that is not known."""
    return len(a) == len(b) and all(x is None or y is None or x == y for x, y in zip(a, b, strict=True))


class Measure:
    """What a unit means: exponents without rad, factor and offset to base units."""

    def __init__(self, name: str, exponents: tuple[int, ...], factor: float, offset: float) -> None:
        self.name = name
        # The standards leave it open whether an angle has a dimension.
        self.exponents = exponents[:-1]
        self.factor = factor
        self.offset = offset

    def __str__(self) -> str:
        return f"{self.name} ({written((*self.exponents, 0))})"

    @classmethod
    def of(cls, name: str, defined: Unit | None) -> "Measure | None":
        """By the definition, else by the name; None where neither says it."""
        if defined is not None and defined.exponents is not None:
            return cls(name, defined.exponents, defined.factor, defined.offset)
        said = meaning(name)
        return None if said is None else cls(name, said.exponents, said.factor, said.offset)

    def converted(self, value: float, other: "Measure") -> float:
        """A value in this unit, in the other one."""
        if isclose(self.factor, other.factor) and self.offset == other.offset:
            return value
        return (self.factor * value + self.offset - other.offset) / other.factor if other.factor else value
