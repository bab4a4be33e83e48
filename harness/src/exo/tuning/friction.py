"""Dry friction along one axis: its force over speed, and what it is worth to a motion that swings.

    F(v) = Σ F_c + (F_s − F_c) exp(−(v/v_s)²) + b v,  v > 0; F(−v) = −F(v)

as the plants have it (`plant-fmu/mechanics/src/arm/stribeck.rs`; the testbed's is F_s = F_c). One term a joint.
"""

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from exo.errors import ExoError
from exo.tuning.machine import LEAST, Checked

Array = NDArray[np.float64]
#: Angles at which a swing is averaged over a period; half of them off zero, where the force jumps.
ANGLES = (np.arange(720) + 0.5) * (2.0 * np.pi / 720)
#: Swings that are tried, over the speed: below 1 nothing turns round.
SWINGS = np.concatenate([np.geomspace(1e-3, 0.95, 10), np.geomspace(1.001, 30.0, 24)])


@dataclass(frozen=True, kw_only=True)
class Stribeck(Checked):
    """One term: F_c and F_s in N, F_s at least F_c; v_s in m/s; b in N·s/m."""

    F_c: float
    F_s: float
    v_s: float
    b: float

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.F_s < self.F_c:
            raise ExoError(f"F_s = {self.F_s:g}: expected at least F_c = {self.F_c:g}")

    def along(self, turn: float) -> "Stribeck | None":
        """Of a joint (N·m, rad/s, N·m·s/rad) that turns by `turn` (rad) for each metre of the axis; None if it stands.

        Virtual work: the force at the handle is |turn| times the torque, at a speed that is 1/|turn| of the joint's.
        """
        turn = abs(turn)
        if turn < LEAST:
            return None
        return Stribeck(F_c=turn * self.F_c, F_s=turn * self.F_s, v_s=self.v_s / turn, b=turn**2 * self.b)


@dataclass(frozen=True)
class Friction:
    """The sum of its terms."""

    terms: tuple[Stribeck, ...]

    @property
    def F_c(self) -> float:  # noqa: N802, the paper's symbol
        """What holds at speed, without the part that grows with it (N)."""
        return sum(term.F_c for term in self.terms)

    @property
    def F_s(self) -> float:  # noqa: N802, the paper's symbol
        """What holds at rest (N)."""
        return sum(term.F_s for term in self.terms)

    @property
    def b(self) -> float:
        """What grows with speed (N·s/m)."""
        return sum(term.b for term in self.terms)

    def force(self, v: Array) -> Array:
        """F(v) in N at the speeds `v` (m/s, not 0)."""
        size = np.abs(v)
        dry = sum(t.F_c + (t.F_s - t.F_c) * np.exp(-np.minimum((size / t.v_s) ** 2, 700.0)) for t in self.terms)
        return np.asarray(np.sign(v) * dry + self.b * v)

    def slope(self, v: float) -> float:
        """dF/dv in N·s/m at the speed v > 0 (m/s): negative where friction falls with speed."""
        falls = sum(2.0 * (t.F_s - t.F_c) * v / t.v_s**2 * math.exp(-min((v / t.v_s) ** 2, 700.0)) for t in self.terms)
        return self.b - falls

    @cached_property
    def least_slope(self) -> float:
        """The smallest slope at any speed (N·s/m)."""
        if not self.terms:
            return 0.0
        speeds = [t.v_s for t in self.terms]
        return min(self.slope(float(v)) for v in np.geomspace(0.1 * min(speeds), 5.0 * max(speeds), 400))

    def equivalent(self, v: float, swing: float) -> float:
        """The damper (N·s/m) that does the work of friction on v + `swing` sin θ: the describing function with a bias.

        N = 2/swing · mean of F(v + swing sin θ) sin θ. For F_c alone and swing > v it is
        4 F_c/(π swing) √(1 − (v/swing)²), at most 2 F_c/(π v). Gelb and Vander Velde, Multiple-Input Describing
        Functions, 1968, chapter 6.
        """
        sine = np.sin(ANGLES)
        return float(2.0 * np.mean(self.force(v + swing * sine) * sine) / swing)

    def span(self, v: float) -> tuple[float, float]:
        """The least and the largest `equivalent` of any swing at the speed v > 0 (m/s), its slope among them."""
        sine = np.sin(ANGLES)
        speeds = v * (1.0 + SWINGS[:, None] * sine)
        worth = 2.0 * np.mean(self.force(speeds) * sine, axis=1) / (v * SWINGS)
        ends = [*worth, self.slope(v), self.b]
        return float(min(ends)), float(max(ends))
