"""What the replay draws of an experiment: kept beside its numbers when it runs, because its signals often are not.

The replay is `exo.replay`: `scene(experiment, cases)` answers what is drawn, for JSON, or None where there is nothing.
Its script defines `exoReplay.mount(element, scene, bus)`. A harness without it has plots alone.
"""

import json
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from exo.errors import ExoError
from exo.experiment import Experiment
from exo.scenario import Scenario

NAME = "scene.json"


def available() -> bool:
    """Whether this harness has a replay."""
    return find_spec("exo.replay") is not None


def keep(*, experiment: Experiment, fresh: Path) -> None:
    """Writes the experiment's scene into its new folder, where there is one to draw."""
    if not available():
        return
    scene = import_module("exo.replay").scene(experiment, chosen(experiment.scenario))
    if scene is not None:
        text = json.dumps(scene, ensure_ascii=False, separators=(",", ":"), allow_nan=False)
        (fresh / NAME).write_text(text + "\n", encoding="utf-8")


def chosen(scenario: Scenario) -> list[str]:
    """The cases to look at: those that figures show, in the scenario's order; without any the first two."""
    ids = [case.id for case in scenario.cases]
    shown = {name for figure in scenario.figures for name in figure.cases}
    return [name for name in ids if name in shown] or ids[:2]


def read(folder: Path) -> Any:
    """The scene in a folder of results; None where there is none. ExoError: it is damaged."""
    path = folder / NAME
    if not available() or not path.is_file():
        return None
    try:
        return json.loads(path.read_text(encoding="utf-8"))
    except ValueError as error:
        raise ExoError(f"{path}: no scene: {error}: run `exo run {folder.name}` again") from error
