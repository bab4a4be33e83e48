"""Tolerance bands around a reference, wide in value and in time, by pyfunnel (extra `pytest`).

pyfunnel's status is 0 when a signal leaves its band, and a NaN is no error to it: what it writes is read, and what it
cannot judge is refused here.
"""

import contextlib
import csv
import io
import tempfile
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike, NDArray

from exo.errors import ExoError

INSTALL = "tolerance bands need pyfunnel: pip install pyfunnel"


@dataclass(frozen=True)
class Excess:
    """By how much a signal leaves its band, in its own unit, and where that is most."""

    largest: float
    #: s
    at: float

    def __bool__(self) -> bool:
        return self.largest > 0.0


def excess(
    *,
    time: ArrayLike,
    actual: ArrayLike,
    reference_time: ArrayLike,
    reference: ArrayLike,
    atol: float = 0.0,
    rtol: float = 0.0,
    time_tol: float = 0.0,
) -> Excess:
    """How far `actual` (at `time`, s) is outside the band around `reference` (at `reference_time`, s).

    All are one-dimensional. `atol` is in the signal's unit, `rtol` a share of the reference's range, `time_tol` in
    seconds. ExoError for numbers that are not finite, for other lengths, and where one signal ends before the other.
    """
    given = {"time": time, "actual": actual, "reference_time": reference_time, "reference": reference}
    arrays = {name: _checked(name, values) for name, values in given.items()}
    for pair in (("time", "actual"), ("reference_time", "reference")):
        sizes = [len(arrays[name]) for name in pair]
        if sizes[0] != sizes[1]:
            raise ExoError(f"{pair[0]} has {sizes[0]} numbers, {pair[1]} {sizes[1]}; expected as many")
    for name, value in (("atol", atol), ("rtol", rtol), ("time_tol", time_tol)):
        if not 0.0 <= value < float("inf"):
            raise ExoError(f"{name} = {value}: expected a number of 0 or more")
    ends = [arrays[name][index] for index in (0, -1) for name in ("time", "reference_time")]
    if not np.allclose(ends[::2], ends[1::2], rtol=0.0, atol=1e-9):
        raise ExoError(
            f"the signal goes from {ends[0]:g} to {ends[2]:g} s, the reference from {ends[1]:g} to {ends[3]:g} s; "
            "expected the same"
        )
    return _by_pyfunnel(arrays, {"atolx": time_tol, "atoly": atol, "rtoly": rtol})


def _checked(name: str, values: ArrayLike) -> NDArray[np.float64]:
    array = np.asarray(values, dtype=np.float64)
    if array.ndim != 1 or not len(array):
        raise ExoError(f"{name} has shape {array.shape}; expected one axis, and numbers along it")
    if not np.isfinite(array).all():
        first = int(np.flatnonzero(~np.isfinite(array))[0])
        raise ExoError(f"{name}[{first}] = {array[first]}: expected finite numbers")
    return array


def _by_pyfunnel(arrays: dict[str, NDArray[np.float64]], tolerances: dict[str, float]) -> Excess:
    try:
        from pyfunnel import compareAndReport  # noqa: PLC0415 (an extra)
    except ImportError as error:
        raise ExoError(INSTALL) from error
    with tempfile.TemporaryDirectory(prefix="exo-band-") as folder:
        said = io.StringIO()
        with contextlib.redirect_stdout(said):
            status = compareAndReport(
                arrays["reference_time"].tolist(),
                arrays["reference"].tolist(),
                arrays["time"].tolist(),
                arrays["actual"].tolist(),
                outputDirectory=folder,
                **tolerances,
            )
        if status != 0:
            raise ExoError(f"pyfunnel cannot compare: {' '.join(said.getvalue().split())}")
        with (Path(folder) / "errors.csv").open(encoding="utf-8", newline="") as file:
            rows = [(float(row["x"]), float(row["y"])) for row in csv.DictReader(file)]
    at, largest = max(rows, key=lambda row: row[1])
    return Excess(largest, at)
