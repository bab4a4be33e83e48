"""Systems, components and signal dictionaries, and the connectors that each of them has."""

from collections.abc import Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

from lxml import etree

from exo.systems.interface import Interface, Variable
from exo.validate.rule import Finding
from exo.validate.ssp.document import Document
from exo.validate.ssp.kinds import Measure, Shape, fits, same
from exo.validate.ssp.rule import error

ELEMENT_NAME = error("element-name", "elements of a system have names, and no two the same")
CONNECTOR_NAME = error("connector-name", "no two connectors of an element have the same name")
CONNECTOR = error("connector-unknown", "connectors of an FMU are variables of it")
KIND = error("connector-kind", "the kind of an FMU's connector is the causality of its variable")
TYPE = error("connector-type", "the type of an FMU's connector is that of its variable")
UNIT = error("connector-unit", "the unit of an FMU's connector measures the same as that of its variable")
SHAPE = error("connector-dimension", "the dimensions of an FMU's connector are those of its variable")
IMPLEMENTATION = error("implementation", "the FMU has the implementation that the component asks for")
DICTIONARY = error("dictionary", "a signal dictionary is there, and the connectors of its references are entries of it")

TAGS = ("System", "Component", "SignalDictionaryReference")
#: Children of a connector that are no type.
OTHER = ("Dimension", "ConnectorGeometry", "Annotations")


@dataclass(frozen=True)
class Connector:
    """A connector, with what its component's variable says."""

    name: str
    kind: str
    #: Empty where neither the connector nor a variable says it.
    type: str
    unit: str
    shape: Shape
    where: str
    measure: Measure | None


@dataclass
class Element:
    """A system, a component or a reference to a signal dictionary."""

    name: str
    tag: str
    node: Any
    where: str
    connectors: dict[str, Connector] = field(default_factory=dict)
    #: Of a component whose FMU could be read.
    interface: Interface | None = None
    children: dict[str, "Element"] = field(default_factory=dict)

    @cached_property
    def lengths(self) -> list[int]:
        """How long the names of children are."""
        return sorted(set(map(len, self.children)))


def read(document: Document, node: Any, interfaces: Mapping[Any, Interface], found: list[Finding]) -> Element:
    """The element and all below it; what is wrong is added to `found`. `interfaces` are those of components."""
    tag = etree.QName(node).localname
    name = node.get("name", "")
    element = Element(name, tag, node, document.place(node, f"{tag} {name}"), interface=interfaces.get(node))
    wanted = node.get("implementation", "any")
    if element.interface is not None and wanted != "any" and wanted not in element.interface.implementations:
        there = " and ".join(sorted(element.interface.implementations)) or "none"
        found.append(IMPLEMENTATION.at(element.where, wanted, f"an implementation of the FMU: {there}"))
    for one in document.all("ssd:Connectors/ssd:Connector", node):
        connector = _connector(document, one, element, found)
        if connector.name in element.connectors:
            found.append(CONNECTOR_NAME.at(connector.where, connector.name, "each name once"))
        element.connectors[connector.name] = connector
    for tag in TAGS:
        for one in document.all(f"ssd:Elements/ssd:{tag}", node):
            child = read(document, one, interfaces, found)
            if child.name in element.children or not child.name:
                found.append(ELEMENT_NAME.at(child.where, repr(child.name), "a name, each once in its system"))
            element.children[child.name] = child
    return element


def every(element: Element) -> Iterator[Element]:
    """The element and all below it."""
    yield element
    for child in element.children.values():
        yield from every(child)


def _connector(document: Document, node: Any, element: Element, found: list[Finding]) -> Connector:
    name, kind = node.get("name", ""), node.get("kind", "")
    where = document.place(node, f"connector {element.name}.{name}")
    typed = next((child for child in node if isinstance(child.tag, str) and _is_type(child)), None)
    type_name = "" if typed is None else etree.QName(typed).localname
    unit = "" if typed is None else typed.get("unit", "")
    measure = Measure.of(unit, document.units.get(unit)) if unit else None
    shape: Shape = tuple(_size(one.get("size")) for one in document.all("ssc:Dimension", node))
    said = Connector(name, kind, type_name, unit, shape, where, measure)
    if element.interface is None:
        return said
    variable = element.interface.variables.get(name)
    if variable is None:
        if type_name != "Binary":  # a bundle of several variables, as in the Open Simulation Interface
            found.append(CONNECTOR.at(where, name, "the name of a variable of the FMU"))
        return said
    found += _compared(said, variable, element.interface)
    if not unit and variable.unit:
        unit, measure = variable.unit, Measure.of(variable.unit, element.interface.units.get(variable.unit))
    return Connector(name, kind, type_name or variable.type, unit, variable.shape, where, measure)


def _compared(connector: Connector, variable: Variable, interface: Interface) -> Iterator[Finding]:
    """What the document says of a connector, against the variable."""
    where = connector.where
    if connector.kind not in (variable.causality, "unspecified") and not interface.version.startswith("1."):
        yield KIND.at(where, connector.kind, variable.causality)
    if connector.type and not same(connector.type, variable.type) and connector.type != "Binary":
        yield TYPE.at(where, connector.type, variable.type)
    theirs = Measure.of(variable.unit, interface.units.get(variable.unit)) if variable.unit else None
    if connector.measure and theirs and connector.measure.exponents != theirs.exponents:
        yield UNIT.at(where, str(connector.measure), f"a unit as {theirs}")
    if not fits(connector.shape, variable.shape):
        yield SHAPE.at(where, f"dimensions {written(connector.shape)}", written(variable.shape))


def _is_type(child: Any) -> bool:
    local = etree.QName(child).localname
    return local not in OTHER and not (local == "Clock" and "Description" in (etree.QName(child).namespace or ""))


def _size(text: str | None) -> int | None:
    with suppress(ValueError):
        return None if text is None or len(text) > 20 else int(text)
    return None


def written(shape: Shape) -> str:
    """`3 × ?`, or `none` for a scalar."""
    return " × ".join("?" if size is None else str(size) for size in shape) or "none"


def dictionaries(
    document: Document, node: Any, entries: Mapping[Any, frozenset[str]], outer: Mapping[str, frozenset[str]]
) -> Iterator[Finding]:
    """References of the system and of those below it to dictionaries; `entries` are those of `SignalDictionary` nodes
    that could be read."""
    known = dict(outer)
    unread = set()
    for one in document.all("ssd:SignalDictionaries/ssd:SignalDictionary", node):
        known[one.get("name", "")] = entries.get(one, frozenset())
        if one not in entries:
            unread.add(one.get("name", ""))
    for one in document.all("ssd:Elements/ssd:SignalDictionaryReference", node):
        name = one.get("dictionary", "")
        where = document.place(one, f"SignalDictionaryReference {one.get('name', '')}")
        if name not in known:
            yield DICTIONARY.at(where, name, "a SignalDictionary of this system or one around it")
        elif name not in unread:
            for connector in document.all("ssd:Connectors/ssd:Connector", one):
                if connector.get("name", "") not in known[name]:
                    at = document.place(connector, f"connector {connector.get('name', '')}")
                    yield DICTIONARY.at(at, connector.get("name", ""), f"an entry of {name}")
    for system in document.all("ssd:Elements/ssd:System", node):
        yield from dictionaries(document, system, entries, known)
