"""Requirements in temporal logic: what a file may say, what a margin is, and where it is told."""

import json
import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from exo import experiment
from exo import scenario as scenarios
from exo.errors import ScenarioError
from exo.fmu import find_fmu_dir
from exo.recording import Recording
from exo.requirements import PREFIX, built_in, formula, load, trace
from exo.requirements.document import Requirements, Signal
from exo.requirements.judged import results
from exo.selection import narrowed

from commands import SHORT, exo

STEP = 0.01


def recorded(**columns: np.ndarray) -> Recording:
    length = len(next(iter(columns.values())))
    return Recording(
        time=np.arange(length) * STEP,
        columns={name.replace("__", "."): values for name, values in columns.items()},
        units={},
        parameters={"plant.limit": 2.0},
        choices={},
        profiles={},
        wall_time=1.0,
        cpu_time=1.0,
    )


def one(*, text: str = "always(x <= 1)", at: float = 0.0, **signals: object) -> Requirements:
    shown: dict[str, object] = {"title": "t", "scenario": "mine", "formula": text, "at": at, "unit": "m"}
    shown["signals"] = signals or {"x": "plant.x"}
    return Requirements.model_validate({"requirements": {"r": {"text": "r", "source": "here", "shown": {"s": shown}}}})


def margin(requirements: Requirements, run: Recording, *, changed: tuple[str, ...] = ()) -> float:
    (result,) = results(requirements, scenario="mine", recordings={"a": run}, changed={"a": changed})
    return result.value


def test_the_margin_is_the_least_distance_from_breaking():
    x = np.array([0.0, 0.4, 0.75, 0.3])
    assert margin(one(), recorded(plant__x=x)) == pytest.approx(0.25)
    assert margin(one(), recorded(plant__x=2 * x)) == pytest.approx(-0.5)


def test_a_formula_looks_at_what_comes_after_its_time_only():
    x = np.concatenate([np.full(50, 5.0), np.full(50, 0.5)])
    assert margin(one(at=0.5), recorded(plant__x=x)) == pytest.approx(0.5)
    assert margin(one(), recorded(plant__x=x)) == pytest.approx(-4.0)


@pytest.mark.parametrize("late", [0, 1, 29, 30, 31, 60])
def test_eventually_is_the_best_within_its_bounds_by_hand(late: int):
    x = np.zeros(100)
    x[late] = 3.0
    best = max(x[:31]) - 1.0
    found = margin(one(text="eventually[0:0.3](x >= 1)"), recorded(plant__x=x))
    assert found == pytest.approx(best)


@pytest.mark.parametrize("signal", ["plant.x", {"norm": ["plant.x", "plant.x"]}, {"largest": "plant.x"}])
def test_a_margin_in_another_unit_than_its_signals_is_refused(signal: object):
    run = replace(recorded(plant__x=np.zeros(5), plant__n=np.zeros(5)), units={"plant.x": "mm"})
    with pytest.raises(
        ScenarioError, match=r"requirement r\.s: case a: unit: got m, and x is in mm; expected one unit"
    ):
        margin(one(x=signal), run)
    assert margin(one(text="always(1000 * x <= 1)", x=signal), run) == pytest.approx(1.0)
    assert margin(one(x="plant.n"), run) == pytest.approx(1.0), "what has no unit is not compared"


def test_a_number_that_is_not_finite_breaks_a_requirement():
    x = np.array([0.0, math.nan, 0.0])
    (result,) = results(one(), scenario="mine", recordings={"a": recorded(plant__x=x)}, changed={"a": ()})
    assert result.verdict == "fail"
    assert math.isnan(result.value)


def test_what_the_command_line_changes_makes_it_information():
    (result,) = results(
        one(), scenario="mine", recordings={"a": recorded(plant__x=np.array([5.0, 5.0]))}, changed={"a": ("plant.M",)}
    )
    assert (result.verdict, result.void_by) == ("info", ("plant.M",))


