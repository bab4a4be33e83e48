"""Parameter bindings: where the values stand, what they are given to, and whether they suit it."""

from collections.abc import Iterator
from dataclasses import dataclass
from math import prod
from typing import Any

from lxml import etree

from exo.systems.interface import Interface, Variable
from exo.validate.rule import Finding
from exo.validate.ssp.document import Document
from exo.validate.ssp.elements import Connector, Element, written
from exo.validate.ssp.kinds import Measure, Shape, family, fits, lossless
from exo.validate.ssp.rule import error, warning

BOTH = error(
    "binding-source", "a binding, a mapping, a dictionary has a source or its content inside, not both, not neither"
)
REPEATED = error("parameter-twice", "no two parameters of a set have the same name")
UNKNOWN = warning("parameter-unknown", "what a binding sets is there: tools ignore a name that they do not know")
NOT_SET = error("parameter-kind", "what a binding sets is a parameter, an input or has a start value")
TYPE = error("parameter-type", "a value has the type of what it sets, or one without loss in that")
VALUE = error("parameter-value", "a value lies within min and max of the variable, or is one of its items")
UNIT = error("parameter-unit", "a value's unit measures the same as that of what it sets")
SHAPE = error("parameter-dimension", "a set has as many values as dimensions say, and those of what it sets")
SOURCE = warning("mapping-source", "what a mapping names is in the parameter set")
TARGET = error("mapping-target", "a mapping gives no two parameters to the same name")

#: Types whose values are texts: an array has one element for each.
TEXTS = ("String", "Enumeration", "Binary")
NUMBERS = ("Real", "Float64", "Float32", "Integer")


@dataclass(frozen=True)
class Target:
    """What a name stands for: a variable of an FMU, or a connector."""

    #: Identity and name of the element.
    owner: int
    element: str
    name: str
    variable: Variable | None
    interface: Interface | None
    connector: Connector | None

    @property
    def type(self) -> str:
        """Its type, empty where nothing says it."""
        return self.variable.type if self.variable else self.connector.type if self.connector else ""

    @property
    def shape(self) -> Shape:
        """Its dimensions."""
        return self.variable.shape if self.variable else self.connector.shape if self.connector else ()

    @property
    def measure(self) -> Measure | None:
        """What its unit means."""
        if self.variable and self.interface and self.variable.unit:
            return Measure.of(self.variable.unit, self.interface.units.get(self.variable.unit))
        return self.connector.measure if self.connector and not self.variable else None


@dataclass(frozen=True)
class Parameter:
    """A `Parameter` of a set: its value, as a type's element."""

    name: str
    where: str
    type: str
    node: Any
    shape: Shape
    measure: Measure | None

    @property
    def values(self) -> list[str]:
        """The values, as they are written."""
        text = str(self.node.get("value", ""))
        if self.type not in TEXTS:
            return text.split()
        return [str(one.get("value", "")) for one in self.node.iterfind("{*}Value")] or [text]


def parameters(document: Document) -> tuple[list[Parameter], list[Finding]]:
    """The parameters of a set, and what is wrong with the set by itself."""
    listed: dict[str, Parameter] = {}
    found: list[Finding] = []
    for node in document.all("ssv:Parameters/ssv:Parameter"):
        name = node.get("name", "")
        where = document.place(node, f"parameter {name}")
        typed = next(
            (one for one in node if isinstance(one.tag, str) and etree.QName(one).namespace.endswith("Values")), None
        )
        if typed is None:
            continue  # the schema says so
        unit = typed.get("unit", "")
        measure = Measure.of(unit, document.units.get(unit)) if unit else None
        sizes = tuple(_size(one.get("size")) for one in document.all("ssc:Dimension", node))
        one = Parameter(name, where, etree.QName(typed).localname, typed, sizes, measure)
        if name in listed:
            found.append(REPEATED.at(where, name, "each name once"))
        if None not in sizes:
            wanted = prod(size or 0 for size in sizes)
            if len(one.values) != wanted:
                found.append(SHAPE.at(where, f"{len(one.values)} values", f"{wanted}: dimensions {written(sizes)}"))
        listed[name] = one
    return list(listed.values()), found


