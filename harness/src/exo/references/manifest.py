"""`fmi-ls-manifest.xml`: which related files there are, and in which role."""

import posixpath
import re
from dataclasses import dataclass
from typing import Any
from urllib.parse import unquote, urlsplit

from exo.references.names import CSV_TYPE, DESCRIPTION, FMI_LS, NAME
from exo.references.xml import children, local, located, parse
from exo.validate import references as rules
from exo.validate.rule import Finding

ROLES = (
    *("document", "requirement", "specification", "model", "parameter", "system", "testcase", "experiment", "result"),
    *("method", "rationale", "report", "request", "delivery", "configuration", "signature", "serialized-state"),
    *("meta-data", "other"),
)
EXPERIMENTS = ("smoke-test", "validation", "uncertainty-analysis")
#: Any platform may follow a state; three purposes may follow an experiment.
ROLE = re.compile(rf"({'|'.join(ROLES)}|experiment/({'|'.join(EXPERIMENTS)})|serialized-state/.*)")
ANY_TYPE = "application/octet-stream"
ATTRIBUTES = {"type", "source", "role", "description"}


@dataclass(frozen=True)
class Related:
    """One related file, whose address is that in the archive."""

    type: str
    #: Path in the archive; None where the address is absolute, and so not looked at.
    path: str | None
    source: str
    role: str
    where: str

    @property
    def main_role(self) -> str:
        """The role without what follows a slash."""
        return self.role.split("/", maxsplit=1)[0]


def resolve(base: str, source: str) -> str | None:
    """The path in the archive that a relative address means, seen from the file `base`; None for an absolute one.

    A path that leaves the archive begins with `..`; nothing in the archive has such a name.
    """
    try:
        parts = urlsplit(source)
    except ValueError:
        return None
    if parts.scheme or parts.netloc or parts.path.startswith("/"):
        return None
    return posixpath.normpath(posixpath.join(posixpath.dirname(base), unquote(parts.path)))


def read(data: bytes, where: str) -> tuple[list[Related], list[Finding]]:
    """The related files, and what the schema does not allow: as much is read as can be."""
    root, found = parse(data, where)
    if root is None:
        return [], found
    if local(root) != "fmiReferences" or root.tag != "fmiReferences":
        return [], [rules.MANIFEST.at(located(where, root), root.tag, "the root fmiReferences without a namespace")]
    found += _attributes(root, where)
    related = []
    for child in root:
        match local(child):
            case "Related":
                found += _related(child, where)
                if source := child.get("source"):
                    related.append(
                        Related(
                            type=child.get("type", ANY_TYPE),
                            path=resolve(where, source),
                            source=source,
                            role=child.get("role", ""),
                            where=located(where, child),
                        )
                    )
            case "Annotations" | "":
                pass
            case other:
                found.append(rules.MANIFEST.at(located(where, child), other, "Related or Annotations"))
    return related, found


def _attributes(root: Any, where: str) -> list[Finding]:
    expected = {"fmi-ls-name": NAME, "fmi-ls-version": None, "fmi-ls-description": DESCRIPTION}
    found = []
    for name, value in expected.items():
        got = root.get(f"{{{FMI_LS}}}{name}")
        if got is None or (value is not None and got != value):
            wanted = repr(value) if value else "a version, as 1.0.0-beta.1"
            said = f"{name} {got!r}" if got is not None else f"no attribute fmi-ls:{name}"
            found.append(rules.MANIFEST.at(located(where, root), said, wanted))
    return found


def _related(element: Any, where: str) -> list[Finding]:
    def broken(value: str, expected: str) -> Finding:
        return rules.MANIFEST.at(located(where, element), value, expected)

    found = []
    if not element.get("source"):
        found.append(broken("Related without source", "the file's address"))
    role = element.get("role")
    if role is None or not ROLE.fullmatch(role):
        said = f"role {role!r}" if role is not None else "Related without role"
        found.append(broken(said, f"one of {', '.join(ROLES)}, or experiment/{' or '.join(EXPERIMENTS)}"))
    found += [broken(f"attribute {name}", ", ".join(sorted(ATTRIBUTES))) for name in set(element.keys()) - ATTRIBUTES]
    for child in element:
        if local(child) not in ("Label", "Annotations", ""):
            found.append(broken(local(child), "Label or Annotations"))
    found += [broken("Label without name", "a name") for label in children(element, "Label") if not label.get("name")]
    return found


def is_csv(kind: str) -> bool:
    """Whether a type means comma-separated values, whatever parameters it has."""
    return kind.split(";", maxsplit=1)[0].strip().lower() == CSV_TYPE
