"""By how much outputs differ, and by how much they may."""

from dataclasses import asdict, dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from exo.references.experiments import Experiment
from exo.references.series import Column
from exo.references.variables import nominal, unit
from exo.validate.rule import Finding, Severity

#: What outputs may differ by where nothing is stated, and what never counts: rounding of a column that is zero.
UNSTATED, NOTHING = 1e-3, 1e-12

Array = NDArray[Any]


@dataclass(frozen=True)
class Outcome:
    """How one output of an experiment came out."""

    experiment: str
    output: str
    unit: str
    #: Largest difference, and where it is (s); as much may be.
    difference: float
    at: float
    allowed: float

    @property
    def good(self) -> bool:
        """Whether the tolerance is kept."""
        return self.difference <= self.allowed


@dataclass
class Replay:
    """What became of an FMU's references."""

    findings: list[Finding] = field(default_factory=list)
    outcomes: list[Outcome] = field(default_factory=list)
    #: Sentences: what was not looked at, and why.
    skipped: list[str] = field(default_factory=list)

    @property
    def failed(self) -> bool:
        """Whether there is an error."""
        return any(finding.severity is Severity.ERROR for finding in self.findings)

    def as_json(self) -> dict[str, Any]:
        """For other programs: `failed`, `findings` as of `exo validate`, `outputs`, `skipped`."""
        return {
            "failed": self.failed,
            "findings": [asdict(finding) for finding in self.findings],
            "outputs": [asdict(one) | {"good": one.good} for one in self.outcomes],
            "skipped": self.skipped,
        }

    def sentences(self) -> list[str]:
        """One for each experiment that was replayed: by how much its outputs differ."""
        said = []
        for name in dict.fromkeys(one.experiment for one in self.outcomes):
            mine = [one for one in self.outcomes if one.experiment == name]
            worst = max(mine, key=lambda one: one.difference / one.allowed)
            most = f"by {worst.difference:.3g} {worst.unit}".rstrip()
            allowed = f"{worst.allowed:.3g} {worst.unit}".rstrip()
            differs = f"{worst.output} differs most, {most} of {allowed} allowed"
            said.append(f"experiment {name}: {len(mine)} outputs replayed; {differs}")
        return said


def judge(one: Experiment, column: Column, time: Array, got: Array) -> Outcome:
    """How an output came out; `got` has a row for each of the times."""
    variable = column.place.variable
    apart = np.abs(got - column.values).max(axis=1)
    apart[np.isnan(apart)] = np.inf
    row = int(apart.argmax())
    largest = max(float(np.abs(column.values).max()), nominal(variable))
    tolerance = UNSTATED if one.tolerance is None else one.tolerance
    return Outcome(
        experiment=one.name,
        output=column.name,
        unit=unit(variable),
        difference=float(apart[row]),
        at=float(time[row]),
        allowed=max(tolerance * largest, NOTHING),
    )


def sampled(time: Array, values: Array, wanted: Array, *, continuous: bool) -> Array:
    """Values at the wanted times: at a communication point those, in between on a straight line or those before."""
    after = np.clip(np.searchsorted(time, wanted), 0, len(time) - 1)
    before = np.clip(after - 1, 0, None)
    nearest = np.where(np.abs(time[after] - wanted) <= np.abs(time[before] - wanted), after, before)
    met = np.isclose(time[nearest], wanted, rtol=1e-9, atol=1e-9)
    span = np.where(time[after] > time[before], time[after] - time[before], 1.0)
    share = np.clip((wanted - time[before]) / span, 0.0, 1.0)[:, None] if continuous else 0.0
    between = values[before] + share * (values[after] - values[before])
    return np.where(met[:, None], values[nearest], between)
