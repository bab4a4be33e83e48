"""The gain guide as a picture: K over the mass, k_h over K at the lightest and the heaviest mass, and dry friction."""

import math
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.figure import Figure as Canvas
from matplotlib.ticker import NullLocator
from numpy.typing import NDArray

from exo.plots import STYLE
from exo.theory import Hand
from exo.tuning import region
from exo.tuning.friction import Friction
from exo.tuning.guide import KT_OVER_M_MAX, Guide
from exo.tuning.sliding import Sliding

Array = NDArray[np.float64]
#: Points of the map along each axis, and halves by which a boundary between two of them is found.
GRID, HALVES = 48, 5
#: Where there is one mass only, the limits are drawn from this share of it to as many times as much.
AROUND = 2.0


def draw(*, guide: Guide, path: Path) -> None:
    """Writes the picture as PNG."""
    machine = guide.machine
    ends = sorted({machine.M_min, machine.M_max})
    panels = 1 + len(ends) + int(guide.friction is not None)
    with mpl.rc_context(STYLE):  # type: ignore[arg-type]
        canvas = Canvas(layout="constrained", figsize=(4.2 * panels, 4.4))
        axes = canvas.subplots(1, panels, squeeze=False)[0]
        _over_mass(axes[0], guide)
        for place, mass in zip(axes[1:], ends, strict=False):
            _over_gain(place, guide, M=mass)
        if guide.friction is not None and guide.worst_sliding is not None:
            _over_speed(axes[-1], guide.friction, guide.worst_sliding)
        verdict = "stable" if guide.stable else "unstable"
        title = f"The gains are {verdict}. T = {1e3 * machine.T:g} ms, delay {machine.delay}"
        canvas.suptitle(title, fontsize=11)
        canvas.savefig(path, metadata={"Software": None}, bbox_inches="tight")


def _over_mass(axes: Any, guide: Guide) -> None:
    """The largest and the smallest K that are stable, without a hand and with it."""
    machine, gains = guide.machine, guide.gains
    if machine.M_min < machine.M_max:
        masses = [at.M for at in guide.masses]
        ends = {
            "without a hand": [at.K_free for at in guide.masses],
            "with the hand": [at.K_held for at in guide.masses],
        }
    else:
        wider = replace(machine, M_min=machine.M_min / AROUND, M_max=machine.M_max * AROUND)
        masses = wider.masses
        ends = {
            label: [region.gain_interval(machine=machine, gains=gains, M=M, hand=hand) for M in masses]
            for label, hand in (("without a hand", Hand()), ("with the hand", machine.hand))
        }
    for (label, intervals), color, look in zip(ends.items(), ("C0", "C1"), ("-", "--"), strict=True):
        highs = [x.high if x and math.isfinite(x.high) else math.nan for x in intervals]
        lows = [x.low if x and x.low else math.nan for x in intervals]
        if np.isfinite(highs).any():
            axes.loglog(masses, highs, look, color=color, marker="v", markersize=4, label=f"largest K {label}")
        if np.isfinite(lows).any():
            axes.loglog(masses, lows, look, color=color, marker="^", markersize=4, label=f"smallest K {label}")
    axes.loglog(
        masses, [KT_OVER_M_MAX * M / machine.T for M in masses], ":", color="#555555", label="advised: K T/M = 0.25"
    )
    axes.loglog(guide.machine.masses, [gains.K] * len(guide.machine.masses), "k+", markersize=9, label="K as given")
    axes.set(xlabel="effective mass M [kg]", ylabel="K [N·s/m]", title="stable between ▼ and ▲")
    axes.set_xticks([masses[0], masses[len(masses) // 2], masses[-1]], minor=False)
    axes.xaxis.set_major_formatter("{x:.3g}")
    axes.xaxis.set_minor_locator(NullLocator())
    axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.18), ncols=1)


def _over_gain(axes: Any, guide: Guide, *, M: float) -> None:
    """Where K and the stiffness of the hand are stable at the mass M (kg)."""
    machine, gains = guide.machine, guide.gains
    limits = [at.K_free.high for at in guide.masses if at.K_free and math.isfinite(at.K_free.high)]
    top = 2.0 * max([*limits, gains.K])
    k_limit = guide.k_h_limit if 0.0 < guide.k_h_limit < math.inf else 100.0
    K = np.geomspace(1e-4 * top, top, GRID)
    k_h = np.geomspace(0.02 * max(k_limit, machine.k_h), 50.0 * max(k_limit, machine.k_h), GRID)

    def stable(gain: float, stiffness: float) -> bool:
        hand = replace(machine.hand, k_h=stiffness)
        return region.is_stable(machine=machine, gains=replace(gains, K=gain), M=M, hand=hand)

    field = distance(stable=stable, x=K, y=k_h)
    axes.contourf(K, k_h, field, levels=[-2.0, 0.0], colors=["#dddddd"], hatches=["///"])
    axes.contour(K, k_h, field, levels=[0.0], colors="k", linewidths=1.2)
    axes.plot([gains.K], [max(machine.k_h, k_h[0])], "k+", markersize=11, label="the gains and the hand")
    axes.plot([], [], "s", color="#dddddd", markeredgecolor="#555555", markersize=9, label="hatched: something grows")
    axes.set(xscale="log", yscale="log", xlabel="K [N·s/m]", ylabel="k_h [N/m]", title=f"M = {M:.4g} kg")
    axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.18), ncols=1)


