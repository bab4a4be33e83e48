"""Systems of FMI 3.0 twins in a container of fmu-manipulation-toolbox: arrays are linked whole, and the C library
that it puts into the container calls them.

The toolbox' description of an array that can be set is refused by the official schema (it writes `<Start>`, which only
Strings and Binaries have), so the container shows outputs only and has its start values inside.
"""

import logging
import shutil
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import fmpy
import numpy as np
from fmu_manipulation_toolbox.container import FMUContainer

from exo.master import Plan

from foreign.runs import Outputs
from foreign.twin import Twin, expanded, place

Link = tuple[tuple[str, str], tuple[str, str]]


@dataclass(frozen=True)
class Box:
    """A system: components in the order in which they step, links of whole variables, what makes it move."""

    components: dict[str, str]
    #: (component, output) → (component, input).
    links: tuple[Link, ...]
    start: dict[str, float | int]
    step: float

    def plan(self, duration: float) -> Plan:
        """The same system for the harness, element by element."""
        inputs = {}
        for (source, output), (target, given) in self.links:
            for element in ("[1]", "[2]", "[3]") if self.step == ARM_STEP else ("",):
                inputs[f"{target}.{given}{element}"] = f"{source}.{output}{element}"
        return Plan(
            components=self.components,
            parameters=self.start,
            inputs=inputs,
            delayed=(),
            profiles={},
            coupling="zero_delay",
            duration=duration,
            step=self.step,
        )


ARM_STEP = 0.001
PUSH = {"operator.segment[1].axis": 3, "operator.segment[1].amplitude": 6.0, "operator.segment[2].amplitude": -4.0}


def _arm(plant: str, prefix: str) -> Box:
    links = (
        (("plant", f"{prefix}q"), ("controller", "q")),
        (("operator", "f_h"), ("controller", "f_h")),
        (("controller", "tau_a"), ("plant", f"{prefix}tau_a")),
        (("operator", "f_h"), ("plant", f"{prefix}f_h")),
        (("plant", f"{prefix}p"), ("operator", "p")),
        (("plant", f"{prefix}dp"), ("operator", "dp")),
    )
    components = {"controller": "ArmController.fmu", "plant": plant, "operator": "HumanOperator.fmu"}
    return Box(components=components, links=links, start=PUSH, step=ARM_STEP)


#: Every twin is in one of them.
BOXES = {
    "testbed": Box(
        components={"controller": "TestbedController.fmu", "plant": "Testbed.fmu"},
        links=((("plant", "q"), ("controller", "q")), (("controller", "tau_a"), ("plant", "tau_a"))),
        start={"controller.tau_h": 2.0, "plant.tau_h": 2.0},
        step=0.002,
    ),
    "arm": _arm("ExoskeletonArm.fmu", ""),
    "arms": _arm("ExoskeletonArms.fmu", "left."),
}


def run(box: Box, duration: float, folder3: Path, folder: Path) -> Outputs:
    """The container's outputs as the harness records them, by the same names."""
    for file in box.components.values():
        shutil.copy(folder3 / file, folder / file)
    logging.getLogger("fmu_manipulation_toolbox").setLevel(logging.CRITICAL)  # inputs that nothing is linked to
    container = FMUContainer("box", folder, fmi_version=3)
    container.start_time, container.stop_time = 0.0, duration
    for file in box.components.values():
        container.get_fmu(file)
    for (source, output), (target, given) in box.links:
        container.add_link(box.components[source], output, box.components[target], given)
    discrete: dict[str, bool] = {}
    for name, file in box.components.items():
        twin = Twin(folder3 / file)
        starts: dict[str, list[Any]] = {}
        for key, value in box.start.items():
            if key.split(".", 1)[0] == name:
                array, element = place(key.split(".", 1)[1])
                variable = twin.variables[array]
                whole = variable.start.split() if variable.shape else [variable.start]
                starts.setdefault(array, whole)[element] = value
        for array, values in starts.items():
            container.add_start_value(file, array, " ".join(str(value) for value in values))
        for variable in twin.outputs:
            container.add_output(file, variable.name, f"{name}.{variable.name}")
            discrete |= {f"{name}.{key}": variable.variability == "discrete" for key in expanded(variable)}
    container.make_fmu("box.fmu", step_size=box.step, sequential=True)
    result = fmpy.simulate_fmu(str(folder / "box.fmu"), stop_time=duration, output_interval=box.step)
    columns = {}
    for name in result.dtype.names[1:]:
        values = np.atleast_2d(result[name].T)
        names = [f"{name}[{i + 1}]" for i in range(len(values))] if result[name].ndim > 1 else [name]
        columns |= dict(zip(names, values.astype(np.float64), strict=True))
    return {key: values[1:] if discrete[key] else values[:-1] for key, values in columns.items()}
