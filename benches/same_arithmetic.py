"""Controller and arm beside the same arithmetic in C: `python benches/same_arithmetic.py`, in `cargo xtask bench`.

The inputs are those of the scenario arm_payload, recorded: the pad lands, presses, grips, comes off the table, carries,
sets down. All sides get them in turns, and the smallest time of each counts. That they compute the same is what
`tests/system/test_same_arithmetic.py` shows, bit for bit.

| side | what is measured |
|---|---|
| FMU | Set, DoStep and Get through the C interface: of the inputs that wires carry and the outputs that wires take |
| FMU, all outputs | the same with a Get of every output, as a recording needs it |
| C | `arm_law.c`, `arm_plant.c`: inputs copied in, a tick or a step, every output in a struct |

The second column is instructions, counted by callgrind: it knows no noise, and no cache either.
"""

import pickle
import platform
import re
import subprocess
import sys
import tempfile
from collections.abc import Callable
from contextlib import ExitStack
from ctypes import CDLL, Structure, byref, c_double, c_long, c_size_t, c_void_p, cast
from dataclasses import dataclass, field
from pathlib import Path
from shutil import which
from time import perf_counter

import numpy as np
from numpy.typing import NDArray

from engines import Row
from exo.fmu import DTYPES, Archive, Instance, find_fmu_dir
from exo.manifest import processor
from in_c import FORCES, SENSED, Case, InC, compiled, recorded

SCENARIO, CASE = "arm_payload", "passive_bounded_17.5kg"
REPETITIONS = 7
#: Steps that callgrind counts, after those that nobody counts: the lift.
COUNTED = range(7_000, 8_000)
#: Outputs that wires take.
WIRED = {
    "law": ["tau_a[1]", "tau_a[2]", "tau_a[3]"],
    "arm": [f"{name}[{i}]" for name in ("q", "p", "dp") for i in (1, 2, 3)],
}
BOUNDS = 1.5, 1.1


class Fmu(Structure):
    """`struct fmu` of arm_cycles.c."""

    _fields_ = (
        *((name, c_void_p) for name in ("instance", "do_step", "set_real", "set_boolean")),
        *((name, c_void_p) for name in ("get_real", "get_integer", "get_boolean")),
        *((name, c_void_p) for name in ("inputs", "switches", "reals", "integers", "booleans")),
        *((f"{name}_count", c_size_t) for name in ("inputs", "switches", "reals", "integers", "booleans")),
        *((name, c_void_p) for name in ("input_rows", "switch_rows", "real_row", "integer_row", "boolean_row")),
    )


@dataclass(frozen=True)
class Side:
    """What is measured: brought to its start, then run from one step to before another."""

    start: Callable[[], None]
    advance: Callable[[int, int], None]


@dataclass(frozen=True)
class Given:
    """What a component gets: its name, its archive, names and rows of Reals and of Booleans."""

    component: str
    archive: str
    inputs: tuple[str, ...]
    rows: NDArray[np.float64]
    switches: tuple[str, ...] = ()
    switch_rows: NDArray[np.int32] = field(default_factory=lambda: np.zeros(1, dtype=np.int32))


def played(library: CDLL, instance: Instance, case: Case, inputs: Given, outputs: list[str]) -> Side:
    """An FMU over recorded inputs."""
    run = library.fmu_cycles
    run.restype, run.argtypes = c_long, [c_void_p, c_size_t, c_size_t, c_double]
    given, shown = instance.references([*inputs.inputs, *inputs.switches]), instance.references(outputs)
    rows = [np.zeros(max(refs.count, 1), dtype=DTYPES[kind]) for kind, refs in shown.items()]
    calls = ("DoStep", "SetReal", "SetBoolean", "GetReal", "GetInteger", "GetBoolean")
    all_references = (given["Real"], given["Boolean"], shown["Real"], shown["Integer"], shown["Boolean"])
    struct = Fmu(
        instance.component,
        *(cast(instance.function(f"fmi2{name}"), c_void_p).value for name in calls),
        *(refs.address for refs in all_references),
        *(refs.count for refs in all_references),
        inputs.rows.ctypes.data,
        inputs.switch_rows.ctypes.data,
        *(row.ctypes.data for row in rows),
    )
    struct.kept = (inputs, rows, all_references)  # alive as long as what points to them

    def start() -> None:
        instance.reset()
        instance.set_starts(case.given[inputs.component])
        instance.setup_experiment(start_time=0.0, stop_time=1e4)
        instance.enter_initialization_mode()
        instance.exit_initialization_mode()

    def advance(first: int, end: int) -> None:
        failed = run(byref(struct), first, end, case.step)
        assert failed == -1, (failed, instance.last_message())

    return Side(start, advance)


