"""Replays the references of any FMU, and says by how much each output differs."""

from collections.abc import Mapping
from contextlib import ExitStack
from pathlib import Path, PurePosixPath
from typing import Any

import fmpy
import numpy as np
from numpy.typing import NDArray

from exo.errors import FmuError
from exo.references import experiments, manifest, parameters, series
from exo.references.experiments import TRANSIENT, Experiment, File
from exo.references.names import EXPERIMENTS_TYPE, FOLDER, MANIFEST, OLD_EXPERIMENTS_TYPE, SSV_TYPE
from exo.references.outcome import Outcome, Replay, judge, sampled
from exo.references.variables import REALS, size, starts
from exo.validate import child
from exo.validate import references as rules
from exo.validate.archive import Contents, open_archive
from exo.validate.load import host_platforms, missing
from exo.validate.rule import Finding
from exo.validate.workspace import workspace

PLAYER = "exo.references.player"
#: Where neither experiment nor description say how long it is and in what steps (s).
STOP, STEPS = 1.0, 1000
#: The name of what no experiments file has named.
DEFAULT = "(default)"
#: More steps than any smoke test needs; an importer would wait for an hour.
MAX_STEPS = 10_000_000
UNREADABLE = "references: the description cannot be read"


def replay(path: Path, *, run: bool = True) -> Replay:
    """Reads the references of an FMU and, with `run`, plays its experiments, each in a process of its own.

    Nothing happens where there are none. What is wrong is a finding, also with the archive; FmuError where it cannot be
    extracted, or where there are references and its description cannot be read.
    """
    with ExitStack() as stack:
        contents, found = open_archive(path, stack)
        if contents is None:
            return Replay(found)
        answer = look(contents, path, run=run)
    if UNREADABLE in answer.skipped:
        raise FmuError(f"{path}: modelDescription.xml: cannot be read; `exo validate` says what is wrong with it")
    return answer


def look(contents: Contents, path: Path, *, run: bool) -> Replay:
    """The same on an archive that is open already; `path` is its file."""
    answer = Replay()
    where = f"{FOLDER}/{MANIFEST}"
    if where not in contents.files:
        return answer
    try:
        description = fmpy.read_model_description(str(path), validate=False)
    except Exception:  # fmpy raises what its parts raise; what is wrong the validator says
        answer.skipped.append(UNREADABLE)
        return answer
    with ExitStack() as stack:
        _Reader(contents, description, answer).read(where, stack if run else None)
    return answer


