"""The description as a tree: parsed without trusting it, tolerant of what other rules will report."""

import re
from collections import ChainMap
from collections.abc import Collection, Iterator, Mapping, MutableMapping
from dataclasses import dataclass
from functools import cached_property
from itertools import islice
from xml.parsers import expat

from lxml import etree

from exo.validate.archive import DESCRIPTION
from exo.validate.rule import Finding, error, printable

PARSES = error("xml-parses", "the description is well-formed XML")
DOCTYPE = error("xml-doctype", "the description declares no document type and no entities")
DECLARATION = error("xml-declaration", "the description begins with an XML declaration that names its encoding")
ENCODING = error("xml-encoding", "the description is encoded in UTF-8")
ROOT = error("xml-root", "the root element is fmiModelDescription")
VERSION = error("xml-version", "fmiVersion is 2.0")

KINDS = ("Real", "Integer", "Boolean", "String", "Enumeration")


@dataclass(frozen=True)
class Variable:
    """A `ScalarVariable`, with what its declared type gives."""

    #: 1-based position, as ModelStructure counts.
    index: int
    #: Own attributes.
    own: Mapping[str, str]
    #: Real, Integer, Boolean, String, Enumeration; empty when there is none of them.
    kind: str
    #: Attributes of the kind's element over those of the declared type.
    type: Mapping[str, str]
    where: str

    @property
    def name(self) -> str:
        """The name, empty if missing."""
        return self.own.get("name", "")

    @property
    def causality(self) -> str:
        """The causality, by default local."""
        return self.own.get("causality", "local")

    @property
    def variability(self) -> str:
        """The variability, by default continuous."""
        return self.own.get("variability", "continuous")

    @property
    def initial(self) -> str:
        """How the value is initialised: given, or the default of causality and variability; empty for none."""
        if "initial" in self.own:
            return self.own["initial"]
        if self.causality in ("input", "independent"):
            return ""
        exact = self.causality == "parameter" or self.variability == "constant"
        return "exact" if exact else "calculated"

    @property
    def has_start(self) -> bool:
        """Whether the importer knows the value before it asks the FMU."""
        return self.causality == "input" or self.initial == "exact"


class SimpleType:
    """A `SimpleType`: asked once for each variable that declares it, so its children are sorted once."""

    def __init__(self, element: etree._Element) -> None:
        self.element = element
        #: Attributes of its kinds; of a kind that stands twice those of the first.
        self.kinds = {str(child.tag): texts(child) for child in reversed(element) if child.tag in KINDS}
        #: The values of an Enumeration's items, in their order.
        self.items = dict.fromkeys(
            value for item in element.iterfind("Enumeration/Item") for value in integers(item.get("value")) or []
        )


class Description:
    """The parsed description."""

    def __init__(self, root: etree._Element) -> None:
        self.root = root
        self.types = {
            element.get("name", ""): SimpleType(element) for element in self.all("TypeDefinitions/SimpleType")
        }
        self.variables = tuple(
            self._variable(index, element)
            for index, element in enumerate(self.all("ModelVariables/ScalarVariable"), start=1)
        )

    def all(self, path: str) -> list[etree._Element]:
        """Elements below the root."""
        return list(self.root.iterfind(path))

    def first(self, path: str) -> etree._Element | None:
        """The first element below the root."""
        return self.root.find(path)

    @property
    def identifier(self) -> str | None:
        """The modelIdentifier of co-simulation; None when it is no C identifier, and so no name of a file in here."""
        slave = self.first("CoSimulation")
        identifier = "" if slave is None else slave.get("modelIdentifier", "")
        return identifier if re.fullmatch(r"[A-Za-z_][A-Za-z0-9_]*", identifier) else None

    @cached_property
    def states(self) -> frozenset[int]:
        """Indices of the variables that have a derivative."""
        return frozenset(index for v in self.variables for index in integers(v.type.get("derivative")) or [])

    def items(self, variable: Variable) -> Collection[int]:
        """The item values of an Enumeration's declared type."""
        declared = self.types.get(variable.type.get("declaredType", ""))
        return () if declared is None else declared.items.keys()

    def _variable(self, index: int, element: etree._Element) -> Variable:
        kind_element = next((child for child in element if child.tag in KINDS), None)
        kind = ""
        given: MutableMapping[str, str] = {}
        if kind_element is not None:
            kind = str(kind_element.tag)
            given = texts(kind_element)
            declared = self.types.get(given.get("declaredType", ""))
            if declared is not None and kind in declared.kinds:
                given = ChainMap(given, declared.kinds[kind])
        own = texts(element)
        return Variable(index, own, kind, given, place(element, f"variable {own.get('name', '')}"))


