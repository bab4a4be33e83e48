"""The description as a tree: parsed without trusting it, tolerant of what other rules will report."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from xml.parsers import expat

from lxml import etree

from exo.validate.archive import DESCRIPTION
from exo.validate.rule import Finding, error, printable

PARSES = error("xml-parses", "the description is well-formed XML")
DOCTYPE = error("xml-doctype", "the description declares no document type and no entities")
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


class Description:
    """The parsed description."""

    def __init__(self, root: etree._Element) -> None:
        self.root = root
        self.types = {t.get("name", ""): t for t in self.all("TypeDefinitions/SimpleType")}
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

    def items(self, variable: Variable) -> list[int]:
        """The item values of an Enumeration's declared type."""
        declared = self.types.get(variable.type.get("declaredType", ""))
        if declared is None:
            return []
        return [value for item in declared.iterfind("Enumeration/Item") for value in integers(item.get("value")) or []]

    def _variable(self, index: int, element: etree._Element) -> Variable:
        kind_element = next((child for child in element if child.tag in KINDS), None)
        kind, given = "", {}
        if kind_element is not None:
            kind = str(kind_element.tag)
            declared = self.types.get(kind_element.get("declaredType", ""))
            inherited = None if declared is None else declared.find(kind)
            given = {**({} if inherited is None else texts(inherited)), **texts(kind_element)}
        own = texts(element)
        return Variable(index, own, kind, given, place(element, f"variable {own.get('name', '')}"))


def texts(element: etree._Element) -> dict[str, str]:
    """The attributes of an element."""
    return {str(key): str(value) for key, value in element.attrib.items()}


def place(element: etree._Element, name: str) -> str:
    """`modelDescription.xml:12 <name>`"""
    return f"{DESCRIPTION}:{element.sourceline} {printable(name)}"


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
    if found:
        return None, found
    parser = etree.XMLParser(resolve_entities=False, load_dtd=False, no_network=True, huge_tree=False)
    try:
        root = etree.fromstring(data, parser)
    except etree.XMLSyntaxError as problem:
        return None, [PARSES.at(DESCRIPTION, problem, "well-formed XML")]
    if root.tag != "fmiModelDescription":
        return None, [ROOT.at(f"{DESCRIPTION}:{root.sourceline}", root.tag, "fmiModelDescription")]
    if root.get("fmiVersion") != "2.0":
        value = f"fmiVersion {root.get('fmiVersion')}"
        return None, [VERSION.at(f"{DESCRIPTION}:{root.sourceline}", value, "2.0, the only version that is checked")]
    return Description(root), []


class _DoctypeError(Exception):
    """Ends the first pass before any entity is expanded."""


def _prolog(data: bytes) -> Iterator[Finding]:
    """A first pass that keeps nothing: well-formedness, encoding, and no document type."""
    encodings: list[str] = []

    def doctype(*_: object) -> None:
        raise _DoctypeError

    parser = expat.ParserCreate()
    parser.StartDoctypeDeclHandler = doctype
    parser.XmlDeclHandler = lambda _version, encoding, _standalone: encodings.append(encoding or "UTF-8")
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
        if data[:2] in (b"\xff\xfe", b"\xfe\xff") or any(name.upper() != "UTF-8" for name in encodings):
            yield ENCODING.at(f"{DESCRIPTION}:1", encodings[0] if encodings else "UTF-16", "UTF-8")
