"""The program `cargo-fmu`, and the environment in which a stranger calls it."""

import os
import subprocess
import sys
from functools import cache
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


@cache
def program() -> Path:
    """The built program. `cargo xtask test` has built it in an earlier stage; otherwise it is built here."""
    target = ROOT / os.environ.get("CARGO_TARGET_DIR", "target")
    path = target / "debug" / ("cargo-fmu.exe" if os.name == "nt" else "cargo-fmu")
    if not path.is_file():
        build = ["cargo", "build", "--quiet", "--locked", "--workspace", "--exclude", "importers", "--bin", "cargo-fmu"]
        subprocess.run(build, cwd=ROOT, check=True)
    return path


def environment(target: Path | None = None) -> dict[str, str]:
    """Environment variables with the program and this Python on the path; cargo's target folder, if one is said."""
    path = os.pathsep.join([str(program().parent), str(Path(sys.executable).parent), os.environ["PATH"]])
    kept = {key: value for key, value in os.environ.items() if not key.startswith(("CARGO_TARGET", "FMU_", "EXO_"))}
    said = {} if target is None else {"CARGO_TARGET_DIR": str(target)}
    return {**kept, **said, "PATH": path, "SDK": str(ROOT), "CARGO_INCREMENTAL": "0"}


def cargo_fmu(*words: str, cwd: Path, target: Path | None = None) -> subprocess.CompletedProcess[str]:
    """`cargo fmu …` in a folder; what it prints."""
    command = ["cargo", "fmu", *words]
    return subprocess.run(
        command, cwd=cwd, env=environment(target), capture_output=True, encoding="utf-8", timeout=900, check=False
    )
