"""Columns as whole numbers: JSON that compresses to two or three bytes a value, the same in every browser."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

#: Beyond this a browser's numbers are no longer whole.
LARGEST = 2**53


def pack(values: NDArray[Any], *, unit: float) -> dict[str, Any]:
    """A column as multiples of `unit`: the first one, then the differences.

    `unit` is the resolution: what comes back is off by half of it at most. ValueError for NaN, infinity and what is too
    large.
    """
    scaled = np.rint(np.asarray(values, dtype=np.float64) / unit)
    if not np.all(np.abs(scaled) < LARGEST):  # also false for NaN
        raise ValueError(
            f"a column with resolution {unit} has a value that is not finite or not below {LARGEST * unit}"
        )
    whole = scaled.astype(np.int64)
    return {"unit": unit, "steps": np.diff(whole, prepend=0).tolist()}


def unpack(column: dict[str, Any]) -> NDArray[np.float64]:
    """The values again."""
    return np.asarray(np.cumsum(np.asarray(column["steps"], dtype=np.int64)) * column["unit"], dtype=np.float64)


def switches(values: NDArray[np.bool_], time: NDArray[np.float64]) -> list[float]:
    """When a Boolean changes (s). It begins as false: a change at the first instant says that it is true there."""
    return [float(t) for t in time[np.flatnonzero(np.diff(values.astype(np.int8), prepend=0))]]
