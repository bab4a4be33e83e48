"""SSP archives through Ecos."""

import json
import subprocess
import sys
from collections.abc import Mapping
from ctypes.util import find_library
from importlib import metadata
from pathlib import Path
from typing import Any

CHILD = Path(__file__).with_name("ecos_child.py")
#: The library that Ecos is linked to and does not bring.
TBB = "libtbb.so.12"


def tbb() -> str:
    """Where libtbb lies: in the Python package `tbb`, or in the system."""
    try:
        files = metadata.files("tbb") or []
    except metadata.PackageNotFoundError:
        files = []
    for file in files:
        if file.name == TBB:
            return str(Path(str(file.locate())).resolve())
    if find_library("tbb") == TBB:
        return TBB
    raise AssertionError(
        f"Ecos is not run: {TBB} is missing. The Python package tbb, which harness/requirements.lock installs on linux "
        "x86_64, and Debian's package libtbb12 have it"
    )


def ecos(job: Mapping[str, Any]) -> dict[str, list[float]]:
    """The outputs after each step of a job (see `ecos_child`, which `tbb` is filled in for). Any complaint fails."""
    answer = subprocess.run(
        [sys.executable, CHILD],
        input=json.dumps(dict(job) | {"tbb": tbb()}),
        capture_output=True,
        text=True,
        check=False,
        timeout=120,
    )
    output = answer.stdout + answer.stderr
    assert answer.returncode == 0, output
    *complaints, found = output.splitlines()
    assert complaints == []
    return dict(json.loads(found.removeprefix("found ")))
