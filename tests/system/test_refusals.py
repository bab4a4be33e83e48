"""What a user can get wrong at the command `exo`: one sentence, exit code 2, and nothing runs or stays behind."""

import os
import re
import tempfile
import time
from pathlib import Path
from typing import Any

import pytest
from typer.testing import Result

from exo import experiment

from commands import SHORT, exo


def assert_refused(answer: Result, *words: str) -> None:
    """Exit code 2, no exception but the exit, and a message of exo with these words."""
    assert isinstance(answer.exception, SystemExit), answer.exception
    assert answer.exit_code == 2, answer.output
    assert answer.stderr.startswith("exo: ")
    assert "error of exo itself" not in answer.stderr
    for word in words:
        assert word in answer.stderr, answer.stderr


@pytest.fixture(autouse=True)
def never(monkeypatch: pytest.MonkeyPatch) -> None:
    """Nothing is simulated."""

    def simulate(**_: Any) -> None:
        pytest.fail("a simulation began")

    monkeypatch.setattr(experiment, "simulate", simulate)


@pytest.fixture
def run(tmp_path: Path, fmu_dir: Path) -> Any:
    """Runs a scenario's text that must be refused before anything is simulated."""

    def run(text: str | bytes, *more: object) -> Result:
        path = tmp_path / "mine.toml"
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        return exo("run", path, "--out", tmp_path / "out", "--fmu-dir", fmu_dir, *more)

    return run


def changed(old: str, new: str) -> str:
    assert old in SHORT
    return SHORT.replace(old, new, 1)


@pytest.mark.parametrize(
    "name", ["..", ".", ".hidden", "a/b", "a\\\\b", "dot.", "CON", "con", "nul.csv", "LPT1", "a b", "", "x" * 200, "ä"]
)
@pytest.mark.parametrize("place", ['id = "short"', 'id = "push"', '[[figures]]\nid = "q"'])
def test_an_id_that_cannot_name_a_file_everywhere_is_refused(place: str, name: str, run: Any, tmp_path: Path) -> None:
    text = changed(place, re.sub(r'"\w+"', lambda _: f'"{name}"', place))
    assert_refused(run(text), "id", "expected")
    assert {path.name for path in tmp_path.iterdir()} == {"mine.toml"}


def test_ids_that_differ_by_case_only_are_refused(run: Any) -> None:
    assert_refused(run(changed('id = "push"', 'id = "push"\n[[cases]]\nid = "Push"')), "push and Push differ by case")


@pytest.mark.parametrize("name", ["junit.xml", "report.html"])
def test_an_id_that_is_a_file_beside_the_results_is_refused(name: str, run: Any) -> None:
    assert_refused(run(changed('id = "short"', f'id = "{name}"')), name, "beside the results")


def test_two_files_with_one_id_are_refused(tmp_path: Path, fmu_dir: Path) -> None:
    for name in ("a.toml", "b.toml"):
        (tmp_path / name).write_text(SHORT, encoding="utf-8")
    answer = exo("run", tmp_path / "a.toml", tmp_path / "b.toml", "--fmu-dir", fmu_dir, "--out", tmp_path / "out")
    assert_refused(answer, "a.toml", "b.toml", "both have the id short")


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (changed('[[cases]]\nid = "push"', "cases = []").replace("[components.c", "cases = []\n[components.c", 1), []),
        (re.sub(r"\[\[cases\]\].*", "", SHORT, flags=re.DOTALL), ["cases: missing"]),
        (changed('title = "q"', 'title = "q\\u0007"'), ["title", "U+0007"]),
        (changed('title = "A second', 'title = "\\u001b[2J'), ["title", "U+001B"]),
        (changed('unit = "m"', 'unit = "\\uffff"'), ["unit", "U+FFFF"]),
        (changed('"controller.q" =', '"controller.q[1..99999999999]" ='), ["at most 10000 elements"]),
        (changed('"wall.q" = 1e9', '"wall.q[1..10002]" = 1e9'), ["10002 elements; expected at most 10000"]),
        (changed('"wall.q" = 1e9', f'"wall.q" = {"[" * 5000}{"]" * 5000}'), ["nested too deeply"]),
        (changed("duration = 1.0", f"duration = {'9' * 5000}"), ["not TOML"]),
        (changed("duration = 1.0", "duration = 0.002"), ["case push: duration 0.002 s is one step of 0.002 s"]),
        (changed("duration = 1.0", "duration = 1e300"), ["expected at most 1e+08"]),
        (changed("duration = 1.0", "duration = 1e-9"), ["no multiple of the step"]),
        (changed("duration = 1.0", "duration = 190000.0"), ["GB of this machine"]),
        (changed('column = "plant.q" }', 'column = "plant.q", after = 2.0 }'), ["no tick in 2.0 s ≤ t < 1.0 s"]),
        (changed('column = "plant.q" }', 'column = "plant.q", after = "2" }'), ["after: got 2", "number"]),
        (changed('column = "plant.q" }', 'column = "plant.p" }'), ["metric moved: case push", "no variable p"]),
        (changed('column = "plant.q" }', 'column = "plant.tau_d" }'), ["plant.tau_d is not recorded"]),
        (changed('column = "plant.q", label', 'column = "plant.qq", label'), ["figure q: case push", "qq"]),
        (changed('title = "A', 'signals = ["plant.x"]\ntitle = "A'), ["signals", "no variable x"]),
        (SHORT.replace("[components.plant", '[components."a.b"'), ["components.a.b"]),
        (SHORT.replace("[components.plant", "[components.profile"), ["components.profile: this name stands"]),
        (changed('[[cases]]\nid = "push"', '[[cases]]\nid = "push"\nparameters = { "controller.q" = 1.0 }'), [
            "case push: controller.q = 1.0 has no effect, because it is wired to plant.q",
        ]),
        (changed('"plant.tau_a" = "c', '"plant.M" = "c'), ["M: only inputs and tunables can be wired"]),
        (changed('= "controller.tau_a"', '= "controller.engage"'), ["expected a Real output"]),
        (changed('"plant.tau_a" = "c', '"controller.engage" = "-c'), ["only a Real has a negative, this is of type"]),
        (SHORT.encode("utf-16"), ["is no UTF-8"]),
        (SHORT.encode().replace(b"pushing", b"pr\xfcfen"), ["line 3", "0xfc is no UTF-8"]),
        (SHORT + "#" * 1_000_001, ["expected a scenario of at most 1000000"]),
        (changed('[[cases]]\nid = "push"', '[axes]\na = [{0}]\nb = [{0}]\n[cases."{{a}}_{{b}}"]'.format(
            ",".join(map(str, range(200)))
        )), ["a × b has 40000 combinations"]),
    ],
)  # fmt: skip
def test_what_a_file_says_wrong_is_told_before_anything_runs(text: str | bytes, words: list[str], run: Any) -> None:
    began = time.perf_counter()
    assert_refused(run(text), *words)
    assert time.perf_counter() - began < 20.0


