"""What runs leave: whole folders that say where they come from; nothing of another run, a killed one, a full disk."""

import hashlib
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import Any
from xml.etree import ElementTree as ET

import pytest

from exo import __version__, folder, junit, recording
from exo.errors import ExoError
from exo.fmu import Archive

from commands import SHORT, exo, full_beyond

REQUIREMENT = """
[requirements.reach]
text = "The mass gets far."
source = "here"
[requirements.reach.shown.end]
title = "position"
scenario = "short"
formula = "eventually(q >= 0.1)"
unit = "m"
signals.q = "plant.q"
"""


@pytest.fixture
def short(tmp_path: Path) -> Path:
    path = tmp_path / "short.toml"
    path.write_text(SHORT, encoding="utf-8")
    return path


def files(place: Path) -> set[str]:
    return {path.relative_to(place).as_posix() for path in place.rglob("*") if path.is_file()}


def manifest(place: Path) -> dict[str, object]:
    return dict(json.loads((place / "manifest.json").read_text(encoding="utf-8")))


def test_the_manifest_says_what_belongs_to_a_run_and_where_it_comes_from(
    short: Path, tmp_path: Path, fmu_dir: Path
) -> None:
    exo("run", short, "--fmu-dir", fmu_dir, "--out", tmp_path / "out", "--set", "controller.K=20")
    place = tmp_path / "out" / "short"
    found = manifest(place)
    assert {file["path"] for file in found["files"]} | {"manifest.json"} == files(place)
    for file in found["files"]:
        data = (place / file["path"]).read_bytes()
        assert (file["bytes"], file["sha256"]) == (len(data), hashlib.sha256(data).hexdigest())
    facts = found["fmus"]["Testbed.fmu"]
    assert facts["sha256"] == hashlib.sha256((fmu_dir / "Testbed.fmu").read_bytes()).hexdigest()
    assert re.fullmatch(r"[0-9a-f]{40}(-dirty)?|unknown", facts["git_hash"])
    with Archive(fmu_dir / "Testbed.fmu") as archive:
        assert facts["guid"] == archive.description.guid
    assert found["versions"]["exo"] == __version__
    assert found["overrides"] == {"controller.K": 20.0}
    assert found["scenario"]["components"]["plant"]["parameters"] == {"wall.q": 1e9}
    assert found["cases"] == ["push"]
    assert "controller.engage" in found["unwired"]
    assert time.time() - time.mktime(time.strptime(found["date"][:19], "%Y-%m-%dT%H:%M:%S")) < 2 * 86400.0
    assert os.uname().nodename not in json.dumps(found["machine"])


def test_a_renamed_case_leaves_nothing_and_what_the_user_has_added_stays(
    short: Path, tmp_path: Path, fmu_dir: Path
) -> None:
    place = tmp_path / "out" / "short"
    exo("run", short, "--fmu-dir", fmu_dir, "--out", tmp_path / "out")
    (place / "signals" / "notes.txt").write_text("mine", encoding="utf-8")
    short.write_text(SHORT.replace('"push"', '"pull"'), encoding="utf-8")
    exo("run", short, "--fmu-dir", fmu_dir, "--out", tmp_path / "out")
    assert {name for name in files(place) if name.startswith("signals/")} == {
        "signals/pull.parquet",
        "signals/notes.txt",
    }


def test_results_from_before_there_were_manifests_are_replaced(short: Path, tmp_path: Path, fmu_dir: Path) -> None:
    place = tmp_path / "out" / "short"
    exo("run", short, "--fmu-dir", fmu_dir, "--out", tmp_path / "out")
    (place / "signals" / "old.parquet").write_bytes((place / "signals" / "push.parquet").read_bytes())
    (place / "manifest.json").unlink()
    exo("run", short, "--fmu-dir", fmu_dir, "--out", tmp_path / "out")
    assert "signals/old.parquet" not in files(place)


