"""One scenario from data to verdicts: opens the archives, runs every case, evaluates every metric."""

import hashlib
import math
from collections.abc import Callable, Mapping, Sequence
from contextlib import ExitStack
from dataclasses import dataclass
from importlib import metadata
from pathlib import Path
from typing import Any

from exo import derived, metrics, preflight, requirements, trial
from exo import overrides as settings
from exo.errors import ScenarioError, in_case
from exo.fmu import Archive, Instance
from exo.loop import Engine
from exo.master import Plan, plan, simulate
from exo.paper import lookup
from exo.recording import Recording
from exo.requirements import Requirements
from exo.scenario import Case, Scenario, Value
from exo.verdict import Result, Verdict, beside_the_paper, judge


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
    #: What made the steps.
    engine: Engine = "fmpy"
    #: Inputs at their start values: nothing feeds them and nothing sets them.
    unwired: tuple[str, ...] = ()
    #: What else may be a slip, a sentence each.
    notes: tuple[str, ...] = ()

    @property
    def passed(self) -> bool:
        """Whether no verdict failed."""
        return all(result.verdict != "fail" for result in self.results)

    @property
    def verdict(self) -> Verdict:
        """Of the whole: pass where something was judged and nothing failed, info where nothing was judged."""
        found = {result.verdict for result in self.results}
        return "fail" if "fail" in found else "pass" if "pass" in found else "info"

    def description(self) -> dict[str, Any]:
        """Everything that says how the numbers came about, for metrics.json."""
        return {
            "title": self.scenario.title,
            "source": self.scenario.source,
            "fmus": {name: dict(facts) for name, facts in self.fmus.items()},
            "versions": {name: metadata.version(name) for name in ("exo", "fmpy", "numpy", "scipy")},
            "engine": self.engine,
            "overrides": dict(self.overrides),
            "cases": {
                case.id: {
                    "label": case.label,
                    "coupling": self.plans[case.id].coupling,
                    "inputs": dict(self.plans[case.id].inputs),
                    "duration_s": self.plans[case.id].duration,
                    "step_s": self.plans[case.id].step,
                    "parameters_set": dict(self.plans[case.id].parameters),
                    "parameters": {
                        # JSON has no NaN and no infinity.
                        key: value if math.isfinite(value) else str(value)
                        for key, value in self.recordings[case.id].parameters.items()
                    },
                    "wall_time_s": self.recordings[case.id].wall_time,
                    "real_time_factor": self.recordings[case.id].real_time_factor,
                    **_deadlines(self.recordings[case.id]),
                }
                for case in self.scenario.cases
            },
        }


def run(
    *,
    scenario: Scenario,
    fmu_dir: Path,
    overrides: Mapping[str, str] | None = None,
    given: Mapping[str, float] | None = None,
    engine: Engine = "fmpy",
    real_time: bool = False,
    required: Sequence[Requirements] | None = None,
    on_case: Callable[[Case], None] = lambda _case: None,
) -> Experiment:
    """Runs all cases and judges metrics and requirements (the project's, when `required` is None).

    `overrides` are texts from the command line; `on_case` is told before each case.

    `engine` makes the steps (`exo.loop`), `real_time` by the clock; ExoError when the engine is not installed.

    `given` are `duration` and `step` (s) where they have replaced the scenario's (`exo.selection.narrowed`).
    """
    preflight.functions(scenario)
    with ExitStack() as stack:
        names = {part.archive for part in scenario.components.values()}
        archives = {name: stack.enter_context(Archive(fmu_dir / name)) for name in sorted(names)}
        parsed = settings.parse(scenario, archives, overrides or {})
        plans = {case.id: plan(scenario=scenario, case=case, overrides=parsed) for case in scenario.cases}
        preflight.check(scenario=scenario, plans=plans, archives=archives, shortened=bool(given))
        for archive in archives.values():
            trial.check(archive)
        changed = {
            case.id: (
                *settings.changed(plain=plan(scenario=scenario, case=case), overrides=parsed, archives=archives),
                *(given or {}),
            )
            for case in scenario.cases
        }
        recordings = {}
        for case in scenario.cases:
            on_case(case)
            with in_case(scenario.id, case.id):
                run = simulate(plan=plans[case.id], archives=archives, engine=engine, real_time=real_time)
            recordings[case.id] = derived.added(run, scenario.derived)
        fmus = {name: _facts(archive) for name, archive in archives.items()}
        unwired = preflight.unwired(plans, archives)
        notes = preflight.timing(plans, archives)
    return Experiment(
        scenario=scenario,
        overrides=parsed | dict(given or {}),
        plans=plans,
        recordings=recordings,
        results=evaluate(scenario=scenario, recordings=recordings, plans=plans, changed=changed)
        + _required(required, scenario=scenario, recordings=recordings, changed=changed),
        fmus=fmus,
        engine=engine,
        unwired=tuple(unwired),
        notes=tuple(notes),
    )


