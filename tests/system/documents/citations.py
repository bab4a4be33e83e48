"""What verdicts and comments cite of docs/specification.md and docs/passivity.md, and whether it stands there."""

import re

from documents.names import OWN, ROOT, files

SECTION = re.compile(r"docs/specification\.md,? sections? (\d)(?:, ([^\";:.]+))?")
#: Only headings can be cited of the other page, with a step of the proof.
HEADING = re.compile(r"docs/passivity\.md, ([A-Z][^\";:.\n]+)")


def sources() -> list[str]:
    """Files that may cite: scenarios, the harness, tests, the law."""
    kinds, folders = (".toml", ".py", ".rs", ".xml"), ("harness/", "tests/", "fmu/", "plant-fmu/")
    return [path for path in files() if path.endswith(kinds) and path.startswith(folders) and not path.startswith(OWN)]


def sections(text: str) -> dict[str, str]:
    """The numbered sections of a page."""
    parts = re.split(r"^## (\d) ", text, flags=re.MULTILINE)
    return dict(zip(parts[1::2], parts[2::2], strict=True))


def subjects(section: str) -> list[str]:
    """What a section marks as a subject: headings, bold and slanted terms, names in backticks; in small letters."""
    section = re.sub(r"<!--.*?<!-- end -->", "", section, flags=re.DOTALL)
    marked = re.findall(r"\*\*(.+?)\*\*|(?<!\*)\*([^*\n]+)\*|`([^`\n]+)`", section)
    terms = [term.strip(" .:").lower() for groups in marked for term in groups if term]
    return [section.splitlines()[0].lower(), *terms]


def unfounded(text: str) -> list[str]:
    """The citations of a text that lead nowhere."""
    specification = sections((ROOT / "docs/specification.md").read_text(encoding="utf-8"))
    wrong = []
    for number, subject in SECTION.findall(text):
        cited = subject.strip().lower()
        if number not in specification or (
            cited
            and not cited.startswith("section")
            and not any(map(cited.startswith, subjects(specification[number])))
        ):
            wrong.append(f"section {number}, {subject}")
    passivity = (ROOT / "docs/passivity.md").read_text(encoding="utf-8")
    headings = re.findall(r"^## (.+)$", passivity, flags=re.MULTILINE)
    wrong += [heading for heading in HEADING.findall(text) if not any(map(heading.startswith, headings))]
    return wrong