def _over_speed(axes: Any, friction: Friction, at: Sliding) -> None:
    """What friction is worth as a damper at each speed, and the dampers with which the loop is unstable."""
    v = np.geomspace(1e-3, 0.1, 80)
    low, high = np.array([friction.span(float(x)) for x in v]).T
    axes.fill_between(
        1e3 * v, low, high, color="C0", alpha=0.25, linewidth=0.0, label="friction, of a swing of any size"
    )
    axes.plot(1e3 * v, [friction.slope(float(x)) for x in v], color="C0", label="friction, of steady motion: its slope")
    for i, dampers in enumerate(at.unstable):
        label = "hatched: the loop is unstable" if i == 0 else None
        axes.axhspan(dampers.low, dampers.high, facecolor="#dddddd", hatch="///", alpha=0.6, label=label)
    if at.speed is not None:
        axes.axvline(1e3 * at.speed, color="k", linestyle=":", label="the speed that is asked about")
    axes.set(xscale="log", xlabel="speed [mm/s]", ylabel="damper [N·s/m]", title=f"stick-slip, M = {at.M:.4g} kg")
    axes.set_yscale("symlog", linthresh=100.0)
    axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.18), ncols=1)


def distance(*, stable: Callable[[float, float], bool], x: Array, y: Array) -> Array:
    """How far a point of the map (rows `y`, columns `x`, both geometric) is from the boundary, in steps of the map.

    Positive where it is stable, at most 1. Two neighbours on different sides share out the step at the boundary between
    them, so that a contour at 0 runs through it.
    """
    inside = np.array([[stable(float(a), float(b)) for a in x] for b in y])
    far = np.ones(inside.shape)
    for i, j in zip(*np.nonzero(inside[:, 1:] != inside[:, :-1]), strict=True):
        _share(far, (i, j), (i, j + 1), _crossing(lambda a, i=i: stable(a, float(y[i])), x[j], x[j + 1]))  # type: ignore[misc]
    for i, j in zip(*np.nonzero(inside[1:] != inside[:-1]), strict=True):
        _share(far, (i, j), (i + 1, j), _crossing(lambda b, j=j: stable(float(x[j]), b), y[i], y[i + 1]))  # type: ignore[misc]
    return np.where(inside, far, -far)


def _crossing(stable: Callable[[float], bool], low: float, high: float) -> float:
    """The share of the step from `low` to `high` at which the answer changes."""
    at_low, a, b = stable(float(low)), 0.0, 1.0
    for _ in range(HALVES):
        middle = 0.5 * (a + b)
        a, b = (middle, b) if stable(float(low * (high / low) ** middle)) == at_low else (a, middle)
    return 0.5 * (a + b)


def _share(far: Array, before: tuple[int, int], after: tuple[int, int], share: float) -> None:
    far[before], far[after] = min(far[before], share), min(far[after], 1.0 - share)
