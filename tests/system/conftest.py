"""What the system tests share: the built archives, a scenario's run per file, synthetic recordings."""

from collections.abc import Iterator, Mapping
from contextlib import ExitStack
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from exo import experiment as experiments
from exo import scenario as scenarios
from exo.errors import FmuError
from exo.experiment import Experiment
from exo.fmu import Archive, find_fmu_dir
from exo.recording import Recording

from foreign.matrix import names

NAMES = names()


def verdict_ids(name: str) -> list[str]:
    """Ids of everything that a scenario judges or reports, known before it runs."""
    data = scenarios.load(name)
    cases = tuple(case.id for case in data.cases)
    metrics = [f"{metric.id}/{case}" for metric in data.metrics for case in metric.cases or cases]
    return metrics + [ratio.id for ratio in data.ratios]


@pytest.fixture(scope="session")
def fmu_dir() -> Path:
    """The folder of the built archives."""
    here = Path(__file__).resolve().parents[2] / "target" / "fmu"
    try:
        folder = here if here.is_dir() else find_fmu_dir()
    except FmuError as error:
        pytest.exit(str(error), returncode=2)
    for name in NAMES:
        if not (folder / f"{name}.fmu").is_file():
            pytest.exit(f"{name}.fmu is not in {folder.name}: run `cargo xtask fmu` first", returncode=2)
    return folder


@pytest.fixture(scope="session", params=NAMES)
def fmu(request: pytest.FixtureRequest, fmu_dir: Path) -> Path:
    """Each built archive in turn."""
    return fmu_dir / f"{request.param}.fmu"


@pytest.fixture(scope="session")
def archives(fmu_dir: Path) -> Iterator[Mapping[str, Archive]]:
    """All archives, extracted, by file name."""
    with ExitStack() as stack:
        yield {f"{name}.fmu": stack.enter_context(Archive(fmu_dir / f"{name}.fmu")) for name in NAMES}


@pytest.fixture(scope="module")
def experiment(request: pytest.FixtureRequest, fmu_dir: Path) -> Experiment:
    """The run of the module's SCENARIO."""
    return experiments.run(scenario=scenarios.load(request.module.SCENARIO), fmu_dir=fmu_dir)


@pytest.fixture(scope="module")
def results(experiment: Experiment) -> dict[str, Any]:
    """The module's verdicts by id."""
    return {result.id: result for result in experiment.results}


def recording(*, time: Any, parameters: Mapping[str, float] | None = None, **columns: Any) -> Recording:
    """A synthetic recording; `__` in a column's name stands for the dot."""
    named = {name.replace("__", "."): np.asarray(column) for name, column in columns.items()}
    return Recording(
        time=np.asarray(time, dtype=np.float64),
        columns=named,
        units={},
        parameters=dict(parameters or {}),
        profiles={},
        wall_time=1.0,
        cpu_time=1.0,
    )
