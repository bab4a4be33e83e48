"""What a run leaves: columns over tick time, with units, and how they are stored."""

import csv as text
import json
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.csv
import pyarrow.parquet
from numpy.typing import NDArray

from exo.errors import ExoError, close_matches
from exo.folder import check_name
from exo.pace import Deadlines
from exo.scenario import Segment

TIME = "time"
#: Metadata of a table: parameters and choices as JSON; and what `pandas.read_parquet` makes the table's `attrs` of.
ABOUT, PANDAS = b"exo.run", b"PANDAS_ATTRS"


@dataclass(frozen=True, kw_only=True)
class Recording:
    """Columns over the ticks t_k = k·T: sampled outputs are those of tick k, continuous outputs those at t_k, inputs
    those that acted from t_k on."""

    time: NDArray[np.float64]
    columns: Mapping[str, NDArray[Any]]
    units: Mapping[str, str]
    #: All parameters as the FMUs held them after initialization, by `component.name`.
    parameters: Mapping[str, float | int | bool]
    #: Of parameters that are enumerations, the item's name.
    choices: Mapping[str, str]
    #: The force profiles that were applied.
    profiles: Mapping[str, tuple[Segment, ...]]
    #: Time that the loop took (s).
    wall_time: float
    #: Processor time of it (s): less, when the machine does something else meanwhile.
    cpu_time: float
    #: Of a run by the clock.
    deadlines: Deadlines | None = None

    def __getitem__(self, name: str) -> NDArray[Any]:
        try:
            return self.columns[name]
        except KeyError:
            raise ExoError(f"no recorded column {name}{close_matches(name, self.columns)}") from None

    def parameter(self, name: str) -> float:
        """A parameter of a component as a number."""
        try:
            return float(self.parameters[name])
        except KeyError:
            raise ExoError(f"no parameter {name}{close_matches(name, self.parameters)}") from None

    def choice(self, name: str) -> str:
        """The item of a component's enumeration parameter, for instance the law's name."""
        try:
            return self.choices[name]
        except KeyError:
            raise ExoError(f"no enumeration parameter {name}{close_matches(name, self.choices)}") from None

    @property
    def step(self) -> float:
        """Distance of two ticks (s); a scenario has two or more."""
        return float(self.time[1] - self.time[0])

    @property
    def real_time_factor(self) -> float:
        """Simulated time over computing time."""
        return len(self.time) * self.step / self.wall_time

    def table(self, names: tuple[str, ...] = ()) -> pa.Table:
        """The named columns, or all, behind the time, as `table` writes them."""
        return table(
            time=self.time,
            columns={name: self[name] for name in names} or self.columns,
            units=self.units,
            parameters=self.parameters,
            choices=self.choices,
        )


def table(
    *,
    time: NDArray[np.float64],
    columns: Mapping[str, NDArray[Any]],
    units: Mapping[str, str],
    parameters: Mapping[str, float | int | bool],
    choices: Mapping[str, str],
) -> pa.Table:
    """Columns behind the time; the unit of each is in its field's metadata, and in those that pandas makes `attrs` of.

    What the parameters were stands in the table's own metadata.
    """
    every = {TIME: time, **columns}
    known = {name: "s" if name == TIME else units.get(name, "") for name in every}
    fields = [
        pa.field(name, pa.from_numpy_dtype(column.dtype), metadata={"unit": known[name]})
        for name, column in every.items()
    ]
    about = {"parameters": dict(parameters), "choices": dict(choices)}
    metadata = {ABOUT: json.dumps(about, ensure_ascii=False), PANDAS: json.dumps({"units": known}, ensure_ascii=False)}
    return pa.table([pa.array(column) for column in every.values()], schema=pa.schema(fields, metadata=metadata))


def write(table: pa.Table, path: Path, *, csv: bool = False) -> None:
    """`<path>.parquet` and, if asked for, `<path>.csv`; both keep every bit of a number."""
    path.parent.mkdir(parents=True, exist_ok=True)
    pyarrow.parquet.write_table(table, f"{path}.parquet", compression="zstd")
    if csv:
        pyarrow.csv.write_csv(table, f"{path}.csv")
    else:
        Path(f"{path}.csv").unlink(missing_ok=True)  # of an earlier run


def read(path: Path) -> dict[str, NDArray[Any]]:
    """Columns of a Parquet or CSV file; CSV may be what `exo run --csv` or what `exo export` has left."""
    check_name(path)
    try:
        match path.suffix:
            case ".parquet":
                table = pyarrow.parquet.read_table(path)
            case ".csv":
                table = _csv(path)
            case _:
                raise ExoError(f"{path}: expected a .parquet or .csv file")
    except (pa.ArrowException, text.Error) as error:
        raise ExoError(f"{path}: cannot be read: {' '.join(str(error).split())}") from error
    except UnicodeDecodeError as error:
        raise ExoError(f"{path}: is no UTF-8; expected a text file in UTF-8") from error
    names = table.column_names
    if twice := [name for name in names if names.count(name) > 1]:
        raise ExoError(f"{path}: column {twice[0]} is there twice; expected each name once")
    return {name: table[name].to_numpy() for name in names}


def units_of(path: Path) -> dict[str, str]:
    """Units of the columns of a file that `read` can read; nothing where it has none."""
    if path.suffix == ".csv":
        head = _head(path)
        return dict(zip(head.names, head.second, strict=True)) if head.has_units else {}
    fields = pyarrow.parquet.read_schema(path)
    return {field.name: (field.metadata or {}).get(b"unit", b"").decode(errors="replace") for field in fields}


@dataclass(frozen=True, kw_only=True)
class _Head:
    """The first two rows of a CSV file, and what stands between cells."""

    names: list[str]
    second: list[str]
    between: str

    @property
    def has_units(self) -> bool:
        """Whether the second row has units, as `exo export` writes them: else there is a number below `time`."""
        return len(self.names) == len(self.second) and (TIME, "s") in zip(self.names, self.second, strict=True)


def _head(path: Path) -> _Head:
    with path.open(encoding="utf-8-sig", newline="") as file:
        lines = [file.readline(), file.readline()]
    # Where the comma is the decimal one, `exo export` separates by semicolons.
    between = ";" if lines[0].startswith(f"{TIME};") else ","
    rows = [*text.reader(lines, delimiter=between), [], []]
    return _Head(names=rows[0], second=rows[1], between=between)


def _csv(path: Path) -> pa.Table:
    head = _head(path)
    return pyarrow.csv.read_csv(
        path,
        read_options=pyarrow.csv.ReadOptions(skip_rows_after_names=int(head.has_units)),
        parse_options=pyarrow.csv.ParseOptions(delimiter=head.between),
        convert_options=pyarrow.csv.ConvertOptions(decimal_point="," if head.between == ";" else "."),
    )
