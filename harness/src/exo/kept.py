"""What a run leaves besides its numbers and pictures: whose signals, and whether as CSV too."""

from collections.abc import Iterable
from dataclasses import dataclass

from exo.errors import ScenarioError, close_matches

ALL, NONE = "all", "none"


@dataclass(frozen=True, kw_only=True)
class Kept:
    """`signals`: ids of the scenarios whose signals are written; None: of all. `csv`: beside each Parquet file."""

    signals: frozenset[str] | None = None
    csv: bool = False

    def has_signals_of(self, scenario: str) -> bool:
        """Whether the signals of this scenario are written."""
        return self.signals is None or scenario in self.signals


EVERYTHING = Kept()


def parse(*, signals: str, csv: bool, scenarios: Iterable[str]) -> Kept:
    """`signals` is `all`, `none`, or ids between commas, each one of `scenarios`."""
    if signals == ALL:
        return Kept(csv=csv)
    chosen = [] if signals == NONE else [name.strip() for name in signals.split(",")]
    known = list(scenarios)
    for name in chosen:
        if name not in known:
            hint = close_matches(name, known)
            raise ScenarioError(f"--signals {signals}: expected all, none or scenarios that run, got {name!r}{hint}")
    return Kept(signals=frozenset(chosen), csv=csv)
