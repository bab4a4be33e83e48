"""How much each assumption matters: every parameter of a plant changed alone, and what a few figures become.

A study (TOML) lists figures, each the metric of one case of a scenario, and parameters, each with its source. A
parameter is changed by +25 % and −25 % of the value that the scenario's case gives it, or to two stated values.
"""

import json
import math
import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import BeforeValidator, Field, ValidationError

from exo import experiment, refused, scenario
from exo.errors import ScenarioError
from exo.naming import elements
from exo.plain import read_tables
from exo.scenario import Data, Positive, Scenario

#: By how much a parameter is changed where the study states no values.
SHARE = 0.25
#: Significant digits that are kept: a thousandth of the smallest effect that the table shows.
DIGITS = 7
#: A table below this height (m) is none: out of the arm's reach.
OUT_OF_REACH = -1.0

Number = Annotated[float, BeforeValidator(lambda x: float(x) if isinstance(x, int) else x)]
Source = Literal["paper", "chosen", "fitted"]


class Figure(Data):
    """A number that a scenario measures: the metric of one case, with one plant in the loop."""

    id: str
    title: str
    plant: str
    scenario: str
    case: str
    metric: str
    #: End of the run (s) where nothing later counts; else the scenario's.
    until: Positive | None = None


class Parameter(Data):
    """One parameter of a plant, or the elements of an array, `link.m[1..3]`."""

    plant: str
    group: str
    name: str
    source: Source
    #: The paper's label, why the value was chosen, or what it was fitted to.
    why: str
    #: The two values that replace +25 % and −25 %, and in words what was done.
    values: tuple[Number, ...] = Field(default=(), max_length=2)
    change: str = ""
    #: Another component's parameter that is the same assumption and takes the same value.
    along: str = ""
    #: Ids of the figures in which it is off.
    off: tuple[str, ...] = ()
    #: Whether the table keeps its distance below the pad at the start.
    table_follows: bool = False

    @property
    def names(self) -> list[str]:
        """The FMU's names."""
        return elements(self.name)


class Study(Data):
    """What is changed, and what is looked at."""

    figure: tuple[Figure, ...]
    parameter: tuple[Parameter, ...]

    def figures(self, plant: str) -> list[Figure]:
        """The figures that have this plant in the loop."""
        return [figure for figure in self.figure if figure.plant == plant]


def load(path: Path) -> Study:
    """A study from its file; ScenarioError says what is wrong in it and where."""
    data = read_tables(path, what="study")
    try:
        return Study.model_validate_json(json.dumps(data))
    except ValidationError as error:
        raise ScenarioError("\n".join(refused.sentences(error, str(path), data, Study))) from error


@dataclass(frozen=True)
class Run:
    """What one run of a case has given: the study's figures by id, and all parameters by `component.name`."""

    values: dict[str, float]
    parameters: dict[str, float]


class Runner:
    """Runs a study's figures, each with one parameter changed. Figures of one case come from one run."""

    def __init__(self, *, study: Study, fmu_dir: Path) -> None:
        self.study = study
        self._fmu_dir = fmu_dir
        self._scenarios: dict[tuple[str, str], Scenario] = {}
        self._runs: dict[tuple[Any, ...], Run] = {}

    def base(self, figure: Figure) -> Run:
        """The figure's run with nothing changed."""
        return self._run(figure, {})

    def changed(self, figure: Figure, parameter: Parameter, name: str) -> list[float]:
        """The figure for each of the parameter's changed values."""
        base = self.base(figure).parameters
        value = base[f"plant.{name}"]
        results = []
        for new in parameter.values or ((1 + SHARE) * value, (1 - SHARE) * value):
            settings = {f"plant.{name}": new}
            settings |= {parameter.along: new} if parameter.along else {}
            if parameter.table_follows and base["plant.table.z"] > OUT_OF_REACH:
                before, after = (pad_height(base | extra) for extra in ({}, settings))
                settings["plant.table.z"] = base["plant.table.z"] + after - before
            results.append(self._run(figure, settings).values[figure.id])
        return results

    def _run(self, figure: Figure, settings: dict[str, float]) -> Run:
        case = figure.scenario, figure.case
        key = (*case, *sorted(settings.items()))
        if key not in self._runs:
            if case not in self._scenarios:
                self._scenarios[case] = reduced(self.study, figure)
            texts = {name: repr(int(x) if x == int(x) else x) for name, x in settings.items()}
            done = experiment.run(scenario=self._scenarios[case], fmu_dir=self._fmu_dir, overrides=texts)
            values = {result.id.split("/")[0]: result.value for result in done.results}
            self._runs[key] = Run(
                values={one.id: values[one.metric] for one in self.study.figure if (one.scenario, one.case) == case},
                parameters={
                    name: float(x)
                    for name, x in done.recordings[figure.case].parameters.items()
                    if not isinstance(x, str)
                },
            )
        return self._runs[key]


