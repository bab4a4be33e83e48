"""The native engine beside other co-simulation tools, each with the FMUs that it can be given.

libcosim couples the testbed's pair and records all Reals. Ecos and OMSimulator read an SSP archive, so the closed
testbed: the pair and the operator who pushes. Ecos records nothing, or, in a row of its own, a CSV file. OMSimulator is
a program: its processor time for a long run less that for a short one.
"""

import json
import os
import resource
import shutil
import subprocess
import sys
from collections.abc import Callable, Iterator, Mapping
from contextlib import ExitStack, contextmanager
from ctypes.util import find_library
from dataclasses import replace
from importlib import metadata
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from benches.engines import STEP, STEPS, beside, coupled_testbed, engine
from benches.row import Bench, Found, NotRun
from benches.turns import Times, in_turns, pinned
from exo.coupled import Coupled
from exo.fmu import Archive
from exo.plan import Plan
from exo.systems import closed, ssp

CHILD = Path(__file__).with_name("tool_child.py")
TBB = "libtbb.so.12"
#: Rounds, at most: a tool may take seconds.
ROUNDS = 5
SYSTEM = "TestbedSystem"
OMSIMULATOR = "OMSimulator"


def measure(bench: Bench) -> Iterator[Found]:
    """The rows."""
    rounds = min(bench.rounds, ROUNDS)
    if find_spec("libcosimpy") is None:
        yield NotRun(name="libcosim", reason="the Python package libcosimpy is not installed")
    else:
        with coupled_testbed(bench) as (plan, coupled):
            job = {"tool": "libcosim", "folder": str(bench.fmu_dir)}
            times = _beside(plan, coupled, {"libcosim": lambda: child(job)}, rounds)
        yield beside(times, "libcosim", "libcosim with series, testbed pair", limit=1 / 4, aim=1 / 6)
    with closed_testbed(bench) as (plan, coupled, archive, default):
        work: dict[str, Callable[[], float]] = {}
        library = tbb()
        if find_spec("ecospy") is None or library is None:
            yield NotRun(name="Ecos", reason=f"the Python package ecospy or {TBB} (Debian's libtbb12) is not there")
        else:
            common = {"ssp": str(archive), "set": default, "tbb": library, "csv": str(bench.work / "ecos.csv")}
            for tool in ("ecos", "ecos with its CSV writer"):
                work[tool] = lambda tool=tool: child({"tool": tool, **common})  # type: ignore[misc]
        if shutil.which(OMSIMULATOR) is None:
            yield NotRun(name=OMSIMULATOR, reason=f"no program {OMSIMULATOR} on PATH")
        else:
            work[OMSIMULATOR] = lambda: omsimulator(archive, bench.work)
        if work:
            times = _beside(plan, coupled, work, rounds)
            for tool in work:
                yield beside(times, tool, f"{tool[0].upper()}{tool[1:]}, testbed and operator")


def _beside(plan: Plan, coupled: Coupled, work: Mapping[str, Callable[[], float]], rounds: int) -> Times:
    with pinned():
        return in_turns({"native": lambda: engine(plan, coupled, "native"), **work}, rounds)


@contextmanager
def closed_testbed(bench: Bench) -> Iterator[tuple[Plan, Coupled, Path, str]]:
    """The closed testbed as the native engine runs it, as an SSP archive, and the name of its parameter set."""
    system = closed.load(SYSTEM)
    plan = replace(closed.case_plans(SYSTEM)[system.default], duration=STEPS * STEP)
    with ExitStack() as stack:
        files = sorted(set(plan.components.values()))
        archives = {file: stack.enter_context(Archive(bench.fmu_dir / file)) for file in files}
        path = ssp.write(system=system, archives=archives, folder=bench.work)
        yield plan, stack.enter_context(Coupled(plan, archives)), path, system.default


def child(job: Mapping[str, Any]) -> float:
    """Seconds of the steps of a job of `tool_child`."""
    cores = sorted(range(os.cpu_count() or 1))
    given = dict(job) | {"step": STEP, "steps": STEPS, "cores": cores}
    answer = subprocess.run(
        [sys.executable, CHILD], input=json.dumps(given), capture_output=True, text=True, check=False, timeout=300
    )
    if answer.returncode != 0 or "took" not in answer.stdout:
        raise RuntimeError(f"{job['tool']}: {(answer.stdout + answer.stderr)[-500:]}")
    return float(answer.stdout.rpartition("took")[2])


def omsimulator(archive: Path, work: Path) -> float:
    """Processor seconds of the program for the run, without what a run of one step takes."""

    def seconds(stop: float) -> float:
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        options = (f"--tempDir={work}", f"--resultFile={work / 'oms.csv'}", f"--stopTime={stop:g}")
        subprocess.run([OMSIMULATOR, *options, archive], check=True, capture_output=True, cwd=work, timeout=600)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime

    return max(seconds(STEPS * STEP) - seconds(STEP), 1e-9)


def tbb() -> str | None:
    """Where libtbb lies: in the Python package `tbb`, or in the system."""
    try:
        files = metadata.files("tbb") or []
    except metadata.PackageNotFoundError:
        files = []
    found = next((str(Path(str(file.locate())).resolve()) for file in files if file.name == TBB), None)
    return found or (TBB if find_library("tbb") == TBB else None)
