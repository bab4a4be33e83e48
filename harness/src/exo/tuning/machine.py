"""What is tuned: a machine, who holds it, and the gains."""

import math
from dataclasses import dataclass, fields

import numpy as np

from exo.errors import ExoError
from exo.theory import Hand, Loop

#: Masses between the lightest and the heaviest at which the loop is judged.
MASSES = 9
#: What may be 0. Everything else has the range of the controllers' parameters (`min` of modelDescription/*.xml).
MAY_BE_ZERO = (
    *("k_h", "b_h", "hand_delay", "substep", "D_n", "alpha", "delay"),
    *("dq_cutoff", "f_cutoff", "drive_cutoff", "resolution", "F_c", "F_s", "b"),
)
LEAST = 1e-6
#: Beyond it no machine is meant, and the arithmetic would overflow.
MOST = 1e12


class Checked:
    """Refuses what is not finite or out of its range, by name."""

    def __post_init__(self) -> None:
        for field in fields(self):  # type: ignore[arg-type]
            least = 0.0 if field.name in MAY_BE_ZERO else -MOST if field.name == "slope" else LEAST
            check(field.name, getattr(self, field.name), least=least)


def check(name: str, value: float, *, least: float, most: float = MOST) -> None:
    """Refuses a value that is not finite or not within the range."""
    if not math.isfinite(value) or value < least:
        raise ExoError(f"{name} = {value:g}: expected a finite value, at least {least:g}")
    if value > most:
        raise ExoError(f"{name} = {value:g}: expected at most {most:g}")


@dataclass(frozen=True, kw_only=True)
class Machine(Checked):
    """A robot along one axis, and the hand on it.

    T in s; delay of the force in samples; effective masses M_min ≤ M_max in kg; k_h in N/m, b_h in N·s/m, hand_delay in
    s; substep of the simulated plant in s, 0 for the exact mass. Corner frequencies in Hz, 0 for none: of the low
    passes on the velocity and on the force that the law sees, and of the drive's lag. resolution: one count of the
    encoder along the axis in m, 0 for an ideal one. slope: friction of the robot over its speed in N·s/m, of either
    sign.
    """

    T: float
    delay: int = 0
    M_min: float
    M_max: float
    k_h: float = 0.0
    b_h: float = 0.0
    hand_delay: float = 0.0
    substep: float = 0.0
    dq_cutoff: float = 0.0
    f_cutoff: float = 0.0
    drive_cutoff: float = 0.0
    resolution: float = 0.0
    slope: float = 0.0

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.M_max < self.M_min:
            raise ExoError(f"M_max = {self.M_max:g}: expected at least M_min = {self.M_min:g}")
        if self.delay not in (0, 1):
            raise ExoError(f"delay = {self.delay}: expected 0 or 1")
        if self.hand_delay > 1.0:
            raise ExoError(f"hand_delay = {self.hand_delay:g}: expected at most 1 s")

    @property
    def hand(self) -> Hand:
        """The hand."""
        return Hand(k_h=self.k_h, b_h=self.b_h, delay=self.hand_delay)

    @property
    def masses(self) -> list[float]:
        """Masses at which the loop is judged, from the lightest to the heaviest."""
        if self.M_min == self.M_max:
            return [self.M_min]
        return [float(M) for M in np.geomspace(self.M_min, self.M_max, MASSES)]


@dataclass(frozen=True, kw_only=True)
class Gains(Checked):
    """Gains of one axis: M_n in kg, D_n, K and alpha in N·s/m, K_P in 1/s."""

    M_n: float
    D_n: float
    K: float
    K_P: float
    alpha: float = 1.0


def loop(*, machine: Machine, gains: Gains, M: float) -> Loop:
    """The loop at the mass M (kg)."""
    return Loop(
        M=M,
        M_n=gains.M_n,
        D_n=gains.D_n,
        K=gains.K,
        K_P=gains.K_P,
        alpha=gains.alpha,
        T=machine.T,
        substep=machine.substep,
        b=machine.slope,
        dq_cutoff=machine.dq_cutoff,
        f_cutoff=machine.f_cutoff,
        drive_cutoff=machine.drive_cutoff,
    )