def test_signals_are_what_their_names_say():
    rng = np.random.default_rng(1)
    f, v, g, w = rng.normal(size=(4, 200))
    run = recorded(**{"a__f[1]": f, "a__f[2]": g, "a__v[1]": v, "a__v[2]": w})
    both, along = ["a.f[1..2]"], ["a.v[1..2]"]

    def signal(**data: object) -> np.ndarray:
        return trace.signal(Signal.model_validate(data), run)

    assert signal(norm=both) == pytest.approx(np.hypot(f, g))
    assert signal(moved=both) == pytest.approx(np.hypot(f - f[0], g - g[0]))
    assert signal(largest=both) == pytest.approx(np.maximum(abs(f), abs(g)))
    assert signal(largest="a.f[1]", over="plant.limit") == pytest.approx(abs(f) / 2.0)
    assert signal(parameter="plant.limit") == pytest.approx(np.full(200, 2.0))
    power = f[:-1] * (v[1:] + v[:-1]) / 2 + g[:-1] * (w[1:] + w[:-1]) / 2
    assert signal(work=both, along=along)[-1] == pytest.approx(power.sum() * STEP)


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"text": "always(x <="}, "temporal logic"),
        ({"text": "always[1:0.5](x <= 1)"}, r"window \[1:0\.5\]: expected bounds of 0 or more that increase"),
        ({"text": "always[-1:0.5](x <= 1)"}, r"window \[-1:0\.5\]: expected bounds of 0 or more"),
        ({"text": "always[1ms:5](x <= 1)"}, r"window \[1ms:5\]: expected a unit behind the second bound, too"),
        ({"text": "always(x/y <= 1)", "y": "plant.y"}, "x/y would be one name; expected spaces around /"),
        ({"text": "always(y <= 1)"}, "no signal y"),
        ({"x": "plant.x", "z": "plant.z"}, "signal z"),
        ({"x": {"norm": "a.b", "column": "a.b"}}, "column and norm"),
        ({"x": {"work": ["a.f", "a.g"], "along": ["a.v"]}}, "expected as many"),
        ({"x": {"work": "a.f"}}, "needs along"),
        ({"x": {"nrom": "a.b"}}, "nrom"),
    ],
)
def test_a_wrong_requirement_is_refused_by_name(change: dict[str, object], said: str):
    with pytest.raises(ValueError, match=said):
        one(**change)  # type: ignore[arg-type]


@pytest.mark.parametrize("text", ["always[0:0.04](x <= 1)", "eventually[40ms:40ms](x >= -1)", "always(next(x <= 1))"])
def test_a_window_may_end_with_the_last_sample(text: str):
    assert margin(one(text=text), recorded(plant__x=np.zeros(5))) == pytest.approx(1.0)


def test_a_step_that_is_no_whole_number_of_nanoseconds_has_windows_of_whole_samples():
    x = np.zeros(2049)
    x[513] = 5.0
    for text, expected in (("always[0:0.5](x <= 1)", 1.0), ("always[0:0.501953125](x <= 1)", -4.0)):
        assert formula.robustness(text, {"x": x}, step=1 / 1024) == pytest.approx(expected)


@pytest.mark.parametrize(
    ("requirement", "said"),
    [
        (one(x="plant.y"), "no recorded column plant.y"),
        (one(x={"parameter": "plant.q"}), "no parameter plant.q"),
        (one(at=7.0), "within the run"),
        (one(at=0.005), "multiple of the step"),
        (one(text="always[0:0.0005](x <= 1)"), "window [0:0.0005]: expected multiples of the step, 0.01 s"),
        (one(text="always[0:0.05](x <= 1)"), "looks 0.05 s ahead and the run ends after 0.04 s"),
        (one(text="always[0.06:0.07](x <= 1)"), "looks 0.07 s ahead and the run ends after 0.04 s"),
        (one(text="eventually[0:0.05](x >= 0)"), "looks 0.05 s ahead"),
        (one(text="always[0:0.03](eventually[0:0.02](x >= 0))"), "looks 0.05 s ahead"),
        (one(text="always((x >= 1) implies always[0:50ms](x <= 1))"), "looks 0.05 s ahead"),
        (one(text="always[0:0.03](x <= 1)", at=0.02), "looks 0.03 s ahead and the run ends after 0.02 s"),
        (one(at=0.04), "one sample is left; expected two or more"),
    ],
)
def test_what_a_run_lacks_is_named_with_requirement_and_case(requirement: Requirements, said: str):
    with pytest.raises(ScenarioError, match=r"requirement r\.s: case a") as error:
        margin(requirement, recorded(plant__x=np.zeros(5)))
    assert said in str(error.value)


