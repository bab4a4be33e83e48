"""What the plants tell at initialization: a contact too stiff for the substep, a payload that waits for its vacuum."""

import re
from collections.abc import Mapping
from math import isclose

import pytest

from exo.fmu import Archive, Instance

PLANTS = ("Testbed.fmu", "ExoskeletonArm.fmu", "ExoskeletonArms.fmu")


def told(archive: Archive, **values: float | bool) -> list[tuple[str, str]]:
    """The messages of an instance initialized with `values`, whose names have `_` for a dot."""
    with Instance(archive, "told") as instance:
        for name, value in values.items():
            variable = archive.variable(name.replace("_", ".", 1))
            reference = [variable.valueReference]
            if variable.type == "Boolean":
                instance._slave.setBoolean(reference, [value])
            else:
                instance._slave.setReal(reference, [value])
        instance.setup_experiment(start_time=0.0, stop_time=1.0)
        instance.enter_initialization_mode()
        instance.messages.clear()
        instance.exit_initialization_mode()
        return [one for one in instance.messages if " initialized at t = " not in one[1]]


@pytest.mark.parametrize("name", PLANTS)
def test_the_start_values_give_no_warning(name: str, archives: Mapping[str, Archive]) -> None:
    assert not [one for one in told(archives[name]) if one[0] == "logStatusWarning"]


@pytest.mark.parametrize(
    ("name", "stiff", "reach", "lost"),
    [
        ("Testbed.fmu", "wall_k", {}, 15.0),
        ("ExoskeletonArm.fmu", "table_k", {"table_z": -0.4}, 12.6),
        ("ExoskeletonArms.fmu", "wall_k", {"wall_x": 0.6}, 6.2),
    ],
)
def test_a_contact_too_stiff_for_the_substep_is_named_with_what_it_costs_and_what_helps(
    name: str, stiff: str, reach: Mapping[str, float], lost: float, archives: Mapping[str, Archive]
) -> None:
    ((category, text),) = told(archives[name], **{stiff: 1e7}, **reach)
    assert category == "logStatusWarning"
    found = re.fullmatch(
        r"substep = \S+ s is too long for (\S+) = 10000000\.0 N/m: the (?:mass|pad) rebounds (\S+) percent too slowly, "
        r"expected at most (\S+) s for 2 percent",
        text,
    )
    assert found, text
    assert found[1] == stiff.replace("_", ".")
    assert isclose(float(found[2]), lost, abs_tol=0.2), text
    # What is advised is not warned of.
    assert not told(archives[name], **{stiff: 1e7, "substep": 0.99 * float(found[3])}, **reach)


def test_a_surface_out_of_reach_is_not_warned_of(archives: Mapping[str, Archive]) -> None:
    assert not told(archives["ExoskeletonArm.fmu"], table_k=1e7, wall_k=1e7)
    assert not told(archives["Testbed.fmu"], wall_k=1e9, wall_q=1e9)


@pytest.mark.parametrize("name", PLANTS[1:])
def test_a_payload_that_hangs_from_the_start_says_what_it_waits_for(name: str, archives: Mapping[str, Archive]) -> None:
    assert told(archives[name], payload_m=10.0, payload_attached=True) == [
        ("logEvents", "payload.attached = true: the payload hangs until vacuum has been true and is false again")
    ]
