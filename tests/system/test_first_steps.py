"""What the README tells a newcomer to type, typed."""

import csv
import shlex
import subprocess
import sys
import textwrap
from pathlib import Path

import numpy as np
import pytest
from matplotlib import image

ROOT = Path(__file__).resolve().parents[2]
README = (ROOT / "README.md").read_text(encoding="utf-8")


@pytest.fixture
def clone(tmp_path: Path, fmu_dir: Path) -> Path:
    """A folder in which the README's paths lead to what was built."""
    (tmp_path / "target").mkdir()
    (tmp_path / "target" / "fmu").symlink_to(fmu_dir, target_is_directory=True)
    (tmp_path / ".venv").symlink_to(Path(sys.prefix), target_is_directory=True)
    return tmp_path


def test_the_first_command_runs_and_its_numbers_move(clone: Path) -> None:
    command = next(line.strip() for line in README.splitlines() if line.strip().startswith(".venv/bin/fmpy simulate"))
    subprocess.run(shlex.split(command), cwd=clone, check=True, capture_output=True, timeout=120)
    with (clone / "testbed.csv").open(encoding="utf-8") as file:
        q = np.array([float(row["q"]) for row in csv.DictReader(file)])
    # "stops at its wall, at 0.3 m"; the wall gives by 1 N over its stiffness.
    assert q[0] == 0.0
    assert q[-1] == pytest.approx(0.3, abs=1e-4)


def test_the_first_script_draws_lines_that_are_not_flat(clone: Path) -> None:
    begin = README.index("      import fmpy\n      from matplotlib")
    script = textwrap.dedent(README[begin : README.index("\n\n", begin)])
    environment = {"MPLBACKEND": "agg", "PATH": "", "HOME": str(clone)}
    subprocess.run(
        [sys.executable, "-c", script], cwd=clone, check=True, capture_output=True, timeout=120, env=environment
    )
    picture = image.imread(clone / "testbed.png")[..., :3]
    first_blue = np.array([31, 119, 180]) / 255.0
    rows, _ = np.nonzero(np.abs(picture - first_blue).max(axis=2) < 0.05)
    assert np.ptp(rows) > 0.5 * len(picture)  # q climbs through most of the picture