class _Reader:
    """One archive while it is looked at."""

    def __init__(self, contents: Contents, description: Any, answer: Replay) -> None:
        self.contents, self.description, self.answer = contents, description, answer
        self.variables: Mapping[str, Any] = {one.name: one for one in description.modelVariables}
        #: Files are judged once, however many experiments name them.
        self.sets: dict[str, parameters.Values] = {}
        self.series: dict[str, series.Series | None] = {}

    def read(self, where: str, stack: ExitStack | None) -> None:
        related, found = manifest.read(self.contents.read(where), where)
        self.answer.findings += found
        played: list[Experiment] = []
        lone: list[manifest.Related] = []
        for one in related:
            if one.path is None:
                self.answer.skipped.append(f"references: {one.source} lies outside of the archive")
            elif one.path not in self.contents.files:
                self.answer.findings.append(rules.RELATED.at(one.where, one.source, "a file of the archive"))
            elif one.main_role == "experiment":
                played += self._experiments(one)
            elif one.main_role == "parameter" and one.type == SSV_TYPE:
                self._parameters(one.path)
            elif one.main_role == "result" and manifest.is_csv(one.type):
                lone.append(one)
        compared = {one.references.path for one in played if one.references is not None}
        played += [_default(one) for one in lone if one.path not in compared and self._is_readable(one)]
        tasks = [(one, task) for one in played if (task := self._task(one)) is not None]
        if stack is not None and tasks and self._runs():
            folder = stack.enter_context(workspace())
            self.contents.extract(folder)
            if not (folder / "resources").exists():  # it may be a file
                (folder / "resources").mkdir()
            for experiment, task in tasks:
                self._play(experiment, task | {"folder": str(folder)})

    def _experiments(self, one: manifest.Related) -> list[Experiment]:
        assert one.path is not None
        if one.type not in (EXPERIMENTS_TYPE, OLD_EXPERIMENTS_TYPE) and not one.path.endswith(".exp"):
            self.answer.skipped.append(f"references: {one.source} has the unknown type {one.type}")
            return []
        read, found = experiments.read(self.contents.read(one.path), one.path)
        self.answer.findings += found
        return read

    def _parameters(self, path: str) -> parameters.Values:
        if path not in self.sets:
            self.sets[path], found = parameters.read(self.contents.read(path), path, self.variables)
            self.answer.findings += found
        return self.sets[path]

    def _series(self, path: str) -> series.Series | None:
        if path not in self.series:
            self.series[path], found = series.read(self.contents.read(path), path, self.variables)
            self.answer.findings += found
        return self.series[path]

    def _is_readable(self, one: manifest.Related) -> bool:
        """Whether a result that no experiment names is one of this FMU's variables over time; it may be anything."""
        assert one.path is not None
        read, found = series.read(self.contents.read(one.path), one.path, self.variables)
        if read is None or found:
            self.answer.skipped.append(f"references: {one.source} is not replayed: {found[0].where}: {found[0].value}")
            return False
        self.series[one.path] = read
        return True

    def _has(self, file: File | None, kinds: bool, one: Experiment) -> bool:
        """Whether a file is there and of a type that can be read; says so where it is not."""
        if file is None:
            return False
        if file.path is None or not kinds:
            what = "lies outside of the archive" if file.path is None else f"has the type {file.type}"
            self.answer.skipped.append(f"experiment {one.name}: {file.source} {what}")
            return False
        if file.path not in self.contents.files:
            self.answer.findings.append(rules.MISSING.at(file.where, file.source, "a file of the archive"))
            return False
        return True

    def _task(self, one: Experiment) -> dict[str, Any] | None:
        """What the player needs; None where the experiment cannot or need not be played."""
        files = {
            "parameters": self._has(one.parameters, bool(one.parameters and one.parameters.type == SSV_TYPE), one),
            "stimuli": self._has(one.stimuli, bool(one.stimuli and manifest.is_csv(one.stimuli.type)), one),
            "references": self._has(one.references, bool(one.references and manifest.is_csv(one.references.type)), one),
        }
        values = self._parameters(_path(one.parameters)) if files["parameters"] else {}
        stimuli = self._series(_path(one.stimuli)) if files["stimuli"] else None
        results = self._series(_path(one.references)) if files["references"] else None
        needed = (("parameters", one.parameters, values), ("stimuli", one.stimuli, stimuli))
        if any(file is not None and (not files[name] or read is None) for name, file, read in needed):
            return None  # with other parameters or inputs the results would say nothing
        if one.references is not None and results is None:
            return None
        if one.kind != TRANSIENT:
            self.answer.skipped.append(f"experiment {one.name}: {one.kind} is no simulation")
            return None
        times = self._times(one)
        if times is None or (stimuli is not None and not self._fits(one, stimuli)):
            return None
        start, stop, step = times
        if results is not None and not self._within(one, results, start, stop):
            return None
        return {
            "start": start,
            "stop": stop,
            "step": step,
            "tolerance": one.tolerance,
            "values": values,
            "time": [] if stimuli is None else stimuli.time.tolist(),
            "stimuli": [] if stimuli is None else _inputs(stimuli),
            "outputs": [] if results is None else list(dict.fromkeys(c.place.variable.name for c in results.columns)),
        }

    def _times(self, one: Experiment) -> tuple[float, float, float] | None:
        default = self.description.defaultExperiment

        def stated(own: float | None, name: str, other: float) -> float:
            told = getattr(default, name, None)
            return own if own is not None else float(told) if told is not None else other

        start = stated(one.start, "startTime", 0.0)
        stop = stated(one.stop, "stopTime", start + STOP)
        step = stated(one.step, "stepSize", (stop - start) / STEPS)
        if not stop > start or not step > 0.0 or (stop - start) / step > MAX_STEPS:
            value = f"from {start:g} s to {stop:g} s in steps of {step:g} s"
            self.answer.findings.append(rules.EXPERIMENT.at(one.where, value, f"at most {MAX_STEPS} steps forward"))
            return None
        return start, stop, step

    def _fits(self, one: Experiment, stimuli: series.Series) -> bool:
        assert one.stimuli is not None
        wrong = [
            column
            for column in stimuli.columns
            if column.place.variable.causality != "input" and column.place.variable.variability != "tunable"
        ]
        for column in wrong:
            variable = column.place.variable
            self.answer.findings.append(
                rules.VARIABLE.at(
                    f"{one.stimuli.path}: column {column.name}",
                    f"a {variable.variability} {variable.causality}",
                    "an input or a tunable parameter",
                )
            )
        return not wrong

    def _within(self, one: Experiment, results: series.Series, start: float, stop: float) -> bool:
        first, last = float(results.time[0]), float(results.time[-1])
        slack = 1e-9 * max(1.0, abs(start), abs(stop))
        if first < start - slack or last > stop + slack:
            value = f"results from {first:g} s to {last:g} s"
            expected = f"times within the experiment, {start:g} s to {stop:g} s"
            self.answer.findings.append(rules.SERIES.at(_path(one.references), value, expected))
            return False
        return True

    def _runs(self) -> bool:
        if self.description.coSimulation is None:
            self.answer.skipped.append("experiments of the references: the FMU has no co-simulation")
            return False
        if not any(
            name.startswith(tuple(f"binaries/{one}/" for one in host_platforms())) for name in self.contents.files
        ):
            self.answer.skipped.append(f"experiments of the references: no library for {' or '.join(host_platforms())}")
            return False
        return True

    def _play(self, one: Experiment, task: dict[str, Any]) -> None:
        answer = child.run(task, program=PLAYER)
        played, failed = answer.facts("played"), answer.facts("failed")
        if failed and (lacking := missing(failed[0])):
            self.answer.skipped.append(f"experiment {one.name}: the library needs {lacking}, which this machine lacks")
        elif failed or not played:
            reason = failed[0] if failed else answer.ended
            if one.name == DEFAULT:
                self.answer.skipped.append(f"references: the default experiment is not replayed: {reason}")
                return
            self.answer.findings.append(rules.RUN.at(one.where, f"{one.name}: {reason}", "a run to its end"))
        elif one.references is not None:
            self._compare(one, played[0])

    def _compare(self, one: Experiment, played: dict[str, Any]) -> None:
        results = self.series[_path(one.references)]
        assert results is not None
        time = np.array(played["time"])
        for left_out in results.left_out:
            self.answer.skipped.append(f"experiment {one.name}: {left_out} is no number")
        for column in results.columns:
            variable = column.place.variable
            got = np.array(played["columns"][variable.name])
            if column.place.element is not None:
                got = got[:, [column.place.element]]
            continuous = variable.type in REALS and variable.variability == "continuous"
            there = sampled(time, got, results.time, continuous=continuous)
            outcome = judge(one, column, results.time, there)
            self.answer.outcomes.append(outcome)
            if not outcome.good and one.name != DEFAULT:
                self.answer.findings.append(broken(one, outcome))


