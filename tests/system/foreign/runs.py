"""A record of inputs through each importer: the outputs after each step, by name.

Every importer sets the first row before initialization ends; then, for every row, sets it, steps and reads. They differ
in the last bit of times and step sizes, of which an arm that touches a table makes 1e-10 N: so each is compared with
calls at the instants of its own clock.
"""

import os
import subprocess
from collections.abc import Callable, Mapping
from pathlib import Path

import fmpy
import numpy as np
from numpy.typing import NDArray

from exo.fmu import DTYPES, Archive, Instance
from exo.systems import container
from exo.systems.system import System

from foreign.cosim import cosim
from foreign.record import Record

Outputs = Mapping[str, NDArray[np.float64]]
#: Instants and step sizes (s).
Times = list[tuple[float, float]]
Clock = Callable[[Record], Times]
#: The only component of a container.
BOX = "one"


def outputs(archive: Archive) -> list[str]:
    """Names of the outputs that are numbers."""
    return [name for name in archive.names("output") if archive.variable(name).type in DTYPES]


def product(record: Record) -> Times:
    """k·T, and T."""
    return [(k * record.step, record.step) for k in range(len(record.time))]


def difference(record: Record) -> Times:
    """k·T, and (k + 1)·T − k·T."""
    return [(k * record.step, (k + 1) * record.step - k * record.step) for k in range(len(record.time))]


def nanoseconds(record: Record) -> Times:
    """Whole nanoseconds, as libcosim counts them, in seconds; and the difference of two such instants."""
    ns = round(record.step * 1e9)
    return [(k * ns / 1e9, (k + 1) * ns / 1e9 - k * ns / 1e9) for k in range(len(record.time))]


def by_calls(archive: Archive, record: Record, clock: Clock) -> Outputs:
    """fmpy's library object, called as the harness calls it: what the importers are compared with."""
    names = outputs(archive)
    found = []
    with Instance(archive, BOX) as instance:
        inputs = instance.references(list(record.inputs))
        columns = {kind: np.array([record.inputs[n] for n in r.names]).T for kind, r in inputs.items() if r}
        for name, value in record.settings.items():
            instance.set_start(name, value)

        def apply(k: int) -> None:
            for kind, rows in columns.items():
                instance.write(inputs[kind], np.ascontiguousarray(rows[k], dtype=DTYPES[kind]))

        instance.setup_experiment(start_time=0.0, stop_time=record.end)
        apply(0)
        instance.enter_initialization_mode()
        instance.exit_initialization_mode()
        for k, (t, step) in enumerate(clock(record)):
            apply(k)
            instance.do_step(t, step)
            found.append(list(instance.values(names).values()))
        instance.terminate()
    return dict(zip(names, np.array(found, dtype=np.float64).T, strict=True))


def by_simulate(archive: Archive, record: Record, _folder: Path) -> Outputs:
    """`fmpy.simulate_fmu`, which unpacks the archive, applies the inputs and records by itself."""
    names = outputs(archive)
    dtype = [("time", np.float64)] + [(name, DTYPES[archive.variable(name).type]) for name in record.inputs]
    signals = np.array(list(zip(record.time, *record.inputs.values(), strict=True)), dtype=dtype)
    result = fmpy.simulate_fmu(
        str(archive.path),
        stop_time=record.end,
        output_interval=record.step,
        start_values=record.settings,
        input=signals,
        output=names,
    )
    return {name: result[name][1:].astype(np.float64) for name in names}


def by_cosim(archive: Archive, record: Record, _folder: Path, tolerated: tuple[str, ...] = ()) -> Outputs:
    """libcosim."""
    first = {name: values[0] for name, values in record.inputs.items()}
    found = cosim(
        {
            "step_ns": round(record.step * 1e9),
            "steps": len(record.time),
            "instances": {BOX: str(archive.path)},
            "start": {f"{BOX}.{name}": value for name, value in (record.settings | first).items()},
            "connections": {},
            "inputs": {f"{BOX}.{name}": values.tolist() for name, values in record.inputs.items()},
            "outputs": [f"{BOX}.{name}" for name in outputs(archive)],
        },
        tolerated=tolerated,
    )
    return {key.removeprefix(f"{BOX}."): np.array(values, dtype=np.float64) for key, values in found.items()}


def program() -> Path:
    """The `fmi` crate as a program."""
    root = Path(__file__).parents[3]
    path = Path(os.environ.get("EXO_FMI_CRATE", root / "target" / "debug" / "fmi_crate"))
    assert path.is_file(), f"{path} is missing: run `cargo test --package importers` first"
    return path


def by_fmi_crate(archive: Archive, record: Record, folder: Path) -> Outputs:
    """The `fmi` crate."""
    given, made = folder / "in.csv", folder / "out.csv"
    record.write(given)
    settings = [f"{name}={float(value)!r}" for name, value in record.settings.items()]
    answer = subprocess.run(
        [program(), archive.path, repr(record.step), given, made, *settings],
        capture_output=True,
        text=True,
        check=False,
    )
    assert answer.returncode == 0, answer.stderr
    lines = made.read_text().splitlines()
    table = np.array([[float(number) for number in line.split(",")] for line in lines[1:]])
    assert table[:, 0].tolist() == record.time.tolist()
    return dict(zip(lines[0].split(",")[1:], table[:, 1:].T, strict=True))


def in_container(archive: Archive, record: Record, folder: Path) -> Outputs:
    """A container of fmu-manipulation-toolbox that holds this FMU alone, called through fmpy."""
    boxed = System(
        name=f"{archive.path.stem}Alone",
        title="One FMU",
        components={BOX: archive.path.name},
        connections={},
        inputs={},
        parameter_sets={},
        default="",
        step=record.step,
        duration=record.end,
    )
    path = container.write(system=boxed, archives={archive.path.name: archive}, folder=folder)
    with Archive(path) as box:
        found = by_calls(box, record.within(BOX), product)
    return {name.removeprefix(f"{BOX}."): values for name, values in found.items()}


#: Importer, as `matrix.toml` names it → how it runs a record, and its clock.
RUNS: dict[str, tuple[Callable[[Archive, Record, Path], Outputs], Clock]] = {
    "fmpy": (by_simulate, difference),
    "libcosimpy": (by_cosim, nanoseconds),
    "fmi crate": (by_fmi_crate, product),
    "fmu-manipulation-toolbox": (in_container, product),
}
