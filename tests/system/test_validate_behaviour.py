"""`exo validate --load`: dynamic rules on good FMUs, and what cannot be judged. Broken ones: test_validate.py."""

import json
from pathlib import Path

import pytest
from typer.testing import CliRunner

from exo.cli import app
from exo.validate import behaviour, binaries, check, child
from exo.validate.rule import RULES

from broken.moving import MOVING2, MOVING3
from broken.mutants3 import typed
from broken.parts import COMPILED, Parts, moving2, moving3, plain

ALL = [trial.rule.id for trial in behaviour.TRIALS]
ONLY_3 = {trial.rule.id for trial in behaviour.TRIALS if trial.rule.only == "3.0"}


@pytest.fixture(autouse=True)
def unparsed(monkeypatch: pytest.MonkeyPatch) -> None:
    """Leaves the libraries' files alone, which takes most of the time."""
    monkeypatch.setattr(binaries, "findings", lambda *_, **__: iter(()))


def only(monkeypatch: pytest.MonkeyPatch, *rules: str) -> None:
    """Runs these trials only."""
    monkeypatch.setattr(behaviour, "TRIALS", [trial for trial in behaviour.TRIALS if trial.rule.id in rules])


def verdicts(parts: Parts, folder: Path) -> dict[str, str]:
    """Verdicts, with reasons where there are any, by rule."""
    report = check(parts.write(folder), dynamic=True)
    return {one.rule: f"{one.verdict}: {one.reason}" if one.reason else one.verdict for one in report.verdicts}


def test_the_project_s_fmus_keep_their_word(fmu: Path) -> None:
    report = check(fmu, dynamic=True)
    assert report.findings == (), report
    assert [one.rule for one in report.verdicts] == [rule for rule in ALL if rule not in ONLY_3]
    passed = {one.rule for one in report.verdicts if one.verdict == "passed"}
    skipped = {one.rule for one in report.verdicts if one.verdict == "skipped"}
    assert passed | skipped == set(ALL) - ONLY_3
    assert skipped == set(), report


@pytest.mark.parametrize("name", [MOVING2, MOVING3])
def test_a_good_fmu_passes_every_dynamic_rule(name: str, tmp_path: Path) -> None:
    assert verdicts(COMPILED[name](tmp_path), tmp_path) == dict.fromkeys(
        [rule for rule in ALL if name == MOVING3 or rule not in ONLY_3], "passed"
    )


def scheduled(folder: Path, *macros: str) -> Parts:
    """The FMU that moves, for scheduled execution."""
    parts = moving3(folder, "-DSCHEDULED", *macros)
    parts.edit(
        "CoSimulation",
        tag="ScheduledExecution",
        remove=(
            "canHandleVariableCommunicationStepSize",
            "fixedInternalStepSize",
            "hasEventMode",
            "providesIntermediateUpdate",
            "canReturnEarlyAfterIntermediateUpdate",
        ),
    )
    return parts


def test_scheduled_execution_runs_by_its_clock(tmp_path: Path) -> None:
    none = "skipped: scheduled execution has no communication steps"
    without = ("run-step-size", "run-stop-time", "run-event-mode", "run-early-return")
    assert verdicts(scheduled(tmp_path), tmp_path) == {rule: none if rule in without else "passed" for rule in ALL}


