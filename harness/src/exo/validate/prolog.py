"""The description's file, before it is a tree: well-formedness, declaration, encoding, and no document type."""

from collections.abc import Iterator
from xml.parsers import expat

from exo.validate.archive import DESCRIPTION
from exo.validate.rule import Finding, error

PARSES = error("xml-parses", "the description is well-formed XML")
DOCTYPE = error("xml-doctype", "the description declares no document type and no entities")
DECLARATION = error("xml-declaration", "the description begins with an XML declaration that names its encoding")
ENCODING = error("xml-encoding", "the description is encoded in UTF-8")


class _DoctypeError(Exception):
    """Ends the first pass before any entity is expanded."""


def findings(data: bytes, file: str = DESCRIPTION) -> Iterator[Finding]:
    """All of this module's rules, in a first pass over `file` that keeps nothing."""
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
        encoding = next(filter(None, declared), "UTF-8")
        if data[:2] in (b"\xff\xfe", b"\xfe\xff") or encoding.upper() != "UTF-8":
            yield ENCODING.at(f"{file}:1", encoding if encoding.upper() != "UTF-8" else "UTF-16", "UTF-8")
