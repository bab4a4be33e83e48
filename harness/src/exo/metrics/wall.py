"""The nominal while the mass rests at a wall."""

import math

import numpy as np
from numpy.typing import NDArray

from exo import theory
from exo.metrics.basic import window
from exo.metrics.registry import metric
from exo.recording import Recording


@metric
def wall_curve_error(
    run: Recording,
    *,
    controller: str,
    plant: str,
    after: float,
    before: float,
    rest_speed: float,
    at_least: float,
    force: float,
) -> float:
    """Largest distance of e_nr from the closed form at the wall, as a share of F/(α K_P), F = `force`.

    The closed form holds while the mass rests at the wall, and a lightly damped nominal pulls it off again when it
    swings back. So the window is the longest stretch within after … before in which the mass touches the wall and is
    slower than `rest_speed` at every tick. e and de = dq_n − dq are taken from its first tick, and nothing is fitted.
    NaN when the stretch is shorter than `at_least` (s).
    """
    resting = window(run.time, after=after, before=before) & (run[f"{plant}.tau_e"] < 0.0)
    resting &= np.abs(run[f"{plant}.dq"]) < rest_speed
    ticks = longest_stretch(resting)
    if len(ticks) * run.step < at_least:
        return math.nan
    value = {name: run.parameter(f"{controller}.{name}") for name in ("M_n", "D_n", "K_P", "alpha")}
    e = run[f"{controller}.e_nr"][ticks]
    curve = theory.error_at_a_wall(
        time=run.time[ticks],
        f_h=run[f"{controller}.tau_h"][ticks],
        e=float(e[0]),
        de=float(run[f"{controller}.dq_n"][ticks[0]] - run[f"{plant}.dq"][ticks[0]]),
        **value,
    )
    return float(np.max(np.abs(e - curve))) / (force / (value["alpha"] * value["K_P"]))


def longest_stretch(mask: NDArray[np.bool_]) -> NDArray[np.intp]:
    """Indices of the longest uninterrupted run of True, the first of several."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], mask, [False]]).astype(np.int8)))
    if not len(edges):
        return np.arange(0)
    starts, ends = edges[::2], edges[1::2]
    longest = int(np.argmax(ends - starts))
    return np.arange(starts[longest], ends[longest])
