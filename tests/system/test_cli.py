"""The command: exit codes, messages, and what it leaves on disk."""

import json
import os
import re
import shlex
import shutil
import signal
import subprocess
import sys
from pathlib import Path
from xml.etree import ElementTree as ET

import numpy as np
import pyarrow as pa
import pytest
from typer.testing import Result

from exo import recording, results
from exo.scenario import built_in

from commands import SHORT, exo


@pytest.fixture
def short(tmp_path: Path) -> Path:
    path = tmp_path / "short.toml"
    path.write_text(SHORT, encoding="utf-8")
    return path


def run(short: Path, out: Path, fmu_dir: Path, *more: str) -> Result:
    return exo("run", short, "--out", out, "--fmu-dir", fmu_dir, *more)


def test_list_names_every_scenario() -> None:
    answer = exo("list")
    assert answer.exit_code == 0
    assert all(name in answer.output for name in built_in())


def test_a_passing_run_exits_zero_and_leaves_everything(short: Path, tmp_path: Path, fmu_dir: Path) -> None:
    answer = run(short, tmp_path / "out", fmu_dir)
    assert answer.exit_code == 0, answer.output
    folder = tmp_path / "out" / "short"
    document = json.loads((folder / "metrics.json").read_text(encoding="utf-8"))
    assert document["metrics"]["moved/push"]["verdict"] == "pass"
    facts = document["run"]["fmus"]["Testbed.fmu"]
    assert facts["guid"]
    case = document["run"]["cases"]["push"]
    assert case["coupling"] == "zero_delay"
    assert case["parameters_set"] == {"plant.wall.q": 1e9}
    assert case["parameters"]["controller.K"] == 30.0
    assert case["real_time_factor"] > 1.0
    columns = recording.read(folder / "signals" / "push.parquet")
    assert len(columns["time"]) == 500
    assert {"controller.tau_a", "plant.q", "plant.energy.residual", "controller.tick"} <= set(columns)
    assert not list(folder.rglob("*.csv"))
    assert (folder / "q.png").is_file()
    assert ET.parse(tmp_path / "out" / "junit.xml").find("testsuite/testcase").get("name") == "moved/push"


def test_csv_is_written_on_request_and_holds_every_bit(short: Path, tmp_path: Path, fmu_dir: Path) -> None:
    folder = tmp_path / "short"
    assert run(short, tmp_path, fmu_dir, "--csv").exit_code == 0
    for name in ("signals/push", "figures/q"):
        columns, table = (recording.read(folder / f"{name}.{kind}") for kind in ("parquet", "csv"))
        assert list(columns) == list(table)
        assert all((columns[name] == table[name]).all() for name in columns)
    # A run without them leaves none of an earlier one.
    assert run(short, tmp_path, fmu_dir).exit_code == 0
    assert not list(folder.rglob("*.csv"))
    assert len(list(folder.rglob("*.parquet"))) == 2


def test_signals_are_written_of_the_scenarios_that_are_named(short: Path, tmp_path: Path, fmu_dir: Path) -> None:
    other = tmp_path / "other.toml"
    other.write_text(short.read_text(encoding="utf-8").replace('id = "short"', 'id = "other"'), encoding="utf-8")
    for choice, kept in (
        ("all", {"short", "other"}),
        ("other", {"other"}),
        ("none", set()),
        ("short,other", {"short", "other"}),
    ):
        assert run(short, tmp_path, fmu_dir, other, "--signals", choice).exit_code == 0
        assert {path.parents[1].name for path in tmp_path.glob("*/signals/push.parquet")} == kept
        assert (tmp_path / "short" / "metrics.json").is_file()
    refused = run(short, tmp_path, fmu_dir, "--signals", "shrt")
    assert refused.exit_code == 2
    assert "--signals shrt: expected all, none or scenarios that run, got 'shrt'" in refused.stderr
    assert "short" in refused.stderr.split("got")[1]


