"""XML of an archive, read without trusting it: no document type, no entity, no network."""

from math import isfinite
from typing import Any

from lxml import etree

from exo.validate.references import XML
from exo.validate.rule import Finding


def parse(data: bytes, where: str) -> tuple[Any, list[Finding]]:
    """The root element, or None with the finding that says why."""
    parser = etree.XMLParser(resolve_entities=False, no_network=True, load_dtd=False, huge_tree=False)
    try:
        root = etree.fromstring(data, parser)
    except (etree.XMLSyntaxError, ValueError) as problem:
        return None, [XML.at(where, problem, "well-formed XML")]
    if root.getroottree().docinfo.doctype:
        return None, [XML.at(where, "a document type", "none")]
    return root, []


def local(element: Any) -> str:
    """An element's name without its namespace; empty for comments and processing instructions."""
    return etree.QName(element).localname if isinstance(element.tag, str) else ""


def children(element: Any, name: str) -> list[Any]:
    """The children of this name, whatever their namespace."""
    return [child for child in element if local(child) == name]


def located(where: str, element: Any) -> str:
    """File and line."""
    return f"{where}: line {element.sourceline}"


def number(text: str | None) -> float | None:
    """A finite number, or None. An underscore, which Python takes, is none."""
    try:
        value = float(text) if text is not None and "_" not in text else float("nan")
    except ValueError:
        return None
    return value if isfinite(value) else None
