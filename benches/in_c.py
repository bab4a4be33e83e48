"""Law and arm in C: compiled, filled with a run's parameters, fed with a run's inputs."""

import subprocess
from collections.abc import Mapping
from ctypes import CDLL, POINTER, Structure, byref, c_char_p, c_double, c_int32, c_long, c_size_t, c_void_p, create_string_buffer
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from exo.recording import Recording

HERE = Path(__file__).parent
SOURCES = ("arm_law.c", "arm_plant.c", "arm_cycles.c")
#: No contraction, or the sums would round otherwise; what nobody looks at (errno, traps) is not kept, as in Rust.
FLAGS = ("-std=c99", "-O3", "-ffp-contract=off", "-fno-math-errno", "-fno-trapping-math", "-Wall", "-Wextra")

INPUTS = ("q[1]", "q[2]", "q[3]", "f_h[1]", "f_h[2]", "f_h[3]")


def compiled(folder: Path) -> CDLL:
    """All of it as one library."""
    library = folder / "same_arithmetic.so"
    sources = [HERE / name for name in SOURCES]
    subprocess.run(["cc", *FLAGS, "-shared", "-fPIC", "-o", library, *sources, "-lm"], check=True)
    return CDLL(str(library))


def names(library: CDLL, table: str) -> list[str]:
    """A table of names that ends with NULL."""
    found: list[str] = []
    pointers = (c_char_p * 1000).in_dll(library, table)
    while (name := pointers[len(found)]) is not None:
        found.append(name.decode())
    return found


class Law:
    """The law in C."""

    def __init__(self, library: CDLL, parameters: Mapping[str, float]) -> None:
        self.library = library
        self.reals, self.integers = names(library, "arm_law_real_names"), names(library, "arm_law_integer_names")
        self.row = np.dtype([("reals", "f8", len(self.reals)), ("integers", "i4", len(self.integers))])
        values = [float(parameters[name]) for name in names(library, "arm_law_parameter_names")]
        self.parameters = (c_double * len(values))(*values)
        self.state = create_string_buffer(library.law_size())
        self.run = library.law_cycles
        self.run.restype = c_long
        self.run.argtypes = [c_void_p, c_void_p, c_size_t, c_void_p, c_size_t]
        self.start()

    def start(self) -> None:
        self.library.arm_law_start(self.state, self.parameters)

    def replayed(self, inputs: NDArray[np.float64]) -> dict[str, NDArray[Any]]:
        """Outputs for rows of q and f_h, by name."""
        rows = np.zeros(len(inputs), dtype=self.row)
        failed = self.run(self.state, inputs.ctypes.data, len(inputs), rows.ctypes.data, 1)
        assert failed == -1, f"tick {failed}"
        reals = {name: rows["reals"][:, i] for i, name in enumerate(self.reals)}
        return reals | {name: rows["integers"][:, i] for i, name in enumerate(self.integers)}


class Plant:
    """The arm in C."""

    def __init__(self, library: CDLL, parameters: Mapping[str, float]) -> None:
        self.library = library
        self.reals, self.booleans = names(library, "arm_plant_real_names"), names(library, "arm_plant_boolean_names")
        self.row = np.dtype([("reals", "f8", len(self.reals)), ("booleans", "i4", len(self.booleans))])
        values = [float(parameters[name]) for name in names(library, "arm_plant_parameter_names")]
        self.parameters = (c_double * len(values))(*values)
        self.state = create_string_buffer(library.plant_size())
        self.run = library.plant_cycles
        self.run.restype = c_long
        self.run.argtypes = [c_void_p, c_void_p, c_void_p, c_size_t, c_double, c_void_p, c_size_t]
        self.start()

    def start(self) -> None:
        self.library.arm_plant_start(self.state, self.parameters)

    def replayed(self, inputs: NDArray[np.float64], vacuum: NDArray[np.int32], step: float) -> dict[str, NDArray[Any]]:
        """Outputs for rows of tau_a, f_h and f_d, by name."""
        rows = np.zeros(len(inputs), dtype=self.row)
        failed = self.run(self.state, inputs.ctypes.data, vacuum.ctypes.data, len(inputs), step, rows.ctypes.data, 1)
        assert failed == -1, f"step {failed}"
        reals = {name: rows["reals"][:, i] for i, name in enumerate(self.reals)}
        return reals | {name: rows["booleans"][:, i] for i, name in enumerate(self.booleans)}


def inputs_of(run: Recording, component: str, names: tuple[str, ...]) -> NDArray[np.float64]:
    """Recorded inputs of a component, a row for each step."""
    return np.ascontiguousarray(np.column_stack([run[f"{component}.{name}"] for name in names]))


def parameters_of(run: Recording, component: str) -> dict[str, float]:
    """Its parameters as the FMU held them."""
    prefix = f"{component}."
    return {name.removeprefix(prefix): value for name, value in run.parameters.items() if name.startswith(prefix)}