def reduced(study: Study, figure: Figure) -> Scenario:
    """The figure's scenario with nothing in it but its case, and the metrics of the study's figures of that case."""
    whole = scenario.load(figure.scenario)
    wanted = [one.metric for one in study.figure if (one.scenario, one.case) == (figure.scenario, figure.case)]
    cases = tuple(
        case.model_copy(update={"duration": figure.until or case.duration})
        for case in whole.cases
        if case.id == figure.case
    )
    metrics = tuple(metric for metric in whole.metrics if metric.id in wanted)
    if not cases or len(metrics) < len(wanted):
        raise ScenarioError(f"figure {figure.id}: {figure.scenario} has no case {figure.case} with {', '.join(wanted)}")
    metrics = tuple(metric.model_copy(update={"cases": (figure.case,)}) for metric in metrics)
    return whole.model_copy(update={"cases": cases, "metrics": metrics, "ratios": (), "figures": ()})


def pad_height(value: dict[str, float]) -> float:
    """Height of the pad at the start (m): link 2 at q_2 above the level, link 3 at q_2 + q_3."""
    pitch = value["plant.q_start[2]"]
    level = pitch + value["plant.q_start[3]"]
    across = value["plant.pad.x"] * math.sin(level) + value["plant.pad.z"] * math.cos(level)
    return value["plant.L1"] * math.sin(pitch) + across


def jobs(study: Study) -> Iterator[tuple[Parameter, str, Figure]]:
    """Everything that is run beside the figures themselves."""
    for parameter in study.parameter:
        for name in parameter.names:
            for figure in study.figures(parameter.plant):
                if figure.id not in parameter.off:
                    yield parameter, name, figure


def measure(runner: Runner, *, on_job: Callable[[str], None] = lambda _job: None) -> dict[str, Any]:
    """All effects: figure id → its value and, by parameter, start value and the figure's changed values.

    A figure that is not reached, such as the time of leaving where the arm does not leave, is null.
    """
    study = runner.study
    found: dict[str, Any] = {}
    for figure in study.figure:
        base = runner.base(figure)
        names = [name for one in study.parameter if one.plant == figure.plant for name in one.names]
        found[figure.id] = {
            "value": rounded(base.values[figure.id]),
            "parameters": {name: rounded(base.parameters[f"plant.{name}"]) for name in names},
            "changed": {},
        }
    for parameter, name, figure in jobs(study):
        on_job(f"{parameter.plant} {name}")
        found[figure.id]["changed"][name] = [rounded(x) for x in runner.changed(figure, parameter, name)]
    return found


def rounded(value: float) -> float | None:
    """A number as it is kept."""
    return float(f"{value:.{DIGITS}g}") if math.isfinite(value) else None


def text(effects: dict[str, Any]) -> str:
    """The effects as JSON, a line a parameter."""
    lines = json.dumps(effects, indent=1)
    return re.sub(r"\[[^\]]*\]", lambda values: " ".join(values[0].split()), lines) + "\n"
