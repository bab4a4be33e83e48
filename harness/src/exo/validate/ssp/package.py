"""The files of an SSP archive: what lies where, and what a URI in a document points to."""

import posixpath
from collections.abc import Iterator
from urllib.parse import unquote, urlsplit

from exo.validate.archive import Contents
from exo.validate.rule import Finding
from exo.validate.ssp.document import Document
from exo.validate.ssp.rule import error, warning

LAYOUT = warning("layout", "the root holds descriptions, and only the folders that the standard names")
DOCUMENTATION = error("documentation", "documentation/, if there, has index.html")
VARIANT = error("variant-name", "the names of the descriptions at the root differ, where one of them is of version 2.0")
OUTSIDE = warning("source-outside", "sources are relative URIs that stay in the archive")
MISSING = error("source-missing", "what a source names is in the archive")

DEFAULT = "SystemStructure.ssd"
FOLDERS = {"resources", "documentation", "extra"}


def findings(contents: Contents) -> Iterator[Finding]:
    """What is wrong with the names of the files."""
    for name in contents.files:
        if "/" not in name and not name.endswith(".ssd"):
            yield LAYOUT.at(name, "a file at the root", "descriptions (.ssd) only")
    for folder in sorted(contents.folders):
        if "/" not in folder and folder not in FOLDERS:
            yield LAYOUT.at(folder, "a folder at the root", f"one of {', '.join(sorted(FOLDERS))}")
    if "documentation" in contents.folders and "documentation/index.html" not in contents.files:
        yield DOCUMENTATION.at("documentation", "no index.html", "documentation/index.html as the way in")


def variants(documents: dict[str, Document]) -> Iterator[Finding]:
    """Names that two descriptions at the root share."""
    root = {file: document for file, document in documents.items() if "/" not in file and file.endswith(".ssd")}
    if all(document.version == "1.0" for document in root.values()):
        return
    known: dict[str, str] = {}
    for file, document in root.items():
        name = document.root.get("name", "")
        if (other := known.setdefault(name, file)) != file:
            yield VARIANT.at(
                document.place(document.root, "SystemStructureDescription"), f"{name}, as {other}", "another name"
            )


def resolve(contents: Contents, document: Document, where: str, source: str) -> tuple[str, list[Finding]]:
    """The file in the archive that a source names, empty where there is none, and what is wrong with the source.

    What lies in another archive or on a server is not looked for.
    """
    try:
        parts = urlsplit(source)
    except ValueError as problem:
        return "", [OUTSIDE.at(where, f"{source}: {problem}", "a relative URI")]
    if parts.scheme or parts.netloc or source.startswith("/"):
        return "", [OUTSIDE.at(where, source, "a relative URI of a file in the archive")]
    base = posixpath.dirname(document.file)
    file = posixpath.normpath(posixpath.join(base, unquote(parts.path)))
    if file.startswith(".."):
        return "", [OUTSIDE.at(where, source, "a relative URI that does not leave the archive")]
    if file not in contents.files:
        return "", [MISSING.at(where, source, "a file of the archive")]
    return file, []
