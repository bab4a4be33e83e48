"""Limits and margins of the sampled loop, found on the eigenvalues of `theory.closed_loop` or, where the hand acts many
samples late, by Nyquist's count of the same ones."""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
from numpy.polynomial import polynomial
from numpy.typing import NDArray

from exo import theory
from exo.theory import Hand
from exo.tuning.machine import Gains, Machine, loop
from exo.tuning.nyquist import Late, Parts, samples

#: An eigenvalue is this close to the unit circle before it counts as growing: the rounding of one that lies on it.
ON_THE_CIRCLE = 1e-9
#: Up to so many samples of reflex delay the eigenvalues of the matrix are as fast as counting.
FEW_SAMPLES = 32
#: Frequencies at which the loop is cut: at least so many, and so many in each turn of the hand's phase.
CUTS, CUTS_A_TURN = 4000, 32
#: Where the hand's force is this share of the mass' inertia it no longer shapes the loop.
FADED = 1e-3
#: Values tried a decade when a range is scanned; a limit is then refined by halves.
PER_DECADE = 24


def late_hand(*, machine: Machine, gains: Gains, M: float, hand: Hand) -> Late | None:
    """The loop at M (kg) for Nyquist's count, if its matrix would be large."""
    if samples(delay=hand.delay, T=machine.T)[0] <= FEW_SAMPLES or not (hand.k_h or hand.b_h):
        return None
    return Late.of(loop=loop(machine=machine, gains=gains, M=M), hand=hand, delay=machine.delay)


def felt(hand: Hand) -> Hand:
    """The hand; one that exerts nothing is never late."""
    return hand if hand.k_h or hand.b_h else Hand()


def is_stable(*, machine: Machine, gains: Gains, M: float, hand: Hand | None = None) -> bool:
    """Whether nothing grows at the mass M (kg), with the machine's hand or another one."""
    hand = felt(machine.hand if hand is None else hand)
    late = late_hand(machine=machine, gains=gains, M=M, hand=hand)
    if late:
        return not late.growing(size=math.exp(ON_THE_CIRCLE))
    loop_at = loop(machine=machine, gains=gains, M=M)
    return theory.growth_rate(loop=loop_at, hand=hand, delay=machine.delay) * machine.T <= ON_THE_CIRCLE


def growth(*, machine: Machine, gains: Gains, M: float) -> float:
    """Growth σ (1/s) of the slowest mode, exp(σ t), at the mass M (kg) with the machine's hand."""
    hand = felt(machine.hand)
    late = late_hand(machine=machine, gains=gains, M=M, hand=hand)
    if late:
        return late.growth() / machine.T
    return theory.growth_rate(loop=loop(machine=machine, gains=gains, M=M), hand=hand, delay=machine.delay)


@dataclass(frozen=True)
class Interval:
    """Between what values the loop is stable; 0 and infinity where no end was found."""

    low: float
    high: float

    def __contains__(self, value: float) -> bool:
        return self.low <= value <= self.high


def widest(*, stable: Callable[[float], bool], low: float, high: float) -> Interval | None:
    """The widest stable stretch, as a ratio, between `low` and `high`; None if there is none."""
    grid = np.geomspace(low, high, int(PER_DECADE * math.log10(high / low)) + 2)
    flags = [stable(float(x)) for x in grid]
    stretches, start = [], None
    for i, flag in enumerate([*flags, False]):
        if flag and start is None:
            start = i
        elif not flag and start is not None:
            stretches.append((start, i - 1))
            start = None
    if not stretches:
        return None
    first, last = max(stretches, key=lambda s: s[1] - s[0])
    lower = 0.0 if first == 0 else edge(stable=stable, inside=float(grid[first]), outside=float(grid[first - 1]))
    end = len(grid) - 1
    upper = math.inf if last == end else edge(stable=stable, inside=float(grid[last]), outside=float(grid[last + 1]))
    return Interval(lower, upper)


