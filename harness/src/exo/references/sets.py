"""The paper's parameter sets, one FMU at a time: what the cases of its scenarios set, each set once."""

from collections.abc import Mapping
from dataclasses import dataclass, field

from exo import presets
from exo import scenario as scenarios
from exo.fmu import Archive
from exo.master import plan
from exo.references.record import Experiment
from exo.scenario import Value
from exo.systems import ssp
from exo.systems.system import System, by_element

#: The paper's experiments: gain study, wall, experiments 1 to 3.
SCENARIOS = ("gain_study", "wall", "arm_performance", "arm_contact", "arm_payload", "arm_both")
#: Components of a scenario whose archive occurs twice are told by their first one.
FMU = "fmu"


@dataclass
class ParameterSet:
    """Values by variable, and which cases set them."""

    name: str
    values: Mapping[str, Value]
    titles: list[str]
    scenarios: list[str] = field(default_factory=list)

    @property
    def source(self) -> str:
        """Its file, seen from the manifest."""
        return f"parameters/{self.name}.ssv"

    def content(self, archive: Archive) -> bytes:
        """The file's bytes."""
        system = System(
            name=self.name,
            title="",
            components={FMU: archive.path.name},
            connections={},
            inputs={},
            parameter_sets={self.name: {f"{FMU}.{key}": value for key, value in self.values.items()}},
            default=self.name,
            step=1.0,
            duration=1.0,
        )
        return ssp.parameter_set(system=system, archives={archive.path.name: archive}, name=self.name, component=FMU)


def of(archive: str, experiments: list[Experiment]) -> list[ParameterSet]:
    """The sets of an archive: of the paper's cases, the presets, and what its experiments need besides."""
    found: list[ParameterSet] = []

    def add(name: str, values: Mapping[str, Value], title: str, scenario: str) -> None:
        same = next((one for one in found if one.values == values), None)
        if same is None:
            found.append(ParameterSet(name, dict(values), [title], [scenario]))
        elif values:
            same.titles.append(title)
            same.scenarios += [scenario] if scenario not in same.scenarios else []

    for data in map(scenarios.load, SCENARIOS):
        for case in data.cases:
            whole = plan(scenario=data, case=case)
            component = next((name for name, file in whole.components.items() if file == archive), None)
            if component is not None:
                prefix = f"{component}."
                values = {
                    key.removeprefix(prefix): value for key, value in whole.parameters.items() if key.startswith(prefix)
                }
                add(f"{data.id}-{case.id}", values, f"{data.id}, {case.label or case.id}", data.id)
    for preset in map(presets.load, presets.names()):
        if preset.archive == archive:
            gains = by_element(preset.qualified({FMU: archive}))
            values = {key.removeprefix(f"{FMU}."): value for key, value in gains.items()}
            add(f"preset-{preset.name}", values, preset.title, f"preset {preset.name}")
    for experiment in experiments:
        if for_experiment(found, experiment) is None:
            add(f"experiment-{experiment.name}", experiment.parameters, experiment.title, experiment.scenario)
    return [one for one in found if one.values]


def for_experiment(sets: list[ParameterSet], experiment: Experiment) -> ParameterSet | None:
    """The set that an experiment needs; None where it runs with the start values."""
    return next((one for one in sets if one.values == experiment.parameters), None)
