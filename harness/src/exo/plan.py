"""What a case runs: scenario, case and command line merged."""

from collections.abc import Mapping
from dataclasses import dataclass

from exo.scenario import Case, Coupling, Scenario, Segment, Value


@dataclass(frozen=True, kw_only=True)
class Plan:
    """A case with everything that the scenario and the command line contribute."""

    components: Mapping[str, str]
    parameters: Mapping[str, Value]
    inputs: Mapping[str, str]
    delayed: tuple[str, ...]
    profiles: Mapping[str, tuple[Segment, ...]]
    coupling: Coupling
    duration: float
    step: float
    #: Variables that are recorded besides outputs and wired inputs, by `component.name`.
    recorded: tuple[str, ...] = ()

    @property
    def steps(self) -> int:
        """Number of macro steps."""
        return round(self.duration / self.step)


def plan(*, scenario: Scenario, case: Case, overrides: Mapping[str, Value] | None = None) -> Plan:
    """Merges scenario, case and overrides, the later before the earlier."""
    parameters = {
        f"{name}.{key}": value for name, part in scenario.components.items() for key, value in part.parameters.items()
    }
    return Plan(
        components={name: part.archive for name, part in scenario.components.items()},
        parameters=parameters | case.parameters | dict(overrides or {}),
        inputs=scenario.inputs | case.inputs,
        delayed=scenario.delayed,
        profiles=scenario.profiles | case.profiles,
        coupling=case.coupling or scenario.coupling,
        duration=case.duration or scenario.duration,
        step=case.step or scenario.step,
    )
