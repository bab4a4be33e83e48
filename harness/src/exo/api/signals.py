"""What is given to inputs during a run: numbers, functions of time, arrays over the ticks, segments as in a scenario.

All become profiles, so that a run from Python and one from a scenario file take the same way.
"""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray
from pydantic import ValidationError

from exo.errors import ScenarioError
from exo.naming import elements
from exo.plan import Plan
from exo.scenario import PROFILE, Segment, Value

Array = NDArray[np.float64]
#: A number that is held, or an item of a choice; a function of the instants (s); a value for each tick; terms of a sum.
Signal = (
    Value
    | np.generic
    | Callable[[Array], Any]
    | Callable[[float], Any]
    | Sequence[float]
    | NDArray[Any]
    | Sequence[Mapping[str, Any]]
)
#: NumPy's kinds of numbers: true and false, integers, floating point.
NUMBERS = "biuf"


def fed(plan: Plan, inputs: Mapping[str, Signal]) -> Plan:
    """The plan with these signals at these inputs, in the place of what has fed them."""
    if not isinstance(inputs, Mapping):
        raise ScenarioError(f'inputs: got a value of type {type(inputs).__name__}; expected {{"plant.tau_h": 1.0}}')
    wires, profiles = dict(plan.inputs), dict(plan.profiles)
    parameters = dict(plan.parameters)
    time = np.arange(plan.steps, dtype=np.float64) * np.float64(plan.step)
    for key, signal in inputs.items():
        names = _elements(key)
        if isinstance(signal, np.generic) or (isinstance(signal, np.ndarray) and signal.ndim == 0):
            signal = signal.item()  # noqa: PLW2901
        if isinstance(signal, str):
            for name in names:
                wires.pop(name, None)
                parameters[name] = signal
            continue
        for name, segments in zip(names, _segments(key, signal, time, len(names)), strict=True):
            # A profile's name has no dot in a scenario, so that none of its own is meant.
            profiles[f"input.{name}"] = segments
            wires[name] = f"{PROFILE}.input.{name}"
            parameters.pop(name, None)
    return replace(plan, inputs=wires, profiles=profiles, parameters=parameters)


def _elements(key: object) -> list[str]:
    component, _, variable = str(key).partition(".")
    if not isinstance(key, str) or not component or not variable:
        raise ScenarioError(f"inputs: {key!r}: expected component.input")
    try:
        return elements(key)
    except ValueError as error:
        raise ScenarioError(f"inputs: {error}") from error


def _segments(key: str, signal: Any, time: Array, count: int) -> list[tuple[Segment, ...]]:
    """What feeds each of the `count` elements of `key`."""
    if isinstance(signal, bool | int | float):
        try:
            return [(Segment.model_construct(kind="constant", amplitude=float(signal)),)] * count
        except OverflowError:
            raise ScenarioError(f"inputs: {key}: a number of {len(str(signal))} digits; expected a double") from None
    if callable(signal):
        return _tables(key, _evaluated(key, signal, time), time, count)
    if isinstance(signal, Iterable) and not isinstance(signal, np.ndarray | Mapping):
        signal = list(signal)
        if signal and all(isinstance(one, Mapping | Segment) for one in signal):
            return [tuple(_segment(key, number, one) for number, one in enumerate(signal))] * count
    return _tables(key, signal, time, count)


def _segment(key: str, number: int, given: Any) -> Segment:
    if isinstance(given, Segment):
        return given
    plain = {name: tuple(map(tuple, value)) if name == "points" else value for name, value in given.items()}
    try:
        return Segment.model_validate(plain)
    except (ValidationError, TypeError) as error:
        problem = error.errors()[0] if isinstance(error, ValidationError) else {"loc": ("points",), "msg": str(error)}
        where = ".".join(str(part) for part in problem["loc"])
        said = str(problem["msg"]).removeprefix("Value error, ")
        raise ScenarioError(f"inputs: {key}: term {number + 1}{where and f'.{where}'}: {said}") from error


def _evaluated(key: str, function: Callable[[Array], Any], time: Array) -> Any:
    """The function at all instants at once, or one by one where it takes numbers only."""
    try:
        values = _numbers(key, function(time))
    except (TypeError, ValueError):
        try:
            values = _numbers(key, [function(t) for t in time.tolist()])
        except ScenarioError:
            raise
        except Exception as error:  # what a caller's function raises
            raise ScenarioError(f"inputs: {key}: its function raised {type(error).__name__}: {error}") from error
    except ScenarioError:
        raise
    except Exception as error:
        raise ScenarioError(f"inputs: {key}: its function raised {type(error).__name__}: {error}") from error
    return np.full_like(time, values) if values.ndim == 0 else values


def _tables(key: str, values: Any, time: Array, count: int) -> list[tuple[Segment, ...]]:
    """A value for each tick, and a column for each element where there are several."""
    try:
        array = _numbers(key, values)
    except (TypeError, ValueError):
        raise ScenarioError(
            f"inputs: {key}: got {values!r:.60}; expected a number, a function of the time, an array or segments"
        ) from None
    shapes = [(len(time),)] if count == 1 else [(len(time),), (len(time), count)]
    if array.shape not in shapes:
        wanted = " or ".join(map(str, shapes))
        raise ScenarioError(f"inputs: {key}: got an array of shape {array.shape}; expected {wanted}, a value each step")
    columns = [array] * count if array.ndim == 1 else list(array.T)
    # A table is linear in between and exact at its points, and these are the ticks.
    return [
        (Segment.model_construct(kind="table", points=tuple(zip(time.tolist(), column.tolist(), strict=True))),)
        for column in columns
    ]


def _numbers(key: str, values: Any) -> Array:
    """An array of doubles. NumPy would read texts, make NaN of None and drop what is imaginary: ScenarioError."""
    array = np.asarray(values)
    if array.dtype.kind == "O" and not any(one is None or isinstance(one, complex | str) for one in array.flat):
        return array.astype(np.float64)
    if array.dtype.kind not in NUMBERS:
        odd = next(one for one in array.flat if not isinstance(one, bool | int | float))
        raise ScenarioError(
            f"inputs: {key}: got {odd!r:.60} of type {type(odd).__name__}; "
            "expected numbers, a function of the time, or segments"
        )
    return array.astype(np.float64)