def _default(one: manifest.Related) -> Experiment:
    """A result that no experiment names, as that of the default experiment, which Reference-FMUs means by it.

    The standard does not say so: a difference is told, and is no finding.
    """
    file = File(one.type, one.path, one.source, one.where)
    return Experiment(DEFAULT, TRANSIENT, None, None, None, None, None, None, file, one.where)


def broken(one: Experiment, outcome: Outcome) -> Finding:
    """The finding that an output differs by too much."""
    rule = rules.UNSTATED if one.tolerance is None else rules.RESULT
    value = f"{one.name}: {outcome.output} differs by {outcome.difference:.4g} {outcome.unit} at {outcome.at:g} s"
    expected = f"at most {outcome.allowed:.4g} {outcome.unit}".rstrip()
    return rule.at(f"{_path(one.references)}: column {outcome.output}", value, expected)


def _path(file: File | None) -> str:
    assert file is not None
    assert file.path is not None
    return str(PurePosixPath(file.path))


def _inputs(stimuli: series.Series) -> list[dict[str, Any]]:
    """Columns by variable: where a file has single elements of a vector, the others keep their start values."""
    values: dict[str, NDArray[np.float64]] = {}
    variables = {column.place.variable.name: column.place.variable for column in stimuli.columns}
    for column in stimuli.columns:
        variable = column.place.variable
        if column.place.element is None:
            values[variable.name] = column.values
        else:
            whole = np.tile(np.array(starts(variable), dtype=np.float64), (len(stimuli.time), 1))
            values.setdefault(variable.name, whole)[:, column.place.element] = column.values[:, 0]
    return [
        {
            "name": name,
            "reference": variables[name].valueReference,
            "kind": variables[name].type,
            "held": variables[name].variability != "continuous",
            "vector": size(variables[name]) > 1 or bool(variables[name].shape),
            "values": rows.tolist(),
        }
        for name, rows in values.items()
    ]
