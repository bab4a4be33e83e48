"""`earlier.json`: the verdicts that a run has replaced, so that the report can say what has changed since."""

import json
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from exo import metrics_file
from exo.errors import ExoError
from exo.folder import METRICS

NAME = "earlier.json"
SCHEMA_ID = "urn:exo:earlier:1"


def keep(*, old: Path, fresh: Path) -> None:
    """Writes into `fresh` what the results in `old` have come to; nothing where there are none, or none to read."""
    try:
        found = of(old)
    except ExoError:
        return
    if found is not None:
        text = json.dumps(found, indent=2, ensure_ascii=False)
        (fresh / NAME).write_text(text + "\n", encoding="utf-8")


def of(folder: Path) -> dict[str, Any] | None:
    """Verdict, value and unit of each metric in a scenario's folder, and when they were written; None without results.

    ExoError: the metrics.json is none.
    """
    path = folder / METRICS
    if not path.is_file():
        return None
    metrics = metrics_file.numbers(path)
    written = datetime.fromtimestamp(path.stat().st_mtime, UTC)
    return {
        "schema": SCHEMA_ID,
        "date": written.isoformat(timespec="seconds"),
        "metrics": {name: {key: one[key] for key in ("verdict", "value", "unit")} for name, one in metrics.items()},
    }


def read(folder: Path) -> dict[str, Any] | None:
    """What `keep` has left in a scenario's folder; None where this was the first run. ExoError: it is damaged."""
    path = folder / NAME
    if not path.is_file():
        return None
    try:
        found = json.loads(path.read_text(encoding="utf-8"))
        if found["schema"] != SCHEMA_ID:
            raise ExoError(f"{path}: expected schema {SCHEMA_ID}, got {found['schema']}")
        metrics_file.check_numbers(found, path)
        return {"date": str(found["date"]), "metrics": dict(found["metrics"])}
    except (ValueError, KeyError, TypeError) as error:
        raise ExoError(f"{path}: not the verdicts of an earlier run: {type(error).__name__}: {error}") from error
