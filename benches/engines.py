"""The engines beside their peers, ratios within one run: `python benches/engines.py`, a stage of `cargo xtask bench`.

All rows couple the testbed's pair, 20 000 macro steps of 2 ms, every output recorded. What is compared runs in turns,
so that what else the machine does meets all; the smallest time of each counts.

| name | what |
|---|---|
| raw C loop | `loop.c`: what one writes by hand over the same instances and the same buffers |
| native | `exo run --engine native` |
| fmpy | `exo run`, the reference |
| libcosim | libcosimpy with a time series observer of all Reals |
| own cost | native over FMUs that do nothing: what the engine adds to the calls |
| sweep | 10 s runs of `exo.batch`, reset and metrics included, beside the raw C loop alone |
"""

import platform
import subprocess
import sys
import tempfile
from collections.abc import Callable
from ctypes import CDLL, POINTER, Structure, byref, c_double, c_long, c_size_t, c_uint32, c_void_p, cast
from dataclasses import dataclass, replace
from pathlib import Path
from time import perf_counter
from typing import Any

import numpy as np

from exo import master
from exo.coupled import Coupled
from exo.fmu import Archive, find_fmu_dir
from exo.loop import Part, native
from exo.manifest import processor
from exo.runs import Batch
from exo.scenario import load

STEPS, STEP = 20_000, 0.002
REPETITIONS = 7
CASE = "passive_bounded_5_0.5"


@dataclass(frozen=True)
class Row:
    """A figure with the bound that is asked for and the one that is aimed at: at most these, with `least` at least."""

    name: str
    value: float
    asked: float
    aimed: float
    unit: str = ""
    least: bool = False

    @property
    def good(self) -> bool:
        """Whether it is what is asked for."""
        return self.value >= self.asked if self.least else self.value <= self.asked


class Fmu(Structure):
    """`struct fmu` of loop.c."""

    _fields_ = (
        *((name, c_void_p) for name in ("instance", "do_step", "set_real", "get_real", "get_integer", "get_boolean")),
        *((name, c_void_p) for name in ("inputs", "reals", "integers", "booleans")),
        *((f"{name}_count", c_size_t) for name in ("inputs", "reals", "integers", "booleans")),
        *((name, c_void_p) for name in ("input_rows", "real_rows", "integer_rows", "boolean_rows")),
    )


def compiled(folder: Path) -> CDLL:
    """loop.c as a library."""
    source, library = Path(__file__).with_name("loop.c"), folder / "loop.so"
    subprocess.run(["cc", "-O2", "-Wall", "-Wextra", "-shared", "-fPIC", "-o", library, source], check=True)
    return CDLL(str(library))


def struct_of(part: Part) -> Fmu:
    """An FMU's functions, references and buffers for the C loop."""

    def function(name: str) -> int:
        return int(cast(part.instance.function(name), c_void_p).value or 0)

    def references(kind: Any) -> tuple[int, int]:
        found = part.outputs.get(kind)
        return (found.address, found.count) if found else (0, 0)

    def rows(kind: Any) -> int:
        return int(part.y[kind].ctypes.data) if kind in part.y else 0

    kinds = ("Real", "Integer", "Boolean")
    given = part.inputs["Real"]
    outputs = [references(kind) for kind in kinds]
    return Fmu(
        part.instance.component,
        *(function(f"fmi2{name}") for name in ("DoStep", "SetReal", "GetReal", "GetInteger", "GetBoolean")),
        given.address,
        *(address for address, _ in outputs),
        given.count,
        *(count for _, count in outputs),
        part.u["Real"].ctypes.data,
        *(rows(kind) for kind in kinds),
    )


def raw(library: CDLL, coupled: Coupled) -> float:
    """Seconds that the C loop takes, over instances that have just been initialized."""
    controller, plant = (coupled._parts[name] for name in ("controller", "plant"))
    structs = struct_of(controller), struct_of(plant)
    columns = (
        controller.input("q")[1],
        plant.output("q", "Real"),
        plant.input("tau_a")[1],
        controller.output("tau_a", "Real"),
    )
    run = library.raw_loop
    run.restype = c_long
    run.argtypes = [POINTER(Fmu), POINTER(Fmu), *[c_size_t] * 5, c_double]
    began = perf_counter()
    failed = run(byref(structs[0]), byref(structs[1]), *columns, STEPS, STEP)
    took = perf_counter() - began
    assert failed == -1, failed
    return took


def empty(library: CDLL) -> float:
    """Seconds of the native engine over two FMUs that do nothing, wired as the pair: one Set and three Gets each."""
    transfer, step = (
        int(cast(getattr(library, name), c_void_p).value or 0) for name in ("empty_transfer", "empty_step")
    )
    rows = np.zeros((STEPS + 1, 8))
    references = (c_uint32 * 8)()
    address = cast(references, c_void_p).value or 0
    call = (transfer, address, 8, rows.ctypes.data, rows.strides[0])
    copy = (rows.ctypes.data, rows.strides[0], rows.ctypes.data + 8, rows.strides[0], 8, False)
    component = (1, step, [copy], [call], [call, call, call])
    began = perf_counter()
    assert native().run([component, component], first=0, steps=STEPS, step=STEP) is None
    return perf_counter() - began


