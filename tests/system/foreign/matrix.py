"""The table of importers: `matrix.toml` as data, as Markdown, and put into the documents.

cd tests/system && python -m foreign.matrix
"""

import tomllib
from dataclasses import dataclass
from pathlib import Path
from typing import Any

ROOT = Path(__file__).parents[3]
#: Document → the tables in it, each between two comments.
DOCUMENTS = {"docs/importers.md": ("importers", "matrix", "limits", "platforms", "absent")}
#: How a platform's state is said of an FMU.
STATES = {"run": "run", "built": "built, not run", "absent": "–"}


@dataclass(frozen=True)
class Matrix:
    """The tables of `matrix.toml`."""

    importer: list[dict[str, Any]]
    subject: list[dict[str, Any]]
    platform: list[dict[str, Any]]
    absent: list[dict[str, Any]]

    def ran(self, importer: str, fmu: str) -> bool:
        """Whether the table says that the importer ran the FMU."""
        return any(importer in one["ran"] for one in self.subject if one["name"] == f"{fmu}.fmu")

    def table(self, name: str) -> str:
        """One of the tables in Markdown."""
        match name:
            case "importers":
                head = ["importer", "version", "what it runs", "what is compared", "where"]
                rows = [
                    [one["name"], one.get("version", "–"), one["run"], one["compared"], _files(one["tests"])]
                    for one in self.importer
                ]
            case "limits":
                head = ["importer", "what it cannot do, or does its own way"]
                rows = [[one["name"], one["limits"]] for one in self.importer]
            case "platforms":
                head = ["platform", "state", "by"]
                rows = [[one["name"], STATES[one["state"]], one["by"]] for one in self.platform]
            case "absent":
                head = ["not run", "why"]
                rows = [[one["name"], one["why"]] for one in self.absent]
            case _:
                _, *others = self.platform
                importers = [one["name"] for one in self.importer]
                head = ["archive", *importers, *(one["name"] for one in others)]
                rows = [
                    [f"`{one['name']}`" if "(" not in one["name"] else one["name"]]
                    + ["run" if name in one["ran"] else "–" for name in importers]
                    + [_state(one["name"], other["state"]) for other in others]
                    for one in self.subject
                ]
        lines = [head, ["---"] * len(head), *rows]
        return "".join(f"| {' | '.join(line)} |\n" for line in lines)


def _state(subject: str, platform: str) -> str:
    """What was done with a subject on a platform: the C host there calls the functions of both versions."""
    return STATES[platform if subject.endswith(".fmu") else "absent"]


def _files(paths: list[str]) -> str:
    return ", ".join(f"`{path}`" for path in paths)


def names() -> tuple[str, ...]:
    """The FMUs: those with a committed description, which are those of the list in `modelDescription/fmus`."""
    return tuple(sorted(path.stem for path in (ROOT / "modelDescription").glob("*.xml")))


#: The models with a clock: those that have a description for scheduled execution.
NAMES_SCHEDULED = tuple(sorted(path.stem for path in (ROOT / "modelDescription" / "fmi3" / "scheduled").glob("*.xml")))


def load() -> Matrix:
    """`matrix.toml` as it is now."""
    tables = tomllib.loads(Path(__file__).with_name("matrix.toml").read_text(encoding="utf-8"))
    folders = {"fmus": ("", names()), "fmi3": ("fmi3/", names()), "scheduled": ("fmi3/scheduled/", NAMES_SCHEDULED)}
    fmus = []
    for table, (folder, of_folder) in folders.items():
        ran = tables.pop(table)["ran"]
        fmus += [{"name": f"{folder}{name}.fmu", "ran": ran} for name in of_folder]
    return Matrix(**{**tables, "subject": fmus + tables["subject"]})


def filled(document: str, text: str) -> str:
    """The text of a document with the tables as they are now."""
    matrix = load()
    for name in DOCUMENTS[document]:
        begin, end = f"<!-- {name}: made from tests/system/foreign/matrix.toml -->\n", "<!-- end -->"
        before, rest = text.split(begin)
        _, after = rest.split(end, 1)
        text = f"{before}{begin}{matrix.table(name)}{end}{after}"
    return text


if __name__ == "__main__":
    for document in DOCUMENTS:
        path = ROOT / document
        path.write_text(filled(document, path.read_text(encoding="utf-8")), encoding="utf-8")
