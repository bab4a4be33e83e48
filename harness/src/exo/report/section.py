"""What one experiment has left in its folder, as the page needs it."""

import json
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from pydantic import ValidationError

from exo import metrics_file
from exo import scenario as scenarios
from exo.errors import ExoError, ScenarioError
from exo.folder import MANIFEST, METRICS, check_name
from exo.report.verdicts import Before, Row, row
from exo.scenario import Scenario

VERDICTS = ("pass", "fail", "info")


@dataclass(frozen=True, kw_only=True)
class Section:
    """An experiment: where it lies, what it was, what has come out."""

    folder: Path
    scenario: Scenario
    verdict: str
    rows: tuple[Row, ...]
    #: metrics.json's `run`: title, source, fmus, versions, overrides, cases.
    run: Mapping[str, Any]
    #: When the earlier run was, with which `rows` are compared; empty without one.
    before: str
    #: Ids of numbers that the earlier run had.
    gone: tuple[str, ...]

    @property
    def id(self) -> str:
        """The scenario's id, and its folder's name."""
        return self.scenario.id

    @property
    def counts(self) -> dict[str, int]:
        """How many rows have which verdict."""
        return {verdict: sum(row.verdict == verdict for row in self.rows) for verdict in VERDICTS}

    def beside(self, row: Row) -> Row | None:
        """The same number judged by the paper's; None where that is not fair (`exo.verdict.beside_the_paper`)."""
        return next((one for one in self.rows if one.id == f"{row.id}/paper"), None)

    @property
    def changed(self) -> int:
        """How many rows are not what they were, or have come or gone."""
        return sum(bool(row.change) for row in self.rows) + len(self.gone)

    @property
    def has_signals(self) -> bool:
        """Whether the run has kept every tick of its signals."""
        return (self.folder / "signals").is_dir()

    @property
    def simulated(self) -> float:
        """Seconds simulated in all cases."""
        return float(sum(case["duration_s"] for case in self.run["cases"].values()))

    @property
    def computing(self) -> float:
        """Seconds that took."""
        return float(sum(case["wall_time_s"] for case in self.run["cases"].values()))

    @property
    def slowest(self) -> float:
        """Simulated over computing time of the slowest case."""
        return float(min(case["real_time_factor"] for case in self.run["cases"].values()))


def read(folder: Path, before: Before) -> Section:
    """The results in `folder`. ExoError: there are none, or they are no results of this version."""
    check_name(folder)
    if not (folder / METRICS).exists():
        raise ExoError(f"{folder / METRICS}: missing: run `exo run {folder.name}` first")
    document = metrics_file.read(folder / METRICS)
    earlier = before.of(folder)
    old = {} if earlier is None else earlier["metrics"]
    return Section(
        folder=folder,
        scenario=_scenario(folder),
        verdict=document["verdict"],
        rows=tuple(row(name, metric, earlier) for name, metric in document["metrics"].items()),
        run=document["run"],
        before="" if earlier is None else earlier["date"],
        gone=tuple(name for name in old if name not in document["metrics"]),
    )


def _scenario(folder: Path) -> Scenario:
    """The scenario as it ran, from the manifest; one of before there were manifests is looked up by its id."""
    path = folder / MANIFEST
    if not path.is_file():
        return scenarios.load(folder.name)
    try:
        return Scenario.model_validate_json(json.dumps(_json(path)["scenario"]))
    except (KeyError, ValidationError, ScenarioError) as error:
        raise ExoError(f"{path}: holds no scenario of this version: run `exo run {folder.name}` again") from error


def _json(path: Path) -> dict[str, Any]:
    try:
        return dict(json.loads(path.read_text(encoding="utf-8")))
    except (ValueError, TypeError) as error:
        raise ExoError(f"{path}: not a file of exo's results: {error}") from error
