"""What the command line changes: which verdicts still hold, what is printed, and which part of a scenario runs."""

import json
import re
import subprocess
import sys
from pathlib import Path
from typing import Any

import jsonschema
import pytest

from exo import __version__, overrides, preflight, results, scenario, selection
from exo.master import plan

from commands import SHORT, exo

#: An invariant beside the figure that rests on all parameters, and one that rests on the torque's limit.
MORE = """
[[metrics]]
id = "balance"
title = "the plant's balance closes"
unit = "J"
function = "max_abs"
arguments = { column = "plant.energy.residual" }
check = { at_most = 1e-9 }
source = "here"
rests_on = []
[[metrics]]
id = "limit"
title = "torque"
unit = "N"
function = "max_abs"
arguments = { column = "controller.tau_a" }
check = { at_most = 12.5 }
source = "here"
rests_on = ["controller.tau_max", "controller.f*"]
[[metrics]]
id = "seen"
title = "information"
unit = "m"
function = "mean"
arguments = { column = "plant.q" }
source = "here"
[[ratios]]
id = "one"
title = "one"
of = ["moved/push", "moved/push"]
check = { value = 1.0, within = 0.0 }
source = "here"
[[figures]]"""


@pytest.fixture
def run(tmp_path: Path, fmu_dir: Path) -> Any:
    """Runs a scenario's text; the verdicts by metric, and the answer."""
    path = tmp_path / "short.toml"

    def run(*more: object, text: str = SHORT.replace("[[figures]]", MORE, 1)) -> Any:
        path.write_text(text, encoding="utf-8")
        answer = exo("run", path, "--fmu-dir", fmu_dir, "--out", tmp_path / "out", *more)
        document = json.loads((tmp_path / "out" / "short" / "metrics.json").read_text(encoding="utf-8"))
        jsonschema.Draft202012Validator(results.schema()).validate(document)
        return {name.split("/")[0]: entry for name, entry in document["metrics"].items()}, answer

    return run


def verdicts(found: dict[str, Any]) -> dict[str, str]:
    return {name: entry["verdict"] for name, entry in found.items()}


def test_an_override_makes_information_of_what_rests_on_it_and_of_nothing_else(run: Any) -> None:
    plain, _ = run()
    assert verdicts(plain) == {"moved": "pass", "balance": "pass", "limit": "pass", "seen": "info", "one": "pass"}
    assert "void_by" not in plain["moved"]
    # 3 N move nothing: the figure is not what is expected, and nobody expects it.
    found, answer = run("--set", "plant.F_c=25")
    assert answer.exit_code == 0
    assert verdicts(found) == {"moved": "info", "balance": "pass", "limit": "pass", "seen": "info", "one": "info"}
    assert found["moved"]["void_by"] == ["plant.F_c"]
    assert found["moved"]["expected"] == 0.1
    assert re.search(r"info +moved/push +0 +m +\(≥ 0\.1\) +–\n", answer.output)
    assert "expectations in brackets hold without plant.F_c" in answer.output
    found, _ = run("--set", "controller.tau_max=20")
    assert verdicts(found)["limit"] == "info"


def test_an_invariant_that_an_override_breaks_is_a_failed_verdict(run: Any) -> None:
    text = SHORT.replace("[[figures]]", MORE, 1).replace("at_most = 1e-9", "at_most = -1.0")
    found, answer = run("--set", "controller.K=20", text=text)
    assert (verdicts(found)["balance"], answer.exit_code) == ("fail", 1)


@pytest.mark.parametrize("setting", ["controller.K=30", "controller.K=3e1", "plant.wall.q=1e9", "controller.law=4"])
def test_an_override_that_changes_nothing_makes_nothing_information(setting: str, run: Any) -> None:
    found, _ = run("--set", setting)
    assert verdicts(found)["moved"] == "pass"


def test_what_an_expectation_rests_on_is_a_name_or_a_pattern() -> None:
    names = ("controller.K[1]", "controller.law", "plant.M", "step")
    assert overrides.void(None, names) == names
    assert overrides.void((), names) == ()
    assert overrides.void(("controller.K", "plant.*"), names) == ("controller.K[1]", "plant.M")


def test_the_example_of_the_readme_ends_green_and_says_which_numbers_are_new(tmp_path: Path, fmu_dir: Path) -> None:
    answer = exo(
        "run", "wall", "--set", "controller.K=20", "--case", "*_5_0.5", "--out", tmp_path, "--fmu-dir", fmu_dir
    )
    assert answer.exit_code == 0, answer.output
    document = json.loads((tmp_path / "wall" / "metrics.json").read_text(encoding="utf-8"))
    by_id = {name: entry["verdict"] for name, entry in document["metrics"].items()}
    assert set(document["run"]["cases"]) == {f"{law}_5_0.5" for law in (
        "standard", "passive", "passive_applied", "passive_bounded"
    )}  # fmt: skip
    assert by_id["release_delay/standard_5_0.5"] == "info"
    assert by_id["tank/passive_bounded_5_0.5"] == "pass"
    assert by_id["energy_residual/passive_5_0.5"] == "pass"
    assert by_id["spring_force/passive_bounded_5_0.5"] == "pass"
    # Of the three figures the one that draws only these cases.
    assert {path.name for path in (tmp_path / "wall").glob("*.png")} == {"release.png"}