def texts(element: etree._Element) -> dict[str, str]:
    """The attributes of an element."""
    return {str(key): str(value) for key, value in element.attrib.items()}


def place(element: etree._Element, name: str) -> str:
    """`modelDescription.xml:12 <name>`"""
    return f"{DESCRIPTION}:{element.sourceline} {printable(name)}"


def listed(values: Collection[object], limit: int = 10) -> str:
    """`1, 2, 3`; of many values the first ones."""
    return ", ".join(map(str, islice(values, limit))) + (f", … ({len(values)} in all)" if len(values) > limit else "")


def number(text: str | None) -> float | None:
    """The number that an attribute holds, None without one."""
    try:
        return None if text is None else float(text)
    except ValueError:
        return None


def integers(text: str | None) -> list[int] | None:
    """The list that an attribute holds; None without one, or when it is not a list of integers."""
    try:
        return None if text is None else [int(part) for part in text.split()]
    except ValueError:
        return None


def parse(data: bytes) -> tuple[Description | None, list[Finding]]:
    """The description, or None when there is nothing to go on with, and what is wrong with the file itself."""
    found = list(_prolog(data))
    if any(finding.rule not in (DECLARATION.id, ENCODING.id) for finding in found):
        return None, found
    # Not huge_tree: depth and single texts stay limited, whatever the size of the whole.
    parser = etree.XMLParser(resolve_entities=False, load_dtd=False, no_network=True, huge_tree=False)
    try:
        root = etree.fromstring(data, parser)
    except etree.XMLSyntaxError as problem:
        return None, [*found, PARSES.at(DESCRIPTION, problem, "well-formed XML")]
    if root.tag != "fmiModelDescription":
        return None, [*found, ROOT.at(f"{DESCRIPTION}:{root.sourceline}", root.tag, "fmiModelDescription")]
    if root.get("fmiVersion") != "2.0":
        value = f"fmiVersion {root.get('fmiVersion')}"
        wanted = "2.0, the only version that is checked"
        return None, [*found, VERSION.at(f"{DESCRIPTION}:{root.sourceline}", value, wanted)]
    return Description(root), found


class _DoctypeError(Exception):
    """Ends the first pass before any entity is expanded."""


def _prolog(data: bytes) -> Iterator[Finding]:
    """A first pass that keeps nothing: well-formedness, declaration, encoding, and no document type."""
    #: Of the declaration, if there is one: the encoding that it names.
    declared: list[str | None] = []

    def doctype(*_: object) -> None:
        raise _DoctypeError

    parser = expat.ParserCreate()
    parser.StartDoctypeDeclHandler = doctype
    parser.XmlDeclHandler = lambda _version, encoding, _standalone: declared.append(encoding)
    try:
        parser.Parse(data, True)
    except _DoctypeError:
        yield DOCTYPE.at(
            f"{DESCRIPTION}:{parser.CurrentLineNumber}",
            "<!DOCTYPE",
            "no document type: entities can expand without end",
        )
    except (expat.ExpatError, ValueError, LookupError) as problem:
        yield PARSES.at(DESCRIPTION, problem, "well-formed XML")
    else:
        if declared in ([], [None]):
            value = "a declaration without encoding" if declared else "no XML declaration"
            yield DECLARATION.at(f"{DESCRIPTION}:1", value, '<?xml version="1.0" encoding="UTF-8"?>')
        encoding = next(filter(None, declared), "UTF-8")
        if data[:2] in (b"\xff\xfe", b"\xfe\xff") or encoding.upper() != "UTF-8":
            yield ENCODING.at(f"{DESCRIPTION}:1", encoding if encoding.upper() != "UTF-8" else "UTF-16", "UTF-8")
