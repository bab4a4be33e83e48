"""What an experiment leaves on disk: metrics.json, signals, figures with their data, and the JUnit file of all."""

import json
import math
import shutil
from collections.abc import Sequence
from importlib import resources
from pathlib import Path
from typing import Any
from xml.etree import ElementTree as ET

import jsonschema

from exo import plots, recording
from exo.experiment import Experiment
from exo.kept import EVERYTHING, Kept

SCHEMA_ID = "urn:exo:metrics:1"


def schema() -> dict[str, Any]:
    """The published schema of metrics.json."""
    text = (resources.files("exo") / "metrics.schema.json").read_text(encoding="utf-8")
    return dict(json.loads(text))


def metrics_document(experiment: Experiment) -> dict[str, Any]:
    """The content of metrics.json, checked against the schema."""
    document = {
        "schema": SCHEMA_ID,
        "scenario": experiment.scenario.id,
        "verdict": "pass" if experiment.passed else "fail",
        "metrics": {result.id: result.as_json() for result in experiment.results},
        "run": experiment.description(),
    }
    # A round trip makes JSON of tuples and refuses what JSON has not: NaN and infinity.
    checked: dict[str, Any] = json.loads(json.dumps(document, allow_nan=False))
    jsonschema.Draft202012Validator(schema()).validate(checked)
    return checked


def write(*, experiment: Experiment, out: Path, kept: Kept = EVERYTHING) -> Path:
    """Writes `<out>/<scenario>/` and returns it."""
    folder = out / experiment.scenario.id
    folder.mkdir(parents=True, exist_ok=True)
    text = json.dumps(metrics_document(experiment), indent=2, ensure_ascii=False)
    (folder / "metrics.json").write_text(text + "\n", encoding="utf-8")
    if kept.has_signals_of(experiment.scenario.id):
        for case, run in experiment.recordings.items():
            recording.write(run.table(experiment.scenario.signals), folder / "signals" / case, csv=kept.csv)
    else:
        shutil.rmtree(folder / "signals", ignore_errors=True)  # of an earlier run
    for figure in experiment.scenario.figures:
        plots.draw(figure=figure, recordings=experiment.recordings, path=folder / f"{figure.id}.png")
        data = plots.data(figure=figure, recordings=experiment.recordings)
        recording.write(data, folder / "figures" / figure.id, csv=kept.csv)
    return folder


def write_junit(*, experiments: Sequence[Experiment], out: Path) -> Path:
    """`<out>/junit.xml`: one test case a verdict; information is no test."""
    root = ET.Element("testsuites", name="exo")
    for experiment in experiments:
        judged = [result for result in experiment.results if result.verdict != "info"]
        suite = ET.SubElement(
            root,
            "testsuite",
            name=experiment.scenario.id,
            tests=str(len(judged)),
            failures=str(sum(result.verdict == "fail" for result in judged)),
            errors="0",
            skipped="0",
            time=f"{sum(run.wall_time for run in experiment.recordings.values()):.3f}",
        )
        for result in judged:
            case = ET.SubElement(suite, "testcase", classname=experiment.scenario.id, name=result.id, time="0")
            if result.verdict == "fail":
                value = f"{result.value:.6g}" if math.isfinite(result.value) else "undefined"
                text = f"{result.title}: {value} {result.unit}, expected {result.expectation()} ({result.source})"
                ET.SubElement(case, "failure", message=text)
    ET.indent(root)
    out.mkdir(parents=True, exist_ok=True)
    path = out / "junit.xml"
    ET.ElementTree(root).write(path, encoding="utf-8", xml_declaration=True)
    return path
