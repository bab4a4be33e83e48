"""Two results side by side: numbers and signals, and whether they agree."""

import math
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

import numpy as np

from exo import metrics_file
from exo.errors import ExoError
from exo.recording import read, units_of


@dataclass(frozen=True, kw_only=True)
class Difference:
    """One number or one signal in both results; `share` is the difference over the larger magnitude."""

    kind: Literal["metric", "signal", "missing"]
    name: str
    a: float | None
    b: float | None
    share: float
    unit: str = ""
    #: Where the share is infinite.
    why: str = "missing"

    def as_json(self) -> dict[str, Any]:
        """With null for what is no finite number."""
        numbers = {
            key: x if x is not None and math.isfinite(x) else None
            for key, x in (("a", self.a), ("b", self.b), ("share", self.share))
        }
        return {
            "kind": self.kind,
            "name": self.name,
            "unit": self.unit,
            **numbers,
            "why": "" if math.isfinite(self.share) else self.why,
        }


def compare(a: Path, b: Path) -> list[Difference]:
    """Differences between two signal files, two scenario folders, or two folders of scenarios."""
    for path in (a, b):
        if not path.exists():
            raise ExoError(f"{path}: no such file or folder")
    if a.is_file() != b.is_file():
        raise ExoError(f"{a} and {b}: expected two files or two folders")
    if a.is_file():
        return _signals(a, b, "")
    files = [_relevant(folder) for folder in (a, b)]
    if not files[0] and not files[1]:
        raise ExoError(f"{a} and {b}: neither metrics.json nor signals in them")
    found = []
    for name in sorted(files[0] | files[1]):
        if name not in files[0] or name not in files[1]:
            found.append(_missing(name))
        elif name.endswith(".json"):
            found += _metrics(a / name, b / name, name.removesuffix("metrics.json"))
        else:
            found += _signals(a / name, b / name, f"{name}: ")
    return found


def _relevant(folder: Path) -> set[str]:
    paths = [*folder.rglob("metrics.json"), *folder.rglob("signals/*.parquet")]
    names = [path.relative_to(folder) for path in paths]
    # A folder that is being written, or was when its run was killed, begins with a dot.
    return {name.as_posix() for name in names if not any(part.startswith(".") for part in name.parts)}


def _missing(name: str) -> Difference:
    return Difference(kind="missing", name=name, a=None, b=None, share=math.inf)


def _metrics(a: Path, b: Path, prefix: str) -> list[Difference]:
    numbers = [_numbers(path) for path in (a, b)]
    found = []
    for name in [*numbers[0], *(name for name in numbers[1] if name not in numbers[0])]:
        if name not in numbers[0] or name not in numbers[1]:
            found.append(_missing(prefix + name))
            continue
        (x, unit), (y, other) = (side[name] for side in numbers)
        share, why = _share_of_numbers(x, y), "undefined in one"
        if unit != other:
            share, why = math.inf, f"{unit} and {other}"
        found.append(Difference(kind="metric", name=prefix + name, a=x, b=y, share=share, unit=unit, why=why))
    return found


def _numbers(path: Path) -> dict[str, tuple[float | None, str]]:
    """Value and unit of each metric."""
    return {name: (entry["value"], entry["unit"]) for name, entry in metrics_file.numbers(path).items()}


def _share_of_numbers(x: float | None, y: float | None) -> float:
    if x is None or y is None:
        return 0.0 if x is y else math.inf
    return 0.0 if x == y else abs(x - y) / max(abs(x), abs(y))


def _signals(a: Path, b: Path, prefix: str) -> list[Difference]:
    columns, units = [read(path) for path in (a, b)], units_of(a) | units_of(b)
    found = []
    for name in [*columns[0], *(name for name in columns[1] if name not in columns[0])]:
        if name not in columns[0] or name not in columns[1]:
            found.append(_missing(prefix + name))
            continue
        x, y = (_as_numbers(side[name], path, name) for side, path in zip(columns, (a, b), strict=True))
        share, why = _share_of_signals(x, y)
        peaks = [_peak(values) for values in (x, y)]
        unit = units.get(name, "")
        found.append(
            Difference(kind="signal", name=prefix + name, a=peaks[0], b=peaks[1], share=share, unit=unit, why=why)
        )
    return found


def _as_numbers(column: Any, path: Path, name: str) -> Any:
    try:
        return np.asarray(column, dtype=np.float64)
    except (TypeError, ValueError) as error:
        raise ExoError(f"{path}: {name}: expected numbers: {error}") from error


def _peak(values: Any) -> float:
    """Largest magnitude of the numbers that are finite."""
    return float(np.max(np.abs(values[np.isfinite(values)]), initial=0.0))


def _share_of_signals(x: Any, y: Any) -> tuple[float, str]:
    """Largest difference over the larger peak. What is NaN, or the same infinity, in both is no difference."""
    if len(x) != len(y):
        return math.inf, f"{len(x)} and {len(y)} values"
    unlike = ~((x == y) | (np.isnan(x) & np.isnan(y)))
    if not unlike.any():
        return 0.0, ""
    if not (np.isfinite(x[unlike]).all() and np.isfinite(y[unlike]).all()):
        return math.inf, "not finite in one"
    return float(np.max(np.abs(x[unlike] - y[unlike]))) / max(_peak(x), _peak(y)), ""
