"""Rows of a batch: what each sets, and the plan of a run that it makes.

The keys are those of `exo.runs`. A key is judged before the first run, a value when its row's turn comes.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
import pyarrow as pa
from pydantic import ValidationError

from exo import scenario as scenarios
from exo.errors import FmuError, ScenarioError, close_matches
from exo.fmu import Archive
from exo.naming import elements
from exo.plan import Plan
from exo.scenario import PROFILE, Segment, Value

#: Keys of a row that are no FMU's.
TIMES = ("duration", "step")

Row = Mapping[str, Value]


def rows_of(parameters: Mapping[str, Sequence[Value]] | pa.Table) -> list[dict[str, Value]]:
    """A table by columns as rows. ScenarioError, if the columns are not of one length, or hold what no row can set."""
    if isinstance(parameters, pa.Table) and len(set(parameters.column_names)) < parameters.num_columns:
        raise ScenarioError(f"parameters: expected each column once, got {', '.join(parameters.column_names)}")
    given = parameters.to_pydict() if isinstance(parameters, pa.Table) else dict(parameters)
    columns = {key: _column(key, values) for key, values in given.items()}
    lengths = {key: len(values) for key, values in columns.items()}
    if len(set(lengths.values())) > 1:
        told = ", ".join(f"{key} has {length}" for key, length in lengths.items())
        raise ScenarioError(f"parameters: expected columns of one length, {told}")
    return [dict(zip(columns, values, strict=True)) for values in zip(*columns.values(), strict=True)]


def _column(key: object, values: Any) -> list[Value]:
    if not isinstance(key, str) or isinstance(values, str | bytes) or not isinstance(values, Iterable):
        raise ScenarioError(f"parameters: {key}: expected a name and a list of values, got {str(values)[:40]}")
    # What NumPy holds is made what TOML and Python have.
    plain = [value.item() if isinstance(value, np.generic) else value for value in values]
    if wrong := unlike(plain):
        raise ScenarioError(f"{key}: {wrong}")
    return plain


def unlike(values: Sequence[object]) -> str:
    """What keeps these values out of one column of a table, as a sentence; else empty."""
    kinds = {_kind(value): value for value in values}
    for kind, value in kinds.items():
        if not kind:
            return f"expected a number of 64 bits, a text, or true or false, got {str(value)[:40]}"
    told = ", ".join(f"the {kind} {str(value)[:40]}" for kind, value in kinds.items())
    return "" if len(kinds) < 2 else f"expected values of one kind, got {told}"


def _kind(value: object) -> str:
    match value:
        case bool():
            return "Boolean"
        case int() if abs(value) < 1 << 63:
            return "number"
        case float():
            return "number"
        case str():
            return "text"
    return ""


def check_key(key: str, of: Plan, archives: Mapping[str, Archive], *, branch_at: float | None) -> None:
    """ScenarioError or FmuError, if no row of this plan's runs can set `key`. `archives` are the opened FMUs."""
    if key in TIMES:
        if branch_at is not None:
            raise ScenarioError(f"{key}: a row that branches off at {branch_at:g} s cannot set it")
        return
    component, _, name = key.partition(".")
    if component == PROFILE:
        if branch_at is not None:
            raise ScenarioError(f"{key}: a row that branches off at {branch_at:g} s cannot set it")
        _segment(of, key)
        return
    if component not in of.components or not name:
        known = close_matches(component, of.components)
        raise ScenarioError(f"{key}: expected <component>.<parameter>, got component {component!r}{known}")
    archive = archives[of.components[component]]
    for element in _elements(key, name):
        variable = archive.variable(element)
        if f"{component}.{element}" in of.inputs:
            raise ScenarioError(f"{key}: is wired to {of.inputs[f'{component}.{element}']}; expected an input without")
        if variable.causality not in ("parameter", "input"):
            raise FmuError(f"{key}: only parameters and inputs can be set, this is {variable.causality}")
        free = variable.causality == "input" or variable.variability == "tunable"
        if branch_at is not None and not free:
            raise FmuError(f"{key}: is fixed; after {branch_at:g} s only tunable parameters and inputs are set")


def planned(row: Row, own: Plan) -> Plan:
    """A case's plan with what the row sets. ScenarioError names key and value."""
    parameters, profiles = dict(own.parameters), dict(own.profiles)
    times: dict[str, float] = {}
    for key, value in row.items():
        component, _, name = key.partition(".")
        if key in TIMES:
            times[key] = _time(key, value)
        elif component == PROFILE:
            profile, number, field, segment = _segment(replace(own, profiles=profiles), key)
            changed = _changed(segment, field, value, key)
            profiles[profile] = (*profiles[profile][: number - 1], changed, *profiles[profile][number:])
        else:
            parameters.update({f"{component}.{element}": value for element in _elements(key, name)})
    made = replace(
        own,
        parameters=parameters,
        profiles=profiles,
        duration=times.get("duration", own.duration),
        step=times.get("step", own.step),
    )
    if times:
        try:
            scenarios.check_duration("row", duration=made.duration, step=made.step)
        except ValueError as error:
            raise ScenarioError(str(error)) from error
    return made


def _elements(key: str, name: str) -> list[str]:
    try:
        return elements(name)
    except ValueError as error:
        raise ScenarioError(f"{key}: {error}") from error


def check_each_once(row: Row) -> None:
    """ScenarioError, if two keys of a row set the same element."""
    owner: dict[str, str] = {}
    for key in row:
        component, _, name = key.partition(".")
        elements_of = [] if key in TIMES or component == PROFILE else _elements(key, name)
        for element in elements_of:
            other = owner.setdefault(f"{component}.{element}", key)
            if other != key:
                raise ScenarioError(f"{key}: sets {component}.{element}, and so does {other}; expected one of them")


def _time(key: str, value: Value) -> float:
    if isinstance(value, bool | str) or not 0.0 < value < float("inf"):
        raise ScenarioError(f"{key} = {value}: expected a time above 0 s")
    return float(value)


def _segment(of: Plan, key: str) -> tuple[str, int, str, Segment]:
    """Profile, number of the term, its field and the term of `profile.<name>.<number>.<field>`."""
    match key.split("."):
        case [_, name, number, field] if number.isdigit() and len(number) < 4:
            if name not in of.profiles:
                raise ScenarioError(f"{key}: no profile {name}{close_matches(name, of.profiles)}")
            segments = of.profiles[name]
            if not 1 <= int(number) <= len(segments):
                raise ScenarioError(f"{key}: profile {name} has {len(segments)} terms; expected 1 to {len(segments)}")
            known = [one for one in Segment.model_fields if one not in ("kind", "points")]
            if field not in known:
                raise ScenarioError(f"{key}: a term has no number {field}{close_matches(field, known)}")
            return name, int(number), field, segments[int(number) - 1]
    raise ScenarioError(f"{key}: expected profile.<name>.<number of its term>.<field>, as profile.tau_h.1.amplitude")


def _changed(segment: Segment, field: str, value: Value, key: str) -> Segment:
    try:
        return Segment.model_validate({**segment.model_dump(), field: value})
    except ValidationError as error:
        problem = error.errors(include_url=False)[0]
        said = str(problem["ctx"]["error"]) if problem["type"] == "value_error" else problem["msg"]
        raise ScenarioError(f"{key} = {value}: {said}") from error
