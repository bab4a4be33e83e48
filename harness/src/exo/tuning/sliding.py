"""Below which speed a hand-led motion sticks and slips.

Three rules, each on the loop of `exo.theory` with the damper that friction is worth to a motion at a mean speed v:

* steady motion grows into a swing where the loop with friction's slope dF/dv is unstable (Armstrong-Hélouvry, Dupont
  and Canudas de Wit, Automatica 30, 1994, section 5: friction that falls with speed is a negative damper);
* a swing that is there can last where the loop is unstable with what friction is worth to a swing of some size, its
  describing function with a bias (Olsson and Åström, Friction generated limit cycles, IEEE TCST 9, 2001): then it
  depends on the start, a jolt or rest, what becomes of the motion;
* where neither is, everything dies out, and the motion is smooth.

A describing function is an approximation: it takes the swing as a sine, and rest as a passing of zero.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from exo.errors import ExoError
from exo.theory import substeps
from exo.tuning import region
from exo.tuning.friction import Friction
from exo.tuning.machine import Gains, Machine
from exo.tuning.region import Interval

#: Speeds that are judged (m/s), and dampers that are tried a decade.
SPEEDS = np.geomspace(1e-4, 1.0, 161)
PER_DECADE = 8
#: Below this (N·s/m) a damper is nothing.
NOTHING = 1.0
#: How far below the least slope of friction dampers are tried.
BEYOND = 4.0
#: How far above what is needed K is looked for.
FURTHER = 100.0
#: Largest exponent by which a motion may grow within a period: the exponential overflows at 700, and Nyquist's
#: polynomials are products of several. And within a substep: backward Euler has a pole there.
GROWTH_MOST, GROWTH_MOST_OF_A_SUBSTEP = 100.0, 10.0


@dataclass(frozen=True, kw_only=True)
class Sliding:
    """What dry friction does to a motion along the axis, at the mass M (kg).

    F_s, F_c in N; least_slope of friction in N·s/m; least_held: the slope above which the loop holds it, −inf if it
    holds four times what this friction has. unstable: the dampers (N·s/m) with which the loop is not stable. slips:
    the speeds (m/s) at which steady motion is unstable. smooth_above: from this speed on (m/s) no swing lasts, 0 if
    none does at any speed, inf if one does at every speed. K_smooth: the K (N·s/m) from which on no speed slips by
    itself, None if K alone does not do. speed (m/s) is one that is asked about, and verdict what it does: "slips",
    "after a jolt", "smooth".
    """

    M: float
    F_s: float
    F_c: float
    least_slope: float
    least_held: float
    unstable: list[Interval]
    slips: list[Interval]
    smooth_above: float
    K_smooth: float | None
    speed: float | None
    verdict: str | None

    @property
    def slips_below(self) -> float:
        """The largest speed (m/s) at which steady motion is unstable; 0: none."""
        return max((speeds.high for speeds in self.slips), default=0.0)


def sliding(*, machine: Machine, gains: Gains, friction: Friction, M: float, speed: float | None = None) -> Sliding:
    """Judges the motion at every speed, and at `speed` (m/s).

    ExoError, if friction falls with speed more steeply than can be computed (`least_damper`).
    """
    speeds = [float(v) for v in SPEEDS]
    spans = {v: friction.span(v) for v in speeds}
    lowest = min(low for low, _ in spans.values())
    least = least_damper(machine=machine, M=M)
    steepest = min(friction.least_slope, lowest, friction.span(speed)[0] if speed else 0.0)
    _check_fall(friction, steepest=steepest, least=least, M=M)
    unstable = unstable_dampers(
        machine=machine,
        gains=gains,
        M=M,
        least=min(lowest, max(BEYOND * lowest, least)),  # it shows how far the loop is from slipping
        most=max(high for _, high in spans.values()),
    )

    def unsteady(v: float) -> bool:
        return any(friction.slope(v) in dampers for dampers in unstable)

    def lasting(v: float) -> bool:
        low, high = friction.span(v)
        return any(dampers.low <= high and low <= dampers.high for dampers in unstable)

    lasts = ranges(speeds, lasting)
    negative = [dampers for dampers in unstable if dampers.low < 0.0]
    return Sliding(
        M=M,
        F_s=friction.F_s,
        F_c=friction.F_c,
        least_slope=friction.least_slope,
        least_held=max((dampers.high for dampers in negative), default=-math.inf),
        unstable=unstable,
        slips=ranges(speeds, unsteady),
        smooth_above=lasts[-1].high if lasts else 0.0,
        K_smooth=smooth_gain(machine=machine, gains=gains, friction=friction, M=M),
        speed=speed,
        verdict=verdict(machine=machine, gains=gains, friction=friction, M=M, speed=speed) if speed else None,
    )


def least_damper(*, machine: Machine, M: float) -> float:
    """The most negative damper on the robot (N·s/m) with which a period can be computed.

    Without a drive a motion grows within T by exp(x), x = −b T/M; in n substeps of backward Euler by (1 − x/n)⁻ⁿ.
    """
    if machine.substep == 0.0:
        return -GROWTH_MOST * M / machine.T
    n = substeps(T=machine.T, substep=machine.substep)
    return n * math.expm1(-min(GROWTH_MOST / n, GROWTH_MOST_OF_A_SUBSTEP)) * M / machine.T


def _check_fall(friction: Friction, *, steepest: float, least: float, M: float) -> None:
    """Refuses friction whose `steepest` slope is below the `least` that can be computed at M (kg)."""
    if steepest < least:
        term = max(friction.terms, key=lambda one: (one.F_s - one.F_c) / one.v_s)
        raise ExoError(
            f"F_s = {term.F_s:g}, v_s = {term.v_s:g}: friction falls with speed by {-steepest:.3g} N·s/m; expected at "
            f"most {-least:.3g} N·s/m at M = {M:g} kg: a larger v_s, or F_s nearer to F_c = {term.F_c:g}"
        )


def verdict(*, machine: Machine, gains: Gains, friction: Friction, M: float, speed: float) -> str:
    """What a motion at `speed` (m/s) does at the mass M (kg): "slips", "after a jolt" or "smooth"."""
    if not holds(machine=machine, gains=gains, M=M, b=friction.slope(speed)):
        return "slips"
    least, most = friction.span(speed)
    lasts = unstable_dampers(machine=machine, gains=gains, M=M, least=least, most=most)
    return "after a jolt" if lasts else "smooth"


def holds(*, machine: Machine, gains: Gains, M: float, b: float) -> bool:
    """Whether the loop at M (kg) is stable with a damper b (N·s/m) on the robot."""
    return region.is_stable(machine=replace(machine, slope=b), gains=gains, M=M)


def unstable_dampers(*, machine: Machine, gains: Gains, M: float, least: float, most: float) -> list[Interval]:
    """The dampers on the robot between `least` and `most` (N·s/m) with which the loop at M (kg) is unstable."""
    between = [x for x in (*(-geometric(-least))[::-1], 0.0, *geometric(most)) if least < x < most]
    b = [least, *map(float, between), most]
    flags = [not holds(machine=machine, gains=gains, M=M, b=x) for x in b]
    found: list[list[float]] = []
    for i, unstable in enumerate(flags):
        if unstable and (i == 0 or not flags[i - 1]):
            found.append([b[0] if i == 0 else _edge(machine, gains, M, outside=b[i - 1], inside=b[i])])
        if unstable and (i == len(b) - 1 or not flags[i + 1]):
            found[-1].append(b[-1] if i == len(b) - 1 else _edge(machine, gains, M, outside=b[i + 1], inside=b[i]))
    return [Interval(float(low), float(high)) for low, high in found]


def geometric(most: float) -> NDArray[np.float64]:
    """From `NOTHING` to `most`, if that is more."""
    if most <= NOTHING:
        return np.zeros(0)
    return np.geomspace(NOTHING, most, int(PER_DECADE * np.log10(most / NOTHING)) + 2)


def _edge(machine: Machine, gains: Gains, M: float, *, outside: float, inside: float) -> float:
    """Where the loop becomes unstable between two dampers, to 1e-3 of their distance."""
    for _ in range(10):
        middle = 0.5 * (outside + inside)
        if holds(machine=machine, gains=gains, M=M, b=middle):
            outside = middle
        else:
            inside = middle
    return inside


def ranges(speeds: list[float], applies: Callable[[float], bool]) -> list[Interval]:
    """The speeds to which it applies, ends by halves; the lowest speed stands for 0, the highest for any above."""
    flags = [applies(v) for v in speeds]
    ends = [0.0] if flags[0] else []
    for (a, at_a), (b, at_b) in pairwise(zip(speeds, flags, strict=True)):
        if at_a != at_b:
            low, high = a, b
            for _ in range(10):
                middle = 0.5 * (low + high)
                low, high = (middle, high) if applies(middle) == at_a else (low, middle)
            ends.append(0.5 * (low + high))
    if flags[-1]:
        ends.append(math.inf)
    return [Interval(low, high) for low, high in zip(ends[::2], ends[1::2], strict=True)]


def smooth_gain(*, machine: Machine, gains: Gains, friction: Friction, M: float) -> float | None:
    """The smallest K (N·s/m) from which on the loop at M (kg) holds every slope that friction has, the other gains as
    given; None if none does up to what sampling allows."""
    slopes = [float(b) for b in np.linspace(friction.least_slope, friction.b, 4)]

    def steady(K: float) -> bool:
        return all(holds(machine=machine, gains=replace(gains, K=K), M=M, b=b) for b in slopes)

    interval = region.widest(stable=steady, low=gains.K / FURTHER, high=gains.K * FURTHER)
    return interval.low if interval else None
