"""Formulas of signal temporal logic, read and evaluated by rtamt in discrete time."""

import re
import sys
import typing
import warnings
from collections.abc import Mapping
from functools import cache
from types import ModuleType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from exo.requirements import windows

#: Words of rtamt's language; what else looks like a name is a signal.
WORDS = frozenset({
    *("not", "and", "or", "implies", "iff", "xor", "rise", "fall", "always", "historically", "eventually", "once"),
    *("until", "unless", "since", "next", "prev", "sqrt", "exp", "pow", "abs", "F", "G", "O", "H", "U", "S", "X", "Y"),
    *("true", "false", "TRUE", "FALSE", "s", "ms", "us", "ns", "ps"),
})  # fmt: skip
NAME = re.compile(r"(?<![\w.])[A-Za-z]\w*")
#: rtamt takes `x/y` for one name.
JOINED = re.compile(r"[A-Za-z]\w*/\w*")


def names(text: str) -> set[str]:
    """The signals of a formula; ValueError, if it is none."""
    if joined := JOINED.search(text):
        raise ValueError(f"formula {text!r}: {joined[0]} would be one name; expected spaces around /")
    found = {name for name in NAME.findall(text) if name not in WORDS}
    _parsed(text, found, step=None)
    return found


def robustness(text: str, signals: Mapping[str, NDArray[np.float64]], *, step: float) -> float:
    """How far the formula is from breaking at the first sample, in the unit of its comparison; below 0 it is broken.

    `signals` have a number a sample, `step` seconds apart. NaN, where a signal has a number that is not finite: no
    margin can be given then. ValueError, if the formula cannot be evaluated at this step, or looks behind the end.
    """
    if not all(np.isfinite(values).all() for values in signals.values()):
        return float("nan")
    spec, ahead = _parsed(text, signals, step=step)
    length = min(len(values) for values in signals.values())
    if length < 2:
        raise ValueError(f"formula {text!r}: one sample is left; expected two or more")
    if ahead >= length:
        raise ValueError(
            f"formula {text!r} looks {ahead * step:g} s ahead and the run ends after {(length - 1) * step:g} s; "
            "expected a longer run, or shorter windows"
        )
    trace: dict[str, Any] = {name: values.tolist() for name, values in signals.items()}
    try:
        margin = float(spec.evaluate({"time": list(range(length)), **trace})[0][1])
    except Exception as error:  # rtamt raises what its visitors meet
        raise ValueError(f"formula {text!r}: {_sentence(error)}") from error
    if not np.isfinite(margin):
        raise ValueError(f"formula {text!r}: its margin is {margin:g}, because it looks at no sample")
    return margin


def _parsed(text: str, signals: Any, *, step: float | None) -> tuple[Any, int]:
    """rtamt's specification with windows in samples, and by how many it looks ahead."""
    spec = _rtamt().StlDiscreteTimeSpecification()
    for name in sorted(signals):
        spec.declare_var(name, "float")
    spec.unit = "s"
    # A sample a second: rtamt counts in whole nanoseconds, which a step need not be.
    spec.set_sampling_period(1, "s", 0.1)
    spec.spec = text
    try:
        spec.parse()
    except Exception as error:
        raise ValueError(
            f"formula {text!r}: {_sentence(error)}; expected signal temporal logic as rtamt reads it"
        ) from error
    try:
        return spec, max(windows.counted(node, step=step) for node in spec.ast.specs)
    except ValueError as error:
        raise ValueError(f"formula {text!r}: {error}") from error


@cache
def _rtamt() -> Any:
    """The library, imported when a formula is there: that takes a second.

    Its antlr4 takes `TextIO` from `typing.io`, which Python 3.13 has no more.
    """
    if "typing.io" not in sys.modules:
        module = ModuleType("typing.io")
        module.TextIO = typing.TextIO  # type: ignore[attr-defined]
        sys.modules["typing.io"] = module
    with warnings.catch_warnings():
        # Python 3.11 says of that import that it is deprecated: nothing that a user could mend.
        warnings.simplefilter("ignore", DeprecationWarning)
        import rtamt  # noqa: PLC0415

    return rtamt


def _sentence(error: BaseException) -> str:
    return " ".join(str(error).split()) or type(error).__name__
