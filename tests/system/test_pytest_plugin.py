"""The pytest plugin, as somebody's own tests use it: in a folder of their own, in a process of its own."""

import math
import os
import subprocess
import sys
from pathlib import Path

import pytest

from exo.bands import excess
from exo.errors import ExoError
from exo.fmu import find_fmu_dir

from commands import SHORT

REQUIREMENTS = """
[requirements.reach]
text = "The mass gets somewhere."
source = "here"
[requirements.reach.shown.soon]
title = "position after a second"
scenario = "short"
at = 0.5
formula = "eventually[0:0.4](q >= {reach})"
unit = "m"
signals.q = "plant.q"
"""


def pytest_in(folder: Path, *arguments: str) -> subprocess.CompletedProcess[str]:
    command = [
        sys.executable,
        "-m",
        "pytest",
        "-p",
        "no:cacheprovider",
        "-n",
        "0",
        "--exo-fmu-dir",
        str(find_fmu_dir(None)),
    ]
    return subprocess.run(
        [*command, *arguments],
        cwd=folder,
        capture_output=True,
        text=True,
        check=False,
        env={**os.environ, "COLUMNS": "120"},
    )


def test_requirements_are_tests_with_their_margin(tmp_path: Path):
    (tmp_path / "short.toml").write_text(SHORT, encoding="utf-8")
    (tmp_path / "requirements.toml").write_text(REQUIREMENTS.format(reach=0.1), encoding="utf-8")
    (tmp_path / "far.requirements.toml").write_text(REQUIREMENTS.format(reach=100.0), encoding="utf-8")
    done = pytest_in(tmp_path, "-v", "--junit-xml=junit.xml")
    assert done.returncode == 1, done.stdout
    assert "requirements.toml::reach.soon[push] PASSED" in done.stdout
    assert "far.requirements.toml::reach.soon[push] FAILED" in done.stdout
    assert "expected at least 0" in done.stdout
    assert "eventually[0:0.4](q >= 100.0)" in done.stdout
    assert "Traceback" not in done.stdout + done.stderr
    assert 'name="margin"' in (tmp_path / "junit.xml").read_text(encoding="utf-8")


def test_a_requirement_of_a_built_in_scenario_needs_no_file_of_it(tmp_path: Path):
    text = REQUIREMENTS.format(reach=0.001).replace('"short"', '"gain_study"\ncases = ["K30"]')
    (tmp_path / "requirements.toml").write_text(text.replace("at = 0.5", "at = 2.0"), encoding="utf-8")
    done = pytest_in(tmp_path)
    assert "1 passed" in done.stdout, done.stdout


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (REQUIREMENTS.format(reach=0.1).replace('"short"', '"shirt"'), "unknown scenario shirt"),
        (REQUIREMENTS.format(reach=0.1).replace("plant.q", "plant.r"), "no recorded column plant.r"),
        (REQUIREMENTS.format(reach="("), "temporal logic"),
        (REQUIREMENTS.format(reach=0.1).replace('"short"', '"short"\ncases = ["pish*"]'), "short has no case pish*"),
        (REQUIREMENTS.format(reach=0.1).replace("[0:0.4]", "[0:40]"), "looks 40 s ahead"),
    ],
)
def test_a_wrong_file_is_one_sentence(tmp_path: Path, text: str, said: str):
    (tmp_path / "short.toml").write_text(SHORT, encoding="utf-8")
    (tmp_path / "requirements.toml").write_text(text, encoding="utf-8")
    done = pytest_in(tmp_path)
    assert done.returncode != 0
    assert said in done.stdout
    assert "Traceback" not in done.stdout + done.stderr


def test_a_project_that_takes_warnings_for_errors_can_have_the_plugin(tmp_path: Path):
    (tmp_path / "short.toml").write_text(SHORT, encoding="utf-8")
    (tmp_path / "requirements.toml").write_text(REQUIREMENTS.format(reach=0.1), encoding="utf-8")
    done = pytest_in(tmp_path, "-W", "error")
    assert "1 passed in" in done.stdout, done.stdout


