"""`manifest.json`: what belongs to a run, and where it comes from: FMUs, versions, machine, date, scenario, files."""

import hashlib
import json
import platform
from datetime import UTC, datetime
from importlib import metadata
from pathlib import Path
from typing import Any

from exo.experiment import Experiment
from exo.folder import MANIFEST

SCHEMA_ID = "urn:exo:manifest:1"
PACKAGES = ("exo", "fmpy", "matplotlib", "numpy", "pyarrow", "scipy")


def document(*, experiment: Experiment, folder: Path) -> dict[str, Any]:
    """The manifest of the files that lie in `folder`."""
    return {
        "schema": SCHEMA_ID,
        "date": datetime.now(UTC).isoformat(timespec="seconds"),
        "versions": {name: metadata.version(name) for name in PACKAGES},
        "machine": {
            "system": platform.system(),
            "release": platform.release(),
            "machine": platform.machine(),
            "processor": processor(),
            "python": platform.python_version(),
        },
        "fmus": {name: dict(facts) for name, facts in experiment.fmus.items()},
        "overrides": dict(experiment.overrides),
        "cases": list(experiment.recordings),
        "unwired": list(experiment.unwired),
        "notes": list(experiment.notes),
        # With every parameter, wire, profile and expectation, bases and axes written out.
        "scenario": experiment.scenario.model_dump(mode="json", exclude_defaults=True),
        "files": [
            {"path": path.relative_to(folder).as_posix(), "bytes": path.stat().st_size, "sha256": sha256(path)}
            for path in sorted(folder.rglob("*"))
            if path.is_file() and path.name != MANIFEST
        ],
    }


def write(*, experiment: Experiment, folder: Path) -> None:
    """Writes it beside the files; the last one of a run."""
    text = json.dumps(document(experiment=experiment, folder=folder), indent=2, ensure_ascii=False, allow_nan=False)
    (folder / MANIFEST).write_text(text + "\n", encoding="utf-8")


def sha256(path: Path) -> str:
    """The file's checksum."""
    with path.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def processor() -> str:
    """What the processor is called."""
    try:
        for line in Path("/proc/cpuinfo").read_text(encoding="utf-8", errors="replace").splitlines():
            if line.startswith("model name"):
                return line.partition(":")[2].strip()
    except OSError:
        pass
    return platform.processor()
