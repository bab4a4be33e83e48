"""Which units a wire may join: nothing converts them, so that two are refused and one under two names is not."""

from types import SimpleNamespace
from typing import Any

import pytest

from exo import dimensions


def variable(unit: str) -> Any:
    return SimpleNamespace(unit=unit, declaredType=None)


def fmu(**units: dict[str, float] | None) -> Any:
    """An FMU that defines these units."""
    bases = {name: dict.fromkeys(("kg", "m", "s", "A", "K", "mol", "cd", "rad"), 0) for name in units}
    definitions = [
        SimpleNamespace(
            name=name,
            baseUnit=None
            if given is None
            else SimpleNamespace(**(bases[name] | {"factor": 1.0, "offset": 0.0} | given)),
        )
        for name, given in units.items()
    ]
    return SimpleNamespace(description=SimpleNamespace(unitDefinitions=definitions))


@pytest.mark.parametrize(
    ("output", "wanted"),
    [
        ("N", "m"),
        ("mm", "m"),
        ("deg", "rad"),
        ("degC", "K"),
        ("rpm", "rad/s"),
        ("N.m", "N"),
        ("kN", "N"),
        ("Hz", "kHz"),
    ],
)
def test_two_units_are_told_apart_by_their_names(output: str, wanted: str) -> None:
    assert dimensions.differ(fmu(), variable(output), fmu(), variable(wanted))
    assert dimensions.differ(fmu(), variable(wanted), fmu(), variable(output))


@pytest.mark.parametrize(
    ("output", "wanted"),
    [
        ("N.m", "N*m"),
        ("N.m", "J"),
        ("N.m/rad", "N.m"),
        ("rad/s", "1/s"),
        ("m/s2", "m/s^2"),
        ("", "m"),
        ("m", ""),
        ("Nm", "N.m"),
        ("furlong", "m"),
        ("ticks", "counts"),
    ],
)
def test_one_unit_under_two_names_and_what_nobody_knows_is_joined(output: str, wanted: str) -> None:
    assert not dimensions.differ(fmu(), variable(output), fmu(), variable(wanted))


def test_what_an_fmu_defines_goes_before_the_name() -> None:
    metre, inch = fmu(m={"m": 1}), fmu(inch={"m": 1, "factor": 0.0254}, length={"m": 1}, odd=None)
    assert dimensions.differ(inch, variable("inch"), metre, variable("m"))
    assert not dimensions.differ(inch, variable("length"), metre, variable("m"))
    assert not dimensions.differ(inch, variable("odd"), metre, variable("m"))
    celsius = fmu(C={"K": 1, "offset": 273.15})
    assert dimensions.differ(celsius, variable("C"), fmu(K={"K": 1}), variable("K"))
