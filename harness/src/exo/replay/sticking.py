"""When a robot sticks: it stays at a surface although the hand pulls it away."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

#: How far from a surface is "away from it" (m): the testbed's wall, the arm's table and wall, as the scenarios' metrics
#: of leaving have it.
TESTBED_MARGIN, ARM_MARGIN = 0.001, 0.002


@dataclass(frozen=True)
class Episode:
    """One time of sticking."""

    #: Last instant at which the hand did not pull away (s).
    begin: float
    #: First instant away from the surface, or at which the hand no longer pulls (s).
    end: float
    #: Whether it ended because the robot came away; if not, the hand gave up or the run was over.
    let_go: bool
    #: Since when the hand had pressed at the surface, or the contact, whichever is later (s).
    pressed: float
    surface: str

    def as_json(self) -> dict[str, Any]:
        """For a scene."""
        return {"from": self.begin, "to": self.end, "letGo": self.let_go, "surface": self.surface}


def episodes(
    *, time: NDArray[np.float64], near: NDArray[np.bool_], pull: NDArray[np.float64], surface: str
) -> list[Episode]:
    """Every time of sticking. `near`: within the margin of the surface; `pull`: the hand's force away from it (N)."""
    stuck = near & (pull > 0.0)
    edges = np.flatnonzero(np.diff(np.concatenate([[False], stuck, [False]]).astype(np.int8)))
    away, pulls = np.flatnonzero(~near), np.flatnonzero(pull > 0.0)
    found = []
    for first, after in zip(edges[::2], edges[1::2], strict=True):
        end = min(after, len(time) - 1)
        contact = _after_last(away, first)
        # One that comes to the surface while the hand pulls has not stuck before.
        begin = max(first - 1, contact)
        pressed = max(contact, _after_last(pulls, begin))
        found.append(Episode(float(time[begin]), float(time[end]), bool(not near[end]), float(time[pressed]), surface))
    return found


def _after_last(ticks: NDArray[np.intp], before: int) -> int:
    """The tick after the last of `ticks` that comes before `before`; 0, if there is none."""
    earlier = ticks[: np.searchsorted(ticks, before)]
    return int(earlier[-1]) + 1 if len(earlier) else 0
