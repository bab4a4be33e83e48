"""What moves in one case: the columns of a run that a scene needs, thinned out and packed."""

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from exo.recording import Recording
from exo.replay import packing, thinning
from exo.replay.parts import DRIVEN, Plant, source
from exo.replay.sticking import ARM_MARGIN, TESTBED_MARGIN, Episode, episodes

#: Resolution of what the pose is computed from (rad, m): the hand that is drawn is the recorded one to 1e-6 m.
POSE = 1e-7
#: Of what is only seen: places (m) and forces (N).
PLACE, FORCE = 1e-4, 1e-2
#: Distance from the straight line between two frames that no eye sees: of angles (rad) and of places (m).
ANGLE_TOLERANCE, PLACE_TOLERANCE = 3e-4, 2e-4
#: Of forces: a share of the largest one, and the least (N).
FORCE_SHARE, FORCE_TOLERANCE = 0.004, 0.05

#: No picture has room for more (m, N, rad).
FARTHEST = 1e6

#: Columns of a scene by name, with their resolution.
Columns = dict[str, tuple[NDArray[np.float64], float]]


class Motion:
    """The columns of one case, ready to be thinned out."""

    def __init__(self, *, plant: Plant, run: Recording, inputs: Mapping[str, str]) -> None:
        self.plant, self.run, self.inputs = plant, run, inputs
        self.controllers = [source(inputs, plant, side, *DRIVEN) for side in plant.sides]
        self.columns: Columns = {}
        self.events: list[NDArray[np.bool_]] = []
        self.peaks: list[NDArray[np.float64]] = []
        self.sticking: list[list[Episode]] = []
        for i, side in enumerate(plant.sides):
            if plant.kind == "testbed":
                self._testbed(i)
            else:
                self._arm(i, side)
        #: Whether the payload hangs at the pads.
        self.attached = self._boolean("attached") if plant.kind != "testbed" else np.zeros(len(run.time), dtype=bool)
        self.events.append(self.attached)

    @property
    def law(self) -> str:
        """The name of the law, where a law drives the plant."""
        return self.run.choices.get(f"{self.controllers[0]}.law", "")

    @property
    def is_drawable(self) -> bool:
        """Whether every value is a number and none is beyond all measure, as in a run that has blown up."""
        return all(bool(np.all(np.abs(values) < FARTHEST)) for values, _ in self.columns.values())

    def packed(self, *, coarser: float) -> dict[str, Any]:
        """The instants that are kept and each column there."""
        run = self.run
        ticks = thinning.kept(
            time=run.time,
            columns=[(values, self._tolerance(name, values)) for name, (values, _) in self.columns.items()],
            events=self.events,
            peaks=self.peaks,
            coarser=coarser,
        )
        packed = {name: packing.pack(values[ticks], unit=unit) for name, (values, unit) in self.columns.items()}
        return {"t": packing.pack(run.time[ticks], unit=_whole(run.step)), **packed}

    def _tolerance(self, name: str, values: NDArray[np.float64]) -> float:
        what = name.partition(":")[0]
        if what.startswith(("f_", "tau_", "tension")):
            return max(FORCE_TOLERANCE, FORCE_SHARE * float(np.max(np.abs(values))))
        return ANGLE_TOLERANCE if what == "q" and self.plant.kind != "testbed" else PLACE_TOLERANCE

    def _testbed(self, i: int) -> None:
        name, controller = self.plant.name, self.controllers[i]
        q, f = self.run[f"{name}.q"], self._column(f"{name}.tau_h")
        self.columns |= {
            "q": (q, POSE),
            "tau_h": (f, FORCE),
            "tau_a": (self.run[f"{name}.tau_drive"], FORCE),
            "tau_e": (self.run[f"{name}.tau_e"], FORCE),
        }
        self._optional("tau_d", f"{name}.tau_d", FORCE)
        self._optional("q_n", f"{controller}.q_n", PLACE)
        near = q >= self.run.parameter(f"{name}.wall.q") - TESTBED_MARGIN
        self.events.append(near)
        self.peaks.append(self.run[f"{name}.tau_e"])
        self.sticking.append(episodes(time=self.run.time, near=near, pull=-f, surface="wall"))

    def _arm(self, i: int, side: str) -> None:
        run, prefix, controller = self.run, f"{self.plant.name}.{side}", self.controllers[i]
        joints = f"{prefix}q_joint" if f"{prefix}q_joint[1]" in run.columns else f"{prefix}q"
        offset = self._shoulder(i)
        for k in (1, 2, 3):
            self.columns[f"q:{i}:{k}"] = (run[f"{joints}[{k}]"], POSE)
            self.columns[f"f_h:{i}:{k}"] = (self._column(f"{prefix}f_h[{k}]"), FORCE)
            self.columns[f"f_e:{i}:{k}"] = (run[f"{prefix}f_e[{k}]"], FORCE)
            self._optional(f"f_d:{i}:{k}", f"{prefix}f_d[{k}]", FORCE)
            if f"{controller}.p_n[{k}]" in run.columns:
                self.columns[f"p_n:{i}:{k}"] = (run[f"{controller}.p_n[{k}]"] + offset[k - 1], PLACE)
        self.columns[f"tension:{i}"] = (run[f"{prefix}tension"], FORCE)
        table = run[f"{prefix}p_pad[3]"] <= run.parameter(f"{self.plant.name}.table.z") + ARM_MARGIN
        wall = run[f"{prefix}p_pad[1]"] >= run.parameter(f"{self.plant.name}.wall.x") - ARM_MARGIN
        self.events += [table, wall]
        self.peaks += [run[f"{prefix}f_e[{k}]"] for k in (1, 3)]
        up, back = self.columns[f"f_h:{i}:3"][0], -self.columns[f"f_h:{i}:1"][0]
        self.sticking.append(
            [
                *episodes(time=run.time, near=table, pull=up, surface="table"),
                *episodes(time=run.time, near=wall, pull=back, surface="wall"),
            ]
        )

    def _shoulder(self, i: int) -> tuple[float, float, float]:
        """A controller knows its own arm only: its frame begins at that shoulder."""
        if self.plant.kind != "arms":
            return 0.0, 0.0, 0.0
        y = self.run.parameter(f"{self.plant.name}.base.y")
        return 0.0, (y, -y)[i], 0.0

    def _column(self, name: str) -> NDArray[np.float64]:
        """An input that nobody wired is at its start value, 0."""
        column = self.run.columns.get(name)
        return np.zeros(len(self.run.time)) if column is None else np.asarray(column, dtype=np.float64)

    def _optional(self, name: str, column: str, unit: float) -> None:
        if column in self.run.columns:
            self.columns[name] = (np.asarray(self.run[column], dtype=np.float64), unit)

    def _boolean(self, name: str) -> NDArray[np.bool_]:
        return np.asarray(self.run[f"{self.plant.name}.{name}"], dtype=bool)


def _whole(step: float) -> float:
    """The step as it was written, without what the difference of two instants has lost."""
    return round(step, 12)
