"""sources/buildDescription.xml of FMI 3.0: how the sources are compiled, and that they are all there."""

from collections.abc import Iterator

from lxml import etree

from exo.validate import attachments
from exo.validate.archive import Contents
from exo.validate.description import Description, place
from exo.validate.rule import Finding, error

FILE = "sources/buildDescription.xml"

THERE = error("sources-description", "sources/ comes with buildDescription.xml, which fits its schema", only="3.0")
VERSION = error("sources-version", "its fmiVersion is that of the description", only="3.0")
IDENTIFIER = error("sources-identifier", "its configurations build modelIdentifiers of the description", only="3.0")
FILES = error("sources-file", "the source files and folders that it names are there", only="3.0")


def findings(contents: Contents, description: Description) -> Iterator[Finding]:
    """All of this module's rules."""
    if FILE not in contents.files:
        if any(name.startswith("sources/") for name in contents.files):
            yield THERE.at("sources", "no buildDescription.xml", FILE)
        return
    root, found = attachments.read(
        contents, FILE, root="fmiBuildDescription", schema="fmi3BuildDescription.xsd", rule=THERE
    )
    yield from found
    if root is None:
        return
    if root.get("fmiVersion") != description.version.name:
        value = f"fmiVersion {root.get('fmiVersion')}"
        yield VERSION.at(f"{FILE}:{root.sourceline}", value, description.version.name)
    interfaces = ("ModelExchange", "CoSimulation", "ScheduledExecution")
    known = {one.get("modelIdentifier", "") for name in interfaces for one in description.all(name)}
    for configuration in root.iterfind("BuildConfiguration"):
        identifier = configuration.get("modelIdentifier", "")
        if identifier not in known:
            value = f"modelIdentifier {identifier}"
            yield IDENTIFIER.at(place(configuration, "BuildConfiguration", FILE), value, " or ".join(sorted(known)))
    yield from _files(contents, root)


def _files(contents: Contents, root: etree._Element) -> Iterator[Finding]:
    for element in root.iter("SourceFile"):
        if f"sources/{element.get('name', '')}" not in contents.files:
            yield FILES.at(place(element, "SourceFile", FILE), element.get("name", ""), "a file in sources/")
    for element in root.iter("IncludeDirectory"):
        name = element.get("name", "").rstrip("/")
        if name not in ("", ".") and f"sources/{name}" not in contents.folders:
            yield FILES.at(place(element, "IncludeDirectory", FILE), name, "a folder in sources/")
