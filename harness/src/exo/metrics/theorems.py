"""What the paper's theorems speak of: an L2 gain, and how fast and how exactly one signal comes up to another."""

import math

import numpy as np
from numpy.typing import NDArray

from exo import theorems
from exo.metrics.basic import values, window
from exo.metrics.registry import metric
from exo.recording import Recording


def _square(run: Recording, columns: tuple[str, ...], after: float | None, before: float | None) -> NDArray[np.float64]:
    return np.asarray(sum(np.asarray(values(run, column, after, before), dtype=np.float64) ** 2 for column in columns))


@metric
def l2_square(
    run: Recording, *, columns: tuple[str, ...], after: float | None = None, before: float | None = None
) -> float:
    """∫ Σ x² dt over the window, each column held over its tick."""
    return float(np.sum(_square(run, columns, after, before))) * run.step


@metric
def l2_gain(run: Recording, *, outputs: tuple[str, ...], inputs: tuple[str, ...]) -> float:
    """√(∫ Σ y² dt / ∫ Σ u² dt) from the start to the end of the run; NaN where there is no input, inf where there is an
    output without one."""
    y, u = l2_square(run, columns=outputs), l2_square(run, columns=inputs)
    return math.sqrt(y / u) if u else (math.inf if y else math.nan)


@metric
def rise_time(run: Recording, *, column: str, of: str, after: float, share: float) -> float:
    """Time from `after` (s) to the first tick at which the column has reached this share of the column `of`."""
    ticks = np.flatnonzero(window(run.time, after=after, before=None))
    there = run[column][ticks] >= share * run[of][ticks]
    return float(run.time[ticks[np.argmax(there)]] - after) if there.any() else math.nan


@metric
def overshoot(run: Recording, *, column: str, of: str, after: float) -> float:
    """How far the column gets above the column `of`, as a share of what `of` is at `after` (s)."""
    ticks = np.flatnonzero(window(run.time, after=after, before=None))
    return float(np.max(run[column][ticks] - run[of][ticks]) / run[of][ticks[0]])


@metric
def l2_share(
    run: Recording, *, controller: str, plant: str, outputs: tuple[str, ...], inputs: tuple[str, ...]
) -> float:
    """`l2_gain` over the smallest γ of thm:passivity, for the testbed without dry friction."""
    names = ("M_n", "D_n", "K", "K_P", "alpha")
    gains = {name: run.parameter(f"{controller}.{name}") for name in names}
    pair = theorems.Pair(M=run.parameter(f"{plant}.M"), b=run.parameter(f"{plant}.b"), **gains)
    return l2_gain(run, outputs=outputs, inputs=inputs) / theorems.l2_gain(pair)


@metric
def left_at_the_end(run: Recording, *, column: str, last: float) -> float:
    """Largest magnitude in the last seconds as a share of the largest of the run."""
    x = np.abs(run[column])
    return float(np.max(x[run.time >= run.time[-1] - last]) / np.max(x))
