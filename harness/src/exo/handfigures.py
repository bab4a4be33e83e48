"""Two pictures of what a hand gets: impedance over frequency, and the stiffest hand over its damping."""

import math
from collections.abc import Mapping
from typing import Any

import numpy as np
from matplotlib.figure import Figure as Canvas

from exo.looks import DASHES, GREEN, LABELS, Look
from exo.metrics.impedance import Impedance, expected_robot, grows, hand_limit_of, impedance_of
from exo.metrics.loops import desired_mass
from exo.recording import Recording

WHO = {"controller": "controller", "plant": "plant", "operator": "operator"}
#: Frequencies of the closed forms' lines (rad/s).
LINE = np.geomspace(0.15, 600.0, 200)
MARKERS = "osD^vP"


def _impedance(run: Recording) -> Impedance:
    return impedance_of(run, **WHO, after=run.time[-1] / 2.0)


def _holds(run: Recording) -> bool:
    return run.parameter("operator.k_h") > 0.0 or run.parameter("operator.b_h") > 0.0


def impedance_table(recordings: Mapping[str, Recording]) -> dict[str, list[float]]:
    """Real part (N·s/m) and apparent mass (kg) of the impedance of each case over ω (rad/s)."""
    found: dict[str, list[float]] = {}
    for case, run in recordings.items():
        seen = _impedance(run)
        found["ω [rad/s]"] = list(map(float, seen.omega))
        shown = {case: seen.robot} | ({f"{case}, robot and hand": seen.held} if _holds(run) else {})
        for name, Z in shown.items():
            found[f"{name}: Re Z [N·s/m]"] = list(map(float, Z.real))
            found[f"{name}: Im Z/ω [kg]"] = list(map(float, Z.imag / seen.omega))
    return found


def draw_impedance(canvas: Canvas, recordings: Mapping[str, Recording]) -> None:
    """|Z|, apparent mass and resistance: dots are the FMUs, lines the closed forms."""
    canvas.set_size_inches(7.0, 8.6)
    size, mass, resistance = canvas.subplots(3, 1, sharex=True)
    for i, (case, run) in enumerate(recordings.items()):
        seen = _impedance(run)
        known, marker = LABELS.get(case, Look(GREEN, 0)), MARKERS[i % len(MARKERS)]
        color = known.color
        held = _holds(run)
        Z = seen.held if held else seen.robot
        label = f"{case}: robot and hand" if held else case
        size.loglog(seen.omega, np.abs(Z), marker, color=color, markersize=4, label=label)
        mass.semilogx(seen.omega, Z.imag / seen.omega, marker, color=color, markersize=4)
        resistance.semilogx(seen.omega, Z.real, marker, color=color, markersize=4)
        if held:
            size.loglog(seen.omega, np.abs(seen.robot), "x", color=color, markersize=6, label=f"{case}: robot alone")
            mass.semilogx(seen.omega, seen.robot.imag / seen.omega, "x", color=color, markersize=6)
            resistance.semilogx(seen.omega, seen.robot.real, "x", color=color, markersize=6)
            continue
        closed = expected_robot(run, controller="controller", plant="plant", omega=LINE)
        look: dict[str, Any] = {"color": color, "linestyle": DASHES[known.rank], "linewidth": 1.0}
        size.loglog(LINE, np.abs(closed), **look)
        mass.semilogx(LINE, closed.imag / LINE, **look)
        resistance.semilogx(LINE, closed.real, **look)
    run = next(iter(recordings.values()))
    M, M_n, D_n = run.parameter("plant.M"), desired_mass(run, controller="controller"), run.parameter("controller.D_n")
    size.loglog(LINE, np.abs(M_n * 1j * LINE + D_n), color="#888888", linewidth=0.8, label="nominal, M_n s + D_n")
    size.loglog(LINE, M * LINE, ":", color="#888888", linewidth=1.2, label="robot, M s")
    for value, dash in ((M_n, "-"), (M, ":")):
        mass.axhline(value, color="#888888", linewidth=1.0, linestyle=dash)
    resistance.axhline(D_n, color="#888888", linewidth=0.8)
    mass.set_ylim(-2.0, 1.6 * M)
    resistance.set_ylim(-40.0, 20.0)
    size.set_ylabel("|Z| [N·s/m]")
    mass.set_ylabel("apparent mass Im Z/ω [kg]")
    resistance.set_ylabel("resistance Re Z [N·s/m]")
    resistance.set_xlabel("ω [rad/s]")
    size.legend(loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=3, frameon=False)


def limits_table(recordings: Mapping[str, Recording]) -> dict[str, list[Any]]:
    """Of each case with a stiff hand: law, b_h, k_h, the closed form's limit of k_h, and whether it grew."""
    rows = [
        (
            run.choice("controller.law"),
            run.parameter("operator.b_h"),
            run.parameter("operator.k_h"),
            hand_limit_of(run, **WHO),
            bool(grows(run, column="plant.q")),
        )
        for run in recordings.values()
        if run.parameter("operator.k_h")
    ]
    names = ("law", "b_h [N·s/m]", "k_h [N/m]", "limit of k_h [N/m]", "grew")
    return {name: list(column) for name, column in zip(names, zip(*rows, strict=True), strict=True)}


def draw_limits(canvas: Canvas, recordings: Mapping[str, Recording]) -> None:
    """Limits of k_h over b_h of each law as lines, the FMUs' runs as filled marks (decays) and crosses (grows)."""
    canvas.set_size_inches(7.0, 5.2)
    axes = canvas.subplots()
    table = limits_table(recordings)
    rows = list(zip(*table.values(), strict=True))
    for i, law in enumerate(dict.fromkeys(table["law"])):
        mine = sorted(row for row in rows if row[0] == law)
        known, marker = LABELS[law], MARKERS[i % len(MARKERS)]
        color = known.color
        line = [(b_h, limit) for _, b_h, _, limit, _ in mine if math.isfinite(limit)]
        axes.semilogy(*np.array(line or [(math.nan, math.nan)]).T, color=color, linestyle=DASHES[known.rank], label=law)
        for _, b_h, k_h, _, grew in mine:
            axes.semilogy([b_h], [k_h], "x" if grew else marker, color=color, markersize=6 if grew else 4)
    axes.plot([], [], "ko", markersize=4, label="FMUs: decays")
    axes.plot([], [], "kx", markersize=6, label="FMUs: grows")
    axes.set_xlabel("damping of the hand b_h [N·s/m]")
    axes.set_ylabel("stiffness of the hand k_h [N/m]")
    axes.legend(loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=4, frameon=False)