def test_a_failed_verdict_exits_one_and_stands_in_the_junit_file(short: Path, tmp_path: Path, fmu_dir: Path) -> None:
    # Forty times the friction: 3 N move nothing.
    short.write_text(SHORT.replace('"wall.q" = 1e9', '"wall.q" = 1e9\nF_c = 25.0'), encoding="utf-8")
    answer = run(short, tmp_path, fmu_dir)
    assert answer.exit_code == 1
    assert re.search(r"fail +moved/push +0 +m +≥ 0\.1 +-0\.1\n", answer.output)
    assert "moved expected by: here" in answer.output
    suite = ET.parse(tmp_path / "junit.xml").find("testsuite")
    assert suite.get("failures") == "1"
    assert "expected ≥ 0.1" in suite.find("testcase/failure").get("message")
    document = json.loads((tmp_path / "short" / "metrics.json").read_text(encoding="utf-8"))
    assert document["verdict"] == "fail"


def test_set_takes_enumeration_items_by_name(short: Path, tmp_path: Path, fmu_dir: Path) -> None:
    run(short, tmp_path, fmu_dir, "--set", "controller.law=standard")
    document = json.loads((tmp_path / "short" / "metrics.json").read_text(encoding="utf-8"))
    assert document["run"]["cases"]["push"]["parameters"]["controller.law"] == 1


@pytest.mark.parametrize(
    ("setting", "message"),
    [
        ("controller.KP=3", "TestbedController.fmu: no variable KP (close matches: K_P"),
        ("contoller.K=3", "--set contoller.K: expected <component>.<parameter>, got component 'contoller'"),
        ("K=3", "--set K: expected <component>.<parameter>"),
        ("controller.K", "--set controller.K: expected <component>.<parameter>=<value>"),
        ("controller.K=fast", "TestbedController.fmu: K: expected Real that is finite, got 'fast'"),
        ("controller.engage=3", "TestbedController.fmu: engage: expected Boolean, got '3'"),
        ("controller.law=pasive", "TestbedController.fmu: law: no item pasive (close matches: passive"),
        ("controller.tau_a=3", "TestbedController.fmu: tau_a: only parameters and inputs can be set, this is output"),
    ],
)
def test_a_wrong_setting_exits_two_and_says_why(
    setting: str, message: str, short: Path, tmp_path: Path, fmu_dir: Path
) -> None:
    answer = run(short, tmp_path, fmu_dir, "--set", setting)
    assert answer.exit_code == 2
    assert message in answer.stderr


def test_a_parameter_that_the_fmu_refuses_is_reported_with_the_fmu_s_own_words(
    short: Path, tmp_path: Path, fmu_dir: Path
) -> None:
    answer = run(short, tmp_path, fmu_dir, "--set", "controller.law=natural", "--set", "controller.form=position_servo")
    assert answer.exit_code == 2
    assert "controller: fmi2" in answer.stderr
    assert "natural" in answer.stderr


@pytest.mark.parametrize("engine", ["fmpy", "native"])
def test_a_run_that_fails_names_scenario_case_component_and_time(
    engine: str, short: Path, tmp_path: Path, fmu_dir: Path
) -> None:
    broken = '[[cases]]\nid = "torn"\nparameters = { "plant.tau_d" = 1e300 }\n'
    short.write_text(SHORT.replace("[[metrics]]", broken + "[[metrics]]"), encoding="utf-8")
    answer = run(short, tmp_path, fmu_dir, "--engine", engine)
    assert answer.exit_code == 2
    said = " ".join(answer.stderr.split())
    assert said.startswith("exo: short: case torn: plant: fmi2DoStep returned fmi2Error: ")
    assert "tau_d = 1e300 N" in said
    assert said.endswith("(step at t = 0 s)")


def test_a_run_in_which_nothing_is_judged_is_no_pass(short: Path, tmp_path: Path, fmu_dir: Path) -> None:
    for more, why in (
        (("--set", "controller.K=20"), "expectations in brackets hold without controller.K"),
        ((), "no metric has an expectation, and no requirement is of this scenario"),
    ):
        if not more:
            short.write_text(SHORT.replace("check = { at_least = 0.1 }\n", ""), encoding="utf-8")
        answer = run(short, tmp_path, fmu_dir, *more)
        assert answer.exit_code == 0
        assert answer.output.startswith("info short: nothing judged, 1 info; 1 s simulated")
        assert why in answer.output
        assert json.loads((tmp_path / "short" / "metrics.json").read_text(encoding="utf-8"))["verdict"] == "info"


