"""One self-contained page: every number, tolerance, paper value, verdict and figure."""

import base64
import json
from dataclasses import dataclass
from datetime import UTC, datetime
from importlib import resources
from pathlib import Path
from typing import Any

import jinja2

from exo.errors import ExoError
from exo.folder import write_file
from exo.paper import Published
from exo.results import SCHEMA_ID
from exo.scenario import Figure, load
from exo.verdict import expectation


@dataclass(frozen=True, kw_only=True)
class Picture:
    """A figure as the page shows it."""

    title: str
    label: str
    uri: str
    data: str


def write(*, out: Path, scenarios: list[str]) -> Path:
    """`<out>/report.html` from what the scenarios left in `out`."""
    environment = jinja2.Environment(
        autoescape=True, trim_blocks=True, lstrip_blocks=True, undefined=jinja2.StrictUndefined
    )
    environment.filters["number"] = number
    environment.filters["expected"] = expected
    environment.filters["off"] = off
    template = environment.from_string((resources.files("exo") / "report.html.jinja").read_text(encoding="utf-8"))
    sections = [_section(out, name) for name in scenarios]
    page = template.render(
        sections=sections,
        made=datetime.now(UTC).strftime("%Y-%m-%d %H:%M UTC"),
        counts={v: sum(s["counts"][v] for s in sections) for v in ("pass", "fail", "info")},
    )
    path = out / "report.html"
    write_file(path, page.encode())
    return path


def _section(out: Path, name: str) -> dict[str, Any]:
    folder = out / name
    path = folder / "metrics.json"
    if not path.is_file():
        raise ExoError(f"{path}: missing: run `exo run {name}` first")
    document = json.loads(path.read_text(encoding="utf-8"))
    if document["schema"] != SCHEMA_ID:
        raise ExoError(f"{path}: expected schema {SCHEMA_ID}, got {document['schema']}")
    scenario = load(name)
    verdicts = [metric["verdict"] for metric in document["metrics"].values()]
    cases = document["run"]["cases"].values()
    return {
        "id": name,
        "about": scenario.about.strip(),
        "document": document,
        "run": document["run"],
        "signals": (folder / "signals").is_dir(),
        "counts": {v: verdicts.count(v) for v in ("pass", "fail", "info")},
        "pictures": [_picture(folder, figure) for figure in scenario.figures],
        "speed": min(case["real_time_factor"] for case in cases),
        "computing": sum(case["wall_time_s"] for case in cases),
        "simulated": sum(case["duration_s"] for case in cases),
    }


def _picture(folder: Path, figure: Figure) -> Picture:
    image = base64.b64encode((folder / f"{figure.id}.png").read_bytes()).decode("ascii")
    return Picture(
        title=figure.title,
        label=figure.label,
        uri=f"data:image/png;base64,{image}",
        data=f"{folder.name}/figures/{figure.id}.parquet",
    )


def number(value: float | None) -> str:
    """Five digits; an undefined number says so."""
    return "undefined" if value is None else f"{value:.5g}"


def off(metric: dict[str, Any]) -> str:
    """Why the number of an entry of metrics.json is off the paper's by more than its rounding, or nothing."""
    if metric["paper"] is None or metric["value"] is None:
        return ""
    return Published(**metric["paper"]).explains(metric["value"])


def expected(metric: dict[str, Any]) -> str:
    """The expectation of an entry of metrics.json as text."""
    return expectation(kind=metric["kind"], expected=metric["expected"], tolerance=metric["tolerance"])
