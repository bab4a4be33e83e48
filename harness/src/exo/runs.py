"""Many runs of a scenario: a table of parameters in, a table of metrics out.

    import exo
    table = exo.batch("wall", {"controller.K": [5.0, 10.0, 20.0]}, cases=["passive_bounded_5_0.5"])

The instances of a case stay from run to run and are reset. The first run shows which outputs the metrics look at; the
others record no more than these. What a row sets is

| key | what |
|---|---|
| `controller.K`, `controller.Lambda_n[1..3]` | a parameter or an input that no wire feeds, of an FMU |
| `duration`, `step` | of all cases, s |
| `profile.tau_h.1.amplitude` | a number of a profile's first term |

With `branch_at` the rows have their first seconds in common: they run once, the FMUs' states are kept, and each row
goes on from there. A row then sets what may be set during a run: tunable parameters and unwired inputs. `branch_at` is
a multiple of the step.
"""

from collections.abc import Iterable, Mapping, Sequence
from contextlib import ExitStack
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from types import TracebackType
from typing import Any, Self

import pyarrow as pa

from exo import loop as loops
from exo import metrics as measures
from exo import preflight, selection, trial
from exo import scenario as scenarios
from exo.errors import ExoError, ScenarioError, close_matches
from exo.fmu import Archive, find_fmu_dir
from exo.loop import Engine
from exo.plan import plan
from exo.repeated import Look, Repeated
from exo.rows import Row, check_each_once, check_key, planned, rows_of
from exo.scenario import Scenario, Value

#: Column of a result table: why a row has no numbers; null where it has.
FAILURE = "failure"


def batch(
    scenario: Scenario | str,
    parameters: Mapping[str, Sequence[Value]] | pa.Table,
    *,
    cases: Iterable[str] = (),
    metrics: Iterable[str] = (),
    branch_at: float | None = None,
    engine: Engine | None = None,
    fmu_dir: Path | None = None,
) -> pa.Table:
    """Runs the scenario once for each row; returns the rows with a column for each metric and `failure`.

    `scenario` is one, an id or a file; `cases` are ids or patterns, all cases without them; `metrics` are ids of
    metrics and ratios, all without them. `branch_at` (s) as above. `engine` is native where it is installed. A row that
    fails is a row with its reason in `failure`, and NaN for numbers.
    ScenarioError and FmuError name what is wrong with all rows: a key, a scenario, an archive.
    """
    rows = rows_of(parameters)
    with Batch(scenario, cases=cases, metrics=metrics, branch_at=branch_at, engine=engine, fmu_dir=fmu_dir) as runs:
        runs.check(rows)
        return table(rows, [runs.run(row) for row in rows], runs.names)


@dataclass(frozen=True)
class Outcome:
    """What a row has come to: its numbers, or why there are none."""

    numbers: Mapping[str, float]
    error: str | None = None


def table(rows: Sequence[Row], outcomes: Sequence[Outcome], names: Sequence[str]) -> pa.Table:
    """Rows and outcomes side by side."""
    keys = list(dict.fromkeys(key for row in rows for key in row))
    columns: dict[str, Any] = {key: pa.array([row.get(key) for row in rows]) for key in keys}
    for name in names:
        columns[name] = pa.array([one.numbers.get(name, float("nan")) for one in outcomes], pa.float64())
    columns[FAILURE] = pa.array([one.error for one in outcomes], pa.string())
    return pa.table(columns)


