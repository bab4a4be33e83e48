"""The page from its templates: styles, scripts and data stand in it, so that it asks for nothing."""

import re
from collections.abc import Sequence
from datetime import UTC, datetime
from importlib import resources
from importlib.resources.abc import Traversable
from pathlib import Path

import jinja2
from markupsafe import Markup

from exo import __version__, scenes
from exo.folder import write_file
from exo.report import figures, packed, story
from exo.report.section import VERDICTS, Section
from exo.report.verdicts import Row, difference, plain

#: In the order in which the page has them; a script uses what stands before it.
STYLES = ("colours.css", "page.css", "first.css", "verdicts.css", "experiments.css", "plots.css", "print.css")
SCRIPTS = (
    "unpack.js",
    "signals.js",
    "theme.js",
    "palette.js",
    "verdicts.js",
    "legend.js",
    "marks.js",
    "panel.js",
    "keys.js",
    "figure.js",
    "timebar.js",
    "experiment.js",
    "main.js",
)

#: What made the steps, as `metrics.json` names it, in the words of the page.
ENGINES = {"fmpy": "fmpy", "native": "the native loop"}


def write(*, out: Path, sections: Sequence[Section], against: Path | None) -> Path:
    """Writes `<out>/report.html`, as a whole. ExoError: a figure's data are missing."""
    path = out / "report.html"
    write_file(path, render(sections=sections, against=against).encode())
    return path


def render(*, sections: Sequence[Section], against: Path | None) -> str:
    """The page's text."""
    home = resources.files("exo")
    environment = jinja2.Environment(
        loader=jinja2.FunctionLoader(lambda name: (home / "report" / name).read_text(encoding="utf-8")),
        autoescape=True,
        trim_blocks=True,
        lstrip_blocks=True,
        undefined=jinja2.StrictUndefined,
    )
    environment.filters |= {"difference": difference, "marked": _marked, "plain": plain, "span": _span}
    drawn = {one.id: scenes.read(one.folder) for one in sections}
    mine = [home / "web" / "timebus.js", *(home / "report" / "web" / name for name in SCRIPTS)]
    return environment.get_template("page.html.jinja").render(
        sections=sections,
        groups=_groups(sections),
        printed=_printed(sections),
        counts={verdict: sum(one.counts[verdict] for one in sections) for verdict in VERDICTS},
        requirements=sum(row.is_requirement for one in sections for row in one.rows),
        failed=[(one, row) for one in sections for row in one.rows if row.verdict == "fail"],
        changed=sum(one.changed for one in sections),
        compared=any(one.before for one in sections),
        against=against,
        simulated=sum(one.simulated for one in sections),
        cases=sum(len(one.run["cases"]) for one in sections),
        made=datetime.now(UTC).strftime("%Y-%m-%d %H:%M UTC"),
        version=__version__,
        engines=" and ".join(sorted({ENGINES[one.run["engine"]] for one in sections})),
        story=story.tell(sections),
        packs={one.id: figures.pack(one.folder, one.scenario.figures) for one in sections},
        scenes={name: packed.pack(scene, []) for name, scene in drawn.items() if scene is not None},
        style="\n".join(_text(file) for file in _styles(home)),
        libraries=_libraries(home, replay=any(scene is not None for scene in drawn.values())),
        script=_script("\n".join(_text(file) for file in mine)),
    )


def _printed(sections: Sequence[Section]) -> list[tuple[Section, Row, Row | None]]:
    """Numbers that the paper prints, those first that are judged by it, each with that verdict."""
    found = [(one, row, one.beside(row)) for one in sections for row in one.rows if row.paper]
    return sorted(found, key=lambda each: each[2] is None)


def _groups(sections: Sequence[Section]) -> list[tuple[str, list[Section]]]:
    """What the paper prints first; then what is of the testbed, and of the arm."""
    names = ("The paper's figures and numbers", "More on the testbed, one axis", "More on the arm, three joints")
    groups: dict[str, list[Section]] = {name: [] for name in names}
    for one in sections:
        printed = any(row.paper for row in one.rows) or any(figure.label for figure in one.scenario.figures)
        arm = any("arm" in part.archive.lower() for part in one.scenario.components.values())
        groups[names[0] if printed else names[2] if arm else names[1]].append(one)
    groups[names[0]].sort(key=lambda one: not any(figure.label for figure in one.scenario.figures))
    return [(name, members) for name, members in groups.items() if members]


def _marked(text: str) -> Markup:
    """A text whose `names` stand between backticks."""
    parts = text.split("`")
    # An odd number of backticks names nothing.
    return Markup("").join(
        Markup("<code>{}</code>").format(part) if i % 2 and len(parts) % 2 else part for i, part in enumerate(parts)
    )


def _span(seconds: float) -> str:
    """A time (s) as people say it."""
    for name, length in (("h", 3600.0), ("min", 60.0)):
        if seconds >= 2.0 * length:
            return f"{seconds / length:.3g} {name}"
    return f"{seconds:.3g} s"


def _styles(home: Traversable) -> list[Traversable]:
    return [home / "web" / "uplot" / "uPlot.min.css", *(home / "report" / "web" / name for name in STYLES)]


def _text(file: Traversable) -> str:
    return file.read_text(encoding="utf-8").strip()


def _libraries(home: Traversable, *, replay: bool) -> list[str]:
    """What the scripts need of others, the replay's only where a scene is."""
    uplot, player = home / "web" / "uplot", home / "web" / "replay"
    found = [_library(uplot / "uPlot.iife.min.js", uplot / "LICENSE")]
    if replay:
        found.append(_library(player / "replay.js", player / "three.LICENSE.txt"))
    return found


def _library(file: Traversable, licence: Traversable) -> str:
    """A library with its licence before it."""
    return _script(f"/*\n{_text(licence)}\n*/\n{_text(file)}")


def _script(text: str) -> str:
    """As it may stand in a `<script>`: a text that would end it does so no more, and means the same."""
    return re.sub(r"</(?=script)", r"<\\/", text, flags=re.IGNORECASE)