def test_the_verdicts_of_other_scenarios_stay_in_the_junit_file(short: Path, tmp_path: Path, fmu_dir: Path) -> None:
    other = tmp_path / "other.toml"
    other.write_text(SHORT.replace('id = "short"', 'id = "other"'), encoding="utf-8")
    for path in (short, other, short):
        exo("run", path, "--fmu-dir", fmu_dir, "--out", tmp_path / "out")
    suites = ET.parse(tmp_path / "out" / "junit.xml").getroot().findall("testsuite")
    assert [suite.get("name") for suite in suites] == ["other", "short"]
    (tmp_path / "out" / "short").rename(tmp_path / "out" / ".short.x.new")
    junit.combine(tmp_path / "out")
    suites = ET.parse(tmp_path / "out" / "junit.xml").getroot().findall("testsuite")
    assert [suite.get("name") for suite in suites] == ["other"]
    (tmp_path / "out" / ".short.x.new").rename(tmp_path / "out" / "short")
    own = ET.parse(tmp_path / "out" / "short" / "junit.xml").getroot().findall("testsuite")
    assert [suite.get("name") for suite in own] == ["short"]


#: Long enough to be met while it runs: a minute of the testbed in some cases.
LONG = SHORT.replace("duration = 1.0", "duration = 60.0")


def many(text: str, number: int, first: float) -> str:
    """The scenario with more cases, each with a gain of its own."""
    cases = "".join(f'[[cases]]\nid = "c{i}"\nparameters = {{ "controller.K" = {first + i} }}\n' for i in range(number))
    return text.replace('[[cases]]\nid = "push"\n', cases).replace('case = "push"', 'case = "c0"')


def start(path: Path, out: Path, fmu_dir: Path) -> subprocess.Popen[bytes]:
    command = [sys.executable, "-m", "exo", "run", path, "--fmu-dir", fmu_dir, "--out", out]
    return subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE)


def test_two_runs_into_one_place_leave_the_folder_of_one_of_them(tmp_path: Path, fmu_dir: Path) -> None:
    out = tmp_path / "out"
    running = []
    for name, first in (("a", 10.0), ("b", 20.0)):
        path = tmp_path / f"{name}.toml"
        path.write_text(many(SHORT, 4, first), encoding="utf-8")
        running += [start(path, out, fmu_dir) for _ in range(2)]
    for process in running:
        _, said = process.communicate(timeout=300)
        assert process.returncode == 0, said
    place = out / "short"
    found = manifest(place)
    document = json.loads((place / "metrics.json").read_text(encoding="utf-8"))
    gains = [case["parameters"]["controller.K"] for case in document["run"]["cases"].values()]
    assert gains in ([10.0, 11.0, 12.0, 13.0], [20.0, 21.0, 22.0, 23.0])
    for file in found["files"]:
        assert hashlib.sha256((place / file["path"]).read_bytes()).hexdigest() == file["sha256"]
    assert files(place) == {"manifest.json", *(file["path"] for file in found["files"])}
    assert {path.name for path in out.iterdir()} == {"short", "junit.xml"}


def test_a_killed_run_leaves_the_results_that_were_there(short: Path, tmp_path: Path, fmu_dir: Path) -> None:
    out = tmp_path / "out"
    exo("run", short, "--fmu-dir", fmu_dir, "--out", out)
    before = {name: (out / "short" / name).read_bytes() for name in files(out / "short")}
    short.write_text(many(LONG, 6, 10.0), encoding="utf-8")
    process = start(short, out, fmu_dir)
    while process.poll() is None and not list(out.glob(".short.*/signals/*.parquet")):
        time.sleep(0.005)
    process.send_signal(signal.SIGKILL)
    process.communicate()
    assert process.returncode == -signal.SIGKILL, "it ended before it was met while it wrote"
    assert {name: (out / "short" / name).read_bytes() for name in files(out / "short")} == before
    short.write_text(SHORT, encoding="utf-8")
    assert exo("run", short, "--fmu-dir", fmu_dir, "--out", out).exit_code == 0
    assert {path.name for path in out.iterdir()} == {"short", "junit.xml"}


