"""`report.html`: one self-contained page that one explores; it works offline from a double click.

What stands in it as text is there with scripts off as well: what was shown, the paper's numbers beside ours, every
verdict, and of every experiment what it is, its cases and versions. Its figures come as signals, thinned and packed,
and are drawn when their section is opened.

| file | idea |
|---|---|
| `section.py` | what one experiment has left: its numbers, scenario, cases |
| `verdicts.py` | a number, its expectation, and what it was before, as a row |
| `story.py` | the first sentence and the first picture |
| `thin.py` | as few points of a signal as show it, peaks among them |
| `packed.py` | numbers and texts as one text of letters, for a `<script>` that no browser runs |
| `figures.py` | a section's figures: panels, curves, looks, and the signals that they show |
| `page.py`, `web/` | the page: templates, styles, scripts |
| `command.py` | `exo report` |
"""

from pathlib import Path

from exo.report import page, section
from exo.report.verdicts import Before


def write(*, out: Path, scenarios: list[str], against: Path | None = None) -> Path:
    """`<out>/report.html` from what the scenarios left in `out`.

    `against` is the folder of earlier results with which verdicts are compared; without it they are compared with those
    that the last run has replaced. ExoError: results are missing or damaged.
    """
    before = Before(against)
    return page.write(out=out, sections=[section.read(out / name, before) for name in scenarios], against=against)
