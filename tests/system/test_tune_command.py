"""The command `exo tune`: what it reads from a scenario, says of encoder and dry friction, and refuses."""

import json
import math
import sys
from pathlib import Path

import pytest
from typer.testing import CliRunner

from exo import scenario as scenarios
from exo.cli import app
from exo.errors import ScenarioError
from exo.fmu import find_fmu_dir
from exo.tuning import reading

from commands import exo, full_beyond

PLAIN = ["--T", "0.002", "--M-min", "6", "--M-max", "6", "--M-n", "5", "--D-n", "0.5", "--K", "30"]


def test_the_arm_is_read_with_its_pose_gears_and_sensors() -> None:
    found = reading.read(
        scenario=scenarios.load("arm_presets"),
        case="stiff_grip_slow",
        axis="z",
        texts={
            "plant.encoder.kind": "motor",
            "controller.dp_cutoff": "40",
            "controller.ft.cutoff": "25",
            "operator.k_h_factor[3]": "0.5",
        },
        fmu_dir=find_fmu_dir(),
    )
    # By hand, at q = (0, −1.48096, 1.70138): levers from shoulder and elbow to the handle, forward and up.
    forward, fore_forward = (
        0.32 * math.cos(-1.48096) + 0.36 * math.cos(0.22042),
        0.36 * math.cos(0.22042),
    )
    up, fore_up = 0.32 * math.sin(-1.48096) + 0.36 * math.sin(0.22042), 0.36 * math.sin(0.22042)
    shoulder_count, elbow_count = 2.0 * math.pi / (2000 * 600), 2.0 * math.pi / (2000 * 354)
    values = found.values
    assert values["resolution"] == pytest.approx(forward * shoulder_count + fore_forward * elbow_count, rel=1e-4)
    assert (values["M_n"], values["D_n"], values["K"], values["K_P"]) == (10.0, 40.0, 3000.0, 20.0)
    assert (values["k_h"], values["b_h"], values["dq_cutoff"], values["f_cutoff"]) == (150.0, 25.0, 40.0, 25.0)
    assert (values["T"], values["drive_cutoff"], values["delay"]) == (0.001, 318.0, 0)
    assert values["M_min"] == values["M_max"] == pytest.approx(15.58, abs=0.01)  # docs: Λ at the start pose
    # dx = −up dq_2 − fore_up dq_3 = 0 and dz = forward dq_2 + fore_forward dq_3 = 1.
    determinant = -up * fore_forward + fore_up * forward
    turns = (-fore_up / determinant * -1.0, -up / determinant)
    expected = sum(abs(turn) * F_s for turn, F_s in zip(turns, (18.0, 16.0), strict=True))
    assert found.friction.F_s == pytest.approx(expected, rel=1e-4)


def test_the_testbed_is_read_with_its_friction() -> None:
    found = reading.read(
        scenario=scenarios.load("wall"),
        case=None,
        axis="x",
        texts={"controller.dq_cutoff": "50"},
        fmu_dir=find_fmu_dir(),
    )
    assert found.friction.F_s == found.friction.F_c == 0.64
    assert found.friction.b == 0.19
    values = found.values
    assert (values["T"], values["M_min"], values["substep"], values["dq_cutoff"]) == (0.002, 6.0, 8e-5, 50.0)
    assert (values["K"], values["K_P"]) == (30.0, 10.0)


@pytest.mark.parametrize(
    ("name", "texts", "text"),
    [
        ("wall", {"controller.law": "natural"}, "controller.law = natural: expected one of the laws 1 to 4"),
        ("wall", {"controller.form": "position_servo"}, "controller.form = position_servo: expected torque"),
        ("arm_presets", {"controller.space": "joint"}, "controller.space = joint: expected task"),
        ("arm_both", {}, "arm_both: got ArmController.fmu, .*; expected TestbedController.fmu and Testbed.fmu or"),
    ],
)
def test_a_loop_that_the_guide_does_not_know_is_refused_by_name(name: str, texts: dict[str, str], text: str) -> None:
    with pytest.raises(ScenarioError, match=text):
        reading.read(scenario=scenarios.load(name), case=None, axis="x", texts=texts, fmu_dir=find_fmu_dir())


def test_the_command_warns_with_numbers_and_with_what_mends_it(tmp_path: Path) -> None:
    arm = ["tune", "--scenario", "arm_presets", "--case", "stiff_grip_low_gain_slow", "--speed", "0.006"]
    coarse = [*arm, "--set", "plant.encoder.kind=joint", "--set", "plant.encoder.bits=13", "--out", str(tmp_path)]
    done = CliRunner().invoke(app, coarse)
    assert done.exit_code == 0, done.output
    numbers = json.loads((tmp_path / "tune.json").read_text(encoding="utf-8"))
    (sliding,), count = numbers["sliding"], numbers["quantization"]
    assert sliding["verdict"] == "slips"
    assert sliding["slips"][0]["low"] < 0.006 < sliding["slips"][0]["high"] <= sliding["smooth_above"]
    assert 2000.0 < sliding["K_smooth"] < 3000.0  # K = 2000 slips, K = 3000 does not: arm_presets
    assert count["share"] > 1.0
    assert len(numbers["warnings"]) >= 2
    for sentence in numbers["warnings"]:
        assert sentence in done.output.replace("\n", " ").replace("  ", " ")
    mends = next(sentence for sentence in numbers["warnings"] if sentence.startswith("encoder"))
    assert f"a count of {count['resolution_needed']:.3g} m" in mends
    assert "Hz on the velocity" in mends
    assert (tmp_path / "tune.png").read_bytes().startswith(b"\x89PNG")

    mended = CliRunner().invoke(app, [*coarse, "--K", "3000", "--resolution", "1e-6", "--D-n", "40", "--M-n", "10"])
    assert mended.exit_code == 0, mended.output
    numbers = json.loads((tmp_path / "tune.json").read_text(encoding="utf-8"))
    assert numbers["warnings"] == []
    assert numbers["sliding"][0]["slips"] == []
    assert numbers["sliding"][0]["verdict"] == "smooth"


