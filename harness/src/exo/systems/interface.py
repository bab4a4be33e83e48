"""What an FMU's description says of its variables, as a system structure needs it: FMI 1.0, 2.0 and 3.0.

The description is read alone, without fmpy and without the library. What is missing or is no number stays away; whether
the description is right, `exo validate` judges.
"""

import re
from collections.abc import Iterable, Mapping
from contextlib import suppress
from dataclasses import dataclass
from math import prod
from typing import Any

from lxml import etree

from exo.errors import FmuError, close_matches

BASE = ("kg", "m", "s", "A", "K", "mol", "cd", "rad")
#: Types of a variable, by the names of FMI 1.0 and 2.0, then those of FMI 3.0.
SCALARS = ("Real", "Integer", "Boolean", "String", "Enumeration")
FLOATS = ("Float64", "Float32")
INTEGERS = ("Int8", "UInt8", "Int16", "UInt16", "Int32", "UInt32", "Int64", "UInt64")
TYPED = (*FLOATS, *INTEGERS, "Boolean", "String", "Binary", "Enumeration", "Clock")
INDICES = re.compile(r"\[([0-9]{1,9}(?:,[0-9]{1,9})*)\]")
IMPLEMENTATIONS = ("CoSimulation", "ModelExchange", "ScheduledExecution")
#: More elements than any variable of a real FMU has.
MAX_ELEMENTS = 1 << 24


@dataclass(frozen=True, kw_only=True)
class Unit:
    """1 unit = factor × product of base units + offset; exponents in the order of `BASE`, None where none are given."""

    name: str
    exponents: tuple[int, ...] | None
    factor: float = 1.0
    offset: float = 0.0


@dataclass(frozen=True, kw_only=True)
class Variable:
    """A variable, with what its declared type gives."""

    name: str
    causality: str
    variability: str
    initial: str
    type: str
    unit: str = ""
    #: Sizes of an array's dimensions; () for a scalar.
    shape: tuple[int, ...] = ()
    #: Start values, as many as there are elements, as they are written.
    start: tuple[str, ...] = ()
    minimum: float | None = None
    maximum: float | None = None
    #: The declared type of an enumeration, and the value of each of its items.
    enumeration: str = ""
    items: Mapping[str, int] | None = None

    @property
    def can_be_set(self) -> bool:
        """Whether an importer may set a start value."""
        if self.variability == "constant":
            return False
        return self.causality in ("parameter", "structuralParameter", "input") or self.initial in ("exact", "approx")

    @property
    def count(self) -> int:
        """How many elements there are."""
        return prod(self.shape)


@dataclass(frozen=True, kw_only=True)
class Interface:
    """The variables of an FMU."""

    #: fmiVersion.
    version: str
    #: By name; an alias of FMI 3.0 is another name of its variable.
    variables: Mapping[str, Variable]
    units: Mapping[str, Unit]
    #: CoSimulation, ModelExchange, ScheduledExecution.
    implementations: frozenset[str]

    def element(self, name: str) -> tuple[Variable, tuple[int, ...]]:
        """The variable of this name, or array and indices, from 1, of an element; else FmuError.

        Elements are called as in FMI 2.0: `q[2]` of the array `q`, `segment[2].t_on` of the array `segment.t_on`.
        """
        if name in self.variables:
            return self.variables[name], ()
        array = self.variables.get(INDICES.sub("", name))
        if array is None:
            raise FmuError(f"no variable {name}{close_matches(name, self.variables)}")
        indices = tuple(int(index) for found in INDICES.findall(name) for index in found.split(","))
        inside = len(indices) == len(array.shape) and all(
            1 <= index <= size for index, size in zip(indices, array.shape, strict=True)
        )
        if not inside:
            raise FmuError(f"no element {name}: {array.name} has the shape {list(array.shape)}")
        return array, indices


def position(shape: Iterable[int], indices: Iterable[int]) -> int:
    """Where the element lies in row-major order, from 0."""
    place = 0
    for size, index in zip(shape, indices, strict=True):
        place = place * size + index - 1
    return place


