"""The machine as a reader needs it to judge ratios: no name of it, no folder."""

import os
import platform
import shutil
import subprocess
from datetime import UTC, datetime

from benches.turns import cores
from exo.manifest import processor


def facts() -> dict[str, str]:
    """What stands above the table."""
    return {
        "date": datetime.now(UTC).date().isoformat(),
        "processor": processor(),
        "cores": f"{cores()}",
        "load at the start": f"{os.getloadavg()[0]:.1f}" if hasattr(os, "getloadavg") else "not known",
        "system": f"{platform.system()} {platform.machine()}",
        "rustc": version("rustc"),
        "cc": version("cc"),
        "python": platform.python_version(),
    }


def version(program: str) -> str:
    """The first line of what a program says about its version."""
    if shutil.which(program) is None:
        return "not there"
    answer = subprocess.run([program, "--version"], capture_output=True, text=True, check=False)
    return (answer.stdout or answer.stderr).partition("\n")[0].strip()
