"""The description as a tree: parsed without trusting it, tolerant of what other rules will report.

Both versions of the standard become the same form. `versions.py` says what each calls things.
"""

import re
from collections import ChainMap
from collections.abc import Collection, Iterator, Mapping, MutableMapping
from functools import cached_property
from itertools import islice
from math import prod

from lxml import etree

from exo.validate import prolog
from exo.validate.archive import DESCRIPTION
from exo.validate.rule import Finding, error, printable
from exo.validate.variable import Alias, Dimension, Variable, integers
from exo.validate.versions import FMI2, VERSIONS, Version

ROOT = error("xml-root", "the root element is fmiModelDescription")
VERSION = error("xml-version", "fmiVersion is 2.0 or 3.0")

#: Elements of one array that are read at most.
MAX_SIZE = 1 << 20


class SimpleType:
    """A type definition: asked once for each variable that declares it, so its children are sorted once."""

    def __init__(self, element: etree._Element, version: Version) -> None:
        self.element = element
        #: Attributes of its kinds; of a kind that stands twice those of the first.
        self.kinds = {kind: texts(part) for kind, part in reversed(version.type_elements(element))}
        #: Items of an Enumeration.
        self.item_elements = [item for _, part in version.type_elements(element) for item in part.iterfind("Item")]
        #: The values of an Enumeration's items, in their order.
        self.items = dict.fromkeys(value for item in self.item_elements for value in integers(item.get("value")) or [])


class Description:
    """The parsed description."""

    def __init__(self, root: etree._Element, version: Version = FMI2) -> None:
        self.root = root
        self.version = version
        #: Type definitions in their order, and by name.
        self.type_elements = [element for element in self.all("TypeDefinitions/*") if isinstance(element.tag, str)]
        self.types = {
            element.get("name", ""): SimpleType(element, version)
            for element in self.type_elements
            if version is not FMI2 or element.tag == "SimpleType"
        }
        read = self._scalar if version is FMI2 else self._typed
        elements = self.all("ModelVariables/ScalarVariable" if version is FMI2 else "ModelVariables/*")
        self.variables = tuple(
            read(index, element)
            for index, element in enumerate((one for one in elements if isinstance(one.tag, str)), start=1)
        )

    def all(self, path: str) -> list[etree._Element]:
        """Elements below the root."""
        return list(self.root.iterfind(path))

    def first(self, path: str) -> etree._Element | None:
        """The first element below the root."""
        return self.root.find(path)

    @property
    def interface(self) -> etree._Element | None:
        """The interface that is judged and run: CoSimulation, else ScheduledExecution in FMI 3.0."""
        found = (self.first(name) for name in self.version.interfaces)
        return next((element for element in found if element is not None), None)

    def capability(self, name: str) -> bool:
        """Whether the interface says true of it."""
        return self.interface is not None and self.interface.get(name) in ("true", "1")

    @property
    def token(self) -> str:
        """What fmi2Instantiate takes as guid, and fmi3Instantiate… as instantiationToken."""
        return str(self.root.get(self.version.token, ""))

    @property
    def identifier(self) -> str | None:
        """The interface's modelIdentifier; None when it is no C identifier, and so no name of a file in here."""
        identifier = "" if self.interface is None else self.interface.get("modelIdentifier", "")
        return identifier if re.fullmatch(r"[A-Za-z_][A-Za-z0-9_]*", identifier) else None

    @cached_property
    def by_reference(self) -> Mapping[int, Variable]:
        """The first variable of each value reference."""
        found: dict[int, Variable] = {}
        for variable in self.variables:
            if variable.reference is not None:
                found.setdefault(variable.reference, variable)
        return found

    def find(self, key: int) -> Variable | None:
        """The variable that ModelStructure, derivative and previous mean: by position, in FMI 3.0 by reference."""
        if self.version is not FMI2:
            return self.by_reference.get(key)
        return self.variables[key - 1] if 1 <= key <= len(self.variables) else None

    def unknowns(self, section: str) -> list[etree._Element]:
        """The unknowns of a section of ModelStructure."""
        return self.all(self.version.sections[section])

    @cached_property
    def states(self) -> frozenset[int]:
        """Positions of the variables that have a derivative."""
        keys = (key for v in self.variables for key in integers(v.type.get("derivative")) or [])
        return frozenset(state.index for key in keys if (state := self.find(key)) is not None)

    def items(self, variable: Variable) -> Collection[int]:
        """The item values of an Enumeration's declared type."""
        declared = self.types.get(variable.type.get("declaredType", ""))
        return () if declared is None else declared.items.keys()

    def size(self, variable: Variable) -> int | None:
        """The number of a variable's elements before a structural parameter is changed.

        None when it is not said, and where they are more than are read.
        """
        extents = [self.extent(dimension) for dimension in variable.dimensions]
        total = prod(extent for extent in extents if extent is not None)
        return None if None in extents or total > MAX_SIZE else total

    def extent(self, dimension: Dimension) -> int | None:
        """How long it is before a structural parameter is changed; None when it is not said."""
        text: str | None = dimension.start
        if dimension.reference is not None:
            keys = integers(dimension.reference) or []
            sizer = self.by_reference.get(keys[0]) if len(keys) == 1 else None
            text = None if sizer is None else sizer.type.get("start")
        found = integers(text) or []
        return found[0] if len(found) == 1 and found[0] >= 0 else None

    def _scalar(self, index: int, element: etree._Element) -> Variable:
        """A `ScalarVariable` of FMI 2.0, whose kind is a child."""
        kind_element = next((child for child in element if child.tag in self.version.kinds), None)
        kind = "" if kind_element is None else str(kind_element.tag)
        given = {} if kind_element is None else texts(kind_element)
        return self._variable(index, element, kind, given)

    def _typed(self, index: int, element: etree._Element) -> Variable:
        """A variable of FMI 3.0, whose kind is the element's name."""
        kind = str(element.tag)
        return self._variable(index, element, kind if kind in self.version.kinds else "", texts(element))

    def _variable(self, index: int, element: etree._Element, kind: str, given: MutableMapping[str, str]) -> Variable:
        declared = self.types.get(given.get("declaredType", ""))
        if declared is not None and kind in declared.kinds:
            named = {key: value for key, value in declared.kinds[kind].items() if key not in ("name", "description")}
            given = ChainMap(given, named)
        own = texts(element)
        return Variable(
            self.version,
            index,
            own,
            kind,
            given,
            place(element, f"variable {own.get('name', '')}"),
            tuple(
                Dimension(
                    one.get("start"), one.get("valueReference"), place(one, f"dimension of {own.get('name', '')}")
                )
                for one in element.iterfind("Dimension")
            ),
            tuple(Alias(texts(one), place(one, f"alias {one.get('name', '')}")) for one in element.iterfind("Alias")),
            tuple(one.get("value", "") for one in element.iterfind("Start")),
        )


