"""A closed SSP archive through the importers that run one: the outputs after each step."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from fmpy.ssp.simulation import simulate_ssp
from fmpy.ssp.ssd import ParameterSet, read_ssd

from exo.systems.system import System

from foreign.cosim import cosim
from foreign.ecos import ecos

Outputs = dict[str, list[float]]


def through_ecos(path: Path, data: System, steps: int, outputs: Mapping[str, str]) -> Outputs:
    """Ecos, which is told the name of the set."""
    job = {"ssp": str(path), "set": data.default, "step": data.step, "steps": steps, "outputs": dict(outputs)}
    return ecos(job)


def through_libcosim(path: Path, data: System, steps: int, outputs: Mapping[str, str]) -> Outputs:
    """libcosim, which applies the first set that is bound. `path` may be a description in an unpacked archive."""
    nothing: dict[str, Any] = {"instances": {}, "start": {}, "connections": {}, "inputs": {}}
    step = round(data.step * 1e9)
    return cosim({"ssp": str(path), "step_ns": step, "steps": steps, "outputs": list(outputs)} | nothing)


def through_fmpy(path: Path, data: System, steps: int, outputs: Mapping[str, str]) -> Outputs:
    """fmpy, which is handed what is bound: it applies no binding by itself."""
    return _fmpy(path, data, steps, outputs, bound_in(path, data.default))


def through_fmpy_alone(path: Path, data: System, steps: int, outputs: Mapping[str, str]) -> Outputs:
    """fmpy without parameters of ours."""
    return _fmpy(path, data, steps, outputs, None)


def bound_in(path: Path, name: str) -> ParameterSet:
    """What the components bind, as one set with the names of the system."""
    together = ParameterSet(name=name)
    for component in read_ssd(str(path)).system.elements:
        for binding in component.parameterBindings:
            for bound in binding.parameterValues:
                for one in bound.parameters:
                    one.name = f"{component.name}.{one.name}"
                    together.parameters.append(one)
    return together


def _fmpy(path: Path, data: System, steps: int, outputs: Mapping[str, str], given: ParameterSet | None) -> Outputs:
    # Half a step short of the end, so that no rounding of the summed time adds a step.
    stop = (steps - 0.5) * data.step
    found = simulate_ssp(str(path), stop_time=stop, step_size=data.step, parameter_set=given)
    return {key: found[key].tolist() for key in outputs}