def in_c(library: CDLL, name: str, case: Case) -> Side:
    """Law or plant in C, its outputs in one struct."""
    one = InC(library, name, case)
    row = np.zeros(1, dtype=one.row)
    return Side(one.start, lambda first, end: one.advance(first, end, row))


def sides(stack: ExitStack, library: CDLL, fmu_dir: Path, case: Case) -> dict[str, Side]:
    """All that is measured, by name."""
    found: dict[str, Side] = {}
    given = {
        "law": Given("controller", "ArmController.fmu", SENSED, case.sensed),
        "arm": Given("plant", "ExoskeletonArm.fmu", FORCES, case.forces, ("vacuum",), case.vacuum),
    }
    for name, inputs in given.items():
        archive = stack.enter_context(Archive(fmu_dir / inputs.archive))
        for what, outputs in (("FMU", WIRED[name]), ("FMU, all outputs", archive.names("output"))):
            instance = stack.enter_context(Instance(archive, name))
            found[f"{name} {what}"] = played(library, instance, case, inputs, outputs)
    return found | {"law C": in_c(library, "law", case), "arm C": in_c(library, "plant", case)}


def timed(all_sides: dict[str, Side], steps: int) -> dict[str, float]:
    """Nanoseconds a step of each, the smallest of some turns."""
    times: dict[str, list[float]] = {name: [] for name in all_sides}
    for _ in range(REPETITIONS):
        for name, side in all_sides.items():
            side.start()
            began = perf_counter()
            side.advance(0, steps)
            times[name].append(perf_counter() - began)
    return {name: 1e9 * min(found) / steps for name, found in times.items()}


def play_counted(folder: Path) -> None:
    """What runs under callgrind: each side, first over steps that nobody counts."""
    case = pickle.loads((folder / "case").read_bytes())
    library = CDLL(str(folder / "same_arithmetic.so"))
    with ExitStack() as stack:
        for name, side in sides(stack, library, find_fmu_dir().resolve(), case).items():
            library.count_calls(False)
            side.start()
            side.advance(0, COUNTED.start)
            library.count_calls(True)
            side.advance(COUNTED.start, COUNTED.stop)
            print(name, flush=True)


def counted(folder: Path, case: Case) -> dict[str, float]:
    """Instructions a step of each; none without valgrind."""
    if which("valgrind") is None:
        print("NOT RUN: instructions; valgrind is missing")
        return {}
    (folder / "case").write_bytes(pickle.dumps(case))
    out = folder / "counts"
    tool = ["valgrind", "--quiet", "--tool=callgrind", "--instr-atstart=no", f"--callgrind-out-file={out}"]
    command = [*tool, sys.executable, __file__, "--counted", str(folder)]
    names = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True, check=True).stdout
    found: dict[str, float] = {}
    for i, name in enumerate(names.splitlines(), start=1):
        total = re.search(r"^totals: (\d+)", (folder / f"counts.{i}").read_text(), re.MULTILINE)
        found[name] = int(total[1] if total else 0) / len(COUNTED)
    return found


def measured(fmu_dir: Path, folder: Path) -> list[Row]:
    """All rows: ratios of times, and of instructions where they can be counted."""
    library = compiled(folder)
    _, case = recorded(SCENARIO, CASE, fmu_dir)
    with ExitStack() as stack:
        took = timed(sides(stack, library, fmu_dir, case), len(case.sensed))
    instructions = counted(folder, case)
    for name, time in took.items():
        count = f"{instructions[name]:9,.0f} instructions" if name in instructions else ""
        print(f"{name:24} {time:9,.0f} ns a step {count}")
    rows = []
    for name, what in (("law", "ArmController cycle / C law"), ("arm", "ExoskeletonArm step / C arm")):
        for unit, values in (("", took), (", instructions", instructions)):
            for shown in ("", ", all outputs"):
                if values:
                    ratio = values[f"{name} FMU{shown}"] / values[f"{name} C"]
                    rows.append(Row(f"{what}{shown}{unit}", ratio, *BOUNDS))
    return rows


def main() -> None:
    """Prints the table; exit code 1, if a figure is not what is asked for."""
    if sys.argv[1:2] == ["--counted"]:
        return play_counted(Path(sys.argv[2]))
    with tempfile.TemporaryDirectory() as folder:
        rows = measured(find_fmu_dir().resolve(), Path(folder))
    print(f"{platform.machine()}, {processor()}")
    for row in rows:
        told = f"{row.name:56} {row.value:8.3f}  at most {row.asked:.3g}, aim {row.aimed:.3g}"
        print(told if row.good else f"{told}  MISSED")
    if not all(row.good for row in rows):
        raise SystemExit(1)
    return None


if __name__ == "__main__":
    main()
