"""How a run is drawn: signals of one unit share a panel."""

from collections.abc import Sequence
from io import BytesIO
from typing import TYPE_CHECKING, Any

import matplotlib as mpl
import numpy as np
from matplotlib.figure import Figure

from exo import plots
from exo.curves import printed
from exo.errors import ExoError
from exo.looks import CYCLE, DASHES

if TYPE_CHECKING:
    from exo.api.run import Run

#: Curves that one still tells apart.
MOST = 12


class Picture(Figure):
    """A figure that a notebook shows by itself, without pyplot and what it keeps."""

    def _repr_png_(self) -> bytes:
        file = BytesIO()
        self.savefig(file, format="png", dpi=100, metadata={"Software": None})
        return file.getvalue()


def drawn(run: "Run", names: Sequence[str], *, title: str) -> Picture:
    """The picture of these signals. ExoError, if they are more than `MOST`."""
    if not 0 < len(names) <= MOST:
        raise ExoError(f"{run.name}: plot of {len(names)} signals; expected names or patterns of 1 to {MOST}")
    panels: dict[str, list[str]] = {}
    for name in names:
        panels.setdefault(run.units[name], []).append(name)
    with mpl.rc_context(plots.STYLE):  # type: ignore[arg-type]
        picture = Picture(figsize=(8.0, 0.8 + 2.1 * len(panels)), layout="constrained")
        grid: Any = picture.subplots(len(panels), 1, sharex=True, squeeze=False)
        for axes, (unit, members) in zip(grid.flat, panels.items(), strict=True):
            for place, name in enumerate(members):
                time, values = plots.thinned(run.time, np.asarray(run[name], dtype=np.float64))
                look = {"color": CYCLE[place % len(CYCLE)], "linestyle": DASHES[place % len(DASHES)]}
                axes.plot(time, values, label=name, **look)
            axes.set_ylabel(f"[{printed(unit)}]")
            axes.legend(loc="best")
        grid.flat[-1].set_xlabel("time [s]")
        picture.suptitle(title, fontsize=11)
    return picture
