"""From a number and its expectation to pass, fail or info."""

import math
from dataclasses import asdict, dataclass
from typing import Any, Literal

from exo.paper import Published
from exo.scenario import Check

Verdict = Literal["pass", "fail", "info"]
Kind = Literal["absolute", "relative", "at_most", "at_least", "none"]


@dataclass(frozen=True, kw_only=True)
class Result:
    """A metric with its verdict, as it stands in metrics.json."""

    id: str
    title: str
    value: float
    unit: str
    expected: float | None
    tolerance: float | None
    kind: Kind
    verdict: Verdict
    source: str
    because: str
    paper: Published | None
    #: What the command line changed and the expectation rests on: the number is information then.
    void_by: tuple[str, ...] = ()

    def as_json(self) -> dict[str, Any]:
        """The entry of metrics.json, without its id. A value that is not a finite number is null."""
        entry = asdict(self)
        del entry["id"]
        if not self.void_by:
            del entry["void_by"]
        if not math.isfinite(self.value):
            entry["value"] = None
        return entry

    @property
    def margin(self) -> float | None:
        """Distance from the value to the bound of what is expected, in the metric's unit; below zero is beyond it."""
        tolerance = self.tolerance or 0.0
        match self.kind, self.expected:
            case "absolute", float(expected):
                return tolerance - abs(self.value - expected)
            case "relative", float(expected):
                return tolerance * abs(expected) - abs(self.value - expected)
            case "at_most", float(expected):
                return expected + tolerance - self.value
            case "at_least", float(expected):
                return self.value - (expected - tolerance)
        return None

    def expectation(self) -> str:
        """The expectation as text."""
        return expectation(kind=self.kind, expected=self.expected, tolerance=self.tolerance)


def expectation(*, kind: str, expected: float | None, tolerance: float | None) -> str:
    """An expectation as text, for instance `10.18 ± 0.1`."""
    tolerance = tolerance or 0.0
    slack = f" (+ {tolerance:g})" if tolerance else ""
    match kind:
        case "absolute":
            return f"{expected:g} ± {tolerance:g}"
        case "relative":
            return f"{expected:g} ± {100 * tolerance:g} %"
        case "at_most":
            return f"≤ {expected:g}{slack}"
        case "at_least":
            return f"≥ {expected:g}{slack}"
    return "–"


def beside_the_paper(result: Result) -> Result:
    """The same number, judged by the one that the paper prints, where that is fair."""
    paper = result.paper
    if paper is None or not paper.is_fair:
        raise ValueError(f"{result.id}: no fair comparison with the paper")
    return judge(
        metric=f"{result.id}/paper",
        title=f"{result.title}, beside the paper",
        value=result.value,
        unit=result.unit,
        check=Check(value=paper.value, within=paper.within, relative=paper.relative, because=paper.because),
        source=f"{paper.label}: {paper.quantity}",
        void_by=result.void_by,
    )


def judge(
    *,
    metric: str,
    title: str,
    value: float,
    unit: str,
    check: Check,
    source: str,
    paper: Published | None = None,
    void_by: tuple[str, ...] = (),
) -> Result:
    """Compares; a NaN fails whatever is expected. Where `void_by` names something, nothing is judged."""
    expected: float | None
    tolerance: float | None
    kind: Kind
    slack = check.within or 0.0
    if check.value is not None and check.relative is not None:
        kind, expected, tolerance = "relative", check.value, check.relative
        good = abs(value - expected) <= tolerance * abs(expected)
    elif check.value is not None:
        kind, expected, tolerance = "absolute", check.value, slack
        good = abs(value - expected) <= tolerance
    elif check.at_most is not None:
        kind, expected, tolerance = "at_most", check.at_most, slack
        good = value <= expected + slack
    elif check.at_least is not None:
        kind, expected, tolerance = "at_least", check.at_least, slack
        good = value >= expected - slack
    else:
        kind, expected, tolerance, good = "none", None, None, True
    verdict: Verdict = "info" if kind == "none" or void_by else "pass" if good else "fail"
    return Result(
        id=metric,
        title=title,
        value=value,
        unit=unit,
        expected=expected,
        tolerance=tolerance,
        kind=kind,
        verdict=verdict,
        source=source,
        because=check.because,
        paper=paper,
        void_by=void_by if kind != "none" else (),
    )
