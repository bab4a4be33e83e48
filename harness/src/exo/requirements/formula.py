"""Formulas of signal temporal logic, read and evaluated by rtamt in discrete time."""

import re
import sys
import typing
from collections.abc import Mapping
from functools import cache
from types import ModuleType
from typing import Any

import numpy as np
from numpy.typing import NDArray

#: Words of rtamt's language; what else looks like a name is a signal.
WORDS = frozenset({
    *("not", "and", "or", "implies", "iff", "xor", "rise", "fall", "always", "historically", "eventually", "once"),
    *("until", "since", "next", "prev", "sqrt", "exp", "pow", "abs", "F", "G", "O", "H", "U", "S", "X", "Y"),
    *("true", "false", "TRUE", "FALSE", "s", "ms", "us", "ns", "ps"),
})  # fmt: skip
NAME = re.compile(r"(?<![\w.])[A-Za-z]\w*")
#: rtamt counts in whole units; a sample period is a whole number of these.
UNIT, UNIT_S = "ns", 1e-9


def names(text: str) -> set[str]:
    """The signals of a formula; ValueError, if it is none."""
    found = {name for name in NAME.findall(text) if name not in WORDS}
    _parsed(text, found, step=UNIT_S)
    return found


def robustness(text: str, signals: Mapping[str, NDArray[np.float64]], *, step: float) -> float:
    """How far the formula is from breaking at the first sample, in the unit of its comparison; below 0 it is broken.

    `signals` have a number a sample, `step` seconds apart. NaN, where a signal has a number that is not finite: no
    margin can be given then. ValueError, if the formula cannot be evaluated at this step.
    """
    if not all(np.isfinite(values).all() for values in signals.values()):
        return float("nan")
    spec = _parsed(text, signals, step=step)
    length = min(len(values) for values in signals.values())
    trace: dict[str, Any] = {name: values.tolist() for name, values in signals.items()}
    try:
        return float(spec.evaluate({"time": list(range(length)), **trace})[0][1])
    except Exception as error:  # rtamt raises what its visitors meet
        raise ValueError(f"formula {text!r}: {_sentence(error)}") from error


def _parsed(text: str, signals: Any, *, step: float) -> Any:
    spec = _rtamt().StlDiscreteTimeSpecification()
    for name in sorted(signals):
        spec.declare_var(name, "float")
    spec.unit = "s"
    spec.set_sampling_period(round(step / UNIT_S), UNIT, 0.1)
    spec.spec = text
    try:
        spec.parse()
    except Exception as error:
        raise ValueError(
            f"formula {text!r}: {_sentence(error)}; expected signal temporal logic as rtamt reads it"
        ) from error
    return spec


@cache
def _rtamt() -> Any:
    """The library, imported when a formula is there: that takes a second.

    Its antlr4 takes `TextIO` from `typing.io`, which Python 3.13 has no more.
    """
    if "typing.io" not in sys.modules:
        module = ModuleType("typing.io")
        module.TextIO = typing.TextIO  # type: ignore[attr-defined]
        sys.modules["typing.io"] = module
    import rtamt  # noqa: PLC0415

    return rtamt


def _sentence(error: BaseException) -> str:
    return " ".join(str(error).split()) or type(error).__name__
