"""A program that has set a locale with decimal commas, as desktop tools do: every number is what it is without.

C's printf and strtod then write and read 1,5. The FMUs, the engines and the files must not go by them.
"""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pyarrow.parquet as pq
import pytest

import exo
from exo import loop, recording

from sweeping import WALL

CASE = "passive_bounded_5_0.5"

#: In every process that begins, workers of a sweep among them: what a tool in German does at its start.
SITE = """
import ctypes, locale
locale.setlocale(locale.LC_ALL, "")
text = ctypes.create_string_buffer(8)
ctypes.CDLL(None).snprintf(text, 8, b"%g", ctypes.c_double(1.5))
assert text.value == b"1,5", text.value
"""


@pytest.fixture(scope="module")
def german(tmp_path_factory: pytest.TempPathFactory) -> dict[str, str]:
    """The environment of such a program."""
    folder = tmp_path_factory.mktemp("german")
    if shutil.which("localedef") is None:
        pytest.skip("no localedef, which makes a locale")
    made = subprocess.run(
        ["localedef", "-i", "de_DE", "-f", "UTF-8", folder / "de_DE.UTF-8"], capture_output=True, text=True, check=False
    )
    if not (folder / "de_DE.UTF-8").exists():
        pytest.skip(f"localedef has no de_DE: {made.stderr.strip()[:200]}")
    (folder / "sitecustomize.py").write_text(SITE)
    own = {"LOCPATH": str(folder), "LC_ALL": "de_DE.UTF-8", "PYTHONPATH": str(folder)}
    return {key: value for key, value in os.environ.items() if not key.startswith("LC_")} | own


def command(environment: dict[str, str], *arguments: object) -> None:
    line = [sys.executable, "-m", "exo", *map(str, arguments)]
    answer = subprocess.run(line, env=environment, capture_output=True, text=True, timeout=300, check=False)
    assert answer.returncode == 0, answer.stderr


def test_a_sweep_has_the_same_table_and_the_same_reasons(
    german: dict[str, str], study_file: Path, fmu_dir: Path, tmp_path: Path
) -> None:
    gains = [12.5, -1.5]
    study_file.write_text(WALL.replace("[10.0, 20.0, 30.0]", str(gains)))
    rows = {"controller.K": [K for K in gains for _ in range(2)], "controller.M_n": [2.0, 8.0] * 2}
    plain = exo.batch("wall", rows, cases=[CASE], metrics=["release_delay", "tank"], fmu_dir=fmu_dir)
    command(german, "sweep", study_file, "--out", tmp_path, "--fmu-dir", fmu_dir, "--workers", 1)
    found = pq.read_table(tmp_path / "small" / "runs.parquet").select(plain.column_names)
    assert str(found.to_pydict()) == str(plain.to_pydict())
    assert plain["release_delay"][0] != plain["release_delay"][1]
    assert "K = -1.5 N.s/m, expected a value from 0.000001" in found["failure"][-1].as_py()


def test_both_engines_and_their_files_have_the_same_numbers(
    german: dict[str, str], fmu_dir: Path, tmp_path: Path
) -> None:
    case = ("--case", CASE, "--set", "controller.K=22.5", "--duration", "1.5", "--csv")
    arguments = ("run", "wall", *case, "--fmu-dir", fmu_dir, "--out")
    command(dict(os.environ), *arguments, tmp_path / "plain")
    for engine in loop.ENGINES:
        command(german, *arguments, tmp_path / engine, "--engine", engine)
    files = sorted(tmp_path.rglob("signals/*.csv"))
    assert len(files) == 3
    assert len({file.read_bytes() for file in files}) == 1
    moved = recording.read(files[0])
    assert len(moved["time"]) == 750
    assert sum(np.ptp(column) > 0.0 for name, column in moved.items() if name != "time") > 5
