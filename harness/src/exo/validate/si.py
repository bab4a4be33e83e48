"""Names of units: what `N.m.s/rad` or `kg.m2` says about exponents and factor, in the grammar of Modelica."""

import re
from dataclasses import dataclass
from math import pi

BASE = ("kg", "m", "s", "A", "K", "mol", "cd", "rad")
Exponents = tuple[int, ...]


@dataclass(frozen=True)
class Meaning:
    """1 unit = factor × product of base units + offset."""

    exponents: Exponents
    factor: float = 1.0
    offset: float = 0.0


def _of(factor: float = 1.0, offset: float = 0.0, **exponents: int) -> Meaning:
    return Meaning(tuple(exponents.get(base, 0) for base in BASE), factor, offset)


#: Units that take prefixes.
PREFIXED = {
    "m": _of(m=1),
    "g": _of(1e-3, kg=1),
    "s": _of(s=1),
    "A": _of(A=1),
    "K": _of(K=1),
    "mol": _of(mol=1),
    "cd": _of(cd=1),
    "rad": _of(rad=1),
    "Hz": _of(s=-1),
    "N": _of(kg=1, m=1, s=-2),
    "Pa": _of(kg=1, m=-1, s=-2),
    "J": _of(kg=1, m=2, s=-2),
    "W": _of(kg=1, m=2, s=-3),
    "C": _of(A=1, s=1),
    "V": _of(kg=1, m=2, s=-3, A=-1),
    "F": _of(kg=-1, m=-2, s=4, A=2),
    "Ohm": _of(kg=1, m=2, s=-3, A=-2),
    "S": _of(kg=-1, m=-2, s=3, A=2),
    "Wb": _of(kg=1, m=2, s=-2, A=-1),
    "T": _of(kg=1, s=-2, A=-1),
    "H": _of(kg=1, m=2, s=-2, A=-2),
    "bar": _of(1e5, kg=1, m=-1, s=-2),
    "l": _of(1e-3, m=3),
}
#: Units that take none; "ft" is no femtotonne.
PLAIN = {
    "1": _of(),
    "%": _of(1e-2),
    "deg": _of(pi / 180.0, rad=1),
    "degC": _of(1.0, 273.15, K=1),
    "min": _of(60.0, s=1),
    "h": _of(3600.0, s=1),
    "d": _of(86400.0, s=1),
    "t": _of(1e3, kg=1),
    "rev": _of(2.0 * pi, rad=1),
    "rpm": _of(2.0 * pi / 60.0, rad=1, s=-1),
}
PREFIXES = {"f": 1e-15, "p": 1e-12, "n": 1e-9, "u": 1e-6, "µ": 1e-6, "m": 1e-3, "c": 1e-2, "d": 1e-1}
PREFIXES |= {"da": 1e1, "h": 1e2, "k": 1e3, "M": 1e6, "G": 1e9, "T": 1e12}
#: Not a picohenry.
NOT_SI = {"pH"}
FACTOR = re.compile(r"(?P<symbol>[A-Za-zµ%]+)\^?(?P<exponent>[+-]?\d+)?")


def meaning(name: str) -> Meaning | None:
    """What the name says, None for a name that is not written with these units."""
    if name in PLAIN:
        return PLAIN[name]
    numerator, slash, denominator = name.replace("·", ".").replace("*", ".").partition("/")
    if slash and not denominator:
        return None
    if denominator.startswith("(") and denominator.endswith(")"):
        denominator = denominator[1:-1]
    elif "." in denominator:
        return None  # whether b.c in a/b.c divides is read both ways
    factors = [(part, 1) for part in numerator.split(".")] + [(part, -1) for part in denominator.split(".") if slash]
    exponents, factor = [0] * len(BASE), 1.0
    for part, sign in factors:
        if part == "1":
            continue
        match = FACTOR.fullmatch(part)
        unit = _symbol(match["symbol"]) if match else None
        if match is None or unit is None or unit.offset:
            return None
        power = sign * int(match["exponent"] or 1)
        if abs(power) > 9:
            return None
        exponents = [a + power * b for a, b in zip(exponents, unit.exponents, strict=True)]
        factor *= unit.factor**power
    return Meaning(tuple(exponents), factor)


def written(exponents: Exponents) -> str:
    """`kg m2 s-2`"""
    parts = [f"{base}{'' if power == 1 else power}" for base, power in zip(BASE, exponents, strict=True) if power]
    return " ".join(parts) or "1"


def _symbol(symbol: str) -> Meaning | None:
    if symbol in PREFIXED:
        return PREFIXED[symbol]
    if symbol in PLAIN:
        return PLAIN[symbol]
    if symbol in NOT_SI:
        return None
    for prefix, scale in PREFIXES.items():
        unit = PREFIXED.get(symbol.removeprefix(prefix)) if symbol.startswith(prefix) else None
        if unit is not None:
            return Meaning(unit.exponents, scale * unit.factor)
    return None