def mapped(document: Document, given: list[Parameter]) -> tuple[list[tuple[str, Parameter, bool]], list[Finding]]:
    """What a mapping gives: name, parameter, and whether its value is changed on the way."""
    known = {one.name: one for one in given}
    result: list[tuple[str, Parameter, bool]] = []
    found: list[Finding] = []
    targets: dict[str, str] = {}
    for node in document.all("ssm:MappingEntry"):
        source, target = node.get("source", ""), node.get("target", "")
        where = document.place(node, f"mapping {source} → {target}")
        if (other := targets.setdefault(target, source)) != source:
            found.append(TARGET.at(where, f"{target}, as {other}", "each target once"))
        if source not in known:
            found.append(SOURCE.at(where, source, "a parameter of the set"))
        else:
            changed = any(isinstance(child.tag, str) and "Transformation" in child.tag for child in node)
            changed = changed or node.get("suppressUnitConversion", "false") in ("true", "1")
            result.append((target, known[source], changed))
    return result, found


class Names:
    """The hierarchical names of an element: its connectors, an FMU's variables, and `child.name` of those below."""

    def __init__(self, element: Element) -> None:
        self.element = element
        self._known: dict[tuple[int, str], tuple[list[Target], bool]] = {}

    def find(self, name: str) -> tuple[list[Target], bool]:
        """What bears the name, and whether something that could not be read may."""
        return self._find(self.element, name)

    def _find(self, element: Element, name: str) -> tuple[list[Target], bool]:
        key = id(element), name
        if key in self._known:
            return self._known[key]
        found: list[Target] = []
        closed = element.tag == "Component" and element.interface is None
        connector = element.connectors.get(name)
        variable = element.interface.variables.get(name) if element.interface else None
        if connector or variable:
            found.append(Target(id(element), element.name, name, variable, element.interface, connector))
        # Names of elements have dots, too. A name with a hundred thousand of them is not tried at each.
        for at in element.lengths:
            child = element.children.get(name[:at]) if name[at : at + 1] == "." else None
            if child is not None:
                below, unread = self._find(child, name[at + 1 :])
                found += below
                closed = closed or unread
        self._known[key] = found, closed
        return found, closed


def applied(names: Names, name: str, parameter: Parameter, *, changed: bool) -> Iterator[Finding]:
    """What is wrong with giving a parameter to what bears a name. `changed` values and units are not compared."""
    targets, unread = names.find(name)
    if not targets and not unread:
        yield UNKNOWN.at(parameter.where, name, f"a parameter of {names.element.name or 'the system'}")
    for target in targets:
        yield from _suits(parameter, target, changed=changed)


def _suits(parameter: Parameter, target: Target, *, changed: bool) -> Iterator[Finding]:
    variable = target.variable
    label = f"{target.element}.{target.name}"
    if variable is not None and not variable.can_be_set:
        value = f"{label}: {variable.variability} {variable.causality}"
        yield NOT_SET.at(parameter.where, value, "a parameter, an input or what has a start value")
    if changed:
        return
    if target.type and not lossless(parameter.type, target.type):
        yield TYPE.at(parameter.where, f"{parameter.type} for {label}", target.type)
        return
    if not fits(parameter.shape, target.shape):
        yield SHAPE.at(parameter.where, f"dimensions {written(parameter.shape)} for {label}", written(target.shape))
    theirs = target.measure
    if parameter.measure and theirs and parameter.measure.exponents != theirs.exponents:
        yield UNIT.at(parameter.where, str(parameter.measure), f"a unit as {theirs}")
    elif variable is not None:
        yield from _within(parameter, variable, theirs, label)


def _within(parameter: Parameter, variable: Variable, measure: Measure | None, label: str) -> Iterator[Finding]:
    if variable.items is not None:
        known = variable.items if parameter.type == "Enumeration" else set(map(str, variable.items.values()))
        for text in parameter.values:
            if text not in known:
                yield VALUE.at(parameter.where, f"{text} for {label}", f"one of {', '.join(list(known)[:12])}")
        return
    if parameter.type not in NUMBERS and "Int" not in family(parameter.type):
        return
    for text in parameter.values:
        try:
            value = float(text)
        except ValueError:
            return  # the schema says so
        if parameter.measure and measure:
            value = parameter.measure.converted(value, measure)
        low, high = variable.minimum, variable.maximum
        if not (low is None or value >= low) or not (high is None or value <= high):
            bounds = f"{'-∞' if low is None else f'{low:g}'} to {'∞' if high is None else f'{high:g}'}"
            yield VALUE.at(parameter.where, f"{text} for {label}", f"a value from {bounds}")


def _size(text: str | None) -> int | None:
    return int(text) if text is not None and text.isdigit() and len(text) <= 20 else None
