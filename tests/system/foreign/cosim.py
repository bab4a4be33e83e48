"""FMUs through libcosim."""

import json
import subprocess
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import Any

CHILD = Path(__file__).with_name("cosim_child.py")


def cosim(job: Mapping[str, Any], *, tolerated: tuple[str, ...] = (), **process: Any) -> dict[str, list[float]]:
    """The outputs after each step of a job (see `cosim_child`).

    Any complaint of libcosim fails, unless it ends with a tolerated one. What is left goes to `subprocess.run`.
    """
    answer = subprocess.run(
        [sys.executable, CHILD],
        input=json.dumps(job),
        capture_output=True,
        text=True,
        check=False,
        timeout=120,
        **process,
    )
    output = answer.stdout + answer.stderr
    assert answer.returncode == 0, output
    complaints = [line for line in output.splitlines() if "[error]" in line.lower() or "[warning]" in line.lower()]
    assert [line for line in complaints if not line.endswith(tolerated)] == []
    return dict(json.loads(output.split("found ")[1].splitlines()[0]))