COSIM = """
import json, sys, time
from libcosimpy.CosimEnums import CosimVariableType
from libcosimpy.CosimExecution import CosimExecution
from libcosimpy.CosimLogging import CosimLogLevel, log_output_level
from libcosimpy.CosimObserver import CosimObserver
from libcosimpy.CosimSlave import CosimLocalSlave
folder, steps, step_ns = sys.argv[1], int(sys.argv[2]), int(sys.argv[3])
log_output_level(CosimLogLevel.WARNING)
execution = CosimExecution.from_step_size(step_size=step_ns)
def added(name, file):
    return execution.add_local_slave(local_slave=CosimLocalSlave(fmu_path=f"{folder}/{file}.fmu", instance_name=name))
indices = {name: added(name, file) for name, file in (("controller", "TestbedController"), ("plant", "Testbed"))}
known = {f"{name}.{v.name.decode()}": (index, v.reference, CosimVariableType(v.type), v.causality)
         for name, index in indices.items() for v in execution.slave_variables(index)}
for source, target in (("plant.q", "controller.q"), ("controller.tau_a", "plant.tau_a")):
    execution.connect_real_variables(*known[source][:2], *known[target][:2])
execution.real_initial_value(*known["controller.tau_h"][:2], 3.0)
execution.real_initial_value(*known["plant.tau_h"][:2], 3.0)
observer = CosimObserver.create_time_series(buffer_size=steps + 2)
execution.add_observer(observer=observer)
for index, reference, kind, causality in known.values():
    if kind is CosimVariableType.REAL and causality == 0:
        observer.start_time_series(index, reference, kind)
execution.step()
began = time.perf_counter()
for _ in range(steps):
    execution.step()
print("took", time.perf_counter() - began)
"""


def cosim(folder: Path) -> float:
    """Seconds that libcosim takes, in a process of its own."""
    arguments = [sys.executable, "-c", COSIM, str(folder), str(STEPS), str(round(STEP * 1e9))]
    answer = subprocess.run(arguments, capture_output=True, text=True, check=True)
    return float(answer.stdout.split("took")[1])


def least(work: dict[str, Callable[[], float]]) -> dict[str, float]:
    """The smallest time of each, in turns."""
    times: dict[str, list[float]] = {name: [] for name in work}
    for _ in range(REPETITIONS):
        for name, once in work.items():
            times[name].append(once())
    return {name: min(found) for name, found in times.items()}


def measured(fmu_dir: Path, library: CDLL) -> list[Row]:
    """All rows."""
    scenario = load("wall")
    case = next(one for one in scenario.cases if one.id == CASE)
    plan = replace(master.plan(scenario=scenario, case=case), duration=STEPS * STEP)
    files = ("TestbedController.fmu", "Testbed.fmu")
    with Archive(fmu_dir / files[0]) as controller, Archive(fmu_dir / files[1]) as plant:
        archives = {archive.path.name: archive for archive in (controller, plant)}
        with Coupled(plan, archives) as coupled, Batch("wall", cases=[CASE], fmu_dir=fmu_dir) as runs:

            def engine(name: Any) -> float:
                coupled.start(plan)
                began = perf_counter()
                coupled.advance(engine=name)
                return perf_counter() - began

            def by_hand() -> float:
                coupled.start(plan)
                return raw(library, coupled)

            gains = iter(np.linspace(10.0, 50.0, 1000).tolist())

            def run_of_a_sweep() -> float:
                row = {"controller.K": next(gains), "duration": 10.0}
                began = perf_counter()
                assert runs.run(row).error is None
                return perf_counter() - began

            run_of_a_sweep()  # the first run looks which columns are wanted
            took = least(
                {
                    "raw": by_hand,
                    "native": lambda: engine("native"),
                    "fmpy": lambda: engine("fmpy"),
                    "empty": lambda: empty(library),
                    "sweep": run_of_a_sweep,
                    "cosim": lambda: cosim(fmu_dir),
                }
            )
    share = took["raw"] * (10.0 / STEP / STEPS) / took["sweep"]
    for name in ("raw", "native", "fmpy", "cosim"):
        print(f"{name:8} {1e6 * took[name] / STEPS:7.3f} µs a macro step")
    print(f"sweep    {3600.0 / took['sweep']:,.0f} runs of 10 s an hour on one processor")
    return [
        Row("native / raw C loop", took["native"] / took["raw"], 1.25, 1.1),
        Row("native's own cost a macro step", 1e9 * took["empty"] / STEPS, 120.0, 60.0, " ns"),
        Row("native / fmpy", took["native"] / took["fmpy"], 1 / 4, 1 / 6),
        Row("native / libcosim with series", took["native"] / took["cosim"], 1 / 4, 1 / 6),
        Row("a run of a sweep as a share of the raw C loop's", share, 0.8, 0.9, least=True),
    ]


def main() -> None:
    """Prints the table; exit code 1, if a figure is not what is asked for."""
    with tempfile.TemporaryDirectory() as folder:
        rows = measured(find_fmu_dir().resolve(), compiled(Path(folder)))
    print(f"{platform.machine()}, {processor()}")
    for row in rows:
        bound = "at least" if row.least else "at most"
        told = f"{row.name:48} {row.value:8.3f}{row.unit:3}  {bound} {row.asked:.3g}, aim {row.aimed:.3g}"
        print(told if row.good else f"{told}  MISSED")
    if not all(row.good for row in rows):
        raise SystemExit(1)


if __name__ == "__main__":
    main()
