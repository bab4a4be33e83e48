"""Signals as files for other programs. All formats take a table of `exo.recording.table`: `time`, then a column for
each signal, its unit in the field's metadata. A file is written as a whole or not at all.

| module | format |
|---|---|
| `text.py` | CSV: names in the first row, units in the second; for Excel with its separators |
| `mdf4.py` | MDF 4.1, by asammdf |
| `matlab.py` | MATLAB's `.mat`, version 5 |
"""

from pathlib import Path

import pyarrow as pa

from exo import recording
from exo.errors import ExoError
from exo.export import matlab, mdf4, text
from exo.export.text import PLAIN, Separators
from exo.folder import replaced_file

#: Names of `exo export --format`, with the endings of their files.
FORMATS = {"csv": ".csv", "mdf4": ".mf4", "matlab": ".mat"}
PARQUET = ".parquet"


def ending(form: str) -> str:
    """The ending of the files of a format. ExoError, if there is no such format."""
    if form not in FORMATS:
        raise ExoError(f"--format {form}: expected one of {', '.join(FORMATS)}")
    return FORMATS[form]


def write(table: pa.Table, path: Path, *, separators: Separators = PLAIN) -> Path:
    """Writes the table in the format of the path's ending, in the place of what lies there; returns the path.

    `separators` are those of CSV. ExoError for another ending, a folder that cannot be written, or what a format
    cannot hold.
    """
    endings = (PARQUET, *FORMATS.values())
    if path.suffix not in endings:
        raise ExoError(f"{path}: expected one of the endings {', '.join(endings)}")
    match path.suffix:
        case ".csv":
            text.check(table, path, separators)
        case ".mf4":
            mdf4.asammdf()
        case ".mat":
            matlab.check(table, path)
    with replaced_file(path) as fresh:
        match path.suffix:
            case ".csv":
                text.write(table, fresh, separators)
            case ".mf4":
                mdf4.write(table, fresh)
            case ".mat":
                matlab.write(table, fresh)
            case _:
                recording.write(table, fresh.with_suffix(""))
    return path