@pytest.mark.parametrize(
    ("more", "words"),
    [
        (["--set", "controller.K[1..99999999999]=3"], ["--set controller.K[1..99999999999]", "elements"]),
        (["--set", "controller.K=nan"], ["K: expected Real that is finite, got 'nan'"]),
        (["--set", "controller.K=1e999"], ["K: expected Real that is finite, got '1e999'"]),
        (["--set", "controller.tau_h=3"], ["controller.tau_h = 3.0 has no effect", "wired to profile.tau_h"]),
        (["--case", "pull"], ["--case pull: no such case of short (close matches: push)"]),
        (["--duration", "0.0031"], ["no multiple of the step"]),
        (["--duration", "nan"], ["--duration nan: expected a time above 0 s"]),
        (["--duration", "-1"], ["--duration -1: expected a time above 0 s"]),
        (["--step", "0"], ["--step 0: expected a time above 0 s"]),
    ],
)
def test_what_an_option_says_wrong_is_told_before_anything_runs(more: list[str], words: list[str], run: Any) -> None:
    assert_refused(run(SHORT, *more), *words)


def test_a_pattern_without_a_scenario_names_what_is_close(tmp_path: Path, fmu_dir: Path) -> None:
    answer = exo("run", "arms_*", "--fmu-dir", fmu_dir, "--out", tmp_path)
    assert_refused(answer, "no scenario matches arms_*", "arm_")


@pytest.mark.parametrize("place", ["/proc/foo", "file", "file/below"])
def test_a_place_for_results_that_cannot_be_written_is_refused_before_anything_runs(
    place: str, run: Any, tmp_path: Path
) -> None:
    (tmp_path / "file").write_text("mine", encoding="utf-8")
    assert_refused(run(SHORT, "--out", tmp_path / place), "--out", "cannot be written")
    assert (tmp_path / "file").read_text(encoding="utf-8") == "mine"


def test_a_name_that_is_no_utf_8_is_refused_before_anything_runs(run: Any, tmp_path: Path, study_file: Path) -> None:
    odd = tmp_path / os.fsdecode(b"o\xff")
    assert_refused(run(SHORT, "--out", odd), "o\\udcff: its name is no UTF-8; expected another folder")
    assert_refused(exo("sweep", study_file, "--out", odd), "o\\udcff", "its name is no UTF-8")
    assert not odd.exists()
    (odd / "signals").mkdir(parents=True)
    (odd / "metrics.json").write_text("{}", encoding="utf-8")
    (odd / "signals" / "a.parquet").write_bytes(b"")
    assert_refused(exo("compare", odd / "signals" / "a.parquet", odd / "signals" / "a.parquet"), "is no UTF-8")
    assert_refused(exo("export", odd, "--out", tmp_path / "export"), "is no UTF-8")
    assert_refused(exo("report", "--out", tmp_path), "o\\udcff: its name is no UTF-8")


def test_a_folder_that_holds_something_else_is_not_overwritten(run: Any, tmp_path: Path) -> None:
    source = tmp_path / "out" / "short" / "main.rs"
    source.parent.mkdir(parents=True)
    source.write_text("mine", encoding="utf-8")
    assert_refused(run(SHORT), "short: holds no results of exo")
    assert source.read_text(encoding="utf-8") == "mine"


def test_a_file_that_is_a_folder_or_cannot_be_read_is_named(tmp_path: Path, fmu_dir: Path) -> None:
    (tmp_path / "folder.toml").mkdir()
    assert_refused(exo("run", tmp_path / "folder.toml", "--fmu-dir", fmu_dir), "no such scenario file")


def test_a_base_that_is_no_utf8_is_named(run: Any, tmp_path: Path) -> None:
    (tmp_path / "base.toml").write_bytes(b'title = "\xe4"\n')
    assert_refused(run('base = "base.toml"\n'), "base.toml: line 1: byte 0xe4 is no UTF-8")


def test_nothing_of_the_archives_stays_behind(run: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    place = tmp_path / "temporary"
    place.mkdir()
    monkeypatch.setattr(tempfile, "tempdir", str(place))
    assert_refused(run(SHORT, "--set", "controller.law=pasive"))
    assert list(place.iterdir()) == []
