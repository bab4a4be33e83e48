"""Inputs that every importer gives to an FMU: the same numbers at the same instants."""

import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from exo.fmu import Archive

#: How far a Real input swings about its start value, by unit: no FMU stays at rest, none leaves its range.
SWING = {"rad": 0.1, "m": 0.02, "m/s": 0.1, "rad/s": 0.5, "N": 12.0, "N.m": 40.0}
#: Without a segment and a hand the operator does nothing; without noise the arm's sensor shows no clock; the arm meets
#: the table with a payload, the arms hold one; the controller's nominal meets a limit of its speed.
SETTINGS: dict[str, dict[str, bool | float | int]] = {
    "ArmController": {"dp_n_max[3]": 0.01},
    "ExoskeletonArm": {"ft.noise": 0.2, "table.z": -0.3771, "payload.m": 17.5, "payload.attached": True},
    "ExoskeletonArms": {"payload.m": 35.0, "payload.attached": True, "table.z": -0.3771},
    "HumanOperator": {
        "segment[1].axis": 3,
        "segment[1].kind": 2,
        "segment[1].t_on": 0.1,
        "segment[1].amplitude": 6.0,
        "k_h": 50.0,
        "b_h": 1.0,
        "delay": 0.01,
    },
}


@dataclass(frozen=True)
class Record:
    """What is set before initialization, and what before each step."""

    settings: dict[str, bool | float | int]
    #: Communication step (s).
    step: float
    #: When each step begins (s).
    time: NDArray[np.float64]
    inputs: dict[str, NDArray[np.float64]]

    @property
    def end(self) -> float:
        """End of the last step (s)."""
        return len(self.time) * self.step

    def within(self, component: str) -> "Record":
        """The same for the FMU as a component of a container."""
        return Record(
            settings={f"{component}.{name}": value for name, value in self.settings.items()},
            step=self.step,
            time=self.time,
            inputs={f"{component}.{name}": values for name, values in self.inputs.items()},
        )

    def write(self, path: Path) -> None:
        """As CSV, with the digits that read back to the same bits."""
        rows = zip(self.time.tolist(), *(values.tolist() for values in self.inputs.values()), strict=True)
        lines = [",".join(("t", *self.inputs))] + [",".join(map(repr, row)) for row in rows]
        path.write_text("\n".join(lines) + "\n")


def record(archive: Archive, *, steps: int) -> Record:
    """Every Real input swings, each at its own frequency; every Boolean is away from its start value at first, each
    for its own time; an Integer counts up every tenth step."""
    T = float(archive.description.defaultExperiment.stepSize)
    k = np.arange(steps)
    inputs = {}
    for i, name in enumerate(archive.names("input")):
        variable = archive.variable(name)
        match variable.type:
            case "Real":
                f = 1.0 + 0.37 * i
                swing = SWING[variable.unit] * np.sin(2.0 * math.pi * f * k * T + 0.9 * i)
                inputs[name] = float(variable.start) + swing
            case "Boolean":
                away = k < steps // 4 + 5 * i
                inputs[name] = (away == (variable.start == "false")).astype(np.float64)
            case "Integer":
                inputs[name] = np.floor(k / 10.0)
    return Record(settings=SETTINGS.get(archive.path.stem, {}), step=T, time=k * T, inputs=inputs)