def _deadlines(run: Recording) -> dict[str, Any]:
    return {} if run.deadlines is None else {"deadlines": run.deadlines.as_json()}


def _facts(archive: Archive) -> dict[str, str]:
    description = archive.description
    texts = {}
    if getattr(archive.variables.get("git_hash"), "type", "") == "String":
        with Instance(archive, "git_hash") as instance:
            texts["git_hash"] = instance.text("git_hash")
    return {
        "guid": str(description.guid),
        "version": str(description.version or ""),
        "generation_tool": str(description.generationTool or ""),
        "sha256": hashlib.sha256(archive.path.read_bytes()).hexdigest(),
        **texts,
    }


def _required(
    required: Sequence[Requirements] | None,
    *,
    scenario: Scenario,
    recordings: Mapping[str, Recording],
    changed: Mapping[str, tuple[str, ...]],
) -> tuple[Result, ...]:
    every = (requirements.built_in(),) if required is None else required
    found: dict[str, Result] = {}
    for one in every:
        for result in requirements.results(one, scenario=scenario.id, recordings=recordings, changed=changed):
            if result.id in found:
                raise ScenarioError(f"{result.id} is twice in the requirements; expected another id in your file")
            found[result.id] = result
    return tuple(found.values())


def evaluate(
    *,
    scenario: Scenario,
    recordings: Mapping[str, Recording],
    plans: Mapping[str, Plan],
    changed: Mapping[str, tuple[str, ...]],
) -> tuple[Result, ...]:
    """All metrics of all cases, then the ratios. `changed`: what the command line has changed of each case."""
    results: dict[str, Result] = {}
    for metric in scenario.metrics:
        for case in metric.cases or tuple(recordings):
            # A run of another length or step may lack what a metric looks at.
            narrowed = bool({"duration", "step"} & set(changed[case]))
            undefined = narrowed and bool(preflight.empty_window(metric, plans[case]))
            value = math.nan
            try:
                if not undefined:
                    value = metrics.evaluate(
                        recording=recordings[case],
                        function=metric.function,
                        arguments=metric.arguments,
                        owner=f"{scenario.id}: metric {metric.id}: case {case}",
                    )
            except ScenarioError:
                if not narrowed:
                    raise
                undefined = True
            name = f"{metric.id}/{case}"
            results[name] = judge(
                metric=name,
                title=metric.title,
                value=value,
                unit=metric.unit,
                check=metric.expected.get(case, metric.check),
                source=metric.source,
                paper=lookup(metric.paper[case]) if case in metric.paper else None,
                void_by=changed[case] if undefined else settings.void(metric.rests_on, changed[case]),
            )
    for ratio in scenario.ratios:
        upper, lower = (results[name].value for name in ratio.of)
        names = tuple(dict.fromkeys(one for name in ratio.of for one in changed[name.split("/", 1)[1]]))
        undefined = bool({"duration", "step"} & set(names)) and not (math.isfinite(upper) and math.isfinite(lower))
        results[ratio.id] = judge(
            metric=ratio.id,
            title=ratio.title,
            value=upper / lower if lower else math.nan,
            unit="1",
            check=ratio.check,
            source=ratio.source,
            paper=lookup(ratio.paper) if ratio.paper else None,
            void_by=names if undefined else settings.void(ratio.rests_on, names),
        )
    beside = [beside_the_paper(result) for result in results.values() if result.paper and result.paper.is_fair]
    return (*results.values(), *beside)
