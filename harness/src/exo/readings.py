"""Readings of joint angles and force sensor from a table of text, as spreadsheets and loggers write it."""

import csv
import math
from pathlib import Path

import numpy as np

from exo.errors import ExoError
from exo.tool import Array

COLUMNS = [f"{name}[{i}]" for name in ("q", "ft.force", "ft.torque") for i in (1, 2, 3)]
#: What may stand between two fields. Where it is no comma, a comma may stand for the decimal point.
DELIMITERS = (";", "\t", ",")
#: No joint turns farther (rad): beyond it angles are degrees.
FARTHEST_ANGLE = 2.0 * math.pi


def read(path: Path) -> tuple[Array, Array, Array]:
    """Joint angles (rad), forces (N) and torques (N·m), each (n, 3), of a file whose first line names the columns.

    Fields stand between commas, semicolons or tabs; `controller.` may stand before a name; other columns are left out.
    """
    text = _text(path)
    delimiter = next((mark for mark in DELIMITERS if mark in text.partition("\n")[0]), ",")
    try:
        rows = [row for row in csv.reader(text.splitlines(), delimiter=delimiter) if any(map(str.strip, row))]
    except csv.Error as error:
        raise ExoError(f"{path}: {error}") from error
    header = [name.strip().removeprefix("controller.") for name in rows[0]] if rows else []
    missing = [name for name in COLUMNS if name not in header]
    if missing:
        raise ExoError(f"{path}: expected the columns {', '.join(COLUMNS)}; missing: {', '.join(missing)}")
    places = [header.index(name) for name in COLUMNS]
    values = np.empty((len(rows) - 1, len(COLUMNS)))
    for k, row in enumerate(rows[1:]):
        _must_be_whole(row, header, at=f"{path}: reading {k + 1}", delimiter=delimiter)
        for j, place in enumerate(places):
            values[k, j] = _number(row[place], at=f"{path}: reading {k + 1}, {COLUMNS[j]}", delimiter=delimiter)
    if len(values) < 3:
        raise ExoError(f"{path}: {len(values)} readings, expected 3 or more")
    q, force, torque = np.split(values, 3, axis=1)
    if np.abs(q).max() > FARTHEST_ANGLE:
        raise ExoError(f"{path}: q reaches {np.abs(q).max():.4g}, expected rad, at most {FARTHEST_ANGLE:.4g}: degrees?")
    return q, force, torque


def _text(path: Path) -> str:
    try:
        return path.read_text(encoding="utf-8-sig")  # with or without a byte order mark
    except UnicodeDecodeError as error:
        raise ExoError(f"{path}: expected text in UTF-8, got byte {error.start}: {error.reason}") from error
    except OSError as error:
        raise ExoError(f"{path}: {error.strerror}") from error


def _must_be_whole(row: list[str], header: list[str], *, at: str, delimiter: str) -> None:
    if len(row) == len(header):
        return
    commas = ", or decimal commas between commas: then write points, or semicolons between the fields"
    raise ExoError(
        f"{at}: {len(row)} fields, expected {len(header)} as in the first line"
        + (commas if delimiter == "," and len(row) > len(header) else "")
    )


def _number(field: str, *, at: str, delimiter: str) -> float:
    text = field.strip()
    if delimiter != "," and text.count(",") == 1 and "." not in text:
        text = text.replace(",", ".")  # a decimal comma
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise ExoError(f"{at}: expected a finite number, got {field.strip()!r}")
    return value
