"""terminalsAndIcons/terminalsAndIcons.xml: terminals whose variables exist, icons that are there.

FMI 2.0 refers to FMI 3.0 for this file, so it is judged in both.
"""

import posixpath
from collections import Counter
from collections.abc import Iterator
from urllib.parse import unquote

from lxml import etree

from exo.validate import attachments
from exo.validate.archive import Contents
from exo.validate.description import Description, place
from exo.validate.rule import Finding, error

FILE = "terminalsAndIcons/terminalsAndIcons.xml"

VALID = error("terminals-valid", "terminalsAndIcons.xml is well-formed, without document type, and fits its schema")
VERSION = error("terminals-version", "its fmiVersion is that of the description", only="3.0")
VARIABLE = error("terminals-variable", "members of terminals are variables of the description")
NAME = error("terminals-name", "terminals side by side have different names, and so have the members of one")
MEMBER = error("terminals-member", "members of a terminal with matchingRule plug or bus have a memberName")
ICON = error("terminals-icon", "each iconBaseName leads to a PNG file in terminalsAndIcons/")


def findings(contents: Contents, description: Description) -> Iterator[Finding]:
    """All of this module's rules."""
    if FILE not in contents.files:
        return
    root, found = attachments.read(
        contents, FILE, root="fmiTerminalsAndIcons", schema="fmi3TerminalsAndIcons.xsd", rule=VALID
    )
    yield from found
    if root is None:
        return
    if description.version.name == "3.0" and root.get("fmiVersion") != description.version.name:
        yield VERSION.at(f"{FILE}:{root.sourceline}", f"fmiVersion {root.get('fmiVersion')}", description.version.name)
    names = {named.name for variable in description.variables for named in variable.named}
    for parent in (*root.iterfind("Terminals"), *root.iter("Terminal")):
        yield from _siblings(parent)
    for terminal in root.iter("Terminal"):
        yield from _terminal(terminal, names)
    yield from _icons(contents, root)


def _siblings(parent: etree._Element) -> Iterator[Finding]:
    for name, times in Counter(one.get("name", "") for one in parent.iterfind("Terminal")).items():
        if times > 1 or not name:
            yield NAME.at(
                place(parent, f"terminals of {parent.get('name', 'the FMU')}", FILE), f"{name!r} {times} times", "once"
            )


def _terminal(terminal: etree._Element, names: set[str]) -> Iterator[Finding]:
    where = f"terminal {terminal.get('name', '')}"
    members: Counter[str] = Counter()
    for element in terminal.iterfind("TerminalMemberVariable"):
        member = element.get("memberName")
        if member is not None:
            members[member] += 1
        elif terminal.get("matchingRule") in ("plug", "bus"):
            value = f"{element.get('variableName', '')} without memberName"
            yield MEMBER.at(place(element, where, FILE), value, "a memberName, by which importers connect")
        yield from _variables(element, where, names, ("variableName",))
    for element in terminal.iterfind("TerminalStreamMemberVariable"):
        members.update(name for key in ("inStreamMemberName", "outStreamMemberName") if (name := element.get(key)))
        yield from _variables(element, where, names, ("inStreamVariableName", "outStreamVariableName"))
    for member, times in members.items():
        if times > 1:
            yield NAME.at(place(terminal, where, FILE), f"memberName {member} {times} times", "once")


def _variables(element: etree._Element, where: str, names: set[str], keys: tuple[str, ...]) -> Iterator[Finding]:
    for key in keys:
        if element.get(key, "") not in names:
            yield VARIABLE.at(place(element, where, FILE), f"{key} {element.get(key)}", "the name of a variable")


def _icons(contents: Contents, root: etree._Element) -> Iterator[Finding]:
    for element in root.iter(etree.Element):
        base = element.get("iconBaseName")
        if base is None:
            continue
        path = posixpath.normpath(posixpath.join("terminalsAndIcons", unquote(base) + ".png"))
        if path not in contents.files:
            yield ICON.at(place(element, str(element.tag), FILE), f"iconBaseName {base}", f"the file {path}")
