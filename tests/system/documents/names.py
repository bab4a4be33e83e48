"""What README.md and docs/*.md name: files, folders, scenarios, and the rows of the map from the paper to the code."""

import re
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from itertools import chain
from pathlib import Path

ROOT = Path(__file__).parents[3]
DOCUMENTS = ("README.md", "harness/README.md", *sorted(f"docs/{path.name}" for path in (ROOT / "docs").glob("*.md")))
#: What a run leaves, what an archive holds, and a unit.
NOT_HERE = {
    "metrics.json": "results/<scenario>/",
    "manifest.json": "results/<scenario>/",
    "earlier.json": "results/<scenario>/",
    "junit.xml": "results/<scenario>/",
    "scene.json": "results/<scenario>/",
    "figures/": "results/<scenario>/",
    "tune.json": "exo tune",
    "tune.png": "exo tune",
    "extra/": "in an FMU",
    "sources/": "in an FMU",
    "fmi3Functions.h": "the standard's header",
    "terminalsAndIcons/": "in an FMU of FMI 3.0",
    "terminalsAndIcons.xml": "in an FMU of FMI 3.0",
    "SystemStructure.ssd": "in an SSP",
    "N.m.s/rad": "a unit",
}
#: What tests the documents has names that are not there on purpose.
OWN = ("tests/system/documents", "tests/system/test_documents.py")
#: Folders that are made, not written.
MADE = {".git", ".venv", "target", "results", "__pycache__"}
#: Beginnings of paths that are none of this repository: made, or inside an archive.
ELSEWHERE = (
    "http",
    "#",
    "target/",
    "results",
    "fmi3/",
    "binaries/",
    "documentation/",
    "resources/",
    "licenses/",
    "include/",
)
#: Of files that are named without a folder; `wall.c` is a variable.
ENDINGS = "rs|py|toml|md|json|xml|svg|png|jinja|txt|csv|h|ssv|ssd|lock|in"
PATH = re.compile(rf"[\w.*{{}},+-]+(/[\w.*{{}},+-]*)+|[\w*{{}},+-]+\.({ENDINGS})")
LABEL = re.compile(r"\b(?:eq|fig|thm|def|sec|lem|rem):\w+")
#: A line of a map: what lies where, two spaces, what it is.
LISTED = re.compile(r"^ {4}(\S+/(?:, \S+/)*) {2}", re.MULTILINE)
SCENARIOS = re.compile(r"[Ss]cenarios? ((?:`\w+`(?:, | and )?)+)")


@cache
def files() -> tuple[str, ...]:
    """All files of the repository, relative to its root."""
    found: list[str] = []
    for folder in (path for path in ROOT.iterdir() if path.name not in MADE):
        inside = folder.rglob("*") if folder.is_dir() else [folder]
        found += [path.relative_to(ROOT).as_posix() for path in inside if path.is_file() and not MADE & set(path.parts)]
    return tuple(found)


def quoted(text: str) -> list[str]:
    """What stands between backticks; blocks of code are no names."""
    return re.findall(r"`([^`\n]+)`", re.sub(r"^```.*?^```", "", text, flags=re.DOTALL | re.MULTILINE))


def paths(text: str) -> list[str]:
    """The paths that a document names, in backticks or as the target of a link, without what lies elsewhere."""
    links = [target.partition("#")[0] for target in re.findall(r"\]\(([^)\s]+)\)", text)]
    named = [name for name in quoted(text) if PATH.fullmatch(name)]
    listed = [name for first in LISTED.findall(text) for name in first.split(", ") if PATH.fullmatch(name)]
    found = dict.fromkeys(links + named + listed)
    return [name for name in found if name and name not in NOT_HERE and not name.startswith(ELSEWHERE)]


def missing(document: str, text: str) -> list[str]:
    """The paths of a document that are not there.

    A path counts from the root, from the document's folder, or is the end of a file's path, as `midpoint.rs`.
    """
    return [name for name in paths(text) if not all(_there(document, one) for one in expanded(name))]


