"""A number with its expectation, its verdict, and what it was before: a row of the page."""

import math
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

from exo import earlier
from exo.errors import ExoError
from exo.paper import Published
from exo.verdict import expectation

Change = Literal["", "new", "verdict", "value"]
#: Before the id of a number that is the margin of a requirement; its formula stands in `because`.
REQUIREMENT = "requirement."
#: Of the gauge: how far beyond the tolerance a number is still drawn in its place.
BEYOND = 1.25


@dataclass(frozen=True, kw_only=True)
class Row:
    """As the page shows it. `share` is the distance from the expected value over the tolerance; None without one."""

    id: str
    title: str
    verdict: str
    measured: str
    unit: str
    expected: str
    share: float | None
    paper: Published | None
    #: Why the number is off the paper's by more than its rounding, or nothing.
    off: str
    source: str
    because: str
    void_by: tuple[str, ...]
    change: Change
    #: What the earlier run had, as text; empty where there was none, or it was the same.
    was: str
    value: float | None

    @property
    def is_requirement(self) -> bool:
        """Whether the number is the margin of a requirement."""
        return self.id.startswith(REQUIREMENT)


class Before:
    """Where the earlier verdicts of a scenario come from."""

    def __init__(self, against: Path | None) -> None:
        if against is not None and not against.is_dir():
            raise ExoError(f"--against {against}: no such folder; expected one with results of exo")
        self._against = against

    def of(self, folder: Path) -> dict[str, Any] | None:
        """Date and metrics of the earlier run of the scenario whose results are in `folder`; None without one."""
        return earlier.of(self._against / folder.name) if self._against is not None else earlier.read(folder)


def row(name: str, metric: dict[str, Any], before: dict[str, Any] | None) -> Row:
    """A row from the entry `name` of metrics.json; `before` is the earlier run."""
    old = None if before is None else before["metrics"].get(name)
    paper = Published(**metric["paper"]) if metric["paper"] is not None else None
    value = metric["value"]
    change = _change(metric, old) if before is not None else ""
    return Row(
        id=name,
        title=metric["title"],
        verdict=metric["verdict"],
        measured=number(value),
        unit=metric["unit"],
        expected=expectation(kind=metric["kind"], expected=metric["expected"], tolerance=metric["tolerance"]),
        share=_share(metric),
        paper=paper,
        off=paper.explains(value) if paper is not None and value is not None else "",
        source=metric["source"],
        because=metric["because"],
        void_by=tuple(metric.get("void_by", ())),
        change=change,
        was=f"{old['verdict']}, {number(old['value'])} {old['unit']}" if old is not None and change else "",
        value=value,
    )


def number(value: float | None) -> str:
    """Five digits; an undefined number says so."""
    return "undefined" if value is None else f"{value:.5g}"


def plain(value: float) -> str:
    """A small number without an exponent: 0.00005."""
    return f"{value:.9f}".rstrip("0").rstrip(".") if 1e-6 <= abs(value) < 1e-3 else f"{value:g}"


def difference(row: Row) -> str:
    """How far the number is off the paper's, as a share of that; empty where one of them is no number, or zero."""
    if row.paper is None or row.value is None or not row.paper.value:
        return ""
    percent = round(100.0 * (row.value / row.paper.value - 1.0), 2)
    return f"{percent:+.2f} %" if percent else "0 %"


def _change(metric: dict[str, Any], old: dict[str, Any] | None) -> Change:
    """Numbers are compared as they are shown: another last bit is no news."""
    if old is None:
        return "new"
    if old["verdict"] != metric["verdict"]:
        return "verdict"
    same = number(old["value"]) == number(metric["value"]) and old["unit"] == metric["unit"]
    return "" if same else "value"


def _share(metric: dict[str, Any]) -> float | None:
    tolerance = metric["tolerance"] or 0.0
    if metric["kind"] == "relative":
        tolerance *= abs(metric["expected"])
    if metric["kind"] not in ("absolute", "relative") or metric["value"] is None or tolerance <= 0.0:
        return None
    share = (metric["value"] - metric["expected"]) / tolerance
    return min(max(share, -BEYOND), BEYOND) if math.isfinite(share) else None