def test_a_run_ends_with_the_command_that_makes_a_page_of_it(
    short: Path, tmp_path: Path, fmu_dir: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The very command that is printed, also for a folder whose name a shell would take apart."""
    monkeypatch.chdir(tmp_path)
    for out in (Path("results"), Path("my results")):
        last = run(short, out, fmu_dir).output.strip().splitlines()[-1]
        command, page = re.fullmatch(r"`exo (.*)` makes a page of the results: (.*)", last).groups()
        assert exo(*shlex.split(command)).exit_code == 0
        assert Path(page) == out / "report.html"
        assert Path(page).is_file()


def test_an_unknown_scenario_exits_two(tmp_path: Path, fmu_dir: Path) -> None:
    answer = run(Path("wal"), tmp_path, fmu_dir)
    assert answer.exit_code == 2
    assert "exo: unknown scenario wal (close matches: wall" in answer.stderr


def test_a_missing_fmu_is_one_sentence_that_names_the_command(short: Path, tmp_path: Path) -> None:
    answer = run(short, tmp_path, tmp_path)
    assert answer.exit_code == 2
    assert len(answer.stderr.strip().splitlines()) == 1
    assert "no such FMU: run `cargo xtask fmu` first" in answer.stderr


def test_without_any_fmu_folder_the_command_is_named(
    short: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.delenv("EXO_FMU_DIR", raising=False)
    answer = exo("run", short)
    assert answer.exit_code == 2
    assert "run `cargo xtask fmu` first, or set EXO_FMU_DIR" in answer.stderr


def test_two_runs_give_the_same_numbers_and_compare_says_so(short: Path, tmp_path: Path, fmu_dir: Path) -> None:
    for name in ("a", "b"):
        run(short, tmp_path / name, fmu_dir)
    tables = [recording.read(tmp_path / name / "short" / "signals" / "push.parquet") for name in ("a", "b")]
    assert all(tables[0][name].tobytes() == tables[1][name].tobytes() for name in tables[0])
    answer = exo("compare", tmp_path / "a", tmp_path / "b", "--tolerance", 0)
    assert answer.exit_code == 0
    assert "0 differ" in answer.output


def test_compare_finds_a_changed_gain_and_a_missing_case(short: Path, tmp_path: Path, fmu_dir: Path) -> None:
    run(short, tmp_path / "a", fmu_dir)
    run(short, tmp_path / "b", fmu_dir, "--set", "controller.K=20")
    answer = exo("compare", tmp_path / "a", tmp_path / "b")
    assert answer.exit_code == 1
    assert "plant.q" in answer.output
    assert exo("compare", tmp_path / "a", tmp_path / "b", "--tolerance", 10).exit_code == 0
    shutil.rmtree(tmp_path / "b" / "short" / "signals")
    assert exo("compare", tmp_path / "a", tmp_path / "b", "--tolerance", 10).exit_code == 1


def test_compare_of_two_files_measures_against_the_larger_peak(tmp_path: Path) -> None:
    time = np.arange(3.0)
    for name, values in (("a", [0.0, 10.0, 0.0]), ("b", [0.0, 20.0, 0.0])):
        recording.write(pa.table({"time": time, "x": np.array(values)}), tmp_path / name, csv=True)
    files = (tmp_path / "a.parquet", tmp_path / "b.csv")
    assert exo("compare", *files, "--tolerance", 0.499).exit_code == 1
    assert exo("compare", *files, "--tolerance", 0.501).exit_code == 0


def test_compare_of_nothing_exits_two(tmp_path: Path) -> None:
    assert exo("compare", tmp_path, tmp_path).exit_code == 2
    assert exo("compare", tmp_path, tmp_path / "none").exit_code == 2


def test_validate_exits_one_on_problems_and_zero_without(tmp_path: Path, fmu: Path) -> None:
    answer = exo("validate", fmu)
    assert answer.exit_code == 0
    assert "No problems found." in answer.output
    broken = tmp_path / "broken.fmu"
    broken.write_bytes(b"no archive")
    assert exo("validate", fmu, broken).exit_code == 1
    assert exo("validate", tmp_path / "none.fmu").exit_code == 2


def test_the_schema_refuses_an_entry_without_its_source(short: Path, tmp_path: Path, fmu_dir: Path) -> None:
    run(short, tmp_path, fmu_dir)
    document = json.loads((tmp_path / "short" / "metrics.json").read_text(encoding="utf-8"))
    validator = results.jsonschema.Draft202012Validator(results.schema())
    assert validator.is_valid(document)
    del document["metrics"]["moved/push"]["source"]
    assert not validator.is_valid(document)


#: `python -m exo`, interrupted when the module of its first argument is looked for.
INTERRUPTED = """
import os, runpy, signal, sys

class Ctrl_C:
    def find_spec(self, name, *_):
        if name == at:
            os.kill(os.getpid(), signal.SIGINT)

at = sys.argv.pop(1)
signal.signal(signal.SIGINT, signal.default_int_handler)
sys.meta_path.insert(0, Ctrl_C())
runpy.run_module("exo", run_name="__main__")
"""


@pytest.mark.skipif(sys.platform == "win32", reason="Windows sends no SIGINT to a process of its own")
@pytest.mark.parametrize("at", ["exo.cli", "numpy", "exo.commands.tune"])
def test_a_ctrl_c_in_the_first_second_shows_no_traceback(at: str) -> None:
    command = [sys.executable, "-c", INTERRUPTED, at, "list"]
    ended = subprocess.run(command, capture_output=True, text=True, check=False)
    assert (ended.returncode, ended.stdout, ended.stderr) == (-signal.SIGINT, "", "")


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="no file of this system is always full")
@pytest.mark.parametrize(
    "arguments", [["--version"], ["--help"], ["run", "--help"], ["list"], ["validate", "FMU", "--no-load"]]
)
def test_a_log_on_a_full_disk_is_a_sentence_and_a_reader_that_has_gone_is_141(
    arguments: list[str], fmu_dir: Path
) -> None:
    command = [
        sys.executable,
        "-m",
        "exo",
        *(str(fmu_dir / "Testbed.fmu") if one == "FMU" else one for one in arguments),
    ]
    with Path("/dev/full").open("w") as full:
        ended = subprocess.run(command, stdout=full, stderr=subprocess.PIPE, text=True, check=False)
    assert ended.returncode == 2
    assert re.fullmatch(r"exo: (standard output: )?No space left on device\n", ended.stderr)
    reads, writes = os.pipe()
    os.close(reads)
    ended = subprocess.run(command, stdout=writes, stderr=subprocess.PIPE, text=True, check=False)
    os.close(writes)
    assert (ended.returncode, ended.stderr) == (141, "")


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="no file of this system is always full")
def test_a_message_that_cannot_be_printed_leaves_the_exit_code() -> None:
    with Path("/dev/full").open("w") as full:
        ended = subprocess.run([sys.executable, "-m", "exo", "run", "nosuch"], stderr=full, check=False)
    assert ended.returncode == 2


@pytest.mark.skipif(sys.platform == "win32", reason="HOME")
def test_a_home_that_cannot_be_written_is_no_matter(short: Path, tmp_path: Path, fmu_dir: Path) -> None:
    command = [sys.executable, "-m", "exo", "run", short, "--out", tmp_path / "out", "--fmu-dir", fmu_dir]
    homeless = {name: value for name, value in os.environ.items() if not name.startswith(("MPL", "XDG"))}
    ended = subprocess.run(command, env={**homeless, "HOME": "/dev/null"}, capture_output=True, text=True, check=False)
    assert (ended.returncode, ended.stderr) == (0, "")
