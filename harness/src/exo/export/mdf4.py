"""MDF 4.1 (ASAM), by asammdf: a channel for each signal with its unit, and the time in seconds as their master."""

from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa

from exo.errors import ExoError

VERSION = "4.10"


def asammdf() -> Any:
    """The package that writes such files. ExoError says how to get it."""
    try:
        return import_module("asammdf")
    except ImportError:
        raise ExoError("MDF4 needs the package asammdf, which is not installed: `pip install asammdf`") from None


def write(table: pa.Table, path: Path) -> None:
    """Writes the file; a Boolean is an 8-bit 1 or 0, for which MDF has no type of its own."""
    package = asammdf()
    time, *columns = (column.to_numpy() for column in table.columns)
    signals = [
        package.Signal(
            samples=column.astype(np.uint8) if column.dtype == bool else column,
            timestamps=time,
            name=field.name,
            unit=(field.metadata or {}).get(b"unit", b"").decode(),
        )
        for field, column in zip(list(table.schema)[1:], columns, strict=True)
    ]
    with package.MDF(version=VERSION) as file:
        file.append(signals, comment="exo", common_timebase=True)
        file.save(path, overwrite=True)
