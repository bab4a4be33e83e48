"""XML files beside the description: parsed like it, judged by the standard's schema, which fmpy brings along."""

from collections.abc import Iterator
from functools import cache
from pathlib import Path

import fmpy
from lxml import etree

from exo.validate import prolog
from exo.validate.archive import Contents
from exo.validate.description import tree
from exo.validate.rule import Finding, Rule

#: Schemas of FMI 3.0, in which both versions write these files.
SCHEMAS = Path(fmpy.__file__).parent / "schema" / "fmi3"
#: Errors of the schema that are shown.
SHOWN = 5


def read(
    contents: Contents, file: str, *, root: str, schema: str, rule: Rule
) -> tuple[etree._Element | None, list[Finding]]:
    """The root of a file, None when it cannot be read; whatever is wrong with it breaks `rule`."""
    data = contents.read(file)
    found = [rule.at(finding.where, finding.value, finding.expected) for finding in prolog.findings(data, file)]
    if found:
        return None, found
    try:
        element = tree(data)
    except etree.XMLSyntaxError as problem:
        return None, [rule.at(file, problem, "well-formed XML")]
    if element.tag != root:
        return None, [rule.at(f"{file}:{element.sourceline}", element.tag, root)]
    return element, list(_schema(element, file, schema, rule))


def _schema(element: etree._Element, file: str, schema: str, rule: Rule) -> Iterator[Finding]:
    judge = _loaded(schema)
    if element.get("fmiVersion", "").startswith("3.") and not judge.validate(element):
        for entry in list(judge.error_log)[:SHOWN]:
            yield rule.at(f"{file}:{entry.line}", entry.message, f"what {schema} allows")


@cache
def _loaded(name: str) -> etree.XMLSchema:
    return etree.XMLSchema(etree.parse(SCHEMAS / name))