def _there(document: str, name: str) -> bool:
    name = name.rstrip("/")
    if any(next(folder.glob(name), None) for folder in (ROOT, (ROOT / document).parent) if not name.startswith("..")):
        return True
    if (ROOT / document).parent.joinpath(name).exists():
        return True
    pattern = re.compile("(^|.*/)" + re.escape(name).replace(r"\*", "[^/]*") + "(/.*)?")
    return any(pattern.fullmatch(path) for path in files())


def expanded(name: str) -> list[str]:
    """`{a,b}.rs` is `a.rs` and `b.rs`."""
    found = re.search(r"\{([^}]*)\}", name)
    if not found:
        return [name]
    parts = found.group(1).split(",")
    return list(chain.from_iterable(expanded(name[: found.start()] + one + name[found.end() :]) for one in parts))


def scenarios(text: str) -> list[str]:
    """The scenarios that a text names as such."""
    return [name for names in SCENARIOS.findall(text) for name in re.findall(r"`(\w+)`", names)]


def tests(text: str) -> list[tuple[str, str]]:
    """What is named as `path::name`."""
    return [(path, name) for path, _, name in (one.partition("::") for one in quoted(text)) if "/" in path and name]


def words(text: str) -> list[str]:
    """The words of names in backticks: of variables, functions, laws, scenarios; not of commands or formulas."""
    names = [name for name in quoted(text) if re.fullmatch(r"[A-Za-z_]\w*(?:(?:\.|::)\w+)*", name)]
    return [word for name in names if not PATH.fullmatch(name) for word in re.findall(r"\w+", name)]


@cache
def known_words() -> frozenset[str]:
    """All words of the sources; the documents and what tests them do not count."""
    kinds = (".rs", ".py", ".toml", ".xml", ".c", ".h", ".jinja", ".json", ".lock", ".in", ".html", ".csv")
    sources = [path for path in files() if path.endswith(kinds) and not path.startswith(("docs/", *OWN))]
    return frozenset(
        word
        for path in sources
        for word in re.findall(r"\w+", (ROOT / path).read_text(encoding="utf-8", errors="replace"))
    )


@dataclass(frozen=True)
class Row:
    """One row of the map: what it is named for, and where that is."""

    paper: str
    labels: tuple[str, ...]
    symbols: tuple[str, ...]
    places: tuple[str, ...]

    def mentioned(self, place: str) -> bool:
        """Whether the file, or a file of the folder, has a label of the row or one of its symbols."""
        path = ROOT / place
        inside = [one for one in path.rglob("*") if one.is_file()] if path.is_dir() else [path]
        wanted = re.compile("|".join([rf"{label}\b" for label in self.labels] + [re.escape(s) for s in self.symbols]))
        return any(wanted.search(one.read_text(encoding="utf-8", errors="replace")) for one in inside)


def paper_map(text: str) -> Iterator[Row]:
    """The rows of the map (docs/map.md) from the paper to the code; a scenario is a place like any file."""
    section = text.split("## From the paper to the code")[1].split("\n## ", maxsplit=1)[0]
    for line in section.splitlines():
        cells = [cell.strip() for cell in line.strip("|").split("|")]
        if not line.startswith("|") or len(cells) != 4 or cells[0] in ("paper", "---"):
            continue
        named = [name for cell in cells[2:] for name in quoted(cell) if PATH.fullmatch(name)]
        judged = [f"harness/src/exo/scenarios/{name}.toml" for cell in cells[2:] for name in scenarios(cell)]
        yield Row(
            paper=cells[0],
            labels=tuple(LABEL.findall(cells[0])),
            symbols=tuple(quoted(cells[1])),
            places=tuple(named + judged),
        )


def labels(text: str) -> set[str]:
    """The paper's labels that a text uses."""
    return set(LABEL.findall(text))