def test_a_file_that_is_wrong_says_where(tmp_path: Path):
    path = tmp_path / "requirements.toml"
    for text, said in (
        ("[requirements", "end of a table"),
        ("", "toml: requirements: missing; expected a value"),
        ("[requirements]", "toml: requirements: got none; expected at least 1"),
        ("[requirements.r]\ntext=1979-05-27", r"requirements\.r\.text: got datetime.date\(1979, 5, 27\); expected"),
        ("[requirements.r]\ntext='t'\nsorce='s'", r"requirements\.r\.sorce: unknown key, .* \(close matches: source"),
        ("a = 1979-05-27", "a"),
    ):
        path.write_text(text, encoding="utf-8")
        with pytest.raises(ScenarioError, match=said):
            load(path)
    with pytest.raises(ScenarioError, match="cannot be read: No such file or directory; expected"):
        load(tmp_path / "none.toml")


def test_every_requirement_of_the_paper_and_of_the_project_finds_its_cases():
    known = scenarios.built_in()
    for name, requirement in built_in().requirements.items():
        for key, shown in requirement.shown.items():
            assert shown.scenario in known, (name, key)
            scenario = scenarios.load(shown.scenario)
            _, ahead = formula._parsed(shown.formula, shown.signals, step=scenario.step)
            assert shown.at + ahead * scenario.step < scenario.duration, (name, key)
            cases = tuple(case.id for case in scenario.cases)
            for pattern in shown.cases:
                assert any(shown.model_copy(update={"cases": (pattern,)}).meant(cases)), (name, key, pattern)
    assert [name for name, one in built_in().requirements.items() if one.of == "paper"] == [
        "operator", "environment", "model",
    ]  # fmt: skip


def test_the_laws_that_stick_to_the_wall_break_the_requirement_that_the_bounded_law_meets():
    requirement = built_in().requirements["environment"].shown["wall"]
    every = requirement.model_copy(update={"cases": ("*_5_0.5",), "scenario": "wall"})
    data = built_in().model_copy(
        update={
            "requirements": {
                "environment": built_in().requirements["environment"].model_copy(update={"shown": {"wall": every}})
            }
        }
    )
    run = experiment.run(scenario=narrowed(scenarios.load("wall"), cases=["*_5_0.5"]), fmu_dir=find_fmu_dir(None))
    found = results(data, scenario="wall", recordings=run.recordings, changed=dict.fromkeys(run.recordings, ()))
    verdicts = {result.id.split("/")[1]: result.verdict for result in found}
    assert verdicts["passive_bounded_5_0.5"] == "pass"
    assert verdicts["standard_5_0.5"] == verdicts["passive_applied_5_0.5"] == "fail"


def test_margins_stand_beside_the_metrics_of_a_run(tmp_path: Path):
    done = exo("run", "gain_study", "--out", tmp_path, "--all", "--signals", "none")
    assert done.exit_code == 0, done.output
    assert f"{PREFIX}model.testbed/K30" in done.output
    metrics = json.loads((tmp_path / "gain_study/metrics.json").read_text(encoding="utf-8"))["metrics"]
    shown = metrics[f"{PREFIX}model.testbed/K30"]
    assert (shown["verdict"], shown["unit"], shown["kind"]) == ("pass", "m", "at_least")
    # K |e_nr|: the metric of the same run says it.
    assert shown["value"] == pytest.approx(0.17 - 30.0 * metrics["max_error/K30"]["value"], abs=1e-12)
    assert f"{PREFIX}model.testbed/K30" in (tmp_path / "junit.xml").read_text(encoding="utf-8")


