"""Where a sweep's results lie: a part for each chunk of rows, written whole or not at all, and one table at the end.

    <out>/<study>/study.json      what was asked for, of which FMUs, by which versions
                  parts/*.parquet rows that are done; gone once the table is written
                  runs.parquet    all rows, in order
                  <figure>.png

A sweep that was killed leaves its parts. The same command goes on with the rows that no part has; a part's rows are
never run again. A folder of another study, or of other FMUs, is refused.
"""

import hashlib
import json
import os
from collections.abc import Sequence
from dataclasses import dataclass
from importlib import metadata
from pathlib import Path
from typing import Any, Self

import pyarrow as pa
import pyarrow.compute as pc
import pyarrow.parquet as pq

from exo import folder
from exo.errors import ExoError
from exo.runs import FAILURE, Outcome
from exo.scenario import Scenario, Value
from exo.sweep.study import Study

STUDY, TABLE, PARTS = "study.json", "runs.parquet", "parts"
#: What of a study is only read or drawn; and letters of a value in a message.
TEXTS, QUOTED = ("title", "about", "label", "figures"), 60
#: Column of a row's number, and of the time that it took (s).
ROW, SECONDS = "row", "seconds"


@dataclass(frozen=True)
class Done:
    """A row that has run."""

    row: int
    outcome: Outcome
    seconds: float


class Store:
    """The folder of one study; locked while it is open, so that two sweeps do not mix."""

    def __init__(
        self,
        out: Path,
        study: Study,
        scenario: Scenario,
        rows: Sequence[dict[str, Value]],
        fmus: dict[str, str],
        *,
        fresh: bool = False,
    ) -> None:
        """`fmus` are the archives' checksums by name. `fresh` forgets what an earlier sweep has left."""
        self.folder = out / study.id
        self._rows = rows
        self._names: list[str] = []
        self._lock: int | None = None
        self._fresh = fresh
        self._asked = {
            "study": study.model_dump(mode="json"),
            "scenario": scenario.model_dump(mode="json", exclude_defaults=True),
            "fmus": fmus,
            "runs": len(rows),
            # Of the samples themselves: another version of scipy may draw others of the same seed.
            "rows": hashlib.sha256(json.dumps(rows, sort_keys=True).encode()).hexdigest(),
        }

    def __enter__(self) -> Self:
        """ExoError, if the folder is another study's, or another sweep works in it."""
        folder.check_name(self.folder)
        try:
            (self.folder / PARTS).mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise ExoError(f"{self.folder}: {error.strerror or error}; expected a folder to write to") from error
        try:
            self._lock = folder.lock(self.folder, wait=False)
        except BlockingIOError as error:
            raise ExoError(f"{self.folder}: another sweep works here; expected its end, or another --out") from error
        except OSError as error:
            said = error.strerror or error
            raise ExoError(f"{self.folder}: cannot be locked: {said}; expected --out on another file system") from error
        try:
            if self._fresh:
                self._clear()
            self._drop_broken()
            self._check()
        except BaseException:
            self.__exit__()
            raise
        return self

    def __exit__(self, *_: object) -> None:
        if self._lock is not None:
            os.close(self._lock)
            self._lock = None

    def _check(self) -> None:
        path = self.folder / STUDY
        if not path.exists():
            if self.done():
                raise ExoError(f"{self.folder}: has parts and no {STUDY}; expected another --out, or --fresh")
            versions = {name: metadata.version(name) for name in ("exo", "numpy", "scipy")}
            self._describe({**self._asked, "versions": versions})
            return
        try:
            there = json.loads(path.read_text(encoding="utf-8"))
        except (OSError, ValueError) as error:
            raise ExoError(f"{path}: {error}; expected another --out, or --fresh") from error
        asked = json.loads(json.dumps(self._asked))
        if isinstance(there, dict) and _numbers_of(there) == _numbers_of(asked):
            if there != {**there, **asked}:  # pictures and texts may be others
                self._describe({**there, **asked})
            return
        what = _difference(_numbers_of(there), _numbers_of(asked), "")
        raise ExoError(f"{self.folder}: holds the results of another study: {what}; expected another --out, or --fresh")

    def _drop_broken(self) -> None:
        """Removes what a machine that was switched off has left half written: those rows run again."""
        for path in (self.folder / PARTS).iterdir():
            try:
                whole = path.suffix == ".parquet" and ROW in pq.read_schema(path).names
            except (OSError, pa.ArrowException):
                whole = False
            if not whole and path.is_file():
                path.unlink()

    def _clear(self) -> None:
        for path in [*(self.folder / PARTS).glob("*.parquet"), self.folder / STUDY, self.folder / TABLE]:
            path.unlink(missing_ok=True)

    def done(self) -> set[int]:
        """Numbers of the rows that have run."""
        if (self.folder / TABLE).exists():
            try:
                rows = pq.read_table(self.folder / TABLE, columns=[ROW])[ROW].to_pylist()
            except (OSError, pa.ArrowException, KeyError) as error:
                raise ExoError(f"{self.folder / TABLE}: cannot be read; expected another --out, or --fresh") from error
            if sorted(rows) != list(range(len(self._rows))):
                raise ExoError(
                    f"{self.folder / TABLE}: has {len(rows)} rows, not rows 0 to {len(self._rows) - 1} once each; "
                    "expected another --out, or --fresh"
                )
            return set(rows)
        found: set[int] = set()
        for path in self._parts():
            found.update(pq.read_table(path, columns=[ROW])[ROW].to_pylist())
        return found

    def _parts(self) -> list[Path]:
        return sorted((self.folder / PARTS).glob("*.parquet"))

    def keep(self, done: Sequence[Done], names: Sequence[str]) -> None:
        """Writes a part."""
        columns: dict[str, Any] = {
            ROW: pa.array([one.row for one in done], pa.int64()),
            **{
                name: pa.array([one.outcome.numbers.get(name, float("nan")) for one in done], pa.float64())
                for name in names
            },
            FAILURE: pa.array([one.outcome.error for one in done], pa.string()),
            SECONDS: pa.array([one.seconds for one in done], pa.float64()),
        }
        sink = pa.BufferOutputStream()
        pq.write_table(pa.table(columns), sink)
        first = min(one.row for one in done)
        self._write(self.folder / PARTS / f"{first:08}.parquet", sink.getvalue().to_pybytes())

    def _describe(self, asked: dict[str, Any]) -> None:
        text = json.dumps(asked, indent=2, ensure_ascii=False)
        self._write(self.folder / STUDY, (text + "\n").encode())

    def _write(self, path: Path, data: bytes) -> None:
        folder.write_file(path, data, kept="what was finished is kept, and the same command goes on")

    def table(self) -> pa.Table:
        """All rows that have run, in order, with what they set."""
        if (self.folder / TABLE).exists():
            return pq.read_table(self.folder / TABLE)
        parts = self._parts()
        if not parts:
            raise ExoError(f"{self.folder}: no row has run")
        found = pa.concat_tables([pq.read_table(path) for path in parts]).sort_by(ROW)
        numbers = found[ROW].to_pylist()
        keys = list(self._rows[0])
        set_by_rows = [pa.array([self._rows[i][key] for i in numbers]) for key in keys]
        columns = [found[ROW], *set_by_rows, *(found[name] for name in found.column_names if name != ROW)]
        names = [ROW, *keys, *(name for name in found.column_names if name != ROW)]
        return pa.table(columns, names=names)

    def finish(self) -> pa.Table:
        """Writes the table in place of the parts; every row once."""
        table = self.table()
        counted = pc.count_distinct(table[ROW]).as_py()
        if not counted == table.num_rows == len(self._rows):
            raise ExoError(f"{self.folder}: {table.num_rows} rows of {len(self._rows)}; expected every row once")
        sink = pa.BufferOutputStream()
        pq.write_table(table, sink, compression="zstd")
        self._write(self.folder / TABLE, sink.getvalue().to_pybytes())
        with (self.folder / TABLE).open("rb+") as file:
            os.fsync(file.fileno())  # before the parts go
        for path in self._parts():
            path.unlink()
        return table


