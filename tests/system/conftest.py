"""What the system tests share: the built archives, one run of each scenario, synthetic recordings."""

from collections.abc import Iterator, Mapping
from contextlib import ExitStack
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from xdist.scheduler import LoadScopeScheduling

from exo import experiment as experiments
from exo import scenario as scenarios
from exo.errors import FmuError
from exo.experiment import Experiment
from exo.fmu import Archive, find_fmu_dir
from exo.recording import Recording

from foreign.matrix import names
from sweeping import WALL

NAMES = names()


#: The scenario that ran last. Its tests stand next to each other, so that it runs once; all together would be some GB.
RUNS: dict[str, Experiment] = {}


def group(nodeid: str) -> str:
    """Tests that stay together, on one worker and in a row: those of a file, and with them the scenario's verdicts."""
    file, _, test = nodeid.partition("::")
    if Path(file).stem == "test_verdicts":
        return test.partition("[")[2].partition("-")[0]
    return Path(file).stem.removeprefix("test_")


class ByScenario(LoadScopeScheduling):  # type: ignore[misc]
    """xdist's loadfile, by `group`. Its own loadgroup does not see the groups under pytest 9.2."""

    def _split_scope(self, nodeid: str) -> str:
        return group(nodeid)


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_make_scheduler(config: pytest.Config, log: Any) -> LoadScopeScheduling:
    """How the workers share the tests."""
    return ByScenario(config, log)


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Groups in a row, also without workers."""
    groups: dict[str, list[pytest.Item]] = {}
    for item in items:
        groups.setdefault(group(item.nodeid), []).append(item)
    items[:] = [item for together in groups.values() for item in together]


def pytest_runtest_teardown(item: pytest.Item, nextitem: pytest.Item | None) -> None:
    """Gives the recordings back where another group follows."""
    if nextitem is None or group(nextitem.nodeid) != group(item.nodeid):
        RUNS.clear()


def run_of(name: str, fmu_dir: Path) -> Experiment:
    """The run of a built-in scenario, done once for all tests of it."""
    if name not in RUNS:
        RUNS.clear()
        RUNS[name] = experiments.run(scenario=scenarios.load(name), fmu_dir=fmu_dir)
    return RUNS[name]


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


@pytest.fixture
def study_file(tmp_path: Path) -> Path:
    """A file with a small study, to be changed."""
    path = tmp_path / "study.toml"
    path.write_text(WALL)
    return path


@pytest.fixture(scope="module")
def experiment(request: pytest.FixtureRequest, fmu_dir: Path) -> Experiment:
    """The run of the module's SCENARIO."""
    return run_of(request.module.SCENARIO, fmu_dir)


@pytest.fixture(scope="module")
def results(experiment: Experiment) -> dict[str, Any]:
    """The module's verdicts by id."""
    return {result.id: result for result in experiment.results}


def recording(
    *,
    time: Any,
    parameters: Mapping[str, float] | None = None,
    choices: Mapping[str, str] | None = None,
    **columns: Any,
) -> Recording:
    """A synthetic recording; `__` in a column's name stands for the dot."""
    named = {name.replace("__", "."): np.asarray(column) for name, column in columns.items()}
    return Recording(
        time=np.asarray(time, dtype=np.float64),
        columns=named,
        units={},
        parameters=dict(parameters or {}),
        choices=dict(choices or {}),
        profiles={},
        wall_time=1.0,
        cpu_time=1.0,
    )