class Batch:
    """A scenario that is run again and again; use with `with`."""

    def __init__(
        self,
        scenario: Scenario | str,
        *,
        cases: Iterable[str] = (),
        metrics: Iterable[str] = (),
        branch_at: float | None = None,
        engine: Engine | None = None,
        fmu_dir: Path | None = None,
    ) -> None:
        """As `batch`. ScenarioError or FmuError, if something is wrong that no row could mend."""
        loaded = scenarios.load(scenario) if isinstance(scenario, str) else scenario
        self.scenario = _measured(selection.narrowed(loaded, cases=cases), tuple(metrics))
        self.engine: Engine = loops.named(engine) if engine else loops.fastest()
        self._branch_at = branch_at
        self._folder = find_fmu_dir(fmu_dir)
        self._stack = ExitStack()
        self._archives: dict[str, Archive] = {}
        self._runs: dict[str, Repeated] = {}
        preflight.functions(self.scenario)
        #: Names of the numbers: `metric/case` and ratios; where one case is run, metrics by themselves.
        self.names = [self._shown(name) for name in _names(self.scenario)]

    def __enter__(self) -> Self:
        with ExitStack() as stack:
            names = {part.archive for part in self.scenario.components.values()}
            self._archives = {name: stack.enter_context(Archive(self._folder / name)) for name in sorted(names)}
            for archive in self._archives.values():
                trial.check(archive)
            plans = {case.id: plan(scenario=self.scenario, case=case) for case in self.scenario.cases}
            preflight.check(scenario=self.scenario, plans=plans, archives=self._archives)
            for case in self.scenario.cases:
                runs = Repeated(plans[case.id], self._archives, self._branch_at, self.engine)
                self._runs[case.id] = stack.enter_context(runs)
            self._stack = stack.pop_all()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._stack.__exit__(kind, error, trace)

    def check(self, rows: Sequence[Row]) -> None:
        """ScenarioError or FmuError for a key that no row can have; values are judged row by row."""
        for key in dict.fromkeys(key for row in rows for key in row):
            for case in self.scenario.cases:
                check_key(key, self._runs[case.id].plan, self._archives, branch_at=self._branch_at)
        for row in {tuple(row): row for row in rows}.values():
            check_each_once(row)

    def run(self, row: Row) -> Outcome:
        """Runs all cases with what the row sets."""
        try:
            recordings: dict[str, Look] = {}
            for case in self.scenario.cases:
                runs = self._runs[case.id]
                recordings[case.id] = runs.look(planned(row, runs.plan), self.scenario.derived)
            return Outcome(self._numbers(recordings))
        except ExoError as error:
            return Outcome({}, " ".join(str(error).split()))
        except MemoryError:
            return Outcome({}, "out of memory; expected a shorter duration or a longer step")

    def _shown(self, name: str) -> str:
        return name.split("/", 1)[0] if len(self.scenario.cases) == 1 else name

    def _numbers(self, recordings: Mapping[str, Look]) -> dict[str, float]:
        found: dict[str, float] = {}
        for metric in self.scenario.metrics:
            for case in metric.cases or tuple(recordings):
                found[f"{metric.id}/{case}"] = recordings[case].measure(
                    partial(
                        measures.call,
                        function=metric.function,
                        arguments=metric.arguments,
                        owner=f"{self.scenario.id}: metric {metric.id}: case {case}",
                    )
                )
        for ratio in self.scenario.ratios:
            upper, lower = (found[name] for name in ratio.of)
            found[ratio.id] = upper / lower if lower else float("nan")
        return {self._shown(name): value for name, value in found.items()}


def _measured(scenario: Scenario, ids: tuple[str, ...]) -> Scenario:
    """The scenario with these metrics and ratios alone; and the metrics that the ratios are of."""
    if not ids:
        return scenario
    known = [metric.id for metric in scenario.metrics] + [ratio.id for ratio in scenario.ratios]
    for name in ids:
        if name not in known:
            raise ScenarioError(f"{scenario.id}: no metric {name}{close_matches(name, known)}")
    ratios = tuple(ratio for ratio in scenario.ratios if ratio.id in ids)
    needed = {*ids, *(name.split("/", 1)[0] for ratio in ratios for name in ratio.of)}
    metrics = tuple(metric for metric in scenario.metrics if metric.id in needed)
    return scenario.model_copy(update={"metrics": metrics, "ratios": ratios})


def _names(scenario: Scenario) -> list[str]:
    ids = [case.id for case in scenario.cases]
    of_cases = [f"{metric.id}/{case}" for metric in scenario.metrics for case in metric.cases or ids]
    return of_cases + [ratio.id for ratio in scenario.ratios]
