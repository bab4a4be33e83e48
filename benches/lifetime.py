"""How long an FMU takes to live: read, loaded, instantiated first and again, initialized, reset, freed; and its size.

`lifetime.c` does it in a process of its own, so that a load is a first one; the files are in the system's memory. The
description is read by fmpy, as the harness does.
"""

import subprocess
from collections.abc import Iterator
from pathlib import Path
from statistics import median
from time import thread_time

import fmpy
from fmpy import read_model_description

from benches import floor, native
from benches.row import Bench, Found, Row, Sheet, amount
from exo.extraction import Extraction

CALLS = 200
HEADER = (
    "archive",
    "kB",
    "read, ms",
    "load, µs",
    "first instance, µs",
    "again, µs",
    "initialize, µs",
    "reset, µs",
    "free, µs",
)


def measure(bench: Bench) -> Iterator[Found]:
    """A sheet, and how FMI 3.0 stands beside FMI 2.0."""
    program = native.program(bench, "lifetime", "-ldl")
    floor.archives(bench, bench.work / "floors")
    paths = sorted(bench.fmu_dir.glob("*.fmu"))
    named = {path.stem: path for path in paths}
    named |= {f"fmi3/{path.stem}": path for path in sorted((bench.fmu_dir / "fmi3").glob("*.fmu"))}
    named["FMI floor, as ArmController"] = bench.work / "floors" / "ArmController.fmu"
    found = {name: figures(program, path, min(bench.rounds, 7)) for name, path in named.items()}
    again = {
        name: found[f"fmi3/{name}"][4] / found[name][4]
        for name in (path.stem for path in paths)
        if f"fmi3/{name}" in found
    }
    if again:
        name = max(again, key=lambda name: again[name])
        yield Row(
            name=f"an instance again, FMI 3.0 / FMI 2.0, the largest of {len(again)}",
            value=again[name],
            told=f"{name}: {1e3 * found[f'fmi3/{name}'][4]:.0f} ns / {1e3 * found[name][4]:.0f} ns",
        )
    yield Sheet(
        title="How long an FMU takes to live",
        about="Processor times, medians; `read` is fmpy's reading and checking of the description, "
        "`load` is dlopen in a fresh process, `again` is the median of many instances after the first one.",
        header=HEADER,
        lines=[(name, *(amount(one) for one in all_of)) for name, all_of in found.items()],
    )


def figures(program: Path, path: Path, rounds: int) -> list[float]:
    """The figures of `HEADER`."""
    description = read_model_description(str(path))
    version, token = description.fmiVersion[0], description.guid
    read = []
    for _ in range(rounds):
        began = thread_time()
        read_model_description(str(path))
        read.append(1e3 * (thread_time() - began))
    with Extraction(path) as files:
        platform = fmpy.platform if version == "2" else fmpy.platform_tuple
        name = f"{description.coSimulation.modelIdentifier}{fmpy.sharedLibraryExtension}"
        command = [program, files.folder / "binaries" / platform / name, version, token, str(CALLS)]
        answers = [
            subprocess.run(command, check=True, capture_output=True, text=True).stdout.split() for _ in range(rounds)
        ]
    us = [median(float(answer[i]) / 1e3 for answer in answers) for i in range(6)]
    return [path.stat().st_size / 1e3, median(read), *us]
