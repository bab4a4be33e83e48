"""From a recording to the signals of a formula."""

import numpy as np
from numpy.typing import NDArray

from exo.recording import Recording
from exo.requirements.document import Signal

Array = NDArray[np.float64]


def signal(of: Signal, run: Recording) -> Array:
    """One number a tick; an ExoError names a column or parameter that the run has not."""
    if of.column is not None:
        return _column(of.column, run)
    if of.parameter is not None:
        return np.full(len(run.time), run.parameter(of.parameter))
    if of.norm is not None:
        return np.asarray(np.linalg.norm([_column(name, run) for name in of.norm], axis=0))
    if of.moved is not None:
        ways = [_column(name, run) - _column(name, run)[0] for name in of.moved]
        return np.asarray(np.linalg.norm(ways, axis=0))
    if of.largest is not None:
        sizes = np.stack([np.abs(_column(name, run)) for name in of.largest])
        if of.over is not None:
            sizes /= np.array([run.parameter(name) for name in of.over])[:, None]
        return np.asarray(sizes.max(axis=0))
    assert of.work is not None
    assert of.along is not None
    total = np.zeros(len(run.time))
    for force, velocity in zip(of.work, of.along, strict=True):
        # What is held over a step meets the mean of the velocities at its ends.
        f, v = _column(force, run), _column(velocity, run)
        total[1:] += np.cumsum(f[:-1] * 0.5 * (v[:-1] + v[1:])) * run.step
    return total


def unit(of: Signal, run: Recording) -> str:
    """Its unit, where it has that of its columns; empty where that is not known."""
    names = [of.column] if of.column is not None else of.norm or of.moved or (of.largest if of.over is None else None)
    return run.units.get((names or [""])[0], "")


def _column(name: str, run: Recording) -> Array:
    return np.asarray(run[name], dtype=np.float64)
