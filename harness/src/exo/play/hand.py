"""The mouse as a hand: a spring and a damper from where the mouse wants the handle to where it is."""

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from exo.errors import ScenarioError

#: (time, value) pairs, straight in between.
Points = Sequence[tuple[float, float]]

#: Stiffness of the hand (N/m) that can be set, and how much of critical damping over 5 kg it has.
STIFFEST, SOFTEST = 1000.0, 5.0
DAMPING = 0.7
FELT_MASS = 5.0


@dataclass
class Hand:
    """Grips or not; where it wants the handle to be, and how stiffly; or the force that a slider gives."""

    axes: int
    #: Most that it pushes with along an axis (N).
    strongest: float
    stiffness: float
    #: m, an axis each; None while the hand does not grip.
    target: list[float] | None = None
    #: N, an axis each: on top.
    push: list[float] = field(default_factory=list)
    #: What it does by itself until somebody takes the handle: the forces of an earlier run (N), an axis each.
    script: Sequence[Points] = ()

    def __post_init__(self) -> None:
        self.push = [0.0] * self.axes

    def aim(self, target: object) -> None:
        """Where the handle should go (m, an axis each), or None to let go."""
        self.target = None if target is None else self._numbers("target", target, 10.0, "m")
        self._taken()

    def press(self, force: object) -> None:
        """The slider's force (N, an axis each)."""
        self.push = self._numbers("push", force, self.strongest, "N")
        self._taken()

    def let_go(self) -> None:
        """Neither grips nor pushes, and has no script."""
        self.target, self.push, self.script = None, [0.0] * self.axes, ()

    def stiffen(self, stiffness: object) -> None:
        """N/m"""
        if isinstance(stiffness, bool) or not isinstance(stiffness, int | float):
            raise ScenarioError(f"stiffness = {stiffness!r:.40}: expected a number")
        if not SOFTEST <= stiffness <= STIFFEST:
            # An int of JSON may be larger than any float.
            raise ScenarioError(f"stiffness = {stiffness!r:.40} N/m: expected {SOFTEST:g} to {STIFFEST:g}")
        self.stiffness = float(stiffness)

    def force(self, position: Sequence[float], velocity: Sequence[float], *, time: float = 0.0) -> list[float]:
        """N, an axis each, for a handle at `position` (m) with `velocity` (m/s), at `time` (s) of the run."""
        if self.script:
            if time <= max(points[-1][0] for points in self.script):
                return [float(np.interp(time, *np.asarray(points).T)) for points in self.script]
            self.script = ()
        found = list(self.push)
        if self.target is not None:
            damping = 2.0 * DAMPING * (self.stiffness * FELT_MASS) ** 0.5
            for i in range(self.axes):
                found[i] += self.stiffness * (self.target[i] - position[i]) - damping * velocity[i]
        return [min(max(one, -self.strongest), self.strongest) for one in found]

    def _taken(self) -> None:
        """Who grips or pushes ends the script; who lets go does not."""
        if self.target is not None or any(self.push):
            self.script = ()

    def _numbers(self, name: str, given: object, most: float, unit: str) -> list[float]:
        if not isinstance(given, list) or len(given) != self.axes:
            raise ScenarioError(f"{name} = {given!r:.60}: expected {self.axes} numbers ({unit})")
        for one in given:
            # A NaN is not within.
            if isinstance(one, bool) or not isinstance(one, int | float) or not -most <= one <= most:
                raise ScenarioError(f"{name} = {given!r:.60}: expected numbers from {-most:g} to {most:g} {unit}")
        return [float(one) for one in given]
