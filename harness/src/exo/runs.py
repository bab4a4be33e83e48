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
from contextlib import ExitStack, suppress
from dataclasses import dataclass, replace
from math import ceil, floor, isclose, isfinite
from pathlib import Path
from types import TracebackType
from typing import Any, Self

import numpy as np
import pyarrow as pa
from pydantic import ValidationError

from exo import derived, preflight, selection, trial
from exo import loop as loops
from exo import metrics as measures
from exo import scenario as scenarios
from exo.coupled import Coupled, NotKeptError, Saved
from exo.errors import ExoError, FmuError, ScenarioError, close_matches
from exo.fmu import Archive, find_fmu_dir
from exo.loop import Engine
from exo.naming import elements
from exo.plan import Plan, plan
from exo.recording import Recording
from exo.scenario import PROFILE, Case, Scenario, Segment, Value

#: Keys of a row that are no FMU's.
TIMES = ("duration", "step")
#: Column of a result table: why a row has no numbers; null where it has.
FAILURE = "failure"

Row = Mapping[str, Value]


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


def rows_of(parameters: Mapping[str, Sequence[Value]] | pa.Table) -> list[dict[str, Value]]:
    """A table by columns as rows. ScenarioError, if the columns are not of one length, or hold what no row can set."""
    if isinstance(parameters, pa.Table) and len(set(parameters.column_names)) < parameters.num_columns:
        raise ScenarioError(f"parameters: expected each column once, got {', '.join(parameters.column_names)}")
    given = parameters.to_pydict() if isinstance(parameters, pa.Table) else dict(parameters)
    columns = {key: _column(key, values) for key, values in given.items()}
    lengths = {key: len(values) for key, values in columns.items()}
    if len(set(lengths.values())) > 1:
        told = ", ".join(f"{key} has {length}" for key, length in lengths.items())
        raise ScenarioError(f"parameters: expected columns of one length, {told}")
    return [dict(zip(columns, values, strict=True)) for values in zip(*columns.values(), strict=True)]


def _column(key: object, values: Any) -> list[Value]:
    if not isinstance(key, str) or isinstance(values, str | bytes) or not isinstance(values, Iterable):
        raise ScenarioError(f"parameters: {key}: expected a name and a list of values, got {str(values)[:40]}")
    # What NumPy holds is made what TOML and Python have.
    plain = [value.item() if isinstance(value, np.generic) else value for value in values]
    if wrong := unlike(plain):
        raise ScenarioError(f"{key}: {wrong}")
    return plain


def unlike(values: Sequence[object]) -> str:
    """What keeps these values out of one column of a table, as a sentence; else empty."""
    kinds = {_kind(value): value for value in values}
    for kind, value in kinds.items():
        if not kind:
            return f"expected a number of 64 bits, a text, or true or false, got {str(value)[:40]}"
    told = ", ".join(f"the {kind} {str(value)[:40]}" for kind, value in kinds.items())
    return "" if len(kinds) < 2 else f"expected values of one kind, got {told}"


