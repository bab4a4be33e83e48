"""One XML document of an SSP archive: parsed without trusting it, then judged by the schema of its version."""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any
from xml.parsers import expat

import fmpy.ssp
from lxml import etree

from exo import systems
from exo.systems.document import SSB, SSC, SSD, SSM, SSV
from exo.systems.interface import Unit, units
from exo.validate.rule import Finding, printable
from exo.validate.ssp.rule import error

PARSES = error("parses", "each document is well-formed XML")
DOCTYPE = error("doctype", "no document declares a document type or entities")
ENCODING = error("encoding", "each document is encoded in UTF-8")
ROOT = error("root", "the root element is that of the file's extension")
VERSION = error("version", "the version of each document is 1.0 or 2.0")
SCHEMA = error("schema", "each document is valid by the schema of its version")
UNIT = error("unit-undefined", "units are defined in the document that uses them")
ENUMERATION = error("enumeration-undefined", "enumerations are defined in the document that uses them")

#: By extension: namespace and root element.
ROOTS = {
    ".ssd": (SSD, "SystemStructureDescription"),
    ".ssv": (SSV, "ParameterSet"),
    ".ssm": (SSM, "ParameterMapping"),
    ".ssb": (SSB, "SignalDictionary"),
}
#: What may name a unit or an enumeration.
USERS = ("Real", "Float64", "Float32", "Enumeration")
SCHEMAS = {
    SSD: "SystemStructureDescription.xsd",
    SSV: "SystemStructureParameterValues.xsd",
    SSM: "SystemStructureParameterMapping.xsd",
    SSB: "SystemStructureSignalDictionary.xsd",
}
#: fmpy brings the schemas of 1.0; those of 2.0 lie in this package (BSD-2-Clause, as each says).
FOLDERS = {
    "1.0": Path(str(fmpy.ssp.__file__)).parent / "schema",
    "2.0": Path(str(systems.__file__)).parent / "schema",
}


@dataclass(frozen=True)
class Document:
    """A parsed file, or an element in a file that could be one."""

    file: str
    root: Any
    version: str
    units: dict[str, Unit]

    def place(self, element: Any, name: str) -> str:
        """`SystemStructure.ssd:12 <name>`"""
        return f"{self.file}:{element.sourceline} {printable(name)}"

    def all(self, path: str, element: Any = None) -> list[Any]:
        """Elements below one of the document, else below the root; prefixes as the standard has them."""
        return list((self.root if element is None else element).iterfind(path, NAMESPACES))

    def inside(self, element: Any) -> "Document":
        """The document that stands in this one. Its units may be those of the whole."""
        own = {unit.name: unit for unit in units(element.iterfind("{*}Units/{*}Unit"), "{*}BaseUnit")}
        return Document(self.file, element, element.get("version", ""), self.units | own)


NAMESPACES = {"ssd": SSD, "ssc": SSC, "ssv": SSV, "ssm": SSM, "ssb": SSB}


def parse(file: str, data: bytes) -> tuple[Document | None, list[Finding]]:
    """The document, or None where there is nothing to go on with, and what is wrong with it by itself."""
    found = list(_prolog(file, data))
    if any(finding.rule != ENCODING.id for finding in found):
        return None, found
    parser = etree.XMLParser(resolve_entities=False, load_dtd=False, no_network=True, huge_tree=False)
    try:
        root = etree.fromstring(data, parser)
    except etree.XMLSyntaxError as problem:
        return None, [*found, PARSES.at(file, problem, "well-formed XML")]
    namespace, name = ROOTS[Path(file).suffix]
    if root.tag != f"{{{namespace}}}{name}":
        return None, [*found, ROOT.at(f"{file}:{root.sourceline}", root.tag, f"{{{namespace}}}{name}")]
    document = Document(file, root, "", {}).inside(root)
    return document, [*found, *judged(document)]


def judged(document: Document) -> Iterator[Finding]:
    """Version, schema and names that must be defined, of a document or of one that stands in another."""
    root = document.root
    where = document.place(root, etree.QName(root).localname)
    if document.version not in FOLDERS:
        yield VERSION.at(where, f"version {document.version}", "1.0 or 2.0")
    else:
        schema = _schema(document.version, etree.QName(root).namespace)
        if not schema.validate(root):
            for entry in schema.error_log:
                message = " ".join(entry.message.split())
                yield SCHEMA.at(
                    f"{document.file}:{entry.line}", message, f"what the schema of {document.version} allows"
                )
    enumerations = {one.get("name") for one in root.iterfind("{*}Enumerations/{*}Enumeration")}
    for element in _own(root):
        unit = element.get("unit")
        if unit and unit not in document.units:
            yield UNIT.at(document.place(element, f"in {_owner(element)}"), unit, "a unit of Units")
        if _names_enumeration(element) and element.get("name") not in enumerations:
            value = element.get("name")
            yield ENUMERATION.at(document.place(element, f"in {_owner(element)}"), value, "one of Enumerations")


def _own(root: Any) -> Iterator[Any]:
    """Types with units and enumerations, without those of documents that stand in this one."""
    inner = {f"{{{namespace}}}{name}" for namespace, name in ROOTS.values()}
    waiting = [root]
    while waiting:
        element = waiting.pop()
        if isinstance(element.tag, str) and etree.QName(element).localname in USERS:
            yield element
        waiting += [child for child in reversed(element) if child.tag not in inner]


def _names_enumeration(element: Any) -> bool:
    """Whether it is the type of a connector or a dictionary's entry, and no definition."""
    parent = element.getparent()
    local = "" if parent is None else etree.QName(parent).localname
    return etree.QName(element).localname == "Enumeration" and local in ("Connector", "DictionaryEntry")


def _owner(element: Any) -> str:
    """`Connector q`"""
    parent = element.getparent()
    return "" if parent is None else f"{etree.QName(parent).localname} {parent.get('name', '')}"


@cache
def _schema(version: str, namespace: str) -> Any:
    return etree.XMLSchema(etree.parse(str(FOLDERS[version] / SCHEMAS[namespace])))


class _DoctypeError(Exception):
    """Ends the first pass before any entity is expanded."""


def _prolog(file: str, data: bytes) -> Iterator[Finding]:
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
            f"{file}:{parser.CurrentLineNumber}", "<!DOCTYPE", "no document type: entities can expand without end"
        )
    except (expat.ExpatError, ValueError, LookupError) as problem:
        yield PARSES.at(file, problem, "well-formed XML")
    else:
        encoding = next(iter(encodings), "UTF-8")
        if data[:2] in (b"\xff\xfe", b"\xfe\xff") or encoding.upper() != "UTF-8":
            yield ENCODING.at(f"{file}:1", encoding if encoding.upper() != "UTF-8" else "UTF-16", "UTF-8")