def texts(element: etree._Element) -> dict[str, str]:
    """The attributes of an element."""
    return {str(key): str(value) for key, value in element.attrib.items()}


def place(element: etree._Element, name: str, file: str = DESCRIPTION) -> str:
    """`modelDescription.xml:12 <name>`"""
    return f"{file}:{element.sourceline} {printable(name)}"


def listed(values: Collection[object], limit: int = 10) -> str:
    """`1, 2, 3`; of many values the first ones."""
    return ", ".join(map(str, islice(values, limit))) + (f", … ({len(values)} in all)" if len(values) > limit else "")


def tree(data: bytes) -> etree._Element:
    """The root of XML that has passed `prolog`; raises XMLSyntaxError."""
    # Not huge_tree: depth and single texts stay limited, whatever the size of the whole.
    return etree.fromstring(
        data, etree.XMLParser(resolve_entities=False, load_dtd=False, no_network=True, huge_tree=False)
    )


def parse(data: bytes) -> tuple[Description | None, list[Finding]]:
    """The description, or None when there is nothing to go on with, and what is wrong with the file itself."""
    found = list(prolog.findings(data))
    if any(finding.rule not in (prolog.DECLARATION.id, prolog.ENCODING.id) for finding in found):
        return None, found
    try:
        root = tree(data)
    except etree.XMLSyntaxError as problem:
        return None, [*found, prolog.PARSES.at(DESCRIPTION, problem, "well-formed XML")]
    found += _root(root)
    version = VERSIONS.get(root.get("fmiVersion", ""))
    return (None if version is None or root.tag != "fmiModelDescription" else Description(root, version)), found


def _root(root: etree._Element) -> Iterator[Finding]:
    where = f"{DESCRIPTION}:{root.sourceline}"
    if root.tag != "fmiModelDescription":
        yield ROOT.at(where, root.tag, "fmiModelDescription")
    elif root.get("fmiVersion") not in VERSIONS:
        yield VERSION.at(where, f"fmiVersion {root.get('fmiVersion')}", f"{' or '.join(VERSIONS)}")
