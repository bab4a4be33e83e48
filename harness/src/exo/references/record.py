"""Records what the archives carry: a coupled run, then each of its FMUs alone, fed with what it was fed.

All numbers come from the FMUs, which give the same bits on every machine: the force of the testbed's hand, too, is a
`HumanOperator` and no profile, whose sine would be the machine's.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from exo import scenario as scenarios
from exo.errors import ScenarioError, close_matches
from exo.fmu import Archive, Instance
from exo.loop import Part as Component
from exo.master import Plan, plan, simulate
from exo.recording import Recording
from exo.references.recipes import Run
from exo.scenario import PROFILE, Value
from exo.systems import closed

#: Digits of a stimulus: an encoder has fewer. A digit more is a tenth more of the archive.
STIMULUS = ".9g"
#: Digits of a result: three more than the tolerance can tell.
RESULT = ".12g"
#: Rows of a result, about.
ROWS = 60

Columns = dict[str, NDArray[np.float64]]


@dataclass(frozen=True, kw_only=True)
class Experiment:
    """One FMU's part of a run: what it is set to and fed with, and what it then puts out."""

    name: str
    title: str
    scenario: str
    case: str
    archive: str
    #: Communication step size and length (s).
    step: float
    duration: float
    parameters: Mapping[str, Value]
    #: Inputs at the beginning of each step.
    stimuli_time: NDArray[np.float64]
    stimuli: Columns
    #: Outputs at some communication points, the first and the last among them.
    time: NDArray[np.float64]
    results: Columns


def coupled(run: Run) -> Plan:
    """The run as the harness plans it, with an operator in place of the profile `tau_h`."""
    data = scenarios.load(run.scenario)
    cases = {case.id: case for case in data.cases}
    if run.case not in cases:
        raise ScenarioError(f"{run.scenario}: no case {run.case}{close_matches(run.case, cases)}")
    whole = plan(scenario=data, case=cases[run.case])
    components, inputs = dict(whole.components), dict(whole.inputs)
    for target, source in inputs.items():
        if source.removeprefix(f"{PROFILE}.") in closed.FORCES:
            inputs[target] = closed.FORCE
            components |= dict([closed.HAND])
    parameters = {key: value for key, value in whole.parameters.items() if ".segment[" not in key}
    return replace(
        whole,
        components=components,
        inputs=inputs,
        parameters=parameters | run.hand,
        profiles=run.profiles,
        duration=run.duration,
    )


def record(name: str, run: Run, archives: Mapping[str, Archive]) -> list[Experiment]:
    """One experiment for each component that the run records. `archives` are opened FMUs by archive name."""
    wired = coupled(run)
    whole = simulate(plan=wired, archives=archives)
    return [
        _alone(name=name, run=run, wired=wired, whole=whole, component=component, archives=archives)
        for component in run.record
    ]


def _alone(
    *, name: str, run: Run, wired: Plan, whole: Recording, component: str, archives: Mapping[str, Archive]
) -> Experiment:
    part = run.record[component]
    archive = archives[wired.components[component]]
    prefix = f"{component}."
    parameters = {key.removeprefix(prefix): value for key, value in wired.parameters.items() if key.startswith(prefix)}
    step = wired.step
    stimuli = _stimuli(archive, wired, whole, prefix)
    steps = len(whole.time)
    results = play(
        archive=archive, parameters=parameters, stimuli=stimuli, step=step, steps=steps, outputs=part.outputs
    )
    shown = _shown(steps)
    return Experiment(
        name=name,
        title=run.title,
        scenario=run.scenario,
        case=run.case,
        archive=wired.components[component],
        step=step,
        duration=steps * step,
        parameters=parameters,
        stimuli_time=np.arange(steps, dtype=np.float64) * np.float64(step),
        stimuli=stimuli,
        time=shown.astype(np.float64) * np.float64(step),
        results={key: rounded(column[shown], RESULT) for key, column in results.items()},
    )


def _stimuli(archive: Archive, wired: Plan, whole: Recording, prefix: str) -> Columns:
    """The inputs that differ from their start value at any time."""
    found = {}
    for key in wired.inputs:
        if not key.startswith(prefix):
            continue
        name = key.removeprefix(prefix)
        column = rounded(np.asarray(whole[key], dtype=np.float64), STIMULUS)
        if np.any(column != float(archive.start_value(name, archive.parse(name, archive.variable(name).start))[1])):
            found[name] = column
    return found


def rounded(column: NDArray[np.float64], digits: str) -> NDArray[np.float64]:
    """Each number as it is after it was written with `digits` and read again; −0 is 0."""
    return np.array([float(format(float(value), digits)) for value in column]) + 0.0


def _shown(steps: int) -> NDArray[np.int64]:
    """Communication points of a result: evenly, with the first and the last one."""
    every = max(1, steps // ROWS)
    return np.unique(np.append(np.arange(0, steps + 1, every), steps))


def play(
    *,
    archive: Archive,
    parameters: Mapping[str, Value],
    stimuli: Columns,
    step: float,
    steps: int,
    outputs: tuple[str, ...],
) -> Columns:
    """One FMU alone, inputs set at the beginning of each step: outputs at all `steps` + 1 communication points."""
    with Instance(archive, "reference") as instance:
        part = Component(instance, inputs=list(stimuli), outputs=archive.names("output"), steps=steps)
        for name, column in stimuli.items():
            kind, index = part.input(name)
            part.u[kind][:, index] = column
        for name, value in parameters.items():
            instance.set_start(name, value)
        instance.setup_experiment(start_time=0.0, stop_time=steps * step)
        instance.enter_initialization_mode()
        part.write_row(0)
        instance.exit_initialization_mode()
        part.read_row(0)
        for k in range(steps):
            part.write_row(k)
            instance.do_step(k * step, step)
            part.read_row(k + 1)
        instance.terminate()
        kinds = {name: kind for kind, references in part.outputs.items() for name in references.names}
        missing = [name for name in outputs if name not in kinds]
        if missing:
            raise ScenarioError(f"{archive.path.name}: {missing[0]} is no output{close_matches(missing[0], kinds)}")
        return {
            name: np.array(part.y[kinds[name]][:, part.output(name, kinds[name])], dtype=np.float64) for name in outputs
        }
