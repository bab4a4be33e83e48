"""Axes of a case matrix, and the placeholders `{axis}` and `{axis.field}` that stand for their values.

    [axes]
    K = [7.5, 15.0, 30.0]                    {K} is 7.5, 15, 30
    [axes.nominal]
    light = { M_n = 0.1 }                    {nominal} is light, {nominal.M_n} is 0.1
    heavy = { M_n = 10.0 }

A text that is one placeholder becomes the value itself: a number stays a number. In a longer text it is written out.
"""

import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from itertools import product
from math import prod
from typing import Any

from exo.errors import ScenarioError, close_matches

PLACEHOLDER = re.compile(r"\{(\w+)(?:\.(\w+))?\}")
#: Keys that hold a text, whatever an axis' values are.
TEXTS = ("id", "title", "label", "case", "y_label")
#: Fields of an axis' value that are part of every case over it; so are names with a dot, which are parameters.
OF_A_CASE = ("parameters", "inputs", "profiles", "coupling", "duration", "step")

#: Of one entry. Each combination is a run or a number that someone reads.
MAX_COMBINATIONS = 10_000


@dataclass(frozen=True)
class Point:
    """One value of an axis: what `{axis}` is, and the fields beside it."""

    value: Any
    fields: Mapping[str, Any]


#: Axis → its value in one entry.
Bound = Mapping[str, Point]


def written(value: Any) -> str:
    """A value inside a text: 5.0 is `5`."""
    return f"{value:g}" if isinstance(value, float) else str(value)


class Axes:
    """The axes of a scenario; it notes which fields are used, so that a misspelt one is found."""

    def __init__(self, data: Any, *, where: str) -> None:
        self.where = where
        if not isinstance(data, dict):
            raise ScenarioError(f"{where}: got {data!r}; expected a table of axes")
        self.points = {name: self._points(name, values) for name, values in data.items()}
        self._used: set[tuple[str, str]] = set()
        self._of_cases: set[str] = set()

    def _points(self, name: str, values: Any) -> dict[str, Point]:
        if isinstance(values, list) and values and not any(isinstance(value, dict | list) for value in values):
            return {written(value): Point(value, {}) for value in values}
        if isinstance(values, dict) and values and all(isinstance(fields, dict) for fields in values.values()):
            return {value: Point(value, fields) for value, fields in values.items()}
        raise ScenarioError(f"{self.where}.{name}: got {values!r}; expected a list of values or a table for each value")

    def only(self, over: Any, *, where: str) -> dict[str, list[Point]]:
        """The values of each axis that `over` leaves: `{ law = ["passive"] }`."""
        chosen = {name: list(points.values()) for name, points in self.points.items()}
        if not isinstance(over, dict):
            raise ScenarioError(f"{where}.over: got {over!r}; expected axes with the values to take")
        for name, values in over.items():
            points = self._axis(name, where=f"{where}.over")
            if not isinstance(values, list):
                raise ScenarioError(f"{where}.over.{name}: got {values!r}; expected a list of its values")
            for value in map(written, values):
                if value not in points:
                    raise ScenarioError(f"{where}.over.{name}: no value {value}{close_matches(value, points)}")
            chosen[name] = [points[written(value)] for value in values]
        return chosen

    def _axis(self, name: str, *, where: str) -> dict[str, Point]:
        if name not in self.points:
            raise ScenarioError(f"{where}: unknown axis {name}{close_matches(name, self.points)}")
        return self.points[name]

    def each(self, texts: Any, *, over: Any = None, where: str) -> Iterator[Bound]:
        """A binding for each combination of the axes in `texts`, the last one that is named running fastest. Once if
        there are none; without any axes braces are only braces."""
        names: list[str] = []
        for name, _ in placeholders(texts) if self.points else ():
            if name not in names:
                self._axis(name, where=where)
                names.append(name)
        chosen = self.only(over or {}, where=where)
        number = prod(len(chosen[name]) for name in names)
        if number > MAX_COMBINATIONS:
            raise ScenarioError(
                f"{where}: {' × '.join(names)} has {number} combinations; expected at most {MAX_COMBINATIONS}"
            )
        for points in product(*(chosen[name] for name in names)):
            yield dict(zip(names, points, strict=True))

    def fill(self, value: Any, bound: Bound, *, where: str) -> Any:
        """`value` with the placeholders of the bound axes replaced, in all texts and keys; others stay."""
        if not bound:
            return value
        match value:
            case str():
                if (whole := PLACEHOLDER.fullmatch(value)) and whole[1] in bound:
                    return self._content(whole, bound, where)
                return PLACEHOLDER.sub(
                    lambda found: written(self._content(found, bound, where)) if found[1] in bound else found[0], value
                )
            case list():
                return [self.fill(one, bound, where=where) for one in value]
            case dict():
                return {
                    written(self.fill(key, bound, where=where)): self._filled(key, one, bound, where)
                    for key, one in value.items()
                }
        return value

    def _filled(self, key: str, value: Any, bound: Bound, where: str) -> Any:
        filled = self.fill(value, bound, where=where)
        return written(filled) if key in TEXTS and isinstance(value, str) else filled

    def _content(self, found: re.Match[str], bound: Bound, where: str) -> Any:
        axis, field = found[1], found[2]
        if field is None:
            return bound[axis].value
        if field not in bound[axis].fields:
            known = close_matches(field, bound[axis].fields)
            raise ScenarioError(f"{where}: {found[0]}: {bound[axis].value} of axis {axis} has no {field}{known}")
        self._used.add((axis, field))
        return bound[axis].fields[field]

    def fragments(self, bound: Bound) -> Iterator[dict[str, Any]]:
        """What the bound values say of a case."""
        self._of_cases.update(bound)
        for axis, point in bound.items():
            of_case = {key: one for key, one in point.fields.items() if key in OF_A_CASE or "." in key}
            self._used.update((axis, key) for key in of_case)
            yield of_case

    def check_all_is_used(self) -> None:
        """A field that nothing has used is misspelt. A base may offer axes that nothing uses, and names beside values
        that are only written out."""
        for axis in sorted(self._of_cases | {axis for axis, _ in self._used}):
            for value, point in self.points[axis].items():
                for field in point.fields:
                    if (axis, field) not in self._used:
                        expected = f"{{{axis}.{field}}} somewhere, a parameter with a dot, or {', '.join(OF_A_CASE)}"
                        raise ScenarioError(
                            f"{self.where}.{axis}.{value}.{field}: nothing uses it; expected {expected}"
                        )


def placeholders(value: Any) -> Iterator[tuple[str, str | None]]:
    """Axis and field of every placeholder, in the order in which they stand."""
    match value:
        case str():
            yield from ((found[1], found[2]) for found in PLACEHOLDER.finditer(value))
        case dict():
            for key, one in value.items():
                yield from placeholders(key)
                yield from placeholders(one)
        case list() | tuple():
            for one in value:
                yield from placeholders(one)


def texts(entry: Mapping[str, Any], keys: Iterable[str]) -> list[Any]:
    """What an entry has under these keys."""
    return [entry[key] for key in keys if key in entry]
