"""CSV: names in the first row, units in the second, then a row for each tick.

Numbers keep every bit. A Boolean is 1 or 0, because words for it differ between languages; NaN is an empty cell.
"""

import csv
import io
import locale
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

import pyarrow as pa
import pyarrow.compute as pc
import pyarrow.csv

from exo.errors import ExoError

Decimal = Literal["point", "comma"]
#: Of a sheet of Excel.
EXCEL_ROWS, EXCEL_COLUMNS = 1_048_576, 16_384
#: Rows of the file before the first tick.
HEADER_ROWS = 2


@dataclass(frozen=True, kw_only=True)
class Separators:
    """What stands between cells and in numbers. `excel`: with the mark by which Excel knows UTF-8, in its limits."""

    decimal: Decimal = "point"
    excel: bool = False

    @property
    def between(self) -> str:
        """Between two cells: where the comma is the decimal one, a semicolon."""
        return ";" if self.decimal == "comma" else ","


PLAIN = Separators()


def separators(*, excel: bool, decimal: str | None) -> Separators:
    """What `--excel` and `--decimal` ask for; for Excel without `--decimal`, what the system's language has."""
    match decimal:
        case None:
            return Separators(excel=excel, decimal=_of_the_system() if excel else "point")
        case "point" | "comma":
            return Separators(excel=excel, decimal=decimal)
    raise ExoError(f"--decimal {decimal}: expected point or comma")


def _of_the_system() -> Decimal:
    """The decimal separator of the user's language settings, which are not this process' until they are asked for."""
    before = locale.setlocale(locale.LC_NUMERIC)
    try:
        locale.setlocale(locale.LC_NUMERIC, "")
        return "comma" if locale.localeconv()["decimal_point"] == "," else "point"
    except locale.Error:  # settings that name a language which is not installed
        return "point"
    finally:
        locale.setlocale(locale.LC_NUMERIC, before)


def check(table: pa.Table, path: Path, separators: Separators) -> None:
    """ExoError, if the table is more than a sheet of Excel holds: Excel would cut it without a word."""
    rows = table.num_rows + HEADER_ROWS
    if separators.excel and (rows > EXCEL_ROWS or table.num_columns > EXCEL_COLUMNS):
        raise ExoError(
            f"{path}: {rows} rows of {table.num_columns} columns; Excel's sheets hold {EXCEL_ROWS} of {EXCEL_COLUMNS}: "
            "expected fewer signals, or --every N"
        )


def write(table: pa.Table, path: Path, separators: Separators) -> None:
    """Writes the file."""
    header = io.StringIO()
    rows = csv.writer(header, delimiter=separators.between, lineterminator="\n")
    rows.writerow(table.column_names)
    rows.writerow([(field.metadata or {}).get(b"unit", b"").decode() for field in table.schema])
    cells = pa.table([_cells(column, separators) for column in table.columns], names=table.column_names)
    with path.open("wb") as file:
        file.write(header.getvalue().encode("utf-8-sig" if separators.excel else "utf-8"))
        options = pyarrow.csv.WriteOptions(
            include_header=False, delimiter=separators.between, quoting_style="none", batch_size=4096
        )
        pyarrow.csv.write_csv(cells, file, options)


def _cells(column: pa.ChunkedArray, separators: Separators) -> pa.ChunkedArray:
    """A column as texts, shortest that keep every bit."""
    if pa.types.is_boolean(column.type):
        return column.cast(pa.int8()).cast(pa.string())
    cells = column.cast(pa.string())
    if not pa.types.is_floating(column.type):
        return cells
    cells = pc.if_else(pc.is_nan(column), "", cells)
    return pc.replace_substring(cells, ".", ",") if separators.decimal == "comma" else cells
