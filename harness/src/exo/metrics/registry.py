"""Metric functions by name, and how a scenario calls them."""

import inspect
import json
from collections.abc import Callable, Mapping
from functools import cache
from typing import Any

from pydantic import ConfigDict, TypeAdapter, ValidationError

from exo.errors import ExoError, ScenarioError, close_matches
from exo.recording import Recording

Function = Callable[..., float]
REGISTRY: dict[str, Function] = {}
#: Arguments that name a component. One that a scenario leaves out is the component of that very name.
COMPONENTS = ("controller", "plant", "operator")


#: Functions whose number is in the unit of their `column`, or of their `columns`.
IN_ITS_UNIT = frozenset({
    *("maximum", "minimum", "max_abs", "max_abs_while", "mean", "peak_to_peak", "least_peak_to_peak", "lowest_change"),
    *("rise", "farthest", "largest_step"),
})  # fmt: skip


def metric(function: Function) -> Function:
    """Registers a function under its name."""
    REGISTRY[function.__name__] = function
    return function


@cache
def _signature(function: Function) -> inspect.Signature:
    """Asked for at each run of a sweep; reading it takes a twentieth of one."""
    return inspect.signature(function)


def complete(function: str, arguments: Mapping[str, Any]) -> dict[str, Any]:
    """The arguments with the components that they leave out."""
    taken = _signature(REGISTRY[function]).parameters if function in REGISTRY else {}
    return {name: name for name in COMPONENTS if name in taken} | dict(arguments)


def evaluate(*, recording: Recording, function: str, arguments: Mapping[str, Any], owner: str) -> float:
    """Calls a registered function; unknown names and wrong arguments are errors that name `owner`."""
    check(function=function, arguments=arguments, owner=owner)
    return call(recording=recording, function=function, arguments=arguments, owner=owner)


def call(*, recording: Recording, function: str, arguments: Mapping[str, Any], owner: str) -> float:
    """The same of arguments that have been checked."""
    try:
        return float(REGISTRY[function](recording, **complete(function, arguments)))
    except ExoError:
        raise
    except Exception as error:  # a recording on which the function is not defined
        raise ScenarioError(f"{owner}: {function}: {type(error).__name__}: {error}") from error


def check(
    *, function: str, arguments: Mapping[str, Any], owner: str, components: Mapping[str, object] | None = None
) -> None:
    """Whether the function exists, takes these arguments, and names components that are there, where they are given."""
    if function not in REGISTRY:
        raise ScenarioError(f"{owner}: unknown function {function}{close_matches(function, REGISTRY)}")
    full = complete(function, arguments)
    try:
        _signature(REGISTRY[function]).bind(None, **full)
    except TypeError as error:
        taken = [*_signature(REGISTRY[function]).parameters][1:]
        raise ScenarioError(f"{owner}: {function}: {error}; it takes {', '.join(taken) or 'none'}") from error
    for name, value in full.items():
        wanted = _signature(REGISTRY[function]).parameters[name].annotation
        try:
            TypeAdapter(wanted, config=ConfigDict(allow_inf_nan=False)).validate_json(
                json.dumps(value, default=str), strict=True
            )
        except ValidationError as error:
            expected = error.errors(include_url=False)[0]["msg"]
            raise ScenarioError(f"{owner}: {function}: {name}: got {str(value)[:80]}; expected: {expected}") from error
    for name in COMPONENTS:
        if components is not None and name in full and full[name] not in components:
            known = close_matches(str(full[name]), components)
            raise ScenarioError(f"{owner}: {function}: {name}: unknown component {full[name]}{known}")