def test_the_numbers_and_the_pictures_are_printed(run: Any, tmp_path: Path) -> None:
    _, answer = run()
    assert re.search(r"info +seen/push +\S+ +m +– +–\n", answer.output)
    assert "moved/push" not in answer.output
    assert f"results: {tmp_path / 'out' / 'short'}: q.png" in answer.output
    found, answer = run("--all")
    moved = found["moved"]
    assert re.search(rf"pass +moved/push +{moved['value']:.6g} +m +≥ 0\.1 +{moved['value'] - 0.1:.6g}\n", answer.output)
    assert "not wired, at their start values: controller.engage" in answer.output


def test_a_shorter_run_leaves_what_it_does_not_reach_undefined(run: Any) -> None:
    text = SHORT.replace("[[figures]]", MORE, 1).replace('"plant.q" }', '"plant.q", after = 0.5 }', 1)
    found, answer = run("--duration", "0.4", text=text)
    assert answer.exit_code == 0
    assert found["moved"]["value"] is None
    assert found["moved"]["void_by"] == ["duration"]
    assert verdicts(found)["balance"] == "pass"
    assert re.search(r"info +moved/push +undefined", answer.output)


@pytest.mark.parametrize("name", [name for name in scenario.built_in() if "arm" not in name] + ["arm_delay"])
def test_the_beginning_of_a_scenario_can_be_run_alone(name: str, tmp_path: Path, fmu_dir: Path) -> None:
    answer = exo("run", name, "--duration", "0.12", "--fmu-dir", fmu_dir, "--out", tmp_path)
    assert answer.exit_code == 0, answer.output + answer.stderr


def test_another_step_is_taken_with_its_sample_period(run: Any, tmp_path: Path) -> None:
    found, _ = run("--step", "0.001", "--set", "controller.T=0.001")
    document = json.loads((tmp_path / "out" / "short" / "metrics.json").read_text(encoding="utf-8"))
    assert document["run"]["cases"]["push"]["step_s"] == 0.001
    assert document["run"]["overrides"] == {"controller.T": 0.001, "step": 0.001}
    assert verdicts(found)["moved"] == "info"


def test_a_part_of_a_scenario_has_the_numbers_of_the_whole() -> None:
    whole = scenario.load("wall")
    part = selection.narrowed(whole, cases=["passive_5_5", "standard_*"])
    assert [case.id for case in part.cases] == [
        "standard_0.1_0.5", "standard_5_0.5", "standard_5_5", "standard_10_0.5", "passive_5_5",
    ]  # fmt: skip
    assert next(metric for metric in part.metrics if metric.id == "mean_error").cases == ("passive_5_5",)
    assert "tank" not in [metric.id for metric in part.metrics]
    assert selection.narrowed(whole) == whole


def test_patterns_are_written_out_and_each_scenario_runs_once() -> None:
    assert selection.named(["arm_bi*", "arm_bo?h", "wall", "arm_bias"]) == ["arm_bias", "arm_both", "wall"]


def test_the_version_and_the_list_are_for_programs_too() -> None:
    assert exo("--version").stdout == f"exo {__version__}\n"
    rows = json.loads(exo("list", "--json").stdout)
    assert [row["id"] for row in rows] == list(scenario.built_in())
    wall = next(row for row in rows if row["id"] == "wall")
    assert (len(wall["cases"]), wall["duration_s"], wall["step_s"]) == (16, 60.0, 0.002)


def test_a_pipe_that_is_closed_early_is_no_error() -> None:
    command = [sys.executable, "-m", "exo", "schema"]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    process.stdout.close()
    assert process.stderr.read() == b""
    process.stderr.close()
    assert process.wait() == 141


def test_inputs_that_nothing_feeds_are_known_as_arrays() -> None:
    class Inputs:
        """An archive as far as its inputs go."""

        def names(self, _: str) -> list[str]:
            return ["q[1]", "q[2]", "f", "engage"]

    data = scenario.parse(text=SHORT, origin="short.toml")
    plans = {"push": plan(scenario=data, case=data.cases[0], overrides={"controller.engage": True})}
    archives: Any = {"TestbedController.fmu": Inputs(), "Testbed.fmu": Inputs()}
    assert preflight.unwired(plans, archives) == ["controller.q", "controller.f", "plant.q", "plant.f", "plant.engage"]
