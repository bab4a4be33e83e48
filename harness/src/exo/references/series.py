"""CSV files of stimuli and results: time and columns, each cell a finite number."""

import csv
import io
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from exo.errors import close_matches
from exo.references.variables import NUMBERS, Place, place, value
from exo.validate import references as rules
from exo.validate.rule import Finding

Array = NDArray[np.float64]
TIME = "time"
#: Problems of one file that are told: a broken column is broken in every row.
TOLD = 3


@dataclass(frozen=True)
class Column:
    """A column, with one row of values an instant."""

    name: str
    place: Place
    values: Array


@dataclass(frozen=True)
class Series:
    """What a file says."""

    time: Array
    columns: tuple[Column, ...]
    #: Columns of texts, clocks and the like, which are not compared.
    left_out: tuple[str, ...]


def read(data: bytes, where: str, variables: Mapping[str, Any]) -> tuple[Series | None, list[Finding]]:
    """The series, or None where the file cannot be read; and what is wrong with it."""
    try:
        rows = [row for row in csv.reader(io.StringIO(data.decode("utf-8-sig"))) if row]
    except (UnicodeDecodeError, csv.Error) as problem:
        return None, [rules.SERIES.at(where, problem, "comma-separated values in UTF-8")]
    header = [name.strip() for name in rows[0]] if rows else []
    if not header or header[0].lower() != TIME or len(rows) < 2:
        said = "empty" if not header else f"first column {header[0]!r}" if header[0].lower() != TIME else "no row"
        return None, [
            rules.SERIES.at(where, said, "a header that begins with time, and rows of numbers between commas")
        ]
    if twice := sorted({name for name in header if header.count(name) > 1}):
        return None, [rules.SERIES.at(where, f"{', '.join(twice)} twice", "each column once")]
    found: list[Finding] = []
    places: dict[int, Place] = {}
    for index, name in enumerate(header[1:], start=1):
        if (meant := place(name, variables)) is None:
            near = close_matches(name, variables)
            found.append(rules.VARIABLE.at(f"{where}: column {name}", "no variable of this name", f"a variable{near}"))
        else:
            places[index] = meant
    read_as = {index: one for index, one in places.items() if one.variable.type in NUMBERS}
    values, broken = _values(rows[1:], header, read_as, where)
    found += broken
    if broken:
        return None, found
    time = values.pop(0)[:, 0]
    columns = tuple(Column(header[index], read_as[index], values[index]) for index in read_as)
    left_out = tuple(header[index] for index in places if index not in read_as)
    return Series(time, columns, left_out), found


def _values(
    rows: list[list[str]], header: list[str], places: Mapping[int, Place], where: str
) -> tuple[dict[int, Array], list[Finding]]:
    """Values by column, that of time among them; the first problems of the file."""
    table: dict[int, list[list[float]]] = {0: [], **{index: [] for index in places}}
    found: list[Finding] = []
    for line, row in enumerate(rows, start=2):
        if len(found) >= TOLD:
            break
        if len(row) != len(header):
            found.append(
                rules.SERIES.at(f"{where}: row {line}", f"{len(row)} cells", f"{len(header)}, as in the header")
            )
            continue
        for index, column in table.items():
            size = places[index].size if index else 1
            parts = row[index].split()
            try:
                if len(parts) != size:
                    raise ValueError("a number" if size == 1 else f"{size} numbers with blanks between them")
                column.append([_number(part, places.get(index)) for part in parts])
            except ValueError as wanted:
                name = f"{where}: row {line}, column {header[index]}"
                found.append(rules.SERIES.at(name, repr(row[index]), str(wanted)))
                break
        if not found and len(table[0]) > 1 and table[0][-1] < table[0][-2]:
            earlier, later = table[0][-2][0], table[0][-1][0]
            found.append(rules.SERIES.at(f"{where}: row {line}", f"time {later:g} s", f"one from {earlier:g} s on"))
    return {} if found else {index: np.array(column) for index, column in table.items()}, found


def _number(text: str, meant: Place | None) -> float:
    """A cell's number. A Boolean may be a number too, as many tools write it."""
    if meant is not None and meant.variable.type == "Boolean" and text in ("true", "false"):
        return float(text == "true")
    return float(value("Real", text))