def test_clocked_outputs_are_compared_in_scheduled_execution(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    only(monkeypatch, "run-reset")
    parts = scheduled(tmp_path, "-DRESET_KEEPS_X")
    parts.edit(typed("x"), clocks="11", variability="discrete")
    parts.edit(typed("steps"), clocks="11")
    assert verdicts(parts, tmp_path)["run-reset"].startswith("failed: x is [")


def test_without_outputs_there_is_nothing_to_compare(tmp_path: Path) -> None:
    parts = moving2(tmp_path)
    for name in ("x", "steps"):
        parts.edit(f"ModelVariables/ScalarVariable[@name='{name}']", causality="local")
    found = verdicts(parts, tmp_path)
    assert found["run-reset"] == "skipped: it has no output that could be compared"
    assert found["run-stop-time"] == "passed"


def test_a_capability_that_is_not_there_is_skipped_with_its_name(tmp_path: Path) -> None:
    parts = plain(tmp_path)
    parts.edit("CoSimulation", canBeInstantiatedOnlyOncePerProcess="true")
    found = verdicts(parts, tmp_path)
    assert found["run-state"] == "skipped: canGetAndSetFMUstate is false"
    assert found["run-serialized"] == "skipped: canSerializeFMUstate is false"
    assert found["run-instances"] == "skipped: canBeInstantiatedOnlyOncePerProcess is true"
    assert found["run-log-set"] == "skipped: it declares no log category"
    assert found["run-repeat"] == "passed"


def test_a_step_size_may_be_refused_where_it_must_not_change(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    only(monkeypatch, "run-step-size")
    parts = moving2(tmp_path, "-DSTEP_FIXED")
    parts.edit("CoSimulation", canHandleVariableCommunicationStepSize="false")
    assert verdicts(parts, tmp_path) == {"run-step-size": "passed"}


def test_an_fmu_that_never_repeats_itself_is_not_compared(tmp_path: Path) -> None:
    found = verdicts(moving2(tmp_path, "-DUNREPEATABLE"), tmp_path)
    assert found["run-repeat"].startswith("failed")
    assert found["run-reset"] == "skipped: equal runs differ: see run-repeat"
    assert found["run-ending"] == "passed"


def test_a_library_that_crashes_at_once_is_not_tried_again(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    asked: list[str] = []
    run = child.run
    monkeypatch.setattr(child, "run", lambda task: asked.append(task["task"]) or run(task))
    found = verdicts(plain(tmp_path, "-DCRASH"), tmp_path)
    assert set(found.values()) == {"skipped: a plain run fails already: see load-…"}
    assert asked == ["load"]


def test_nan_that_hangs_a_step_is_found(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(child, "TIMEOUT_S", 10.0)
    only(monkeypatch, "run-not-finite")
    found = verdicts(moving2(tmp_path, "-DNAN_HANGS"), tmp_path)
    assert found == {"run-not-finite": "failed: fmi2DoStep: no answer within 10 s"}


def test_inputs_stay_within_their_bounds_in_every_trial(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """An input that cannot move stays at its start value: here every trial runs, and nothing moves."""
    only(monkeypatch, "run-repeat")
    tasks: list[dict[str, object]] = []
    run = child.run
    monkeypatch.setattr(child, "run", lambda task: tasks.append(task) or run(task))
    parts = moving3(tmp_path)
    parts.edit(typed("u"), min="0", max="0")
    assert verdicts(parts, tmp_path) == {"run-repeat": "passed"}
    ((_, kind, reference, count, name, starts, low, high, scale),) = tasks[-1]["inputs"]  # type: ignore[misc]
    assert (kind, reference, count, name, starts) == ("Float64", 0, 2, "u", [0.0, 0.0])
    assert (low, high, scale) == (0.0, 0.0, 1.0)


def test_the_command_tells_a_verdict_for_each_rule(tmp_path: Path) -> None:
    path = moving2(tmp_path, "-DSTOP_IGNORED").write(tmp_path)
    told = CliRunner().invoke(app, ["validate", "--load", "--json", str(path)])
    assert told.exit_code == 1
    (report,) = json.loads(told.output)
    by_rule = {verdict["rule"]: verdict for verdict in report["verdicts"]}
    assert set(by_rule) == set(ALL) - ONLY_3
    assert by_rule["run-state"] == {"rule": "run-state", "verdict": "passed", "reason": ""}
    assert by_rule["run-stop-time"]["verdict"] == "failed"
    assert by_rule["run-stop-time"]["reason"] == report["findings"][0]["value"]
    assert RULES["run-stop-time"].severity == report["findings"][0]["severity"]
    silent = CliRunner().invoke(app, ["validate", str(path)])
    assert (silent.exit_code, "run-stop-time" in silent.output) == (0, False)
