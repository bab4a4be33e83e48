"""The scenarios and cases that a file of requirements names. One that is not there would never be judged, and a
requirement that is never judged looks as one that holds.
"""

from collections.abc import Collection, Sequence
from fnmatch import fnmatchcase
from pathlib import Path

from exo import scenario as scenarios
from exo.errors import ScenarioError, close_matches
from exo.requirements.document import Requirements, Shown
from exo.scenario import Scenario


def scenario_of(shown: Shown, folder: Path) -> Scenario:
    """The file of the scenario's id in `folder`, else the built-in scenario. ScenarioError, if there is neither."""
    beside = folder / f"{shown.scenario}.toml"
    return scenarios.load(str(beside) if beside.is_file() else shown.scenario)


def check_cases(shown: Shown, scenario: Scenario, *, where: str) -> None:
    """ScenarioError for an id or a pattern that no case of the scenario matches."""
    cases = [case.id for case in scenario.cases]
    for pattern in shown.cases:
        if not any(fnmatchcase(case, pattern) for case in cases):
            raise ScenarioError(f"{where}: cases: {scenario.id} has no case {pattern}{close_matches(pattern, cases)}")


def check(
    requirements: Requirements, file: Path, *, running: Sequence[Scenario] = (), done: Collection[str] = ()
) -> None:
    """ScenarioError for a place of `file` that does not exist, and where nothing is said of what is `running`.

    A scenario is one of those that run, with all their cases, one beside the file, or one that comes with exo. One that
    is none of them is told by its results alone, if it is in `done`.
    """
    run = {one.id: one for one in running}
    asked: dict[str, None] = {}
    for name, requirement in requirements.requirements.items():
        for key, shown in requirement.shown.items():
            where = f"{file}: requirement {name}.{key}"
            asked[shown.scenario] = None
            try:
                scenario = run.get(shown.scenario) or scenario_of(shown, file.parent)
            except ScenarioError as error:
                if shown.scenario in done:
                    continue
                raise ScenarioError(f"{where}: scenario: {error}") from error
            check_cases(shown, scenario, where=where)
    if run and not set(run) & set(asked):
        raise ScenarioError(f"{file}: has no requirement of {', '.join(run)}; its scenarios are {', '.join(asked)}")
