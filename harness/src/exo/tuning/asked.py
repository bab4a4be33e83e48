"""What is judged: the options of the command line over what a scenario has, over what is usual."""

from collections.abc import Mapping
from dataclasses import fields, replace
from typing import Any

from exo.errors import ExoError
from exo.tuning import guide
from exo.tuning.friction import Friction, Stribeck
from exo.tuning.machine import Gains, Machine
from exo.tuning.reading import Reading

#: Without them nothing can be said.
NEEDED = ("T", "M_min", "M_max")
#: What is taken of gains that are neither given nor read.
USUAL = {"K_P": 10.0, "alpha": 1.0}


def machine_and_gains(*, options: Mapping[str, float | None], found: Reading | None) -> tuple[Machine, Gains]:
    """Options are None where they are not given; a K that is not there becomes the recommended one.

    `ExoError` names what is missing or out of range.
    """
    values: dict[str, Any] = {**USUAL, **(found.values if found else {})}
    values |= {name: value for name, value in options.items() if value is not None}
    for name in NEEDED:
        if name not in values:
            raise ExoError(f"--{name.replace('_', '-')}: expected a value, or a scenario to read it from (--scenario)")
    machine = Machine(**{field.name: values[field.name] for field in fields(Machine) if field.name in values})
    M_n = values.get("M_n", machine.M_min)
    D_n = values.get("D_n", M_n)
    # Where the hand leaves no K to recommend, the advised bound is judged.
    K = values.get("K", guide.KT_OVER_M_MAX * machine.M_min / machine.T)
    gains = Gains(M_n=M_n, D_n=D_n, K=K, K_P=values["K_P"], alpha=values["alpha"])
    if "K" not in values:
        gains = replace(gains, K=guide.recommended_gain(machine=machine, gains=gains) or gains.K)
    return machine, gains


def friction(*, options: Mapping[str, float | None], found: Reading | None) -> Friction | None:
    """The friction of the options F_c, F_s, v_s, b, if one is given, else what is read; None without dry friction."""
    if all(value is None for value in options.values()):
        return found.friction if found and found.friction.F_s else None
    F_c = options["F_c"] or 0.0
    F_s = F_c if options["F_s"] is None else options["F_s"]
    if options["v_s"] is None and F_s > F_c:
        raise ExoError(f"--F-s {F_s:g}: expected the Stribeck speed beside it (--v-s)")
    v_s = 1.0 if options["v_s"] is None else options["v_s"]
    term = Stribeck(F_c=F_c, F_s=F_s, v_s=v_s, b=options["b"] or 0.0)
    return Friction((term,)) if F_s else None
