"""A system without inputs from outside, for tools that connect components only (Ecos, libcosim).

What a profile of the scenario drives has another source here:

* a force on one axis: a `HumanOperator`, whose segments are the profile's, along its x axis;
* a Boolean: the start value of the input, true where the profile is ever true. `engage` is true, which suits tools that
  exchange before the first step; `vacuum` sucks from the start and does not let go.
"""

from collections.abc import Iterable, Mapping
from dataclasses import replace
from math import pi

from exo.errors import ScenarioError
from exo.master import TRUE_FROM, Plan
from exo.scenario import PROFILE, Segment, Value
from exo.systems import system
from exo.systems.system import ENGAGE, System

#: Appended to the system's name.
CLOSED = "Closed"
OPERATOR = "operator"
#: Component and archive that make a force where the system has none that does.
HAND = (OPERATOR, "HumanOperator.fmu")
#: The output that is the force along x.
FORCE = f"{OPERATOR}.f_h[1]"
#: Profiles that are a force; the others of the recipes switch Booleans.
FORCES = ("tau_h",)


def load(name: str, *, default: str | None = None) -> System:
    """The closed system of this name, `<system>Closed`, from the scenarios as they are now."""
    open_system = system.load(name, default=default)
    plans = case_plans(name)
    first = plans[open_system.default]
    return replace(
        open_system,
        name=f"{name}{CLOSED}",
        title=f"{open_system.title.split(';')[0]}; without inputs from outside",
        components=first.components,
        connections=first.inputs,
        inputs={},
        parameter_sets={key: one.parameters for key, one in plans.items()},
    )


def case_plans(name: str) -> dict[str, Plan]:
    """The closed system's cases by the name of their parameter set."""
    wiring = {target: source for source, targets in system.load(name).inputs.items() for target in targets}
    return {key: _closed(plan, wiring) for key, plan in system.case_plans(name).items()}


def _closed(plan: Plan, wiring: Mapping[str, str]) -> Plan:
    """The case with all of the system's inputs, those that only other cases wire too, driven from inside."""
    components, inputs, parameters = dict(plan.components), dict(plan.inputs), dict(plan.parameters)
    for target, name in wiring.items():
        segments = plan.profiles.get(name, ())
        if name in FORCES:
            inputs[target] = FORCE
            if OPERATOR not in components:
                components |= dict([HAND])
                parameters |= as_segments(segments)
        else:
            inputs.pop(target, None)
            if name == ENGAGE or _ever_true(segments):
                parameters[target] = True
    if left := sorted(target for target, source in inputs.items() if source.startswith(f"{PROFILE}.")):
        raise ScenarioError(f"{', '.join(left)}: driven by a profile, which a closed system does not have")
    return replace(plan, components=components, inputs=inputs, parameters=parameters, profiles={})


def as_segments(segments: Iterable[Segment]) -> dict[str, Value]:
    """A profile as parameters of the operator, along x. A sine's phase counts from t = 0 there, here from `t_on`."""
    found: dict[str, Value] = {}
    for i, segment in enumerate(segments, start=1):
        if segment.kind not in ("sine", "constant"):
            raise ScenarioError(f"a {segment.kind} segment: HumanOperator has sine and constant only")
        values: dict[str, Value] = {
            "axis": 1,
            "kind": segment.kind,
            "amplitude": segment.amplitude,
            "t_on": segment.t_on,
            "ramp": segment.ramp,
        }
        if segment.t_off is not None:
            values["t_off"] = segment.t_off
        if segment.kind == "sine":
            values["frequency"] = segment.frequency
            values["phase"] = segment.phase - 2.0 * pi * segment.frequency * segment.t_on
        found |= {f"{OPERATOR}.segment[{i}].{key}": value for key, value in values.items()}
    return found


def _ever_true(segments: Iterable[Segment]) -> bool:
    return any(segment.amplitude >= TRUE_FROM for segment in segments)
