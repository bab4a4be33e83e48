"""How curves look: colours that colour-blind readers tell apart, a signal or law alike in all figures, a dash each.

A curve is known by its signal where a panel shows several signals of one run (`q` and `q_n`), and by its label where it
shows one signal of several runs. No two curves of a figure differ by colour alone.
"""

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

from exo.scenario import Figure, Panel

#: Okabe and Ito's colours, but for the yellow, which is lost on white.
BLUE, VERMILLION, GREEN, PURPLE, ORANGE, BLACK = "#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#000000"
CYCLE = (BLUE, VERMILLION, GREEN, PURPLE, ORANGE, BLACK)
SOLID = "-"
#: From the second curve on, ever more gaps: drawn over the ones before, none of them is hidden.
DASHES: tuple[Any, ...] = (SOLID, (0, (6, 2)), (0, (4, 1.6, 1, 1.6)), (0, (1, 1.4)), (0, (2, 3)), (0, (9, 5)))
#: Of the limits and other levels that a panel marks.
MARK = {"color": "#444444", "linestyle": (0, (8, 2, 1, 2, 1, 2)), "linewidth": 0.9}
#: Of the values 0, 1, … behind a panel, from nothing to a fault: grey, blue, orange, and hatches for those that stop.
BANDS = (
    ("#f7f7f7", ""),
    ("#e0e0e0", ""),
    ("#dceefa", ""),
    ("#a9d4f0", ""),
    ("#fde6bf", ""),
    ("#f8c98b", ".."),
    ("#e3a48f", "//"),
)


@dataclass(frozen=True)
class Look:
    """Colour and dash of a curve, and which lies over which: that with more gaps."""

    color: str
    rank: int

    @property
    def style(self) -> dict[str, Any]:
        """As matplotlib's `plot` takes it."""
        dash = DASHES[self.rank % len(DASHES)]
        width = 1.5 if dash == SOLID else 1.3
        return {"color": self.color, "linestyle": dash, "linewidth": width, "zorder": 2.0 + 0.1 * self.rank}


#: By the last part of a column, without its index. What the nominal does lies over what the robot does.
SIGNALS = {
    **dict.fromkeys(("q", "dq", "p", "dp", "q_joint"), Look(BLUE, 0)),
    **dict.fromkeys(("q_n", "dq_n", "p_n", "dp_n"), Look(VERMILLION, 1)),
    **dict.fromkeys(("tau_h", "f_h", "f_hand", "f_h_measured"), Look(GREEN, 1)),
    **dict.fromkeys(("tau_a", "f_a", "tau_drive"), Look(BLACK, 0)),
    **dict.fromkeys(("tau_d", "f_d", "tau_e", "f_e", "tau_f"), Look(PURPLE, 0)),
    **dict.fromkeys(("tau_ed", "f_ed"), Look(PURPLE, 1)),
    **dict.fromkeys(("e_nr", "e_q"), Look(ORANGE, 0)),
    "p_target": Look(ORANGE, 1),
}
#: By label. The law that this project recommends is solid and blue.
LABELS = {
    "standard": Look(BLACK, 3),
    "passive": Look(VERMILLION, 1),
    "passive_applied": Look(GREEN, 2),
    "passive_bounded": Look(BLUE, 0),
    "natural": Look(PURPLE, 1),
    "sliding_mode": Look(ORANGE, 2),
}


def signal(column: str) -> str:
    """`controller.left.p_n[3]` → `p_n`."""
    return re.sub(r"\[[^]]*\]", "", column).rpartition(".")[2]


def looks(figure: Figure) -> dict[tuple[int, int], Look]:
    """The look of every curve of a figure, by panel and place in it."""
    by_label = _of_labels(figure.panels)
    found = {}
    for i, panel in enumerate(figure.panels):
        told_by_signal = is_told_by_signal(panel)
        for j, curve in enumerate(panel.curves):
            look = SIGNALS[signal(curve.column)] if told_by_signal else by_label[curve.label]
            rank = 0 if len(panel.curves) == 1 else max(look.rank, 1) if curve.dashed else look.rank
            found[i, j] = Look(curve.color or look.color, rank)
    return found


def is_told_by_signal(panel: Panel) -> bool:
    """Whether each of the panel's curves is a signal of its own that has a look, and none is named as a law."""
    names = [signal(curve.column) for curve in panel.curves]
    known = all(name in SIGNALS for name in names) and not any(curve.label in LABELS for curve in panel.curves)
    looks_of_them = [SIGNALS[name] for name in names] if known else []
    return known and len({look.color for look in looks_of_them}) == len(names)


def _of_labels(panels: Sequence[Panel]) -> dict[str, Look]:
    """The same label looks alike in all panels; in none of them do two labels look alike."""
    labels = list(dict.fromkeys(c.label for p in panels if not is_told_by_signal(p) for c in p.curves))
    found = {label: LABELS[label] for label in labels if label in LABELS}
    for label in labels:
        if label not in found:
            beside = {c.label for p in panels if any(c.label == label for c in p.curves) for c in p.curves}
            found[label] = _free([found[name] for name in beside if name in found])
    return found


def _free(taken: Iterable[Look]) -> Look:
    """A colour and a dash that none of `taken` has."""
    taken = list(taken)
    colors = [color for color in CYCLE if color not in {look.color for look in taken}] or [CYCLE[0]]
    rank = next(r for r in range(len(taken) + 1) if r not in {look.rank for look in taken})
    return Look(colors[0], rank)
