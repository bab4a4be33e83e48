"""Tables as text: what the interpreter shows of an FMU and of a run."""

from collections.abc import Sequence

#: Rows of a long table that are shown; half of them from its end.
SHOWN = 60


def columns(header: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """Rows under a header, aligned on the left; of a long table the beginning and the end."""
    shown = [header, *rows]
    if len(rows) > SHOWN:
        half = SHOWN // 2
        shown = [header, *rows[:half], ("…",) * len(header), *rows[-half:]]
    widths = [max(len(row[place]) for row in shown) for place in range(len(header))]
    lines = ("  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)).rstrip() for row in shown)
    return "\n".join(lines)
