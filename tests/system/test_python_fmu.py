"""An FMU in Python, in a process of its own: PythonFMU's library takes hold of the interpreter that loads it."""

import subprocess
import sys
from pathlib import Path

CHILD = Path(__file__).with_name("python_fmu_child.py")


def test_an_fmu_in_python_couples_with_this_projects_by_both_engines() -> None:
    command = [sys.executable, "-m", "pytest", "-q", "-n", "0", str(CHILD)]
    answer = subprocess.run(command, cwd=CHILD.parent, capture_output=True, text=True, check=False, timeout=600)
    assert answer.returncode == 0, answer.stdout[-4000:] + answer.stderr[-1000:]
    assert "4 passed" in answer.stdout