def _kind(value: object) -> str:
    match value:
        case bool():
            return "Boolean"
        case int() if abs(value) < 1 << 63:
            return "number"
        case float():
            return "number"
        case str():
            return "text"
    return ""


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
        self._runs: dict[str, _Runs] = {}
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
                runs = _Runs(plans[case.id], self._archives, self._branch_at, self.engine)
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
                self._key(key, self._runs[case.id].plan)
        for row in {tuple(row): row for row in rows}.values():
            _each_once(row)

    def run(self, row: Row) -> Outcome:
        """Runs all cases with what the row sets."""
        try:
            recordings: dict[str, _Look] = {}
            for case in self.scenario.cases:
                recordings[case.id] = self._runs[case.id].look(self._values(row, case))
            return Outcome(self._numbers(recordings))
        except ExoError as error:
            return Outcome({}, " ".join(str(error).split()))
        except MemoryError:
            return Outcome({}, "out of memory; expected a shorter duration or a longer step")

    def _shown(self, name: str) -> str:
        return name.split("/", 1)[0] if len(self.scenario.cases) == 1 else name

    def _numbers(self, recordings: "dict[str, _Look]") -> dict[str, float]:
        found: dict[str, float] = {}
        for metric in self.scenario.metrics:
            for case in metric.cases or tuple(recordings):
                found[f"{metric.id}/{case}"] = recordings[case].measure(
                    lambda run, metric=metric, case=case: measures.call(
                        recording=run,
                        function=metric.function,
                        arguments=metric.arguments,
                        owner=f"{self.scenario.id}: metric {metric.id}: case {case}",
                    ),
                    self.scenario.derived,
                )
        for ratio in self.scenario.ratios:
            upper, lower = (found[name] for name in ratio.of)
            found[ratio.id] = upper / lower if lower else float("nan")
        return {self._shown(name): value for name, value in found.items()}

    def _key(self, key: str, of: Plan) -> None:
        if key in TIMES:
            if self._branch_at is not None:
                raise ScenarioError(f"{key}: a row that branches off at {self._branch_at:g} s cannot set it")
            return
        component, _, name = key.partition(".")
        if component == PROFILE:
            if self._branch_at is not None:
                raise ScenarioError(f"{key}: a row that branches off at {self._branch_at:g} s cannot set it")
            _segment(of, key)
            return
        if component not in of.components or not name:
            known = close_matches(component, of.components)
            raise ScenarioError(f"{key}: expected <component>.<parameter>, got component {component!r}{known}")
        archive = self._archives[of.components[component]]
        for element in _elements(key, name):
            variable = archive.variable(element)
            if f"{component}.{element}" in of.inputs:
                raise ScenarioError(
                    f"{key}: is wired to {of.inputs[f'{component}.{element}']}; expected an input without"
                )
            if variable.causality not in ("parameter", "input"):
                raise FmuError(f"{key}: only parameters and inputs can be set, this is {variable.causality}")
            free = variable.causality == "input" or variable.variability == "tunable"
            if self._branch_at is not None and not free:
                raise FmuError(
                    f"{key}: is fixed; after {self._branch_at:g} s only tunable parameters and inputs are set"
                )

    def _values(self, row: Row, case: Case) -> Plan:
        """The case's plan with what the row sets."""
        own = self._runs[case.id].plan
        parameters, profiles = dict(own.parameters), dict(own.profiles)
        times: dict[str, float] = {}
        for key, value in row.items():
            component, _, name = key.partition(".")
            if key in TIMES:
                times[key] = _time(key, value)
            elif component == PROFILE:
                profile, number, field, segment = _segment(replace(own, profiles=profiles), key)
                changed = _changed(segment, field, value, key)
                profiles[profile] = (*profiles[profile][: number - 1], changed, *profiles[profile][number:])
            else:
                parameters.update({f"{component}.{element}": value for element in _elements(key, name)})
        made = replace(
            own,
            parameters=parameters,
            profiles=profiles,
            duration=times.get("duration", own.duration),
            step=times.get("step", own.step),
        )
        if times:
            try:
                scenarios.check_duration("row", duration=made.duration, step=made.step)
            except ValueError as error:
                raise ScenarioError(str(error)) from error
        return made


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


def _elements(key: str, name: str) -> list[str]:
    try:
        return elements(name)
    except ValueError as error:
        raise ScenarioError(f"{key}: {error}") from error


def _each_once(row: Row) -> None:
    """ScenarioError, if two keys of a row set the same element."""
    owner: dict[str, str] = {}
    for key in row:
        component, _, name = key.partition(".")
        elements_of = [] if key in TIMES or component == PROFILE else _elements(key, name)
        for element in elements_of:
            other = owner.setdefault(f"{component}.{element}", key)
            if other != key:
                raise ScenarioError(f"{key}: sets {component}.{element}, and so does {other}; expected one of them")


def _time(key: str, value: Value) -> float:
    if isinstance(value, bool | str) or not 0.0 < value < float("inf"):
        raise ScenarioError(f"{key} = {value}: expected a time above 0 s")
    return float(value)


def _segment(of: Plan, key: str) -> tuple[str, int, str, Segment]:
    """Profile, number of the term, its field and the term of `profile.<name>.<number>.<field>`."""
    match key.split("."):
        case [_, name, number, field] if number.isdigit() and len(number) < 4:
            if name not in of.profiles:
                raise ScenarioError(f"{key}: no profile {name}{close_matches(name, of.profiles)}")
            segments = of.profiles[name]
            if not 1 <= int(number) <= len(segments):
                raise ScenarioError(f"{key}: profile {name} has {len(segments)} terms; expected 1 to {len(segments)}")
            known = [one for one in Segment.model_fields if one not in ("kind", "points")]
            if field not in known:
                raise ScenarioError(f"{key}: a term has no number {field}{close_matches(field, known)}")
            return name, int(number), field, segments[int(number) - 1]
    raise ScenarioError(f"{key}: expected profile.<name>.<number of its term>.<field>, as profile.tau_h.1.amplitude")