def test_the_words_of_the_language_are_no_signals():
    assert formula.names("always((rise(a >= 1) and abs(b) <= 2e-3) implies eventually[0:0.5s](c >= d))") == set("abcd")


def test_a_file_of_ones_own_is_judged_beside_and_the_command_shows_the_margins(tmp_path: Path):
    (tmp_path / "short.toml").write_text(SHORT, encoding="utf-8")
    own = tmp_path / "mine.toml"
    text = """
[requirements.reach]
text = "The mass gets far."
source = "here"
[requirements.reach.shown.end]
title = "position"
scenario = "short"
formula = "eventually(q >= 100)"
unit = "m"
signals.q = "plant.q"
"""
    own.write_text(text, encoding="utf-8")
    out = tmp_path / "results"
    out.mkdir()
    assert exo("requirements", own, "--results", out).exit_code == 0
    assert "not run" in exo("requirements", own, "--results", out).output
    done = exo("run", tmp_path / "short.toml", "--requirements", own, "--out", out)
    assert done.exit_code == 1, done.output
    assert f"{PREFIX}reach.end/push" in done.output
    shown = exo("requirements", own, "--results", out)
    assert shown.exit_code == 1
    assert "fail" in shown.output
    (row,) = json.loads(exo("requirements", own, "--results", out, "--json").output)
    assert (row["id"], row["verdict"], row["case"]) == ("reach.end", "fail", "push")
    assert row["margin"] < 0.0
    own.write_text(text.replace("reach", "drift").replace("end]", "drifting]"), encoding="utf-8")
    assert exo("run", tmp_path / "short.toml", "--requirements", own, "--out", out).exit_code == 1
    refused = exo("run", "wall", "--requirements", tmp_path / "none.toml", "--out", out)
    assert (refused.exit_code, "cannot be read" in refused.output) == (2, True)


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ('scenario = "shirt"', "requirement reach.end: scenario: unknown scenario shirt"),
        ('scenario = "short"\ncases = ["pish*"]', "requirement reach.end: cases: short has no case pish*"),
        ('scenario = "wall"', "has no requirement of short; its scenarios are wall"),
    ],
)
def test_a_requirement_that_would_never_be_judged_is_refused(change: str, said: str, tmp_path: Path):
    (tmp_path / "short.toml").write_text(SHORT, encoding="utf-8")
    own = tmp_path / "mine.toml"
    text = """
[requirements.reach]
text = "The mass gets far."
source = "here"
[requirements.reach.shown.end]
title = "position"
scenario = "short"
formula = "always(q <= 100)"
unit = "m"
signals.q = "plant.q"
"""
    own.write_text(text.replace('scenario = "short"', change), encoding="utf-8")
    done = exo("run", tmp_path / "short.toml", "--requirements", own, "--out", tmp_path / "results")
    assert (done.exit_code, said in done.stderr) == (2, True), done.output
    assert not (tmp_path / "results").exists()
    own.write_text(text, encoding="utf-8")
    assert exo("run", tmp_path / "short.toml", "--requirements", own, "--out", tmp_path / "results").exit_code == 0
    assert "pass" in exo("requirements", own, "--results", tmp_path / "results").output
    # A margin of another formula is not this one's.
    own.write_text(text.replace("q <= 100", "q <= 0"), encoding="utf-8")
    shown = exo("requirements", own, "--results", tmp_path / "results")
    assert (shown.exit_code, "not run" in shown.output) == (0, True)


def test_two_files_that_judge_the_same_are_refused():
    data = one()
    scenario = scenarios.load("wall").model_copy(update={"id": "mine"})
    with pytest.raises(ScenarioError, match="twice"):
        experiment._required(
            (data, data), scenario=scenario, recordings={"a": recorded(plant__x=np.zeros(5))}, changed={"a": ()}
        )


def test_a_folder_of_results_that_is_not_there_is_refused(tmp_path: Path):
    answer = exo("requirements", "--results", tmp_path / "reslts")
    assert answer.exit_code == 2
    assert f"--results {tmp_path / 'reslts'}: no such folder" in answer.output