def test_what_a_run_killed_between_two_renames_had_moved_away_comes_back(
    short: Path, tmp_path: Path, fmu_dir: Path
) -> None:
    out = tmp_path / "out"
    exo("run", short, "--fmu-dir", fmu_dir, "--out", out)
    (out / "short" / "notes.txt").write_text("mine", encoding="utf-8")
    (out / ".short.x.old").mkdir()
    (out / "short").rename(out / ".short.x.old" / "was")
    assert exo("run", short, "--fmu-dir", fmu_dir, "--out", out).exit_code == 0
    assert (out / "short" / "notes.txt").read_text(encoding="utf-8") == "mine"
    assert {path.name for path in out.iterdir()} == {"short", "junit.xml"}


@pytest.mark.skipif(sys.platform != "linux", reason="limits of a process")
def test_a_full_disk_is_a_sentence_and_leaves_the_results_that_were_there(
    short: Path, tmp_path: Path, fmu_dir: Path
) -> None:
    out = tmp_path / "out"
    exo("run", short, "--fmu-dir", fmu_dir, "--out", out)
    before = files(out)
    short.write_text(LONG, encoding="utf-8")
    # No file may be longer than the longest library: the table of signals does not fit.
    longest = max(path.stat().st_size for path in Path(fmu_dir).glob("*.fmu")) * 3
    limit = f"import resource; resource.setrlimit(resource.RLIMIT_FSIZE, ({longest}, {longest}))"
    code = f"{limit}\nfrom exo.cli import app\napp()"
    arguments = ["run", short, "--fmu-dir", fmu_dir, "--out", out]
    answer = subprocess.run([sys.executable, "-c", code, *arguments], capture_output=True, text=True, check=False)
    assert answer.returncode == 2, answer.stderr
    assert re.fullmatch(r"exo: .*File too large.*\n", answer.stderr), answer.stderr
    assert files(out) == before


