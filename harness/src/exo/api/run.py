"""What a run leaves: signals over time with their units, as tables of pandas and xarray, pictures and files."""

import json
import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from fnmatch import translate
from os import PathLike
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, Self

import numpy as np
import pyarrow as pa
import pyarrow.parquet
from numpy.typing import NDArray

from exo import export, recording
from exo.api.frozen import Picklable, read_only
from exo.api.shown import SHOWN, columns
from exo.errors import ExoError, close_matches
from exo.folder import signal_files
from exo.naming import elements
from exo.recording import ABOUT, TIME, Recording

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr
    from matplotlib.figure import Figure

#: What a short table has of each signal.
SHORT = ("signal", "unit", "smallest", "largest")
#: NumPy's kinds of what a signal can be: true and false, integers, floating point.
NUMBERS = "biuf"
#: `controller.p_n[2]`: an element of an array.
ELEMENT = re.compile(r"(.+)\[(\d+)\]")


@dataclass(frozen=True, kw_only=True, repr=False, eq=False)
class Run(Picklable):
    """Signals of one run: outputs and wired inputs of all components, by `component.name`. `run["plant.q"]` is one, and
    a loop over the run goes over their names. The arrays are read only: `run["plant.q"].copy()` can be changed.

    Row k belongs to the tick t_k = k · step: sampled outputs are those of tick k, continuous outputs those at t_k,
    inputs those that acted from t_k on. All signals have the shape `(steps,)`.
    """

    #: The case's id, or the file's name.
    name: str
    #: Instants of the rows (s), shape `(steps,)`.
    time: NDArray[np.float64]
    #: Real: float64, Integer and Enumeration: int32, Boolean: bool.
    signals: Mapping[str, NDArray[Any]]
    #: As the FMUs write them, such as `N.m`; empty for a signal without; `time` is among them.
    units: Mapping[str, str]
    #: All parameters as the FMUs held them after initialization.
    parameters: Mapping[str, float | int | bool]
    #: Of parameters that are choices, the item's name.
    choices: Mapping[str, str]

    def __post_init__(self) -> None:
        object.__setattr__(self, "time", read_only(self.time))
        seen = {name: read_only(values) for name, values in self.signals.items()}
        object.__setattr__(self, "signals", MappingProxyType(seen))

    def __setstate__(self, state: dict[str, Any]) -> None:
        super().__setstate__(state)
        # Arrays that come from another process can be written.
        self.__post_init__()

    @classmethod
    def of(cls, run: Recording, *, name: str) -> Self:
        """A recording as a run."""
        return cls(
            name=name,
            time=run.time,
            signals=run.columns,
            units=MappingProxyType({TIME: "s", **{key: run.units.get(key, "") for key in run.columns}}),
            parameters=MappingProxyType(dict(run.parameters)),
            choices=MappingProxyType(dict(run.choices)),
        )

    @property
    def step(self) -> float:
        """Distance of two rows (s)."""
        return float(self.time[1] - self.time[0])

    def __getitem__(self, name: str) -> NDArray[Any]:
        """A signal. ExoError names close matches, if there is none."""
        try:
            return self.signals[name]
        except (KeyError, TypeError):
            raise ExoError(f"{self.name}: no signal {name}{close_matches(name, self.signals)}") from None

    def __contains__(self, name: object) -> bool:
        return name in self.signals

    def __iter__(self) -> Iterator[str]:
        return iter(self.signals)

    def __len__(self) -> int:
        return len(self.signals)

    def names(self, *patterns: str) -> list[str]:
        """Names of the signals that match: a name, `plant.p[1..3]`, or `plant.*`; all without a pattern.

        ExoError for a pattern that nothing matches.
        """
        found: dict[str, None] = {}
        for pattern in patterns:
            found |= dict.fromkeys(self._matching(pattern))
        return list(found) if patterns else list(self.signals)

    def _matching(self, pattern: str) -> list[str]:
        if not isinstance(pattern, str):
            raise ExoError(f"{self.name}: got {pattern!r:.60}; expected names or patterns, one argument each")
        if set("*?") & set(pattern):
            # Brackets are those of an array's element.
            wanted = re.compile(translate(pattern.replace("[", "[[]")))
            matching = [name for name in self.signals if wanted.fullmatch(name)]
        else:
            try:
                matching = elements(pattern)
            except ValueError as error:
                raise ExoError(f"{self.name}: {error}") from error
        for name in matching or [pattern]:
            self[name]
        return matching

    def frame(self, *patterns: str, unit_level: bool = False) -> "pd.DataFrame":
        """The signals as a table of pandas: index `time` (s), a column for each.

        `frame.attrs["units"]` has the units by name. With `unit_level` columns have two levels, `signal`, `unit`.
        """
        import pandas as pd  # noqa: PLC0415

        names = self.names(*patterns)
        table = pd.DataFrame({name: self.signals[name] for name in names}, index=pd.Index(self.time, name=TIME))
        units = {name: self.units[name] for name in (TIME, *names)}
        if unit_level:
            levels = [(name, units[name]) for name in names]
            table.columns = pd.MultiIndex.from_tuples(levels, names=["signal", "unit"])
        table.attrs["units"] = units
        return table

    def dataset(self, *patterns: str) -> "xr.Dataset":
        """The signals as a dataset of xarray: dimension `time` (s); each variable's `attrs["units"]` is its unit.

        The elements of an array are one variable: `plant.p[1]`, `plant.p[2]`, `plant.p[3]` are `plant.p` of the
        dimensions `time` and `element_3`, whose coordinate counts from 1. Parameters are in the dataset's `attrs`.
        """
        import xarray as xr  # noqa: PLC0415

        names = self.names(*patterns)
        variables: dict[str, Any] = {}
        coordinates: dict[str, Any] = {TIME: (TIME, self.time.copy(), {"units": "s"})}
        for name, members in _arrays(names, self.signals).items():
            attributes = {"units": self.units[members[0]]}
            if members == [name]:
                variables[name] = (TIME, self.signals[name].copy(), attributes)
                continue
            along = f"element_{len(members)}"
            coordinates[along] = np.arange(1, len(members) + 1)
            variables[name] = ((TIME, along), np.column_stack([self.signals[one] for one in members]), attributes)
        return xr.Dataset(variables, coordinates, attrs={"name": self.name, **self.parameters})

    def plot(self, *patterns: str, title: str | None = None) -> "Figure":
        """Draws signals over time, those of one unit in one panel, and returns the figure; a notebook shows it.

        Without patterns all signals are drawn, if they are at most 12.
        """
        from exo.api import picture  # noqa: PLC0415

        return picture.drawn(self, self.names(*patterns), title=self.name if title is None else title)

    def table(self, *patterns: str) -> pa.Table:
        """The signals as a table of Arrow: `time`, then a column for each; a field's metadata has its `unit`."""
        return recording.table(
            time=self.time,
            columns={name: self.signals[name] for name in self.names(*patterns)},
            units=self.units,
            parameters=self.parameters,
            choices=self.choices,
        )

    def save(self, path: str | PathLike[str], *patterns: str) -> Path:
        """Writes the signals as a whole, in the place of what lies there, and returns the path.

        The ending says the format: `.parquet` (every bit, units, parameters), `.csv` (units in a second row), `.mf4`
        (MDF 4.1; needs asammdf) or `.mat` (MATLAB, version 5). ExoError, if it is another one or cannot be written.
        """
        return export.write(self.table(*patterns), Path(path))

    def __repr__(self) -> str:
        span = f"{len(self.time)} rows, every {self.step:g} s"
        return f"{self.name}: {len(self.signals)} signals, {span}\n{columns(SHORT, self._rows())}"

    def _repr_html_(self) -> str:
        """What a notebook shows."""
        import html  # noqa: PLC0415

        import pandas as pd  # noqa: PLC0415

        title = html.escape(repr(self).splitlines()[0])
        table = pd.DataFrame(self._rows(), columns=list(SHORT))
        return f"<p>{title}</p>{table.to_html(max_rows=SHOWN, index=False)}"

    def _rows(self) -> list[tuple[str, str, str, str]]:
        return [
            (name, self.units[name], f"{values.min():.6g}", f"{values.max():.6g}")
            for name, values in self.signals.items()
        ]


