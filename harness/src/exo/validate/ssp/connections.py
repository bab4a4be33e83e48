"""Connections: both ends, which way values go, and whether they fit."""

from collections.abc import Iterator
from contextlib import suppress
from typing import Any

from exo.validate.rule import Finding
from exo.validate.ssp.document import Document
from exo.validate.ssp.elements import Connector, Element, written
from exo.validate.ssp.kinds import TRANSFORMATIONS, Shape, fits, same
from exo.validate.ssp.rule import error, warning

END = error("connection-end", "both ends of a connection are connectors")
KIND = error("connection-kind", "a connection joins kinds that the standard lets join, as an output and an input")
TWICE = error("connection-twice", "an input has one source")
TYPE = warning("connection-type", "both ends of a connection have the same type: tools need not convert")
UNIT = error("connection-unit", "both ends of a connection measure the same")
SHAPE = error(
    "connection-dimension", "both ends of a connection have the same dimensions, and its indices are inside them"
)
UNCONNECTED = warning("input-unconnected", "an input that has a connector has a source or a value")

#: What may be joined: owner and kind of the source → those of the destination, as in the standard's table.
_CONSTANTS = ("parameter", "input", "inout")
_OUT = ("calculatedParameter", "output", "local")
ALLOWED: dict[tuple[str, str], dict[str, tuple[str, ...]]] = {
    ("system", "structuralParameter"): {"system": _OUT, "element": ("structuralParameter", *_CONSTANTS)},
    ("system", "parameter"): {"system": _OUT, "element": _CONSTANTS},
    ("system", "input"): {"system": ("output", "local"), "element": ("input", "inout")},
    ("element", "constant"): {"system": ("constant", *_OUT), "element": ("structuralParameter", *_CONSTANTS)},
    ("element", "calculatedParameter"): {"system": _OUT, "element": _CONSTANTS},
    ("element", "output"): {"system": ("output", "local"), "element": ("input", "inout")},
    ("element", "local"): {"system": ("output", "local"), "element": ("input", "inout")},
    ("element", "inout"): {"system": ("output", "local"), "element": ("input",)},
}

#: Where a connection ends: owner (empty for the system), connector, indices.
Place = tuple[str, str, str]
#: Connectors that have a source: owner and connector → indices → where.
Taken = dict[tuple[str, str], dict[str, str]]


def findings(document: Document, system: Element, valued: set[tuple[str, str]]) -> Iterator[Finding]:
    """All of this module's rules, in one system; `valued` are the inputs that a binding gives a value."""
    taken: Taken = {}
    driven: set[tuple[str, str]] = set()
    for node in document.all("ssd:Connections/ssd:Connection", system.node):
        names = _end(node, "start"), _end(node, "end")
        where = document.place(node, f"connection {' → '.join(map(_shown, names))}")
        ends = []
        for name in names:
            connector = _find(system, name)
            if connector is None:
                yield END.at(where, _shown(name), _expected(system, name))
            else:
                ends.append(connector)
        driven.update((name[0], name[1]) for name in names)
        if len(ends) != 2:
            continue
        yield from _joined(where, names, (ends[0], ends[1]), taken)
        yield from _fitting(where, node, names, (ends[0], ends[1]))
    for element in system.children.values():
        if element.tag == "SignalDictionaryReference":
            continue
        for connector in element.connectors.values():
            here = element.name, connector.name
            if connector.kind == "input" and connector.type != "Clock" and here not in driven | valued:
                yield UNCONNECTED.at(connector.where, "no connection and no value", "a source, or no connector")


def _end(node: Any, side: str) -> Place:
    return node.get(f"{side}Element", ""), node.get(f"{side}Connector", ""), node.get(f"{side}Indices", "")


def _shown(place: Place) -> str:
    return f"{place[0]}.{place[1]}" if place[0] else place[1]


def _find(system: Element, place: Place) -> Connector | None:
    if not place[0]:
        return system.connectors.get(place[1])
    element = system.children.get(place[0])
    return None if element is None else element.connectors.get(place[1])


def _expected(system: Element, place: Place) -> str:
    if not place[0]:
        return "a connector of the system"
    return f"a connector of {place[0]}" if place[0] in system.children else "an element of the system"


def _joined(
    where: str, names: tuple[Place, Place], ends: tuple[Connector, Connector], taken: Taken
) -> Iterator[Finding]:
    kinds = [("element" if name[0] else "system", end.kind) for name, end in zip(names, ends, strict=True)]
    if any(end.kind == "unspecified" or end.type == "Clock" for end in ends):
        return
    onward, back = _allowed(kinds[0], kinds[1]), _allowed(kinds[1], kinds[0])
    if not onward and not back:
        value = f"{kinds[0][0]}'s {kinds[0][1]} and {kinds[1][0]}'s {kinds[1][1]}"
        yield KIND.at(where, value, "kinds that the standard lets join")
        return
    if onward == back:
        return
    target = names[1] if onward else names[0]
    indices = " ".join(target[2].split())
    others = taken.setdefault(target[:2], {})
    # A source of the whole is one of each element, too.
    other = next(iter(others.values()), None) if not indices else others.get(indices) or others.get("")
    if other is not None:
        yield TWICE.at(where, f"{_shown(target)} has a source: {other}", "one source")
    others[indices] = where


def _allowed(source: tuple[str, str], target: tuple[str, str]) -> bool:
    return target[1] in ALLOWED.get(source, {}).get(target[0], ())


def _fitting(where: str, node: Any, names: tuple[Place, Place], ends: tuple[Connector, Connector]) -> Iterator[Finding]:
    a, b = ends
    transformed = any(node.find(f"{{*}}{name}") is not None for name in TRANSFORMATIONS)
    if not transformed:
        if a.type and b.type and not same(a.type, b.type):
            yield TYPE.at(where, f"{a.type} and {b.type}", "one type")
        convert = node.get("suppressUnitConversion", "false") in ("false", "0")
        if convert and a.measure and b.measure and a.measure.exponents != b.measure.exponents:
            yield UNIT.at(where, f"{a.measure} and {b.measure}", "units that measure the same")
    shapes: list[Shape] = []
    for name, end in zip(names, ends, strict=True):
        inside = _inside(end.shape, name[2]) if name[2] else end.shape
        if inside is None:
            yield SHAPE.at(where, f"indices {name[2]} of {_shown(name)}", f"indices, from 1, into {written(end.shape)}")
            return
        shapes.append(inside)
    if not fits(*shapes):
        yield SHAPE.at(where, f"{written(shapes[0])} and {written(shapes[1])}", "the same dimensions")


def _inside(shape: Shape, indices: str) -> Shape | None:
    """The shape of what indices choose, None if they are none of this shape."""
    with suppress(ValueError):
        chosen = [int(index) for index in indices.split()]
        if len(chosen) == len(shape) and all(
            index >= 1 and (size is None or index <= size) for index, size in zip(chosen, shape, strict=True)
        ):
            return ()
    return None
