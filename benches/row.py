"""What a provider yields."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Literal

Verdict = Literal["aim reached", "met", "MISSED", ""]


@dataclass(frozen=True, kw_only=True)
class Row:
    """A ratio, or another figure with a limit. At most `limit`, with `least` at least; None: it is information."""

    name: str
    value: float
    limit: float | None = None
    aim: float | None = None
    least: bool = False
    unit: str = ""
    #: The ratios of the rounds went from here to there.
    spread: tuple[float, float] | None = None
    #: The figures behind the ratio.
    told: str = ""

    def reaches(self, bound: float) -> bool:
        """Whether the value is on the good side of a bound."""
        return self.value >= bound if self.least else self.value <= bound

    @property
    def verdict(self) -> Verdict:
        """What has become of limit and aim."""
        if self.limit is None:
            return ""
        if self.aim is not None and self.reaches(self.aim):
            return "aim reached"
        return "met" if self.reaches(self.limit) else "MISSED"

    @property
    def share(self) -> float:
        """The value in units of its limit, below 1 where it is met."""
        if self.limit is None:
            raise ValueError(f"{self.name} has no limit")
        return self.limit / self.value if self.least else self.value / self.limit


@dataclass(frozen=True, kw_only=True)
class Sheet:
    """Figures that are no ratio: a heading, what they are, and a table."""

    title: str
    about: str
    header: Sequence[str]
    lines: Sequence[Sequence[str]]


@dataclass(frozen=True, kw_only=True)
class NotRun:
    """What was not measured, and why: a tool that is not there."""

    name: str
    reason: str


Found = Row | Sheet | NotRun


@dataclass(frozen=True, kw_only=True)
class Bench:
    """What providers work with."""

    #: The built archives; those of FMI 3.0 in `fmi3`.
    fmu_dir: Path
    #: For what is compiled and written meanwhile.
    work: Path
    #: Rounds of each comparison.
    rounds: int = 9
    #: Files of counted instructions, by what was counted: `fmu`, `floor`.
    counts: dict[str, Path] = field(default_factory=dict)


def amount(value: float) -> str:
    """A figure with three digits: .0123, 1.23, 123, 12300."""
    return f"{value:,.0f}" if abs(value) >= 1000 else f"{value:.3g}"


def small(ratio: float) -> str:
    """A ratio: `1/15.2` below a half."""
    return f"1/{1 / ratio:.3g}" if 0.0 < ratio < 0.5 else amount(ratio)
