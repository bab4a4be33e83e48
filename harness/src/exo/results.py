"""What an experiment leaves on disk: metrics.json, signals, figures with their data, JUnit file and manifest."""

import json
from pathlib import Path
from typing import Any

import jsonschema

from exo import earlier, folder, junit, manifest, recording, scenes
from exo.errors import ExoError
from exo.experiment import Experiment
from exo.kept import EVERYTHING, Kept
from exo.metrics_file import SCHEMA_ID, schema


def metrics_document(experiment: Experiment) -> dict[str, Any]:
    """The content of metrics.json, checked against the schema."""
    document = {
        "schema": SCHEMA_ID,
        "scenario": experiment.scenario.id,
        "verdict": experiment.verdict,
        "metrics": {result.id: result.as_json() for result in experiment.results},
        "run": experiment.description(),
    }
    # A round trip makes JSON of tuples and refuses what JSON has not: NaN and infinity.
    checked: dict[str, Any] = json.loads(json.dumps(document, allow_nan=False))
    jsonschema.Draft202012Validator(schema()).validate(checked)
    return checked


def write(*, experiment: Experiment, out: Path, kept: Kept = EVERYTHING) -> Path:
    """Writes `<out>/<scenario>/` as a whole, in the place of what an earlier run has left, and returns it.

    ExoError, if it cannot be written.
    """
    target = out / experiment.scenario.id
    try:
        _write(experiment, out=out, kept=kept)
    except OSError as error:
        # Arrow and matplotlib name no file.
        said = error.strerror or error
        raise ExoError(f"{target}: cannot be written: {said}; what was there before stays") from error
    return target


def _write(experiment: Experiment, *, out: Path, kept: Kept) -> None:
    # What draws takes a third of a second to import: only where something is drawn.
    from exo import plots  # noqa: PLC0415

    target = out / experiment.scenario.id
    document = json.dumps(metrics_document(experiment), indent=2, ensure_ascii=False)
    with folder.replaced(target) as fresh:
        (fresh / folder.METRICS).write_text(document + "\n", encoding="utf-8")
        earlier.keep(old=target, fresh=fresh)
        if kept.has_signals_of(experiment.scenario.id):
            for case, run in experiment.recordings.items():
                recording.write(run.table(experiment.scenario.signals), fresh / "signals" / case, csv=kept.csv)
        for figure in experiment.scenario.figures:
            plots.draw(figure=figure, recordings=experiment.recordings, path=fresh / f"{figure.id}.png")
            data = plots.data(figure=figure, recordings=experiment.recordings)
            recording.write(data, fresh / "figures" / figure.id, csv=kept.csv)
        scenes.keep(experiment=experiment, fresh=fresh)
        (fresh / junit.NAME).write_bytes(junit.text([junit.suite(experiment)]))
        manifest.write(experiment=experiment, folder=fresh)
