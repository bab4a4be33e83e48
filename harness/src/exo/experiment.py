"""One scenario from data to verdicts: opens the archives, runs every case, evaluates every metric."""

from collections.abc import Callable, Mapping
from contextlib import ExitStack
from dataclasses import dataclass
from importlib import metadata
from pathlib import Path
from typing import Any

from exo import metrics, trial
from exo.errors import ScenarioError, close_matches
from exo.fmu import Archive
from exo.naming import elements
from exo.paper import lookup
from exo.recording import Recording
from exo.scenario import Case, Scenario, Value
from exo.simulate import Plan, plan, simulate
from exo.verdict import Result, judge


@dataclass(frozen=True, kw_only=True)
class Experiment:
    """A scenario that has run."""

    scenario: Scenario
    overrides: Mapping[str, Value]
    #: By case id.
    plans: Mapping[str, Plan]
    recordings: Mapping[str, Recording]
    results: tuple[Result, ...]
    #: Archive name → guid, version and tool of the FMU.
    fmus: Mapping[str, Mapping[str, str]]

    @property
    def passed(self) -> bool:
        """Whether no verdict failed."""
        return all(result.verdict != "fail" for result in self.results)

    def description(self) -> dict[str, Any]:
        """Everything that says how the numbers came about, for metrics.json."""
        return {
            "title": self.scenario.title,
            "source": self.scenario.source,
            "fmus": {name: dict(facts) for name, facts in self.fmus.items()},
            "versions": {name: metadata.version(name) for name in ("exo", "fmpy", "numpy", "scipy")},
            "overrides": dict(self.overrides),
            "cases": {
                case.id: {
                    "label": case.label,
                    "coupling": self.plans[case.id].coupling,
                    "inputs": dict(self.plans[case.id].inputs),
                    "duration_s": self.plans[case.id].duration,
                    "step_s": self.plans[case.id].step,
                    "parameters_set": dict(self.plans[case.id].parameters),
                    "parameters": dict(self.recordings[case.id].parameters),
                    "wall_time_s": self.recordings[case.id].wall_time,
                    "real_time_factor": self.recordings[case.id].real_time_factor,
                }
                for case in self.scenario.cases
            },
        }


def run(
    *,
    scenario: Scenario,
    fmu_dir: Path,
    overrides: Mapping[str, str] | None = None,
    on_case: Callable[[Case], None] = lambda _case: None,
) -> Experiment:
    """Runs all cases. `overrides` are texts from the command line; `on_case` is told before each case."""
    _check_functions(scenario)
    with ExitStack() as stack:
        names = {part.archive for part in scenario.components.values()}
        archives = {name: stack.enter_context(Archive(fmu_dir / name)) for name in sorted(names)}
        for archive in archives.values():
            trial.check(archive)
        parsed = _parse_overrides(scenario, archives, overrides or {})
        plans = {case.id: plan(scenario=scenario, case=case, overrides=parsed) for case in scenario.cases}
        recordings = {}
        for case in scenario.cases:
            on_case(case)
            recordings[case.id] = simulate(plan=plans[case.id], archives=archives)
        fmus = {name: _facts(archive) for name, archive in archives.items()}
    return Experiment(
        scenario=scenario,
        overrides=parsed,
        plans=plans,
        recordings=recordings,
        results=evaluate(scenario=scenario, recordings=recordings),
        fmus=fmus,
    )


def _facts(archive: Archive) -> dict[str, str]:
    description = archive.description
    return {
        "guid": str(description.guid),
        "version": str(description.version or ""),
        "generation_tool": str(description.generationTool or ""),
    }


def _check_functions(scenario: Scenario) -> None:
    """Refuses a scenario with a wrong function or argument before anything runs."""
    for metric in scenario.metrics:
        owner = f"{scenario.id}: metric {metric.id}"
        metrics.check(function=metric.function, arguments=metric.arguments, owner=owner, components=scenario.components)
        for key in metric.paper.values():
            lookup(key)


def _parse_overrides(
    scenario: Scenario, archives: Mapping[str, Archive], overrides: Mapping[str, str]
) -> dict[str, Value]:
    parsed: dict[str, Value] = {}
    for key, text in overrides.items():
        component, _, name = key.partition(".")
        if component not in scenario.components or not name:
            known = close_matches(component, scenario.components)
            raise ScenarioError(f"--set {key}: expected <component>.<parameter>, got component {component!r}{known}")
        archive = archives[scenario.components[component].archive]
        parsed.update({f"{component}.{element}": archive.parse(element, text) for element in elements(name)})
    return parsed


def evaluate(*, scenario: Scenario, recordings: Mapping[str, Recording]) -> tuple[Result, ...]:
    """All metrics of all cases, then the ratios."""
    results: dict[str, Result] = {}
    for metric in scenario.metrics:
        for case in metric.cases or tuple(recordings):
            value = metrics.evaluate(
                recording=recordings[case],
                function=metric.function,
                arguments=metric.arguments,
                owner=f"{scenario.id}: metric {metric.id}",
            )
            name = f"{metric.id}/{case}"
            results[name] = judge(
                metric=name,
                title=metric.title,
                value=value,
                unit=metric.unit,
                check=metric.expected.get(case, metric.check),
                source=metric.source,
                paper=lookup(metric.paper[case]) if case in metric.paper else None,
            )
    for ratio in scenario.ratios:
        for name in ratio.of:
            if name not in results:
                raise ScenarioError(f"{scenario.id}: ratio {ratio.id}: no metric {name}{close_matches(name, results)}")
        upper, lower = (results[name].value for name in ratio.of)
        results[ratio.id] = judge(
            metric=ratio.id, title=ratio.title, value=upper / lower, unit="1", check=ratio.check, source=ratio.source
        )
    return tuple(results.values())
