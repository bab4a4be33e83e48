"""pytest plugin: scenarios and FMUs as fixtures, tolerance bands, and requirements as tests (docs/requirements.md).

| fixture | what |
|---|---|
| `exo_fmu_dir` | folder of the archives: `--exo-fmu-dir`, else `$EXO_FMU_DIR` or target/fmu |
| `exo_fmu` | loads an FMU of that folder by its name |
| `exo_couple` | couples FMUs of that folder, and others by their path |
| `exo_run` | runs a case of a scenario, each once a session, or what was coupled; gives an `exo.Run` |
| `exo_in_band` | fails where a signal leaves its tolerance band |

`requirements.toml` and `*.requirements.toml` with requirements of exo are collected: a test for each requirement, place
and case.
"""

from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

if TYPE_CHECKING:
    from exo.api.fmu import Fmu
    from exo.api.run import Run
    from exo.api.system import System
    from exo.requirements import Requirements
    from exo.scenario import Scenario

#: What requirements were judged on: experiments by scenario and case.
RUNS = pytest.StashKey[dict[tuple[str, str], Any]]()
MARK = "requirements."


def pytest_addoption(parser: pytest.Parser) -> None:
    group = parser.getgroup("exo", "FMUs, scenarios and requirements of exo")
    group.addoption("--exo-fmu-dir", type=Path, help="folder of the archives; else $EXO_FMU_DIR or target/fmu")
    group.addoption("--exo-engine", default=None, help="fmpy or native; else native where it is installed")


def pytest_configure(config: pytest.Config) -> None:
    """Refuses options that no test could run with, before any does."""
    fmu_dir, engine = config.getoption("--exo-fmu-dir"), config.getoption("--exo-engine")
    if fmu_dir is not None and not fmu_dir.is_dir():
        raise pytest.UsageError(f"--exo-fmu-dir {fmu_dir}: no such folder; expected the folder of the archives")
    if engine is not None:
        from exo.errors import ExoError  # noqa: PLC0415
        from exo.loop import named  # noqa: PLC0415

        try:
            named(engine)
        except ExoError as error:
            raise pytest.UsageError(str(error).replace("--engine", "--exo-engine")) from error


def pytest_collect_file(file_path: Path, parent: pytest.Collector) -> pytest.Collector | None:
    if file_path.name != "requirements.toml" and not file_path.name.endswith(".requirements.toml"):
        return None
    try:
        ours = f"[{MARK}" in file_path.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError):
        return None
    return File.from_parent(parent, path=file_path) if ours else None


@pytest.fixture(scope="session")
def exo_fmu_dir(pytestconfig: pytest.Config) -> Path:
    """Folder of the archives."""
    return _fmu_dir(pytestconfig)


@pytest.fixture(scope="session")
def exo_fmu(exo_fmu_dir: Path) -> "Callable[..., Fmu]":
    """`exo_fmu("Testbed.fmu")`: what `exo.load` gives, from `exo_fmu_dir` or, where it names a file, from there."""

    def load(name: str | Path) -> "Fmu":
        import exo  # noqa: PLC0415

        return exo.load(name if Path(name).is_file() else exo_fmu_dir / name)

    return load


@pytest.fixture(scope="session")
def exo_couple(exo_fmu: "Callable[..., Fmu]") -> "Callable[..., System]":
    """`exo_couple({"plant": "Testbed.fmu"}, wires=…, step=…)`: `exo.couple`, with FMUs as `exo_fmu` takes them."""

    def couple(fmus: Mapping[str, str | Path], **more: Any) -> "System":
        import exo  # noqa: PLC0415

        return exo.couple({name: exo_fmu(one) for name, one in fmus.items()}, **more)

    return couple