def _arrays(names: list[str], signals: Iterable[str]) -> dict[str, list[str]]:
    """The names by variable: all elements of an array that are among `signals` are one, in their order. Where one of
    them is missing in `names`, or the first is not number 1, each stays by itself."""
    groups: dict[str, dict[int, str]] = {}
    for name in signals:
        if found := ELEMENT.fullmatch(name):
            groups.setdefault(found[1], {})[int(found[2])] = name
    arrays: dict[str, list[str]] = {}
    for name in names:
        found = ELEMENT.fullmatch(name)
        array = groups[found[1]] if found else {}
        whole = sorted(array) == [*range(1, len(array) + 1)] and set(array.values()) <= set(names)
        if found and whole and found[1] not in names:
            arrays[found[1]] = [array[i] for i in sorted(array)]
        else:
            arrays[name] = [name]
    return arrays


def read_run(path: str | PathLike[str], *, case: str | None = None) -> Run:
    """A run that was written: a Parquet file of `exo run` or of `Run.save`, or a scenario's folder of results.

    `case` is the case's id in a folder; a folder with one case needs none. ExoError names what is missing.
    """
    place = Path(path)
    if place.is_dir():
        place = _file(place, case)
    elif not place.exists():
        raise ExoError(f"{place}: no such file or folder; expected a Parquet file, or a scenario's folder of results")
    elif case is not None:
        raise ExoError(f"{place}: is no folder of results; expected no case, got {case!r}")
    if not place.is_file() or place.suffix != ".parquet":
        raise ExoError(f"{place}: expected a Parquet file, or a scenario's folder of results")
    columns = recording.read(place)
    if TIME not in columns or len(columns[TIME]) < 2:
        raise ExoError(f"{place}: expected signals of a run: a column {TIME} of two rows or more")
    for name, values in columns.items():
        if values.dtype.kind not in NUMBERS:
            odd = next((one for one in values.tolist() if not isinstance(one, bool | int | float)), values.dtype)
            raise ExoError(f"{place}: column {name} has {odd!r:.40}; expected numbers, or true and false")
    if not (np.diff(columns[TIME]) > 0.0).all():
        raise ExoError(f"{place}: expected a column {TIME} that increases")
    about = _about_of(place)
    units = recording.units_of(place)
    time = columns.pop(TIME)
    return Run(
        name=place.stem,
        time=time,
        signals=columns,
        units=MappingProxyType({TIME: "s", **{name: units.get(name, "") for name in columns}}),
        parameters=MappingProxyType(about.get("parameters", {})),
        choices=MappingProxyType(about.get("choices", {})),
    )


def _file(folder: Path, case: str | None) -> Path:
    found = signal_files(folder)
    if case is None and len(found) == 1:
        return next(iter(found.values()))
    if case is None or case not in found:
        told = close_matches(case, found) if case else f" ({', '.join([*found][:6])}{', …' if len(found) > 6 else ''})"
        raise ExoError(f"{folder}: case {case!r}: expected one of its {len(found)} cases{told}")
    return found[case]


def _about_of(path: Path) -> dict[str, Any]:
    """Parameters and choices of the run, where the file has them."""
    metadata = pyarrow.parquet.read_schema(path).metadata or {}
    try:
        found: dict[str, Any] = json.loads(metadata.get(ABOUT, b"{}"))
    except ValueError as error:
        raise ExoError(f"{path}: its metadata {ABOUT.decode()} is no JSON: {error}") from error
    return found
