"""Controller and arm beside the same arithmetic in C.

The inputs are those of the scenario arm_payload, recorded: the pad lands, presses, grips, comes off the table, carries,
sets down. That they compute the same is what
`tests/system/test_same_arithmetic.py` shows, bit for bit.

| side | what is measured |
|---|---|
| FMU | Set, DoStep and Get through the C interface: of the inputs that wires carry and the outputs that wires take |
| FMU, all outputs | the same with a Get of every output, as a recording needs it |
| C | `arm_law.c`, `arm_plant.c`: inputs copied in, a tick or a step, every output in a struct |

The second column is instructions, counted by callgrind: it knows no noise, and no cache either.
"""

import pickle
import re
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import ExitStack
from ctypes import CDLL, Structure, byref, c_double, c_long, c_size_t, c_void_p, cast
from dataclasses import dataclass, field
from pathlib import Path
from shutil import which
from time import thread_time

import numpy as np
from numpy.typing import NDArray

from benches.in_c import FORCES, SENSED, Case, InC, compiled, recorded
from benches.row import Bench, Found, NotRun, Row
from benches.turns import in_turns, pinned
from exo.fmu import DTYPES, Archive, Instance, find_fmu_dir

SCENARIO, CASE = "arm_payload", "passive_bounded_17.5kg"
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


def once(side: Side, steps: int) -> float:
    """Processor seconds of a run from its start."""
    side.start()
    began = thread_time()
    side.advance(0, steps)
    return thread_time() - began


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
        return {}
    (folder / "case").write_bytes(pickle.dumps(case))
    out = folder / "counts"
    tool = ["valgrind", "--quiet", "--tool=callgrind", "--instr-atstart=no", f"--callgrind-out-file={out}"]
    command = [*tool, sys.executable, "-m", "benches.same_arithmetic", "--counted", str(folder)]
    names = subprocess.run(
        command, cwd=Path(__file__).parents[1], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True, check=True
    ).stdout
    found: dict[str, float] = {}
    for i, name in enumerate(names.splitlines(), start=1):
        total = re.search(r"^totals: (\d+)", (folder / f"counts.{i}").read_text(), re.MULTILINE)
        found[name] = int(total[1] if total else 0) / len(COUNTED)
    return found


def measure(bench: Bench) -> Iterator[Found]:
    """The rows: ratios of times, and of instructions where they can be counted."""
    library = compiled(bench.work)
    _, case = recorded(SCENARIO, CASE, bench.fmu_dir)
    steps = len(case.sensed)
    with ExitStack() as stack, pinned():
        work = {
            name: lambda side=side: once(side, steps)  # type: ignore[misc]
            for name, side in sides(stack, library, bench.fmu_dir, case).items()
        }
        times = in_turns(work, bench.rounds)
    instructions = counted(bench.work, case)
    if not instructions:
        yield NotRun(name="instructions beside the same arithmetic in C", reason="valgrind is not on PATH")
    for name, what in (("law", "ArmController cycle / C law"), ("arm", "ExoskeletonArm step / C arm")):
        for shown in ("", ", all outputs"):
            ours, theirs = f"{name} FMU{shown}", f"{name} C"
            ns = [1e9 * times.median(one) / steps for one in (ours, theirs)]
            yield Row(
                name=f"{what}{shown}",
                value=times.ratio(ours, theirs),
                spread=times.spread(ours, theirs),
                limit=BOUNDS[0],
                aim=BOUNDS[1],
                told=f"{ns[0]:,.0f} ns / {ns[1]:,.0f} ns",
            )
            if instructions:
                yield Row(
                    name=f"{what}{shown}, instructions",
                    value=instructions[ours] / instructions[theirs],
                    limit=BOUNDS[0],
                    aim=BOUNDS[1],
                    told=f"{instructions[ours]:,.0f} / {instructions[theirs]:,.0f}",
                )


if __name__ == "__main__" and sys.argv[1:2] == ["--counted"]:
    play_counted(Path(sys.argv[2]))
