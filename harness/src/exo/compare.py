"""Two results side by side: numbers and signals, and whether they agree."""

import json
import math
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

import numpy as np

from exo.errors import ExoError
from exo.recording import read


@dataclass(frozen=True, kw_only=True)
class Difference:
    """One number or one signal in both results; `share` is the difference over the larger magnitude."""

    kind: Literal["metric", "signal", "missing"]
    name: str
    a: float | None
    b: float | None
    share: float


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
    return {path.relative_to(folder).as_posix() for path in paths}


def _missing(name: str) -> Difference:
    return Difference(kind="missing", name=name, a=None, b=None, share=math.inf)


def _metrics(a: Path, b: Path, prefix: str) -> list[Difference]:
    numbers: list[dict[str, Any]] = [json.loads(path.read_text(encoding="utf-8"))["metrics"] for path in (a, b)]
    found = []
    for name in [*numbers[0], *(name for name in numbers[1] if name not in numbers[0])]:
        if name not in numbers[0] or name not in numbers[1]:
            found.append(_missing(prefix + name))
            continue
        x, y = (side[name]["value"] for side in numbers)
        found.append(Difference(kind="metric", name=prefix + name, a=x, b=y, share=_share_of_numbers(x, y)))
    return found


def _share_of_numbers(x: float | None, y: float | None) -> float:
    if x is None or y is None:
        return 0.0 if x is y else math.inf
    return 0.0 if x == y else abs(x - y) / max(abs(x), abs(y))


def _signals(a: Path, b: Path, prefix: str) -> list[Difference]:
    columns = [read(path) for path in (a, b)]
    found = []
    for name in [*columns[0], *(name for name in columns[1] if name not in columns[0])]:
        if name not in columns[0] or name not in columns[1] or len(columns[0][name]) != len(columns[1][name]):
            found.append(_missing(prefix + name))
            continue
        x, y = (np.asarray(side[name], dtype=np.float64) for side in columns)
        peaks = [float(np.max(np.abs(values), initial=0.0)) for values in (x, y)]
        apart = float(np.max(np.abs(x - y), initial=0.0))
        share = 0.0 if apart == 0.0 else apart / max(peaks) if math.isfinite(apart) else math.inf
        found.append(Difference(kind="signal", name=prefix + name, a=peaks[0], b=peaks[1], share=share))
    return found
