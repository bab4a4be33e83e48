"""MATLAB's `.mat`, version 5: `time` (s), and the structs `signals`, `units` and `names` with the same fields.

`signals.plant_q` is a column, `units.plant_q` its unit, `names.plant_q` what the FMU calls it.
"""

import re
from collections.abc import Iterable
from pathlib import Path

import pyarrow as pa
import scipy

from exo.errors import ExoError

#: Letters of a name in MATLAB.
LONGEST = 63
#: Bytes of one variable of a file of version 5.
LARGEST = 2**31 - 1
RESERVED = """
break case catch classdef continue else elseif end for function global if otherwise parfor persistent return spmd switch
try while"""


def check(table: pa.Table, path: Path) -> None:
    """ExoError, if the signals are more than such a file holds."""
    size = 8 * table.num_rows * table.num_columns
    if size > LARGEST:
        raise ExoError(
            f"{path}: {size / 1e9:.3g} GB of signals; a MATLAB file of version 5 holds {LARGEST / 1e9:.3g} GB: "
            "expected fewer signals, or --every N"
        )


def write(table: pa.Table, path: Path) -> None:
    """Writes the file."""
    time, *columns = (column.to_numpy() for column in table.columns)
    fields = list(table.schema)[1:]
    valid = names(field.name for field in fields)
    content = {
        "time": time.reshape(-1, 1),
        "signals": {valid[f.name]: column.reshape(-1, 1) for f, column in zip(fields, columns, strict=True)},
        "units": {valid[f.name]: (f.metadata or {}).get(b"unit", b"").decode() for f in fields},
        "names": {valid[f.name]: f.name for f in fields},
    }
    scipy.io.savemat(path, content, format="5", long_field_names=True, do_compression=True, oned_as="column")


def names(given: Iterable[str]) -> dict[str, str]:
    """For each name one that MATLAB takes as a field: `plant.p[1]` becomes `plant_p_1`. No two are alike."""
    found: dict[str, str] = {}
    taken = {*RESERVED.split()}
    for name in given:
        plain = re.sub(r"[^A-Za-z0-9]+", "_", name).strip("_")
        base = (plain if plain[:1].isalpha() else f"x{plain}")[:LONGEST]
        valid, number = base, 1
        while valid in taken:
            number += 1
            valid = f"{base[: LONGEST - len(str(number)) - 1]}_{number}"
        taken.add(valid)
        found[name] = valid
    return found
