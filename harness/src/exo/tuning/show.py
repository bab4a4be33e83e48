"""The gain guide as tables, as JSON and as a map."""

import json
import math
from dataclasses import asdict, replace
from pathlib import Path
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.figure import Figure as Canvas
from rich.table import Table
from rich.text import Text

from exo import theory
from exo.plots import STYLE
from exo.theory import Hand
from exo.tuning import region
from exo.tuning.guide import KT_OVER_M_MAX, MARGIN, MN_OVER_M_MIN, AtMass, Guide
from exo.tuning.machine import loop

#: Points of the map along each axis.
GRID = 48
#: What the columns of `by_mass` are.
LEGEND = """\
K T/M        largest stable one without a hand
K from, to   stable with the hand, N·s/m
k_h to       largest stable stiffness of the hand, N/m
delay        how much later τ_a may come, ms
slowest      time constant, s
damping      of the least damped oscillation, at `swing` Hz
e            swing of e for 1 N at {frequency:g} Hz without a hand, mm"""


def number(value: float | None) -> str:
    """Three figures; a dash for what does not exist."""
    if value is None:
        return "–"
    return "∞" if math.isinf(value) else f"{float(f'{value:.3g}'):.12g}"


def by_mass(guide: Guide) -> Table:
    """One row a mass."""
    table = Table(box=None, padding=(0, 1, 0, 0))
    for name in ("M [kg]", "stable", "K T/M", "K from", "K to", "k_h to", "delay", "slowest", "damping", "swing", "e"):
        table.add_column(Text(name), no_wrap=True)
    for at in guide.masses:
        table.add_row(
            number(at.M),
            "yes" if at.stable else "no",
            number(at.sampled_share(guide.machine.T)),
            number(at.K_held.low if at.K_held else None),
            number(at.K_held.high if at.K_held else None),
            number(at.k_h_limit),
            number(None if at.delay_margin is None else 1e3 * at.delay_margin),
            number(at.slowest),
            number(at.swing.damping if at.swing else None),
            number(at.swing.frequency if at.swing else None),
            number(1e3 * at.error),
        )
    return table


def summary(guide: Guide) -> Table:
    """What follows for the gains."""
    machine, gains = guide.machine, guide.gains
    share = gains.K * machine.T / machine.M_min
    coasting = gains.M_n / gains.D_n if gains.D_n else math.inf
    table = Table(box=None, show_header=False, padding=(0, 1))
    for row in (
        ("K", number(gains.K), f"N·s/m; K T/M_min = {number(share)}, advised ≤ {KT_OVER_M_MAX}"),
        ("recommended K", number(guide.K_recommended), f"N·s/m; {MARGIN:g} below the limit at every mass"),
        ("K may rise by", number(guide.gain_margin), "with the hand"),
        ("K may fall by", number(guide.lowering_margin), "with the hand"),
        ("k_h limit", number(guide.k_h_limit), f"N/m at the worst mass; the hand has {machine.k_h:g}"),
        ("smallest M_n", number(guide.M_n_smallest), f"kg for {MARGIN:g} k_h; it is {gains.M_n:g}"),
        ("smallest D_n", number(guide.D_n_smallest), f"N·s/m for {MARGIN:g} k_h; it is {gains.D_n:g}"),
        ("M_n/M_min", number(gains.M_n / machine.M_min), f"advised ≥ {MN_OVER_M_MIN}"),
        ("M_n/D_n", number(coasting), "s, how long the nominal coasts"),
        ("1/K_P", number(1.0 / gains.K_P), "s, how fast e decays"),
        ("gain_warning", str(guide.gain_warning), "0 none, 1 K T/M_min, 2 M_n/M_min, 3 both"),
    ):
        table.add_row(*row)
    return table


def document(guide: Guide) -> dict[str, Any]:
    """Everything as JSON data; what is infinite is null."""

    def finite(value: Any) -> Any:
        if isinstance(value, dict):
            return {key: finite(x) for key, x in value.items()}
        if isinstance(value, list):
            return [finite(x) for x in value]
        return None if isinstance(value, float) and not math.isfinite(value) else value

    def row(at: AtMass) -> dict[str, Any]:
        return {**asdict(at), "KT_over_M_limit": at.sampled_share(guide.machine.T)}

    whole = {
        **asdict(guide),
        "masses": [row(at) for at in guide.masses],
        "stable": guide.stable,
        "gain_margin": guide.gain_margin,
        "lowering_margin": guide.lowering_margin,
        "k_h_limit": guide.k_h_limit,
    }
    converted: dict[str, Any] = finite(whole)
    return converted