def test_workers_share_the_requirements(tmp_path: Path):
    (tmp_path / "short.toml").write_text(SHORT, encoding="utf-8")
    (tmp_path / "requirements.toml").write_text(REQUIREMENTS.format(reach=0.1), encoding="utf-8")
    (tmp_path / "far.requirements.toml").write_text(REQUIREMENTS.format(reach=100.0), encoding="utf-8")
    done = pytest_in(tmp_path, "-n", "2", "--junit-xml=junit.xml")
    assert "1 failed, 1 passed" in done.stdout, done.stdout
    assert (tmp_path / "junit.xml").read_text(encoding="utf-8").count('name="margin"') == 2


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["--exo-fmu-dir", "nowhere"], "--exo-fmu-dir nowhere: no such folder; expected the folder of the archives"),
        (["--exo-engine", "rust"], "--exo-engine rust: expected one of fmpy, native"),
    ],
)
def test_an_option_that_no_test_could_run_with_is_refused_at_once(tmp_path: Path, arguments: list[str], said: str):
    (tmp_path / "test_nothing.py").write_text("def test_nothing(): pass\n", encoding="utf-8")
    done = pytest_in(tmp_path, *arguments)
    assert done.returncode == 4, "pytest's code of wrong usage"
    assert said in done.stderr
    assert "Traceback" not in done.stdout + done.stderr


def test_files_of_other_tools_are_left_alone(tmp_path: Path):
    (tmp_path / "requirements.toml").write_text('[packages]\nnumpy = "*"\n', encoding="utf-8")
    (tmp_path / "test_nothing.py").write_text("def test_nothing(): pass\n", encoding="utf-8")
    done = pytest_in(tmp_path)
    assert "1 passed" in done.stdout, done.stdout


def test_fixtures_run_a_case_once_and_hold_it_to_a_band(tmp_path: Path):
    (tmp_path / "short.toml").write_text(SHORT, encoding="utf-8")
    (tmp_path / "test_mine.py").write_text(
        """
import pytest

def test_the_hand_pushes(exo_run, exo_in_band):
    run = exo_run("short.toml")
    assert exo_run("short.toml") is run
    light = exo_run("short.toml", **{"plant.M": 1.0})
    assert light["plant.q"][-1] > run["plant.q"][-1]
    q = dict(time=run.time, reference_time=run.time, reference=run["plant.q"], atol=1e-3)
    exo_in_band(actual=run["plant.q"] + 0.9e-3, **q)
    with pytest.raises(pytest.fail.Exception, match="leaves its band by"):
        exo_in_band(actual=run["plant.q"] + 1.5e-3, **q)
    with pytest.raises(Exception, match="expected the id of one of"):
        exo_run("wall")

def test_fmus_and_couplings_are_fixtures(exo_fmu, exo_couple, exo_run):
    assert exo_fmu("Testbed.fmu").inputs["tau_h"].unit == "N"
    pair = exo_couple(
        {"controller": "TestbedController.fmu", "plant": "Testbed.fmu"},
        wires={"controller.q": "plant.q", "plant.tau_a": "controller.tau_a"},
        step=0.002,
    )
    run = exo_run(pair, duration=6.0, inputs={"controller.tau_h": 1.0, "plant.tau_h": 1.0})
    assert run["plant.q"][-1] == pytest.approx(0.3, abs=1e-3)
""",
        encoding="utf-8",
    )
    done = pytest_in(tmp_path)
    assert "2 passed" in done.stdout, done.stdout


TIME = [i / 100 for i in range(101)]
SINE = [math.sin(6 * t) for t in TIME]


def test_a_band_is_wide_in_value_and_in_time():
    common = {"time": TIME, "reference_time": TIME, "reference": SINE}
    assert not excess(actual=SINE, **common)
    shifted = [y + 0.2 for y in SINE]
    found = excess(actual=shifted, atol=0.15, **common)
    assert found
    assert found.largest == pytest.approx(0.05, abs=2e-3)
    late = [0.0 if t < 0.5 else 1.0 for t in TIME]
    step = [0.0 if t < 0.52 else 1.0 for t in TIME]
    both = {"time": TIME, "reference_time": TIME, "reference": step, "actual": late, "atol": 1e-3}
    assert excess(**both)
    assert not excess(**both, time_tol=0.03)


def test_a_band_refuses_what_its_library_would_pass():
    common = {"time": TIME, "reference_time": TIME, "reference": SINE, "atol": 1.0}
    with pytest.raises(ExoError, match=r"actual\[50\] = nan"):
        excess(actual=[*SINE[:50], math.nan, *SINE[51:]], **common)
    with pytest.raises(ExoError, match="expected the same"):
        excess(actual=SINE[:50], **{**common, "time": TIME[:50]})
    with pytest.raises(ExoError, match="expected as many"):
        excess(actual=SINE[:50], **common)
    with pytest.raises(ExoError, match="atol = -1"):
        excess(actual=SINE, **{**common, "atol": -1.0})