def edge(*, stable: Callable[[float], bool], inside: float, outside: float) -> float:
    """The end of a stable stretch between a value in it and one beyond it, to 1e-6 of itself."""
    while abs(outside / inside - 1.0) > 1e-6:
        middle = math.sqrt(inside * outside)
        inside, outside = (middle, outside) if stable(middle) else (inside, middle)
    return inside


def gain_interval(*, machine: Machine, gains: Gains, M: float, hand: Hand | None = None) -> Interval | None:
    """The K (N·s/m) for which the loop is stable at the mass M (kg): sampling ends it above, a hand below."""
    unit = M / machine.T
    return widest(
        stable=lambda K: is_stable(machine=machine, gains=replace(gains, K=K), M=M, hand=hand),
        low=1e-5 * unit,
        high=10.0 * unit,
    )


def hand_limit(*, machine: Machine, gains: Gains, M: float) -> float:
    """The hand stiffness (N/m) up to which the loop is stable at the mass M (kg), b_h and the hand's delay as given."""

    def stable(k_h: float) -> bool:
        return is_stable(machine=machine, gains=gains, M=M, hand=replace(machine.hand, k_h=k_h))

    softest = 1e-2
    if not stable(softest):
        return 0.0
    for k_h in np.geomspace(softest, 1e7, 9 * PER_DECADE + 1):
        if not stable(float(k_h)):
            return edge(stable=stable, inside=float(k_h) / 10.0 ** (1.0 / PER_DECADE), outside=float(k_h))
    return math.inf


def stable_at_all(*, machine: Machine, gains: Gains, k_h_factor: float) -> bool:
    """Whether the loop is stable at every mass, without a hand and with `k_h_factor` times the hand's stiffness."""
    stiffer = replace(machine.hand, k_h=k_h_factor * machine.k_h)
    return all(
        is_stable(machine=machine, gains=gains, M=M, hand=hand) for M in machine.masses for hand in (Hand(), stiffer)
    )


def smallest(*, stable: Callable[[float], bool], low: float, high: float) -> float | None:
    """The smallest value from which on the loop is stable up to `high`: 0 if it is at `low`, None if not at `high`."""
    if not stable(high):
        return None
    grid = np.geomspace(high, low, int(PER_DECADE * math.log10(high / low)) + 2)
    for inside, outside in pairwise(grid):
        if not stable(float(outside)):
            return edge(stable=stable, inside=float(inside), outside=float(outside))
    return 0.0


def delay_margin(*, machine: Machine, gains: Gains, M: float) -> float:
    """How much later τ_a may come (s) before the stable loop at M (kg) with the hand starts to grow; inf: any delay.

    L(z), z = exp(iωT), is the force that comes back for a unit force at the robot, cut at τ_a. Where |L| = 1 a further
    delay of φ/ω turns L onto −1 for feedback by −L, φ being the phase by which it lacks there.
    """
    omega = frequencies(machine=machine, M=M)
    L = cut_loop(machine=machine, gains=gains, M=M, omega=omega)
    size = np.log(np.abs(L))
    margins = []
    for i in np.flatnonzero(np.diff(np.signbit(size))):
        share = size[i] / (size[i] - size[i + 1])
        phase = np.unwrap(np.angle(-L[i : i + 2]))
        crossing = omega[i] + share * (omega[i + 1] - omega[i])
        lack = (phase[0] + share * (phase[1] - phase[0]) + math.pi) % (2.0 * math.pi)
        margins.append(float(lack / crossing))
    return min(margins, default=math.inf)


