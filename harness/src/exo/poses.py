"""The arm from the side: where its joints, handle and pad are at some instants of a run."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from exo.errors import ScenarioError
from exo.looks import BLACK, BLUE, ORANGE, VERMILLION
from exo.recording import Recording
from exo.scenario import Poses

#: Polygon that is drawn as the arm, from the base to the handle; the pad hangs on link 3 as well.
CHAIN = ("base", "shoulder", "elbow", "handle")


def table(*, poses: Poses, run: Recording) -> dict[str, list[float]]:
    """Points in the arm's own vertical plane at each instant: r, the distance from the yaw axis, and z, the height (m).

    Kinematics of docs/specification.md section 4: with c_i = cos, s_i = sin of the pitch angles q₂ and q₂ + q₃;
    positive pitch lifts. `held` says whether a payload hangs at the pad.
    """
    k = [_tick(run, instant) for instant in poses.times]
    value = {
        name: run.parameter(f"{poses.plant}.{name}") for name in ("A1", "L1", "handle.x", "handle.z", "pad.x", "pad.z")
    }
    upper, lower = run[f"{poses.plant}.q_joint[2]"][k], run[f"{poses.plant}.q_joint[3]"][k]
    shoulder = np.array([np.full(len(k), value["A1"]), np.zeros(len(k))])
    elbow = shoulder + _turned(value["L1"], 0.0, upper)
    points = {
        "base": np.zeros((2, len(k))),
        "shoulder": shoulder,
        "elbow": elbow,
        "handle": elbow + _turned(value["handle.x"], value["handle.z"], upper + lower),
        "pad": elbow + _turned(value["pad.x"], value["pad.z"], upper + lower),
    }
    columns = {"time [s]": run.time[k].tolist()}
    for name, (r, z) in points.items():
        columns |= {f"{name} r [m]": r.tolist(), f"{name} z [m]": z.tolist()}
    columns["held"] = run[f"{poses.plant}.attached"][k].astype(float).tolist()
    return columns


def _tick(run: Recording, instant: float) -> int:
    if instant > run.time[-1]:
        raise ScenarioError(f"a pose at {instant} s lies after the run's last tick, {run.time[-1]:g} s")
    return int(np.argmin(np.abs(run.time - instant)))


def _turned(x: float, z: float, angle: Any) -> Any:
    return np.array([x * np.cos(angle) - z * np.sin(angle), x * np.sin(angle) + z * np.cos(angle)])


def draw(*, canvas: Any, poses: Poses, run: Recording) -> None:
    """One pair of axes a pose: links, joints, handle, pad, table, and the payload where it hangs."""
    columns = table(poses=poses, run=run)
    height = run.parameter(f"{poses.plant}.table.z")
    canvas.set_size_inches(2.5 * len(poses.times), 3.6)
    grid = canvas.subplots(1, len(poses.times), sharex=True, sharey=True, squeeze=False)
    for i, axes in enumerate(grid.flat):
        _one(axes, {name: column[i] for name, column in columns.items()}, height)
    grid.flat[0].set_ylabel("z [m]")
    # The payload is not there in every pose.
    named = {str(a.get_label()): a for axes in grid.flat for a in axes.get_legend_handles_labels()[0]}
    canvas.legend(handles=list(named.values()), loc="outside lower center", ncols=len(named))


def _one(axes: Any, at: Mapping[str, float], table_height: float) -> None:
    def line(names: tuple[str, ...], look: str, **more: Any) -> None:
        axes.plot([at[f"{n} r [m]"] for n in names], [at[f"{n} z [m]"] for n in names], look, **more)

    line(CHAIN, "-", color=BLUE, linewidth=4.0, solid_capstyle="round", label="links")
    line(("handle", "pad"), "-", color="#5d6875", linewidth=2.0)
    line(("shoulder", "elbow"), "o", color="white", markeredgecolor=BLUE, markersize=6.0, label="joints")
    line(("handle",), "D", color=VERMILLION, markersize=6.0, label="handle")
    r, z = at["pad r [m]"], at["pad z [m]"]
    axes.plot([r - 0.03, r + 0.03], [z, z], color=BLACK, linewidth=3.0, label="pad")
    if at["held"]:
        corners = [r - 0.09, r + 0.09, r + 0.09, r - 0.09], [z, z, z - 0.025, z - 0.025]
        axes.fill(*corners, facecolor=ORANGE, edgecolor=BLACK, linewidth=0.6, hatch="////", zorder=3, label="payload")
    axes.axhspan(table_height - 0.03, table_height, color="#bbbbbb", label="table")
    axes.set_title(f"t = {at['time [s]']:g} s")
    axes.set_aspect("equal")
    axes.set_xlim(-0.08, 0.72)
    axes.set_ylim(-0.5, 0.42)
    axes.set_xlabel("distance from the yaw axis [m]")