def test_options_go_over_what_is_read_and_friction_over_friction(tmp_path: Path) -> None:
    done = CliRunner().invoke(
        app,
        [
            "tune",
            "--scenario",
            "wall",
            "--K",
            "77",
            "--F-c",
            "1",
            "--F-s",
            "2",
            "--v-s",
            "0.05",
            "--out",
            str(tmp_path),
        ],
    )
    assert done.exit_code == 0, done.output
    numbers = json.loads((tmp_path / "tune.json").read_text(encoding="utf-8"))
    assert numbers["gains"]["K"] == 77.0
    assert numbers["machine"]["M_min"] == 6.0
    assert numbers["friction"]["terms"] == [{"F_c": 1.0, "F_s": 2.0, "v_s": 0.05, "b": 0.0}]
    assert numbers["quantization"] is None


@pytest.mark.parametrize(
    ("arguments", "text"),
    [
        (["--T", "0.001"], "--M-min: expected a value, or a scenario to read it from (--scenario)"),
        ([*PLAIN, "--dq-cutoff", "-3"], "dq_cutoff = -3: expected a finite value, at least 0"),
        ([*PLAIN, "--f-cutoff", "nan"], "f_cutoff = nan: expected a finite value, at least 0"),
        ([*PLAIN, "--resolution", "-1"], "resolution = -1: expected a finite value, at least 0"),
        ([*PLAIN, "--F-s", "3"], "--F-s 3: expected the Stribeck speed beside it (--v-s)"),
        ([*PLAIN, "--F-c", "3", "--F-s", "2"], "F_s = 2: expected at least F_c = 3"),
        ([*PLAIN, "--speed", "0.01"], "speed = 0.01: expected dry friction beside it"),
        ([*PLAIN, "--F-c", "3", "--speed", "-1"], "speed = -1: expected a finite value, at least 1e-06"),
        (
            [*PLAIN, "--F-c", "10", "--F-s", "15", "--v-s", "0.000001", "--speed", "0.01"],
            "F_s = 15, v_s = 1e-06: friction falls with speed",
        ),
        ([*PLAIN, "--case", "paper"], "--case and --set: expected a scenario to apply them to (--scenario)"),
        (["--scenario", "arm_presets", "--axis", "w"], "axis w: expected one of x, y, z"),
        (["--scenario", "arm_presets", "--case", "papr_slow"], "arm_presets: no case papr_slow"),
        (["--scenario", "wall", "--set", "plant.G=3"], "Testbed.fmu: no variable G"),
    ],
)
def test_a_wrong_command_is_one_sentence_that_names_the_thing(arguments: list[str], text: str, tmp_path: Path) -> None:
    done = CliRunner().invoke(app, ["tune", *arguments, "--out", str(tmp_path)])
    assert done.exit_code == 2
    assert text in " ".join(done.stderr.split())
    assert "Traceback" not in done.output


def test_a_substep_that_is_longer_than_the_period_is_one_substep(tmp_path: Path) -> None:
    for substep in ("0.002", "20000"):
        answer = exo("tune", *PLAIN, "--substep", substep, "--out", tmp_path / substep)
        assert answer.exit_code == 0, answer.output
    one, long = (json.loads((tmp_path / name / "tune.json").read_text(encoding="utf-8")) for name in ("0.002", "20000"))
    assert one["machine"].pop("substep") == 0.002
    assert long["machine"].pop("substep") == 20000.0
    assert one == long


@pytest.mark.skipif(sys.platform != "linux", reason="limits of a process")
@pytest.mark.parametrize("name", ["tune.json", "tune.png"])
def test_a_file_that_does_not_fit_is_named_and_the_one_before_stays(name: str, tmp_path: Path) -> None:
    arguments = ("tune", *PLAIN, "--out", tmp_path)
    assert exo(*arguments).exit_code == 0
    path, table = tmp_path / name, tmp_path / "tune.json"
    before, room = path.read_bytes(), table.stat().st_size
    with full_beyond(room + 1000 if name == "tune.png" else room // 2):
        answer = exo(*arguments, "--M-n", "4")
    said = f"exo: {path}: cannot be written: File too large; what was there before stays\n"
    assert (answer.exit_code, answer.stderr) == (2, said)
    assert path.read_bytes() == before
    assert {one.name for one in tmp_path.iterdir()} == {"tune.json", "tune.png"}