def frequencies(*, machine: Machine, M: float) -> NDArray[np.float64]:
    """Where the loop is looked at (rad/s): a late hand turns its phase every 2π/delay until the mass outweighs it."""
    fastest = math.pi / machine.T
    omega = np.geomspace(1e-3, fastest, CUTS)
    if not machine.hand_delay:
        return omega
    faded = min(fastest, max(math.sqrt(2.0 * machine.k_h / (M * FADED)), 2.0 * machine.b_h / (M * FADED)))
    turns = np.arange(1, math.ceil(CUTS_A_TURN * faded * machine.hand_delay / (2.0 * math.pi)) + 1)
    return np.union1d(omega, np.minimum(2.0 * math.pi / (CUTS_A_TURN * machine.hand_delay) * turns, fastest))


def cut_loop(*, machine: Machine, gains: Gains, M: float, omega: NDArray[np.float64]) -> NDArray[np.complex128]:
    """τ_a for a unit force at the robot in its place, at the frequencies `omega` (rad/s)."""
    at = loop(machine=machine, gains=gains, M=M)
    parts = Parts.of(loop=at)
    s = 1j * omega * machine.T
    z, w = np.exp(s), np.expm1(s)
    # As late as the hand is; linear between ticks as in `theory.closed_loop`.
    whole, share = samples(delay=machine.hand_delay, T=machine.T)
    late = np.exp(-whole * s) * (1.0 - share + share / z)

    def value(p: NDArray[np.float64]) -> NDArray[np.complex128]:
        return np.asarray(polynomial.polyval(w, p), dtype=np.complex128)

    asked, pushed = (late * value(p) for p in parts.hand(hand=machine.hand, T=machine.T))
    poles = w * value(parts.poles)
    f_h = -asked / (at.M * poles + pushed)
    place = (value(parts.q_u) + value(parts.q_f) * f_h) / poles  # over T²/M
    felt = value(parts.share) / value(parts.felt) * f_h
    y = (w + 2.0) * value(parts.G_2) * felt - w * machine.T / at.M * value(parts.I_1) * value(
        parts.G_1
    ) * place / value(parts.seen)
    return np.asarray(at.K * z**-machine.delay * y / value(parts.S))


@dataclass(frozen=True)
class Swing:
    """The least damped oscillation: damping ratio, and frequency in Hz."""

    damping: float
    frequency: float


def modes(*, machine: Machine, gains: Gains, M: float) -> tuple[float, Swing | None]:
    """Time constant (s) of the slowest mode, negative if it grows, and the least damped oscillation if there is one."""
    hand = felt(machine.hand)
    late = late_hand(machine=machine, gains=gains, M=M, hand=hand)
    if late:
        s, rate = late.roots() / machine.T, late.growth() / machine.T
    else:
        at = loop(machine=machine, gains=gains, M=M)
        eigenvalues = np.linalg.eigvals(theory.closed_loop(loop=at, hand=hand, delay=machine.delay)).astype(complex)
        s = np.log(eigenvalues[np.abs(eigenvalues) > 1e-12]) / machine.T
        rate = float(np.max(s.real))
    slowest = -1.0 / rate if rate else math.inf
    # A real negative eigenvalue, a swing from tick to tick, counts as one.
    swinging = [x for x in s if abs(x.imag) > 1e-6 * abs(x)]
    if not swinging:
        return slowest, None
    least = min(swinging, key=lambda x: -x.real / abs(x))
    return slowest, Swing(damping=float(-least.real / abs(least)), frequency=float(abs(least.imag) / (2.0 * math.pi)))


def error_per_newton(*, machine: Machine, gains: Gains, M: float, frequency: float) -> float:
    """|E/F_h| (m/N): the swing of e for a force of 1 N at `frequency` (Hz) without a hand, about as 1/K (thm:pm)."""
    law = theory.opened(loop=loop(machine=machine, gains=gains, M=M))
    z = np.exp(2j * math.pi * frequency * machine.T)
    late = z**-machine.delay
    left = z * np.eye(len(law.B)) - law.A - late * np.outer(law.B, law.C)
    x = np.linalg.solve(left[1:, 1:], (law.F + late * law.G * law.B)[1:])
    return float(abs(x[2]))
