"""One run: of a system that was coupled in Python, or of a scenario's case."""

from collections.abc import Mapping, Sequence
from contextlib import AbstractContextManager, ExitStack, nullcontext
from dataclasses import replace
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from exo import derived, loop, preflight, trial
from exo import scenario as scenarios
from exo.api.fmu import Fmu
from exo.api.run import Run
from exo.api.signals import Signal, fed
from exo.api.system import System, archives_of, plan_of, positive
from exo.errors import ScenarioError, close_matches, in_case
from exo.fmu import Archive, find_fmu_dir
from exo.loop import Engine
from exo.master import simulate as one
from exo.naming import expand_values
from exo.plain import plain_values
from exo.plan import Plan, plan
from exo.scenario import Case, Scenario, Value

Tables = Mapping[str, Any]


def read_scenario(scenario: str | PathLike[str] | Tables) -> Scenario:
    """A scenario: one that comes with exo, by id; a file, by a path that ends in `.toml`; or the tables of such a file
    as dictionaries and lists, under the same schema (docs/scenarios.md).

    ScenarioError names file, key, value and what was expected.
    """
    if isinstance(scenario, Mapping):
        return scenarios.from_tables(scenario)
    if not isinstance(scenario, str | PathLike):
        what = type(scenario).__name__
        raise ScenarioError(
            f"scenario: got a value of type {what}; expected an id, a path to a .toml file, or a dictionary"
        )
    return scenarios.load(str(scenario))


def simulate(
    what: System | Scenario | str | PathLike[str] | Tables,
    *,
    case: str | None = None,
    duration: float | None = None,
    step: float | None = None,
    inputs: Mapping[str, Signal] | None = None,
    parameters: Mapping[str, Value | np.generic | Sequence[Any] | NDArray[Any]] | None = None,
    engine: Engine | None = None,
    real_time: bool = False,
    fmu_dir: str | PathLike[str] | None = None,
) -> Run:
    """Runs a system, or one case of a scenario, and returns what it recorded.

    `what` is a system of `exo.couple`, or what `exo.read_scenario` takes. `case` is the case's id; a scenario with one
    case needs none. `duration` and `step` are in s; a scenario has its own.

    `inputs`: by `"plant.tau_h"`, in the input's unit, one of: a number, which is held; a function of the time, called
    with all instants at once (s, shape `(steps,)`); an array of shape `(steps,)`, a value for each step; segments as in
    a scenario's profile, `[{"kind": "sine", "amplitude": 5.0, "frequency": 0.4}]`. `"plant.f_h[1..3]"` stands for three
    inputs and takes `(steps, 3)`, too. What is given to a wired input takes the wire's place.

    `parameters`: start values by `"controller.K"`; choices by name or number; `"controller.K[1..3]"` sets three.

    `engine` is `native` or `fmpy`, with equal numbers; native where it is installed, if left out. `real_time` makes
    the steps by the clock. `fmu_dir` is where a scenario's archives are looked for.

    ScenarioError and FmuError name what is wrong: the thing, its value and what was expected.
    """
    if engine is not None and engine not in loop.ENGINES:
        raise ScenarioError(f"engine {engine!r}: expected one of {', '.join(loop.ENGINES)}")
    chosen: Engine = loop.fastest() if engine is None else loop.named(engine)
    with ExitStack() as stack:
        if isinstance(what, Fmu):
            raise ScenarioError(
                f'{what.path.name}: got an FMU by itself; expected exo.couple({{"name": fmu}}), or a scenario'
            )
        if isinstance(what, System):
            of, archives, name = _of_system(what, case=case, duration=duration, step=step)
            signals: tuple[str, ...] = ()
            located: AbstractContextManager[None] = nullcontext()
        else:
            scenario = what if isinstance(what, Scenario) else read_scenario(what)
            of, archives, name = _of_scenario(scenario, case=case, duration=duration, step=step, fmu_dir=fmu_dir)
            signals = scenario.derived
            located = in_case(scenario.id, name)
        of = _set(fed(of, inputs or {}), parameters or {})
        _known_components(of, inputs or {})
        preflight.one_run(plan=of, archives=archives, owner=name)
        preflight.memory(owner=name, plans={name: of}, archives=archives)
        for archive in archives.values():
            stack.enter_context(archive)
            trial.check(archive)
        with located:
            run = one(plan=of, archives=archives, engine=chosen, real_time=real_time)
        recorded = derived.added(run, signals)
    return Run.of(recorded, name=name)


def _of_system(
    system: System, *, case: str | None, duration: float | None, step: float | None
) -> tuple[Plan, dict[str, Archive], str]:
    if case is not None:
        raise ScenarioError(f"case = {case!r}: a coupled system has no cases; expected a scenario, or no case")
    if duration is None:
        raise ScenarioError("duration: got none; expected the length of the run in s")
    of = plan_of(system, duration=positive("duration", duration))
    return _timed(of, step=step), archives_of(system), "system"


def _of_scenario(
    scenario: Scenario, *, case: str | None, duration: float | None, step: float | None, fmu_dir: Any
) -> tuple[Plan, dict[str, Archive], str]:
    found = _case(scenario, case)
    of = plan(scenario=scenario, case=found)
    if duration is not None:
        of = replace(of, duration=positive("duration", duration))
    folder = find_fmu_dir(None if fmu_dir is None else Path(fmu_dir))
    archives = {name: Archive(folder / name) for name in dict.fromkeys(of.components.values())}
    return _timed(of, step=step), archives, found.id


def _case(scenario: Scenario, name: str | None) -> Case:
    ids = [case.id for case in scenario.cases]
    if name is None and len(ids) == 1:
        return scenario.cases[0]
    if name not in ids:
        told = close_matches(name, ids) if name else f" ({', '.join(ids[:6])}{', …' if len(ids) > 6 else ''})"
        raise ScenarioError(f"{scenario.id}: case {name!r}: expected the id of one of its {len(ids)} cases{told}")
    return next(case for case in scenario.cases if case.id == name)


def _timed(of: Plan, *, step: float | None) -> Plan:
    timed = of if step is None else replace(of, step=positive("step", step))
    try:
        scenarios.check_duration("simulate", duration=timed.duration, step=timed.step)
    except ValueError as error:
        raise ScenarioError(str(error)) from error
    return timed


def _set(of: Plan, parameters: Mapping[str, Any]) -> Plan:
    if not isinstance(parameters, Mapping):
        raise ScenarioError(
            f'parameters: got a value of type {type(parameters).__name__}; expected {{"controller.K": 20.0}}'
        )
    plain = plain_values(parameters, where="parameters")
    try:
        values = expand_values(plain)
    except ValueError as error:
        raise ScenarioError(f"parameters: {error}") from error
    for key, value in values.items():
        component, _, name = str(key).partition(".")
        if component not in of.components or not name:
            known = close_matches(component, of.components)
            raise ScenarioError(f"parameters: {key}: expected component.parameter, got component {component!r}{known}")
        if not isinstance(value, bool | int | float | str):
            raise ScenarioError(f"parameters: {key} = {value!r:.60}: expected a number, true or false, or an item")
    return replace(of, parameters={**of.parameters, **values})


def _known_components(of: Plan, inputs: Mapping[str, Signal]) -> None:
    for key in inputs:
        component = key.partition(".")[0]
        if component not in of.components:
            known = close_matches(component, of.components)
            raise ScenarioError(f"inputs: {key}: expected component.input, got component {component!r}{known}")
