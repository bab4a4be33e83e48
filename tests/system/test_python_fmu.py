"""An FMU in Python, in a process of its own: PythonFMU's library takes hold of the interpreter that loads it."""

import re
import subprocess
import sys
from pathlib import Path

CHILD = Path(__file__).with_name("python_fmu_child.py")


def test_an_fmu_in_python_couples_with_this_projects_by_both_engines() -> None:
    command = [sys.executable, "-m", "pytest", "-q", "-n", "0", str(CHILD)]
    answer = subprocess.run(command, cwd=CHILD.parent, capture_output=True, text=True, check=False, timeout=600)
    # Its process must end well, too: after fmi2Fatal nothing is called or unloaded that Python objects still need.
    assert answer.returncode == 0, answer.stdout[-4000:] + answer.stderr[-1000:]
    assert re.search(r"^4 passed", answer.stdout, re.MULTILINE), answer.stdout[-4000:]