def test_nothing_is_put_into_place_where_writing_fails(
    short: Path, tmp_path: Path, fmu_dir: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    out = tmp_path / "out"
    exo("run", short, "--fmu-dir", fmu_dir, "--out", out)
    before = {name: (out / name).read_bytes() for name in files(out)}

    def full(*_: object, **__: object) -> None:
        raise OSError(28, "No space left on device")  # as Arrow does, without the file

    monkeypatch.setattr(recording, "write", full)
    answer = exo("run", short, "--fmu-dir", fmu_dir, "--out", out)
    said = f"exo: {out / 'short'}: cannot be written: No space left on device; what was there before stays\n"
    assert (answer.exit_code, answer.stderr) == (2, said)
    assert {name: (out / name).read_bytes() for name in files(out)} == before
    assert {path.name for path in out.iterdir()} == {"short", "junit.xml"}


def test_a_file_is_replaced_as_a_whole(tmp_path: Path) -> None:
    path = tmp_path / "a"
    folder.write_file(path, b"one")
    with pytest.raises(TypeError):
        folder.write_file(path, None)  # type: ignore[arg-type]
    assert path.read_bytes() == b"one"
    assert [one.name for one in tmp_path.iterdir()] == ["a"]


GONE: Any = object()
MOVED = ("metrics", "moved/push")
#: Place in metrics.json, what stands there instead, and what is said of it. The first ones only the page reads.
OF_THE_PAGE = [
    (("run",), GONE, "'run' is a required property"),
    (("verdict",), GONE, "'verdict' is a required property"),
    (("run", "cases"), GONE, "run: 'cases' is a required property"),
    (("run", "cases"), {}, "run.cases: got {}; expected minProperties 1"),
    ((*MOVED, "expected"), None, 'metrics.moved/push.expected: got null; expected type "number"'),
    ((*MOVED, "paper"), {"label": "a figure"}, "metrics.moved/push.paper: 'quantity' is a required property"),
]
OF_ALL = [
    ((*MOVED, "value"), GONE, "metrics.moved/push: 'value' is a required property"),
    ((*MOVED, "unit"), GONE, "metrics.moved/push: 'unit' is a required property"),
    ((*MOVED, "value"), "abc", 'metrics.moved/push.value: got "abc"; expected type ["number", "null"]'),
    (MOVED, 1, 'metrics.moved/push: got 1; expected type "object"'),
    ((), [], 'got []; expected type "object"'),
    ((), None, 'got null; expected type "object"'),
]


def damaged(document: Any, place: tuple[str, ...], value: Any) -> Any:
    """The document with another value in one place."""
    if not place:
        return value
    inner = document
    for step in place[:-1]:
        inner = inner[step]
    inner[place[-1]] = value
    if value is GONE:
        del inner[place[-1]]
    return document


@pytest.fixture(scope="module")
def good(tmp_path_factory: pytest.TempPathFactory, fmu_dir: Path) -> Path:
    """A folder with the results of `SHORT`."""
    place = tmp_path_factory.mktemp("good")
    (place / "short.toml").write_text(SHORT, encoding="utf-8")
    assert exo("run", place / "short.toml", "--fmu-dir", fmu_dir, "--out", place / "out").exit_code == 0
    return place / "out"


@pytest.mark.parametrize(("place", "value", "said"), [*OF_THE_PAGE, *OF_ALL])
def test_what_is_wrong_in_the_numbers_of_a_run_is_told_with_file_and_place(
    place: tuple[str, ...], value: Any, said: str, good: Path, tmp_path: Path
) -> None:
    out = tmp_path / "out"
    shutil.copytree(good, out)
    path = out / "short" / "metrics.json"
    document = json.loads(path.read_text(encoding="utf-8"))
    path.write_text(json.dumps(damaged(document, place, value)), encoding="utf-8")
    own = tmp_path / "requirements.toml"
    own.write_text(REQUIREMENT, encoding="utf-8")
    commands: list[tuple[object, ...]] = [("report", "--out", out)]
    if (place, value, said) in OF_ALL:
        commands += [
            ("report", "--out", good, "--against", out),
            ("requirements", own, "--results", out),
            ("compare", out, good),
        ]
    for command in commands:
        answer = exo(*command)
        assert answer.exit_code == 2, (command, answer.output)
        assert answer.stderr.startswith(f"exo: {path}: "), (command, answer.stderr)
        assert said in answer.stderr, (command, answer.stderr)


@pytest.mark.skipif(sys.platform != "linux", reason="limits of a process")
def test_a_page_that_does_not_fit_is_named_and_the_one_before_stays(short: Path, tmp_path: Path, fmu_dir: Path) -> None:
    out = tmp_path / "out"
    exo("run", short, "--fmu-dir", fmu_dir, "--out", out)
    page = out / "report.html"
    page.write_text("as before", encoding="utf-8")
    with full_beyond(1000):
        answer = exo("report", "--out", out)
    said = f"exo: {page}: cannot be written: File too large; what was there before stays\n"
    assert (answer.exit_code, answer.stderr) == (2, said)
    assert page.read_text(encoding="utf-8") == "as before"
    assert {path.name for path in out.iterdir()} == {"short", "junit.xml", "report.html"}


def test_a_file_in_the_place_of_a_folder_is_named_as_it_was_given(tmp_path: Path) -> None:
    with pytest.raises(ExoError) as error:
        folder.write_file(tmp_path, b"one")
    assert re.fullmatch(
        rf"{re.escape(str(tmp_path))}: cannot be written: .+; what was there before stays", str(error.value)
    )
    assert [one.name for one in tmp_path.parent.glob(f".{tmp_path.name}*")] == []
