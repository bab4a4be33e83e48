"""The windows of a formula, counted in samples. rtamt takes what lies behind the end of a run for met, and bounds that
run backwards for a window without samples: how far a formula looks, and its bounds, are judged here.
"""

from math import isclose
from typing import Any

#: What rtamt calls the operators that look ahead.
AHEAD = ("TimedAlways", "TimedEventually", "TimedUntil")
NEXT = ("Next", "StrongNext")
#: Seconds.
UNITS = {"s": 1.0, "ms": 1e-3, "us": 1e-6, "ns": 1e-9}


def counted(node: Any, *, step: float | None) -> int:
    """Puts the bounds of all windows below `node` in samples, `step` seconds apart; without a step they stay.

    Returns how many samples behind the first one they need, nested windows added up. An operator without a window needs
    what is below it. ValueError for bounds that are negative, do not increase, or are no multiple of the step.
    """
    inner = max((counted(child, step=step) for child in node.children), default=0)
    kind = type(node).__name__
    if kind in NEXT:
        return inner + 1
    if not hasattr(node, "begin_unit"):
        return inner
    end = _window(node, step)
    return inner + end if kind in AHEAD else inner


def _window(node: Any, step: float | None) -> int:
    """Its end in samples. One unit behind the second bound is that of both."""
    written = f"window [{float(node.begin):g}{node.begin_unit}:{float(node.end):g}{node.end_unit}]"
    if node.begin_unit and not node.end_unit:
        raise ValueError(f"{written}: expected a unit behind the second bound, too")
    unit = node.end_unit or "s"
    begin, end = (
        float(value) * UNITS[name] for value, name in ((node.begin, node.begin_unit or unit), (node.end, unit))
    )
    if not 0.0 <= begin <= end:
        raise ValueError(f"{written}: expected bounds of 0 or more that increase")
    if step is None:
        return 0
    samples = [round(bound / step) for bound in (begin, end)]
    for bound, count in zip((begin, end), samples, strict=True):
        if not isclose(count * step, bound, rel_tol=1e-9, abs_tol=1e-9 * step):
            raise ValueError(f"{written}: expected multiples of the step, {step:g} s")
    node.begin, node.end = samples
    node.begin_unit = node.end_unit = ""
    return samples[1]