def read(data: bytes) -> Interface:
    """The interface of a `modelDescription.xml`. Raises FmuError when that is no description."""
    if b"<!DOCTYPE" in data:
        raise FmuError("modelDescription.xml declares a document type")
    parser = etree.XMLParser(resolve_entities=False, load_dtd=False, no_network=True, huge_tree=False)
    try:
        root = etree.fromstring(data, parser)
    except etree.XMLSyntaxError as problem:
        raise FmuError(f"modelDescription.xml is no XML: {problem}") from None
    version = root.get("fmiVersion", "")
    if root.tag != "fmiModelDescription" or version[:2] not in ("1.", "2.", "3."):
        raise FmuError(f"modelDescription.xml: expected FMI 1.0, 2.0 or 3.0, got <{root.tag}> {version}")
    variables = _typed(root) if version.startswith("3.") else _scalar(root)
    found = {element.tag for element in root} & set(IMPLEMENTATIONS)
    if version.startswith("1."):
        found = {"CoSimulation" if root.find("Implementation") is not None else "ModelExchange"}
    return Interface(
        version=version,
        variables=variables,
        units={unit.name: unit for unit in units(root.iterfind("UnitDefinitions/Unit"))},
        implementations=frozenset(map(str, found)),
    )


def units(elements: Iterable[Any], base: str = "BaseUnit") -> list[Unit]:
    """`Unit` elements; `base` is the qualified tag of their child."""
    found = []
    for element in elements:
        given = element.find(base)
        if given is None:
            found.append(Unit(name=element.get("name", ""), exponents=None))
            continue
        exponents = tuple(_integer(given.get(key)) or 0 for key in BASE)
        factor, offset = _number(given.get("factor")), _number(given.get("offset"))
        name = element.get("name", "")
        found.append(
            Unit(name=name, exponents=exponents, factor=1.0 if factor is None else factor, offset=offset or 0.0)
        )
    return found


def _scalar(root: Any) -> dict[str, Variable]:
    """FMI 1.0 and 2.0."""
    declared = {}
    for simple in [*root.iterfind("TypeDefinitions/SimpleType"), *root.iterfind("TypeDefinitions/Type")]:
        for child in simple:
            declared[simple.get("name", "")] = child
    found = {}
    for element in root.iterfind("ModelVariables/ScalarVariable"):
        kind = next((child for child in element if child.tag in SCALARS), None)
        if kind is not None:
            type_of = declared.get(kind.get("declaredType"))
            found[element.get("name", "")] = _variable(element, kind, type_of, str(kind.tag))
    return found


def _typed(root: Any) -> dict[str, Variable]:
    """FMI 3.0."""
    declared = {element.get("name", ""): element for element in root.iterfind("TypeDefinitions/*")}
    elements = [element for element in root.iterfind("ModelVariables/*") if element.tag in TYPED]
    sizes = {element.get("valueReference"): element.get("start") for element in elements}
    found = {}
    for element in elements:
        dimensions = [one.get("start") or sizes.get(one.get("valueReference")) for one in element.iterfind("Dimension")]
        shape = tuple(_integer(text) or 0 for text in dimensions)
        if not 0 <= prod(shape) <= MAX_ELEMENTS:
            shape = (0,)
        type_of = declared.get(element.get("declaredType"))
        variable = _variable(element, element, type_of, str(element.tag), shape)
        found[variable.name] = variable
        for alias in element.iterfind("Alias"):
            found.setdefault(alias.get("name", ""), variable)
    return found


def _variable(element: Any, kind: Any, declared: Any, type_name: str, shape: tuple[int, ...] = ()) -> Variable:
    def given(key: str) -> str | None:
        own = kind.get(key)
        text = own if own is not None or declared is None else declared.get(key)
        return None if text is None else str(text)

    causality = element.get("causality", "local")
    text = kind.get("start")
    start: tuple[str, ...] = () if text is None else (text,) if type_name == "String" else tuple(text.split())
    if type_name == "String" and not start:
        start = tuple(one.get("value", "") for one in kind.iterfind("Start"))
    if len(start) == 1 and shape:
        start *= prod(shape)
    items = None
    if type_name == "Enumeration" and declared is not None:
        # FMI 1.0 numbers the items by their order.
        listed = enumerate(declared.iterfind("Item"), start=1)
        items = {item.get("name", ""): _integer(item.get("value", str(i))) or 0 for i, item in listed}
    fixed = causality in ("parameter", "structuralParameter") or (text is not None and causality == "internal")
    return Variable(
        name=element.get("name", ""),
        causality=causality,
        variability=element.get("variability", "continuous"),
        initial=element.get("initial", "exact" if fixed else ""),
        type=type_name,
        unit=given("unit") or "",
        shape=shape,
        start=start,
        minimum=_number(given("min")),
        maximum=_number(given("max")),
        enumeration=kind.get("declaredType", "") if type_name == "Enumeration" else "",
        items=items,
    )


def _number(text: str | None) -> float | None:
    with suppress(ValueError):
        return None if text is None else float(text)
    return None


def _integer(text: str | None) -> int | None:
    with suppress(ValueError):
        # A longer one would take minutes to read.
        return None if text is None or len(text) > 20 else int(text)
    return None
