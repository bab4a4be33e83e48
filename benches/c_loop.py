"""`loop.c` from Python: the same instances and buffers as the engines have."""

from ctypes import CDLL, POINTER, Structure, byref, c_double, c_long, c_size_t, c_uint32, c_void_p, cast
from time import thread_time
from typing import Any

import numpy as np

from benches import native
from benches.row import Bench
from exo import loop
from exo.coupled import Coupled
from exo.loop import Part


class Fmu(Structure):
    """`struct fmu` of loop.c."""

    _fields_ = (
        *((name, c_void_p) for name in ("instance", "do_step", "set_real", "get_real", "get_integer", "get_boolean")),
        *((name, c_void_p) for name in ("inputs", "reals", "integers", "booleans")),
        *((f"{name}_count", c_size_t) for name in ("inputs", "reals", "integers", "booleans")),
        *((name, c_void_p) for name in ("input_rows", "real_rows", "integer_rows", "boolean_rows")),
    )


def load(bench: Bench) -> CDLL:
    """The library."""
    return CDLL(str(native.library(bench, "loop")))


def struct_of(part: Part) -> Fmu:
    """An FMU's functions, references and buffers."""

    def function(name: str) -> int:
        return int(cast(part.instance.function(name), c_void_p).value or 0)

    def references(kind: Any) -> tuple[int, int]:
        found = part.outputs.get(kind)
        return (found.address, found.count) if found else (0, 0)

    def rows(kind: Any) -> int:
        return int(part.y[kind].ctypes.data) if kind in part.y else 0

    kinds = ("Real", "Integer", "Boolean")
    given = part.inputs.get("Real")
    outputs = [references(kind) for kind in kinds]
    return Fmu(
        part.instance.component,
        *(function(f"fmi2{name}") for name in ("DoStep", "SetReal", "GetReal", "GetInteger", "GetBoolean")),
        given.address if given else 0,
        *(address for address, _ in outputs),
        given.count if given else 0,
        *(count for _, count in outputs),
        part.u["Real"].ctypes.data if given else 0,
        *(rows(kind) for kind in kinds),
    )


def alone(library: CDLL, part: Part, steps: int, step: float) -> float:
    """Processor seconds of set, step and get of one FMU, `steps` times, over an instance that is just initialized."""
    run = library.alone
    run.restype = c_long
    run.argtypes = [POINTER(Fmu), c_size_t, c_double]
    struct = struct_of(part)
    began = thread_time()
    failed = run(byref(struct), steps, step)
    took = thread_time() - began
    assert failed == -1, part.instance.fail(f"step {failed}", 3)
    return took


def pair(library: CDLL, coupled: Coupled, steps: int, step: float, *, first: int = 0) -> float:
    """Processor seconds of the testbed's pair in a loop by hand, over instances that stand at step `first`."""
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
    run.argtypes = [POINTER(Fmu), POINTER(Fmu), *[c_size_t] * 6, c_double]
    began = thread_time()
    failed = run(byref(structs[0]), byref(structs[1]), *columns, first, steps, step)
    took = thread_time() - began
    assert failed == -1, failed
    return took


def empty(library: CDLL, steps: int, step: float) -> float:
    """Processor seconds of the native engine over two FMUs that do nothing: a Set, three Gets each, and the wires."""
    transfer, do_step = (
        int(cast(getattr(library, name), c_void_p).value or 0) for name in ("empty_transfer", "empty_step")
    )
    rows = np.zeros((steps + 1, 8))
    references = (c_uint32 * 8)()
    address = cast(references, c_void_p).value or 0
    call = (transfer, address, 8, rows.ctypes.data, rows.strides[0])
    copy = (rows.ctypes.data, rows.strides[0], rows.ctypes.data + 8, rows.strides[0], 8, False)
    component = (1, do_step, [copy], [call], [call, call, call])
    began = thread_time()
    assert loop.native().run([component, component], first=0, steps=steps, step=step) is None
    return thread_time() - began
