"""Force profiles: summed segments, evaluated at all ticks at once."""

import numpy as np
from numpy.typing import NDArray

from exo.scenario import Segment

#: Within this an instant counts as the edge of a segment (s): ticks are k·T in floating point.
SAME_INSTANT = 1e-9

Array = NDArray[np.float64]


def evaluate(*, segments: tuple[Segment, ...], time: Array) -> Array:
    """Sum of all segments at the instants `time` (s)."""
    force = np.zeros_like(time)
    for segment in segments:
        force += window(segment=segment, time=time) * shape(segment=segment, time=time)
    return force


def window(*, segment: Segment, time: Array) -> Array:
    """w(t; a, b) = clip((t − a)/r, 0, 1) − clip((t − b)/r, 0, 1), a = t_on, b = t_off, r = ramp; a step when r = 0."""
    rise = _edge(time=time, at=segment.t_on, ramp=segment.ramp)
    if segment.t_off is None:
        return rise
    return rise - _edge(time=time, at=segment.t_off, ramp=segment.ramp)


def _edge(*, time: Array, at: float, ramp: float) -> Array:
    if ramp == 0.0:
        return (time >= at - SAME_INSTANT).astype(np.float64)
    return np.clip((time - at) / ramp, 0.0, 1.0)


def shape(*, segment: Segment, time: Array) -> Array:
    """The segment without its window. Phase and cycles count from `t_on`."""
    since_on = time - segment.t_on
    match segment.kind:
        case "constant":
            return np.full_like(time, segment.amplitude)
        case "sine":
            return segment.amplitude * np.sin(2.0 * np.pi * segment.frequency * since_on + segment.phase)
        case "square":
            # sign(sin(2π f t + φ)), right-continuous: decided on the fraction of a cycle, because sin at its own zeros
            # is rounding.
            cycles = segment.frequency * since_on + segment.phase / (2.0 * np.pi)
            fraction = np.mod(cycles + SAME_INSTANT, 1.0)
            return np.where(fraction < 0.5, segment.amplitude, -segment.amplitude)
        case "table":
            instants, values = np.asarray(segment.points, dtype=np.float64).T
            return np.asarray(segment.amplitude * np.interp(since_on, instants, values))
