"""Law and arm in C: compiled, filled with a run's parameters, fed with a run's inputs."""

import subprocess
from collections.abc import Mapping
from contextlib import ExitStack
from ctypes import CDLL, c_char_p, c_double, c_long, c_size_t, c_void_p, create_string_buffer
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from exo import master
from exo.fmu import Archive
from exo.loop import fastest
from exo.recording import Recording
from exo.scenario import load

HERE = Path(__file__).parent
SOURCES = ("arm_law.c", "arm_plant.c", "arm_cycles.c")
#: No contraction, or sums would round otherwise; errno and traps, at which nobody looks, are not kept, as in Rust.
FLAGS = ("-std=c99", "-O3", "-ffp-contract=off", "-fno-math-errno", "-fno-trapping-math", "-Wall", "-Wextra", "-Werror")

#: What is set at each step, in the order of the rows.
SENSED = tuple(f"{name}[{i}]" for name in ("q", "f_h") for i in (1, 2, 3))
FORCES = tuple(f"{name}[{i}]" for name in ("tau_a", "f_h", "f_d") for i in (1, 2, 3))


def compiled(folder: Path, *, flags: tuple[str, ...] = FLAGS) -> CDLL:
    """All of it as one library in `folder`."""
    library = folder / "same_arithmetic.so"
    sources = [HERE / name for name in SOURCES]
    subprocess.run(["cc", *flags, "-shared", "-fPIC", "-o", library, *sources, "-lm"], check=True)
    return CDLL(str(library))


@dataclass(frozen=True)
class Case:
    """A case of a scenario, run: what law and arm got in it, and what they are made of."""

    #: Parameters that the case sets, and all that the FMUs had, by component.
    given: Mapping[str, Mapping[str, Any]]
    all: Mapping[str, Mapping[str, float]]
    step: float
    #: (steps, 6) of SENSED, (steps, 9) of FORCES, (steps, 1) of the vacuum's switch.
    sensed: NDArray[np.float64]
    forces: NDArray[np.float64]
    vacuum: NDArray[np.int32]


def recorded(scenario: str, case: str, fmu_dir: Path, **parameters: Any) -> tuple[Recording, Case]:
    """Runs a case of a scenario, with other `parameters`, `component__name`, if there are any."""
    loaded = load(scenario)
    plan = master.plan(scenario=loaded, case=next(one for one in loaded.cases if one.id == case))
    others = {name.replace("__", "."): value for name, value in parameters.items()}
    plan = replace(plan, parameters={**plan.parameters, **others})
    with ExitStack() as stack:
        archives = {name: stack.enter_context(Archive(fmu_dir / name)) for name in set(plan.components.values())}
        run = master.simulate(plan=plan, archives=archives, engine=fastest())
    zeros = np.zeros(len(run.time))

    def rows(component: str, names: tuple[str, ...]) -> NDArray[np.float64]:
        columns = [run.columns[full] if (full := f"{component}.{name}") in run.columns else zeros for name in names]
        return np.ascontiguousarray(np.column_stack(columns), dtype=np.float64)

    def of(component: str, values: Mapping[str, Any]) -> dict[str, Any]:
        return {key.split(".", 1)[1]: value for key, value in values.items() if key.split(".", 1)[0] == component}

    return run, Case(
        given={name: of(name, plan.parameters) for name in plan.components},
        all={name: of(name, run.parameters) for name in plan.components},
        step=plan.step,
        sensed=rows("controller", SENSED),
        forces=rows("plant", FORCES),
        vacuum=rows("plant", ("vacuum",)).astype(np.int32),
    )


def _names(library: CDLL, table: str) -> list[str]:
    """A table of names that ends with NULL."""
    found: list[str] = []
    pointers = (c_char_p * 1000).in_dll(library, table)
    while (name := pointers[len(found)]) is not None:
        found.append(name.decode())
    return found


class InC:
    """Law (`law`) or arm (`plant`) in C, of a case."""

    def __init__(self, library: CDLL, name: str, case: Case) -> None:
        component = {"law": "controller", "plant": "plant"}[name]
        flags = {"law": "integer", "plant": "boolean"}[name]
        self.reals = _names(library, f"arm_{name}_real_names")
        self.flags = _names(library, f"arm_{name}_{flags}_names")
        self.row = np.dtype([("reals", "f8", len(self.reals)), ("flags", "i4", len(self.flags))])
        values = [float(case.all[component][one]) for one in _names(library, f"arm_{name}_parameter_names")]
        self._parameters = (c_double * len(values))(*values)
        self._state = create_string_buffer(library[f"{name}_size"]())
        self._begin = library[f"arm_{name}_start"]
        self._run = library[f"{name}_cycles"]
        self._run.restype = c_long
        self._run.argtypes = [*[c_void_p] * 3, c_size_t, c_size_t, c_double, c_void_p, c_size_t]
        self._inputs = case.sensed if name == "law" else case.forces
        self._case = case
        self.start()

    def start(self) -> None:
        """At t = 0."""
        self._begin(self._state, self._parameters)

    def advance(self, first: int, end: int, rows: NDArray[Any], *, stride: int = 0) -> None:
        """Makes the steps `first` to before `end`; outputs go into `rows`, the next row after `stride` of them."""
        inputs, switch = self._inputs.ctypes.data, self._case.vacuum.ctypes.data
        failed = self._run(self._state, inputs, switch, first, end, self._case.step, rows.ctypes.data, stride)
        assert failed == -1, f"step {failed} is not covered in C"

    def replayed(self) -> dict[str, NDArray[Any]]:
        """Outputs of all steps, by name."""
        rows = np.zeros(len(self._inputs), dtype=self.row)
        self.start()
        self.advance(0, len(rows), rows, stride=1)
        found = {name: rows["reals"][:, i] for i, name in enumerate(self.reals)}
        return found | {name: rows["flags"][:, i] for i, name in enumerate(self.flags)}
