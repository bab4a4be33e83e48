"""Runs by the clock: when each step began, and whether it was done before the next one."""

from dataclasses import dataclass
from time import perf_counter, sleep
from typing import Any

import numpy as np
from numpy.typing import NDArray

#: How long before its time a step is waited for without sleep (s).
SPIN_S = 1e-3


class Pace:
    """The clock of a run of `steps` steps of `step` seconds."""

    def __init__(self, *, steps: int, step: float) -> None:
        self.step = step
        #: How late each step began, and how long it took (s).
        self.late: NDArray[np.float64] = np.zeros(steps)
        self.busy: NDArray[np.float64] = np.zeros(steps)
        self._began = 0.0

    @property
    def addresses(self) -> tuple[int, int]:
        """Of both columns, for the native engine."""
        return self.late.ctypes.data, self.busy.ctypes.data

    def wait(self, k: int, due: float) -> None:
        """Until step k is due."""
        while (left := due - perf_counter()) > 0.0:
            if left > SPIN_S:
                sleep(left - SPIN_S)
        self._began = perf_counter()
        self.late[k] = self._began - due

    def ends(self, k: int) -> None:
        """Step k is done."""
        self.busy[k] = perf_counter() - self._began

    def deadlines(self) -> "Deadlines":
        """What has become of the deadlines."""
        return Deadlines.of(self.late, self.busy, self.step)


@dataclass(frozen=True, kw_only=True)
class Deadlines:
    """Statistics of a run by the clock. A step is an overrun if it ended after the next one was due."""

    steps: int
    step: float
    overruns: int
    #: Of how late steps began (s).
    late_median: float
    late_99: float
    late_max: float
    #: Of how long steps took (s).
    busy_median: float
    busy_99: float
    busy_max: float

    @classmethod
    def of(cls, late: NDArray[np.float64], busy: NDArray[np.float64], step: float) -> "Deadlines":
        """From each step's lateness and duration (s)."""
        figures = {
            f"{name}_{what}": float(np.percentile(column, share))
            for name, column in (("late", late), ("busy", busy))
            for what, share in (("median", 50.0), ("99", 99.0), ("max", 100.0))
        }
        return cls(steps=len(late), step=step, overruns=int(np.count_nonzero(late + busy > step)), **figures)

    def sentence(self) -> str:
        """The figures as one line."""
        return (
            f"{self.steps} steps of {1e3 * self.step:g} ms by the clock: {self.overruns} overruns; began "
            f"{1e6 * self.late_median:.0f} µs late in the middle, {1e6 * self.late_99:.0f} µs 99 % of them, "
            f"{1e6 * self.late_max:.0f} µs the latest; took {1e6 * self.busy_median:.0f} µs in the middle, "
            f"{1e6 * self.busy_max:.0f} µs the longest"
        )

    def as_json(self) -> dict[str, Any]:
        """For metrics.json, times in seconds."""
        return {key: getattr(self, key) for key in self.__dataclass_fields__}
