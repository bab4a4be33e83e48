"""What a coupled system is: FMUs, connections, inputs from outside and parameter sets, all taken from the scenarios.

| system | FMUs | parameter sets, one a case of |
|---|---|---|
| `TestbedSystem` | controller, plant | `gain_study`, `wall` |
| `ExoskeletonSystem` | controller, plant, operator | `arm_performance`, `arm_contact`, `arm_payload` (Exp 1 to 3) |

A system with a controller that has presets gets a parameter set `preset-<name>` for each: the preset's gains, and
everything else at the start values of the FMUs.

The tools that run such a system exchange all values at once: the harness' `exchange_at_once`. Two things follow, which
are the only ones that do not come from a scenario:

* the torque comes one tick late, so that every parameter set has `controller.delay = 1` (its energy ledger must know);
* fmpy steps once before it exchanges for the first time. `controller.engage` is therefore an input of the system: held
  at false until the first exchange, the controller does not engage where no position has been read.

Tools that connect components only run the same systems without inputs: `exo.systems.closed`.
"""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace

from exo import presets
from exo import scenario as scenarios
from exo.errors import ScenarioError, close_matches
from exo.master import Plan, plan
from exo.naming import elements
from exo.scenario import PROFILE, Value

#: Input of each system that lets its controller begin.
ENGAGE = "engage"
#: What every case gets because values are exchanged at once.
LATE = {"controller.delay": 1}


@dataclass(frozen=True)
class Recipe:
    """A system by the scenarios that it can run."""

    title: str
    scenarios: tuple[str, ...]
    #: The parameter set that holds where a tool is told nothing.
    default: str


RECIPES = {
    "TestbedSystem": Recipe(
        title="Admittance controller and testbed; tau_h is the human's force (N), engage lets the controller begin",
        scenarios=("gain_study", "wall"),
        default="wall-passive_bounded_5_0.5",
    ),
    "ExoskeletonSystem": Recipe(
        title="Arm controller, arm and operator; vacuum switches the suction pad, engage lets the controller begin",
        scenarios=("arm_performance", "arm_contact", "arm_payload"),
        default="arm_contact-passive_bounded",
    ),
}


@dataclass(frozen=True, kw_only=True)
class System:
    """FMUs that are wired, and what their parameters can be."""

    name: str
    title: str
    #: Component → archive, in the order in which they step.
    components: Mapping[str, str]
    #: Input → output, both as `component.variable`.
    connections: Mapping[str, str]
    #: Input of the system → inputs of components that it drives.
    inputs: Mapping[str, tuple[str, ...]]
    #: Name → `component.variable` → value.
    parameter_sets: Mapping[str, Mapping[str, Value]]
    default: str
    #: Communication step (s).
    step: float
    #: Length of the default set's experiment (s).
    duration: float
    #: Length of each set's experiment (s).
    durations: Mapping[str, float] = field(default_factory=dict)
    #: Name of a description that is not the archive's default; the set that it binds.
    variant: str = ""


def load(name: str, *, default: str | None = None) -> System:
    """The system of this name, from the scenarios as they are now. `default` is the parameter set that holds where a
    tool is told nothing, if it is not the recipe's."""
    if name not in RECIPES:
        raise ScenarioError(f"unknown system {name}{close_matches(name, RECIPES)}")
    recipe = RECIPES[name]
    plans = case_plans(name)
    bound = default or recipe.default
    if bound not in plans:
        raise ScenarioError(f"{name}: unknown parameter set {bound}{close_matches(bound, plans)}")
    first = next(iter(plans.values()))
    wiring: dict[str, str] = {f"controller.{ENGAGE}": f"{PROFILE}.{ENGAGE}"}
    for key, one in plans.items():
        if dict(one.components) != dict(first.components) or one.step != first.step:
            raise ScenarioError(f"{name}: {key} has other components or another step than the sets before it")
        for target, source in one.inputs.items():
            if wiring.setdefault(target, source) != source:
                raise ScenarioError(f"{name}: {key} wires {target} to {source}, others to {wiring[target]}")
    outside: dict[str, tuple[str, ...]] = {}
    for target, source in wiring.items():
        component, output = source.split(".", 1)
        if component == PROFILE:
            outside[output] = (*outside.get(output, ()), target)
    return System(
        name=name,
        title=recipe.title,
        components=first.components,
        connections={to: origin for to, origin in wiring.items() if origin.split(".", 1)[0] != PROFILE},
        inputs=outside,
        parameter_sets={key: one.parameters for key, one in plans.items()},
        default=bound,
        step=first.step,
        duration=plans[bound].duration,
        durations={key: one.duration for key, one in plans.items()},
    )


def case_plans(name: str) -> dict[str, Plan]:
    """The system's cases by the name of their parameter set: `<scenario>-<case>`, then `preset-<name>`."""
    plans = {
        f"{data.id}-{case.id}": plan(scenario=data, case=case, overrides=LATE)
        for data in map(scenarios.load, RECIPES[name].scenarios)
        for case in data.cases
    }
    model = plans[RECIPES[name].default]
    for preset in map(presets.load, presets.names()):
        if preset.archive in model.components.values():
            gains = by_element(preset.qualified(model.components))
            plans[f"preset-{preset.name}"] = replace(model, parameters=gains | LATE, profiles={})
    return plans


def by_element(values: Mapping[str, float]) -> dict[str, Value]:
    """`controller.K[1..3]` as the names of its elements."""
    found: dict[str, Value] = {}
    for key, value in values.items():
        component, name = key.split(".", 1)
        found |= {f"{component}.{element}": value for element in elements(name)}
    return found


def defaults(names: Iterable[str]) -> dict[str, str]:
    """The parameter set of each system that is named here, by the system's name."""
    sets = {key: name for name in RECIPES for key in case_plans(name)}
    found: dict[str, str] = {}
    for key in names:
        if key not in sets:
            raise ScenarioError(
                f"unknown parameter set {key}: expected <scenario>-<case> or preset-<name>{close_matches(key, sets)}"
            )
        if other := found.get(sets[key]):
            raise ScenarioError(f"{sets[key]} takes one parameter set, got {other} and {key}")
        found[sets[key]] = key
    return found
