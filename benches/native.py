"""C sources of this folder, compiled."""

import subprocess
from pathlib import Path

from benches.row import Bench

FLAGS = ("-O2", "-std=c11", "-Wall", "-Wextra", "-Werror")
HERE = Path(__file__).parent


def library(bench: Bench, name: str) -> Path:
    """`name`.c as a shared library."""
    return _compiled(bench, name, f"{name}.so", "-shared", "-fPIC")


def program(bench: Bench, name: str, *libraries: str) -> Path:
    """`name`.c as a program."""
    return _compiled(bench, name, name, libraries=libraries)


def _compiled(bench: Bench, name: str, made: str, *flags: str, libraries: tuple[str, ...] = ()) -> Path:
    target = bench.work / made
    if not target.exists():
        command = ["cc", *FLAGS, "-D_GNU_SOURCE", *flags, "-o", target, HERE / f"{name}.c", *libraries]
        subprocess.run(command, check=True)
    return target