def _changed(segment: Segment, field: str, value: Value, key: str) -> Segment:
    try:
        return Segment.model_validate({**segment.model_dump(), field: value})
    except ValidationError as error:
        problem = error.errors(include_url=False)[0]
        said = str(problem["ctx"]["error"]) if problem["type"] == "value_error" else problem["msg"]
        raise ScenarioError(f"{key} = {value}: {said}") from error


class _Look:
    """A run that can be looked at: where a metric wants a column that was not kept, it is run again with that one."""

    def __init__(self, runs: "_Runs", of: Plan) -> None:
        self._runs = runs
        self._plan = of

    def measure(self, metric: Any, signals: Iterable[str]) -> float:
        """The metric of the recording with its derived signals."""
        while True:
            try:
                return float(metric(derived.added(self._runs.recording(self._plan), signals)))
            except NotKeptError as missing:
                self._runs.keep(missing.name)


class _Runs:
    """The instances of one case, and what is kept of a run."""

    def __init__(self, of: Plan, archives: Mapping[str, Archive], branch_at: float | None, engine: Engine) -> None:
        self.plan = of
        self._archives = archives
        self._branch = None if branch_at is None else _ticks(branch_at, of)
        self._engine = engine
        self._kept: dict[str, None] = {}
        self._coupled: Coupled | None = None
        self._saved: Saved | None = None
        self._ran: Plan | None = None
        self._recording: Recording | None = None

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._close()

    def _close(self) -> None:
        if self._coupled is not None:
            coupled, self._coupled = self._coupled, None
            try:
                # An instance that has failed may refuse; what is left goes with it.
                if self._saved is not None:
                    with suppress(FmuError):
                        coupled.free(self._saved)
            finally:
                self._saved = None
                coupled.__exit__(None, None, None)
        self._ran = self._recording = None

    def keep(self, name: str) -> None:
        """From now on records this column, too."""
        self._kept[name] = None
        self._close()

    def look(self, of: Plan) -> _Look:
        """A run with this plan, made now."""
        self._run(of)
        return _Look(self, of)

    def recording(self, of: Plan) -> Recording:
        """The recording of the run with this plan, made again where what is kept has changed."""
        if self._ran is not of or self._recording is None:
            self._run(of)
        assert self._recording is not None
        return self._recording

    def _run(self, of: Plan) -> None:
        self._ran = None
        try:
            if self._coupled is None:
                self._coupled = Coupled(self.plan, self._archives, kept=self._kept).__enter__()
            if self._branch is None:
                self._coupled.start(of)
            else:
                self._branched(self._coupled, self._branch, of)
            self._coupled.advance(engine=self._engine)
            self._recording = self._coupled.recording(lazily=True)
            self._ran = of
        except BaseException:
            # Instances that have failed, or that stand in the middle of a run, are not used again.
            self._close()
            raise

    def _branched(self, coupled: Coupled, ticks: int, of: Plan) -> None:
        """The common part, run once; then what this row sets."""
        if self._saved is None:
            coupled.start(self.plan)
            coupled.advance(until=ticks, engine=self._engine)
            self._saved = coupled.save()
        else:
            coupled.restore(self._saved)
        own = self.plan.parameters
        for key, value in of.parameters.items():
            if key not in own or own[key] != value:
                coupled.set(key, value)


def _ticks(at: float, of: Plan) -> int:
    exact = at / of.step if isfinite(at) else 0.0
    ticks = round(exact)
    if not 0 < ticks < of.steps:
        raise ScenarioError(f"branch_at = {at:g} s: expected a time within the run, {of.step:g} to {of.duration:g} s")
    if not isclose(exact, ticks, rel_tol=1e-9):
        below, above = (f"{n * of.step:.12g}" for n in (floor(exact), ceil(exact)))
        raise ScenarioError(
            f"branch_at = {at:.12g} s: expected a multiple of the step {of.step:.12g} s, as {below} or {above} s"
        )
    return ticks