def write(*, guide: Guide, out: Path) -> list[Path]:
    """Writes tune.json and tune.png."""
    out.mkdir(parents=True, exist_ok=True)
    text, picture = out / "tune.json", out / "tune.png"
    text.write_text(json.dumps(document(guide), indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
    draw(guide=guide, path=picture)
    return [text, picture]


def growth_map(guide: Guide, *, M: float, K: Any, k_h: Any) -> Any:
    """Growth (1/s) of the slowest mode over K (columns) and k_h (rows) at the mass M (kg)."""
    machine = guide.machine
    return np.array(
        [
            [
                theory.growth_rate(
                    loop=loop(machine=machine, gains=replace(guide.gains, K=float(x)), M=M),
                    hand=replace(machine.hand, k_h=float(k)),
                    delay=machine.delay,
                )
                for x in K
            ]
            for k in k_h
        ]
    )


def draw(*, guide: Guide, path: Path) -> None:
    """The map: K against the mass without a hand, and k_h against K at the lightest and the heaviest mass."""
    machine, gains = guide.machine, guide.gains
    limits = [at.K_free.high for at in guide.masses if at.K_free]
    top = 2.0 * max([*limits, gains.K])
    K = np.geomspace(1e-4 * top, top, GRID)
    k_limit = guide.k_h_limit if 0.0 < guide.k_h_limit < math.inf else 100.0
    k_h = np.geomspace(0.02 * max(k_limit, machine.k_h), 50.0 * max(k_limit, machine.k_h), GRID)
    heaviest = sorted({machine.M_min, machine.M_max})
    with mpl.rc_context(STYLE):  # type: ignore[arg-type]
        canvas = Canvas(layout="constrained", figsize=(4.2 * (1 + len(heaviest)), 4.0))
        axes = canvas.subplots(1, 1 + len(heaviest), squeeze=False)[0]
        M = [at.M for at in guide.masses]
        for label, hand, look in (("without a hand", Hand(), "-"), ("with the hand", machine.hand, "--")):
            ends = [region.gain_interval(machine=machine, gains=gains, M=x, hand=hand) for x in M]
            axes[0].loglog(M, [e.high if e else math.nan for e in ends], look, marker=".", label=f"largest K {label}")
            if any(e and e.low for e in ends):
                axes[0].loglog(M, [e.low if e and e.low else math.nan for e in ends], look, marker=".",
                               label=f"smallest K {label}")  # fmt: skip
        axes[0].loglog(M, [KT_OVER_M_MAX * x / machine.T for x in M], ":", color="#555555", label="K T/M = 0.25")
        axes[0].axhline(gains.K, color="k", linewidth=0.9, label="K")
        axes[0].set_xlabel("effective mass M [kg]")
        axes[0].set_ylabel("K [N·s/m]")
        axes[0].set_title("stable between the lines")
        axes[0].legend()
        for place, mass in zip(axes[1:], heaviest, strict=True):
            growth = growth_map(guide, M=mass, K=K, k_h=k_h)
            place.contourf(K, k_h, growth, levels=[-1e9, 0.0, 1e9], colors=["#cfe3d4", "#f3d3cf"])
            place.contour(K, k_h, growth, levels=[0.0], colors="k", linewidths=1.0)
            place.plot([gains.K], [max(machine.k_h, k_h[0])], "k+", markersize=11, label="the gains and the hand")
            place.set(xscale="log", yscale="log", xlabel="K [N·s/m]", ylabel="k_h [N/m]", title=f"M = {mass:g} kg")
            place.legend(loc="lower left")
        canvas.suptitle(f"Stable region (green): T = {1e3 * machine.T:g} ms, delay {machine.delay}", fontsize=11)
        canvas.savefig(path, metadata={"Software": None}, bbox_inches="tight")
