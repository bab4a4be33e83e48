"""`exo sensitivity`: one parameter changed, by a quarter, to stated values, with the table; and what it refuses."""

import json
from pathlib import Path

import pytest
from typer.testing import CliRunner

from exo import sensitivity
from exo.cli import app
from exo.sensitivity import load, pad_height

from commands import exo

STUDY = """
[[figure]]
id = "release"
title = "release delay"
plant = "Testbed"
scenario = "wall"
case = "passive_bounded_5_0.5"
metric = "release_delay"
until = 24.0

[[parameter]]
plant = "Testbed"
group = "wall"
name = "wall.q"
source = "chosen"
why = "anywhere"
values = [0.35]

[[parameter]]
plant = "Testbed"
group = "friction"
name = "F_c"
source = "chosen"
why = "any"

[[parameter]]
plant = "Testbed"
group = "wall"
name = "wall.k"
source = "chosen"
why = "any"
off = ["release"]
"""


def test_each_parameter_is_changed_alone(tmp_path: Path, fmu_dir: Path) -> None:
    study = tmp_path / "study.toml"
    study.write_text(STUDY, encoding="utf-8")
    done = CliRunner().invoke(app, ["sensitivity", str(study), "--fmu-dir", str(fmu_dir)])
    assert done.exit_code == 0, done.output
    found = json.loads((tmp_path / "study.json").read_text(encoding="utf-8"))["release"]
    assert found["value"] == 0.332
    assert found["parameters"] == {"wall.q": 0.3, "F_c": 0.64, "wall.k": 1e5}
    assert list(found["changed"]) == ["wall.q", "F_c"], "wall.k is off"
    assert len(found["changed"]["wall.q"]) == 1
    # More friction holds the mass longer.
    more, less = found["changed"]["F_c"]
    assert more > 0.332 > less


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("passive_bounded_5_0.5", "passive_bounded_7", "wall has no case passive_bounded_7 with release_delay"),
        ('metric = "release_delay"', 'metric = "relief"', "wall has no case passive_bounded_5_0.5 with relief"),
        ('source = "chosen"', 'source = "guessed"', "'paper', 'chosen' or 'fitted'"),
        ("values = [0.35]", "values = [-2e9]", "wall.q"),
    ],
)
def test_a_study_that_cannot_be_run_is_one_sentence(
    old: str, new: str, message: str, tmp_path: Path, fmu_dir: Path
) -> None:
    study = tmp_path / "study.toml"
    study.write_text(STUDY.replace(old, new, 1), encoding="utf-8")
    done = CliRunner().invoke(app, ["sensitivity", str(study), "--fmu-dir", str(fmu_dir)])
    assert done.exit_code == 2
    assert message in done.output
    assert not (tmp_path / "study.json").exists()


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (None, "cannot be read: No such file or directory; expected a .toml file"),
        (b"\xff", "byte 0 is no UTF-8"),
        (b"[", "expected TOML"),
        (b"", "figure: missing; expected a value"),
        (STUDY.replace('plant = "Testbed"', "plant = 1979-05-27", 1).encode(), "got datetime.date(1979, 5, 27)"),
        (STUDY.replace("group = ", "grup = ", 1).encode(), "grup: unknown key"),
        (STUDY.replace('source = "chosen"', 'source = "guessed"', 1).encode(), "source: got 'guessed'; expected"),
    ],
)
def test_a_file_that_is_no_study_says_where(text: bytes | None, said: str, tmp_path: Path) -> None:
    study = tmp_path / "study.toml"
    if text is not None:
        study.write_bytes(text)
    done = CliRunner().invoke(app, ["sensitivity", str(study)])
    assert done.exit_code == 2
    assert done.stderr.startswith(f"exo: {study}: ")
    assert said in done.stderr
    for word in ("error of exo itself", "Errno", "http", "validation error"):
        assert word not in done.stderr


@pytest.mark.parametrize(
    ("out", "message"),
    [
        ("folder", "folder: is no file; expected the name of a file to write"),
        ("file/study.json", "study.json: cannot be written: "),
    ],
)
def test_a_place_that_cannot_be_written_is_refused_before_anything_runs(
    out: str, message: str, tmp_path: Path, fmu_dir: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def measure(*_: object, **__: object) -> None:
        raise AssertionError("the place was not looked at")

    monkeypatch.setattr(sensitivity, "measure", measure)
    study = tmp_path / "study.toml"
    study.write_text(STUDY, encoding="utf-8")
    (tmp_path / "folder").mkdir()
    (tmp_path / "file").write_text("a file", encoding="utf-8")
    done = exo("sensitivity", study, "--fmu-dir", fmu_dir, "--out", tmp_path / out)
    assert done.exit_code == 2
    assert message in done.stderr
    assert {path.name for path in tmp_path.iterdir()} == {"study.toml", "folder", "file"}


def test_the_pad_is_where_the_specification_says() -> None:
    lengths = {"L1": 0.32, "pad.x": 0.36, "pad.z": -0.12, "q_start[2]": -1.48096, "q_start[3]": 1.70138}
    height = pad_height({f"plant.{name}": value for name, value in lengths.items()})
    assert height == pytest.approx(-0.35710, abs=5e-6)  # five decimals are given


def test_the_study_of_the_documents_can_be_read() -> None:
    study = load(Path(__file__).parents[2] / "docs/assumptions.toml")
    assert {figure.plant for figure in study.figure} == {"Testbed", "ExoskeletonArm"}