@pytest.fixture(scope="session")
def exo_run(pytestconfig: pytest.Config) -> "Callable[..., Run]":
    """`exo_run(what, case=None, duration=…, step=…, inputs=…, **{"controller.K": 1000})`: what `exo.simulate` gives.

    `what` is a scenario's id, the path of a .toml file, or what `exo_couple` gives. The same call of a scenario without
    `inputs` runs once a session.
    """
    runs: dict[tuple[Any, ...], Any] = {}

    def run(what: Any, case: str | None = None, *, inputs: Mapping[str, Any] | None = None, **more: Any) -> "Run":
        import exo  # noqa: PLC0415

        timed: dict[str, Any] = {name: more.pop(name) for name in ("duration", "step") if name in more}
        arguments: dict[str, Any] = {"case": case, "parameters": more, "inputs": inputs, **timed}
        arguments |= {"engine": pytestconfig.getoption("--exo-engine"), "fmu_dir": _fmu_dir(pytestconfig)}
        if inputs is not None or not isinstance(what, str | Path):
            return exo.simulate(what, **arguments)
        key = (str(what), case, repr(sorted(timed.items())), repr(sorted(more.items())))
        if key not in runs:
            runs[key] = exo.simulate(what, **arguments)
        return runs[key]  # type: ignore[no-any-return]

    return run


@pytest.fixture(scope="session")
def exo_in_band() -> Callable[..., None]:
    """Fails where a signal leaves the band around a reference; the arguments are those of `exo.bands.excess`."""

    def check(**arguments: Any) -> None:
        from exo.bands import excess  # noqa: PLC0415

        found = excess(**arguments)
        if found:
            pytest.fail(f"leaves its band by {found.largest:.6g} at {found.at:g} s", pytrace=False)

    return check


class File(pytest.File):
    """A file of requirements."""

    def collect(self) -> "Iterator[Item]":
        from exo.errors import ExoError  # noqa: PLC0415
        from exo.requirements import check, load, scenario_of  # noqa: PLC0415

        try:
            requirements = load(self.path)
            check(requirements, self.path)
            for name, one in requirements.requirements.items():
                for key, shown in one.shown.items():
                    scenario = scenario_of(shown, self.path.parent)
                    for case in shown.meant(tuple(case.id for case in scenario.cases)):
                        yield Item.from_parent(
                            self, name=f"{name}.{key}[{case}]", requirements=requirements, scenario=scenario, case=case
                        )
        except ExoError as error:
            raise self.CollectError(str(error)) from error


class BrokenError(Exception):
    """A requirement that does not hold; its text is what the user sees."""


class Item(pytest.Item):
    """One requirement in one case."""

    def __init__(self, *, requirements: "Requirements", scenario: "Scenario", case: str, **more: Any) -> None:
        super().__init__(**more)
        self.requirements = requirements
        self.scenario = scenario
        self.case = case

    def runtest(self) -> None:
        from exo.requirements import PREFIX, results  # noqa: PLC0415

        done = _experiment(self.config, self.scenario, self.case)
        wanted = f"{PREFIX}{self.name.split('[')[0]}/{self.case}"
        found = {
            result.id: result
            for result in results(
                self.requirements,
                scenario=self.scenario.id,
                recordings={self.case: done.recordings[self.case]},
                changed={self.case: ()},
            )
        }
        result = found[wanted]
        self.user_properties.append(("margin", f"{result.value:.6g} {result.unit}"))
        if result.verdict == "fail":
            raise BrokenError(
                f"{result.title}: margin {result.value:.6g} {result.unit}, expected at least 0\n"
                f"formula: {result.because}\n{result.source}"
            )

    def repr_failure(self, excinfo: pytest.ExceptionInfo[BaseException], style: Any = None) -> Any:
        from exo.errors import ExoError  # noqa: PLC0415

        if isinstance(excinfo.value, BrokenError | ExoError):
            return str(excinfo.value)
        return super().repr_failure(excinfo, style)

    def reportinfo(self) -> tuple[Path, int | None, str]:
        return self.path, None, f"requirement {self.name}"


def _fmu_dir(config: pytest.Config) -> Path:
    from exo.fmu import find_fmu_dir  # noqa: PLC0415

    return find_fmu_dir(config.getoption("--exo-fmu-dir"))


def _experiment(config: pytest.Config, scenario: "Scenario", case: str) -> Any:
    from exo import experiment, loop  # noqa: PLC0415
    from exo.selection import narrowed  # noqa: PLC0415

    runs = config.stash.setdefault(RUNS, {})
    key = scenario.model_dump_json(), case
    if key not in runs:
        engine = config.getoption("--exo-engine")
        runs[key] = experiment.run(
            scenario=narrowed(scenario, cases=[case]),
            fmu_dir=_fmu_dir(config),
            required=(),
            engine=loop.named(engine) if engine else loop.fastest(),
        )
    return runs[key]
