"""What of the scenarios the command line wants: names and patterns of scenarios and cases, another duration or step."""

import math
from collections.abc import Callable, Iterable
from fnmatch import fnmatchcase
from typing import Any

from exo import scenario as scenarios
from exo.errors import ScenarioError, close_matches
from exo.scenario import Case, Figure, Metric, Scenario

#: What makes a name a pattern.
WILD = "*?["


def named(names: list[str]) -> list[str]:
    """Scenario ids and files, patterns such as `arm_*` written out, each once."""
    known = list(scenarios.built_in())
    found: dict[str, None] = {}
    for name in names:
        if name.endswith(".toml") or not set(WILD) & set(name):
            found[name] = None
            continue
        matching = [one for one in known if fnmatchcase(one, name)]
        if not matching:
            raise ScenarioError(f"no scenario matches {name}{close_matches(name.strip(WILD), known)}")
        found |= dict.fromkeys(matching)
    return list(found)


def load(names: list[str]) -> list[Scenario]:
    """The scenarios; two whose results would lie in one folder are refused."""
    loaded = [scenarios.load(name) for name in named(names)]
    places: dict[str, str] = {}
    for name, one in zip(named(names), loaded, strict=True):
        other = places.setdefault(one.id.casefold(), name)
        if other != name:
            raise ScenarioError(f"{other} and {name} both have the id {one.id}; expected another id for one of them")
    return loaded


def described(scenario: Scenario) -> dict[str, Any]:
    """What `exo list --json` says of a scenario."""
    return {
        "id": scenario.id,
        "title": scenario.title,
        "about": scenario.about.strip(),
        "source": scenario.source,
        "duration_s": scenario.duration,
        "step_s": scenario.step,
        "cases": [case.id for case in scenario.cases],
        "metrics": [metric.id for metric in scenario.metrics] + [ratio.id for ratio in scenario.ratios],
        "archives": sorted({part.archive for part in scenario.components.values()}),
    }


def narrowed(
    scenario: Scenario, *, cases: Iterable[str] = (), duration: float | None = None, step: float | None = None
) -> Scenario:
    """The scenario with only the cases that match, and with another duration and step (s) of all cases."""
    kept = _cases(scenario, list(cases))
    for name, value in (("--duration", duration), ("--step", step)):
        if value is not None and not (math.isfinite(value) and value > 0.0):
            raise ScenarioError(f"{name} {value:g}: expected a time above 0 s")
    for case in kept:
        try:
            length = duration or case.duration or scenario.duration
            wanted = step or case.step or scenario.step
            scenarios.check_duration(f"case {case.id}", duration=length, step=wanted)
        except ValueError as error:
            raise ScenarioError(f"{scenario.id}: {error}") from error
    replaced = {name: None for name, value in (("duration", duration), ("step", step)) if value is not None}
    kept = [case.model_copy(update=replaced) for case in kept]
    ids = {case.id for case in kept}
    metrics = tuple(one for metric in scenario.metrics for one in _metric(metric, ids))
    numbers = {f"{metric.id}/{case}" for metric in metrics for case in metric.cases or ids}
    length = duration or max(case.duration or scenario.duration for case in kept)
    return scenario.model_copy(
        update={
            "cases": tuple(kept),
            "duration": duration or scenario.duration,
            "step": step or scenario.step,
            "metrics": metrics,
            "ratios": tuple(ratio for ratio in scenario.ratios if set(ratio.of) <= numbers),
            "figures": tuple(figure for figure in scenario.figures if _drawable(figure, ids, length)),
        }
    )


def _cases(scenario: Scenario, patterns: list[str]) -> list[Case]:
    if not patterns:
        return list(scenario.cases)
    matches: Callable[[str, str], bool] = fnmatchcase
    for pattern in patterns:
        if not any(case.id == pattern or matches(case.id, pattern) for case in scenario.cases):
            known = close_matches(pattern, [case.id for case in scenario.cases])
            raise ScenarioError(f"--case {pattern}: no such case of {scenario.id}{known}")
    return [case for case in scenario.cases if any(case.id == one or matches(case.id, one) for one in patterns)]


def _metric(metric: Metric, ids: set[str]) -> list[Metric]:
    """The metric of the cases that are left, none if there is none."""
    left = None if metric.cases is None else tuple(case for case in metric.cases if case in ids)
    if left == ():
        return []
    expected = {case: check for case, check in metric.expected.items() if case in ids}
    paper = {case: key for case, key in metric.paper.items() if case in ids}
    return [metric.model_copy(update={"cases": left, "expected": expected, "paper": paper})]


def _drawable(figure: Figure, ids: set[str], duration: float) -> bool:
    """Whether all that it draws has been run."""
    return set(figure.cases) <= ids and not (figure.poses and max(figure.poses.times, default=0.0) > duration)
