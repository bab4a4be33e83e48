"""What one count of the encoder is worth: as velocity, as force, and whether friction swallows it.

The law takes q from an encoder whose count is δ and differentiates it, so its reading is wrong by up to δ/2, and its
velocity by up to δ/T. Error and nominal are linear: the force that the errors make is a sum over those of all ticks,

    τ_a − τ_a(ideal) = Σ g_k ε_(n−k),  |ε| ≤ δ/2    ⇒    |τ_a − τ_a(ideal)| ≤ δ/2 Σ |g_k|

and no bound is less, since ε may have the sign of every g_k. Dry friction takes F_c for each metre. So no error can
keep the robot moving while

    δ/2 Σ |g_k| ≤ F_c

For a bare spring K_w (g_0 = K_w) this is K_w ≤ 2 F_c/δ: Abbott and Okamura, Effects of position quantization and
sampling rate on virtual-wall passivity, IEEE TRO 21 (2005), and Diolaiti et al., Stability of haptic rendering, IEEE
TRO 22 (2006). Here the damper counts, too, and for more: K/T beside K K_P. Where it does not hold, a limit cycle may
be: sufficient, and not necessary.
"""

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from exo import theory
from exo.tuning.machine import Gains, Machine, loop

#: Of the response to one error this share is left when the sum ends; and never more ticks than that.
LEFT, TICKS = 1e-9, 1_000_000
#: The lowest corner frequency that is looked at, as a share of the sample rate.
LOWEST = 1e-4


@dataclass(frozen=True, kw_only=True)
class Quantization:
    """One count of `resolution` δ (m).

    velocity: what a count adds to the velocity in one tick, behind the low pass if there is one (m/s). step: the
    largest force that one count makes (N). force: the largest that readings within δ/2 make (N). share: force/F_c, inf
    without dry friction. Each alone makes the share 1, None where it alone does not do: resolution_needed (m), K_needed
    (N·s/m), cutoff_needed of the velocity's low pass (Hz).
    """

    resolution: float
    velocity: float
    step: float
    force: float
    share: float
    resolution_needed: float | None
    K_needed: float | None
    cutoff_needed: float | None

    @property
    def is_swallowed(self) -> bool:
        """Whether no limit cycle can come from the encoder."""
        return self.share <= 1.0


def force_response(*, machine: Machine, gains: Gains) -> NDArray[np.float64]:
    """g_k (N/m): τ_a at the ticks after a reading that is wrong by 1 m at one tick, while the robot stands.

    The reading enters e at its own tick, and the velocity at that and the next one. The law is that of `theory.opened`;
    the robot's mass does not matter.
    """
    law = theory.opened(loop=loop(machine=machine, gains=gains, M=machine.M_min))
    own, order = law.A.copy(), len(law.B)
    own[:3] = 0.0  # of x = (q, dq, q_k − q_{k−1}, e, v_n, …): the robot stands
    wrong = np.zeros(order)
    wrong[2], wrong[3] = 1.0, -1.0  # q is read too large by 1: it seems to have moved, and e is too small
    right = np.zeros(order)
    right[2], right[3] = -1.0, 1.0  # and back again
    x, responses = wrong, []
    for k in range(TICKS):
        responses.append(float(law.C @ x))
        x = own @ x + (right if k == 0 else 0.0)
        if k > 2 and k % 256 == 0 and np.max(np.abs(responses[-256:])) < LEFT * abs(responses[0]):
            break
    return np.array(responses)


def quantization(*, machine: Machine, gains: Gains, F_c: float) -> Quantization | None:
    """Judges the machine's resolution against dry friction `F_c` (N); None for an ideal encoder."""
    delta = machine.resolution
    if not delta:
        return None
    force = largest_force(machine=machine, gains=gains)
    share = force / F_c if F_c else math.inf
    return Quantization(
        resolution=delta,
        velocity=theory.weight(cutoff=machine.dq_cutoff, T=machine.T) * delta / machine.T,
        step=delta * float(np.max(np.abs(np.cumsum(force_response(machine=machine, gains=gains))))),
        force=force,
        share=share,
        resolution_needed=delta / share if F_c else None,
        K_needed=gains.K / share if F_c else None,  # the open law's force is proportional to K
        cutoff_needed=cutoff_needed(machine=machine, gains=gains, F_c=F_c),
    )


def largest_force(*, machine: Machine, gains: Gains) -> float:
    """δ/2 Σ |g_k| (N)."""
    return 0.5 * machine.resolution * float(np.sum(np.abs(force_response(machine=machine, gains=gains))))


def cutoff_needed(*, machine: Machine, gains: Gains, F_c: float) -> float | None:
    """The highest corner frequency (Hz) of the velocity's low pass with which friction swallows the counts; None if
    none down to `LOWEST` of the sample rate does, or if they are swallowed as it is."""

    def swallowed(cutoff: float) -> bool:
        return largest_force(machine=replace(machine, dq_cutoff=cutoff), gains=gains) <= F_c

    low, high = LOWEST / machine.T, machine.dq_cutoff or 1.0 / machine.T
    if largest_force(machine=machine, gains=gains) <= F_c or not swallowed(low):
        return None
    while high / low > 1.001:
        middle = math.sqrt(low * high)
        low, high = (middle, high) if swallowed(middle) else (low, middle)
    return low