def _numbers_of(asked: Any) -> dict[str, Any]:
    """What the rows' numbers come from: all but what is only read or drawn."""
    asked = asked if isinstance(asked, dict) else {}
    study = asked.get("study")
    study = {key: value for key, value in study.items() if key not in TEXTS} if isinstance(study, dict) else {}
    if isinstance(study.get("axes"), dict):
        study["axes"] = {
            name: {key: value for key, value in axis.items() if key not in TEXTS} if isinstance(axis, dict) else axis
            for name, axis in study["axes"].items()
        }
    return {"study": study, **{key: asked.get(key) for key in ("scenario", "fmus", "runs", "rows")}}


def _difference(there: Any, asked: Any, at: str) -> str:
    """The first difference, by its key."""
    if isinstance(there, dict) and isinstance(asked, dict):
        for key in [*asked, *there]:
            if there.get(key) != asked.get(key):
                return _difference(there.get(key), asked.get(key), f"{at}.{key}" if at else key)
    if at == "rows":
        return "other samples of the same seed, of another version of scipy"
    if at.startswith("fmus."):
        return f"{at.removeprefix('fmus.')} is another one"
    return f"{at} is {_short(asked)}, was {_short(there)}"


def _short(value: Any) -> str:
    text = json.dumps(value, ensure_ascii=False)
    return text if len(text) <= QUOTED else f"{text[:QUOTED]}…"
