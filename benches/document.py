"""The table as text, for the terminal and for `docs/benchmarks.md`."""

from collections.abc import Mapping, Sequence

from benches.row import Found, NotRun, Row, Sheet, amount, small

HEADER = ("what", "figure", "middle half of the rounds", "limit", "aim", "", "behind it")

INTRODUCTION = """# Benchmarks

Made by `cargo xtask bench --write`; `cargo xtask bench` prints the same. Each ratio comes from one run on one machine:
what is compared takes turns, round by round, on one core where the system allows it; the median of the rounds'
ratios counts. So ratios stand what else the machine does; times less so. A ratio that misses its limit does not fail
the command, because a clock decides; counted instructions do (`tests/abi/instructions.json`). A name reads "ours /
theirs": a ratio of 1/5 is a fifth of their time.
"""

PICTURE = "![Each figure in units of its limit: bars that end before 1 meet it](benchmarks.png)"


def of(found: Sequence[Found], facts: Mapping[str, str]) -> str:
    """The document."""
    rows = [one for one in found if isinstance(one, Row)]
    judged, told = [row for row in rows if row.limit is not None], [row for row in rows if row.limit is None]
    parts = [
        INTRODUCTION,
        table(("", ""), [(name, value) for name, value in facts.items()]),
        "## Ratios with a limit\n",
        PICTURE + "\n",
        table(HEADER, [cells(row) for row in judged]),
        "## Other ratios\n",
        table((*HEADER[:3], HEADER[-1]), [(*cells(row)[:3], cells(row)[-1]) for row in told]),
    ]
    for sheet in found:
        if isinstance(sheet, Sheet):
            parts += [f"## {sheet.title}\n", f"{sheet.about}\n", table(sheet.header, sheet.lines)]
    missing = [one for one in found if isinstance(one, NotRun)]
    if missing:
        parts += ["## Not run\n", "\n".join(f"* {one.name}: {one.reason}" for one in missing) + "\n"]
    return "\n".join(parts)


def cells(row: Row) -> tuple[str, ...]:
    """A row of the table, as `HEADER` names its columns."""

    def bound(value: float | None) -> str:
        return "–" if value is None else f"{'≥' if row.least else '≤'} {figure(value)}"

    def figure(value: float) -> str:
        return f"{amount(value)} {row.unit}" if row.unit else small(value)

    spread = "" if row.spread is None else " to ".join(figure(value) for value in row.spread)
    return row.name, figure(row.value), spread, bound(row.limit), bound(row.aim), row.verdict, row.told


def table(header: Sequence[str], lines: Sequence[Sequence[str]]) -> str:
    """As Markdown."""
    rule = ["---", *["---:" if _numbers(lines, i) else "---" for i in range(1, len(header))]]
    return "".join(f"| {' | '.join(line)} |\n" for line in (header, rule, *lines))


def _numbers(lines: Sequence[Sequence[str]], column: int) -> bool:
    """Whether a column holds nothing but figures."""
    return bool(lines) and all(line[column][:1].isdigit() for line in lines)
