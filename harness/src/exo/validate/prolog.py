"""The description's file, before it is a tree: well-formedness, declaration, encoding, and no document type."""

import codecs
from collections.abc import Iterator
from xml.parsers import expat

from exo.validate.archive import DESCRIPTION
from exo.validate.rule import Finding, error, warning

PARSES = error("xml-parses", "the description is well-formed XML")
DOCTYPE = error("xml-doctype", "the description declares no document type and no entities")
DECLARATION = error("xml-declaration", "the description begins with a declaration of XML 1.0 that names its encoding")
MARK = warning("xml-mark", "no byte order mark stands before the description: some readers stumble over it")
ENCODING = error("xml-encoding", "the description is encoded in UTF-8")


class _DoctypeError(Exception):
    """Ends the first pass before any entity is expanded."""


def findings(data: bytes, file: str = DESCRIPTION) -> Iterator[Finding]:
    """All of this module's rules, in a first pass over `file` that keeps nothing."""
    #: Of the declaration, if there is one: the encoding that it names, and the version.
    declared: list[str | None] = []
    versions: list[str] = []

    def doctype(*_: object) -> None:
        raise _DoctypeError

    def declaration(version: str, encoding: str | None, _: int) -> None:
        versions.append(version)
        declared.append(encoding)

    parser = expat.ParserCreate()
    parser.StartDoctypeDeclHandler = doctype
    parser.XmlDeclHandler = declaration
    try:
        parser.Parse(data, True)
    except _DoctypeError:
        yield DOCTYPE.at(
            f"{file}:{parser.CurrentLineNumber}",
            "<!DOCTYPE",
            "no document type: entities can expand without end",
        )
    except (expat.ExpatError, ValueError, LookupError) as problem:
        yield PARSES.at(file, problem, "well-formed XML")
    else:
        if declared in ([], [None]):
            value = "a declaration without encoding" if declared else "no XML declaration"
            yield DECLARATION.at(f"{file}:1", value, '<?xml version="1.0" encoding="UTF-8"?>')
        elif versions != ["1.0"]:
            yield DECLARATION.at(f"{file}:1", f"XML {versions[0]}", "XML 1.0")
        if data.startswith(codecs.BOM_UTF8):
            yield MARK.at(f"{file}:1", "a byte order mark", "<?xml as the first letters")
        encoding = next(filter(None, declared), "UTF-8")
        if data[:2] in (b"\xff\xfe", b"\xfe\xff") or encoding.upper() != "UTF-8":
            yield ENCODING.at(f"{file}:1", encoding if encoding.upper() != "UTF-8" else "UTF-16", "UTF-8")
