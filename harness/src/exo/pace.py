"""Runs by the clock: when each step began, and whether it was done before the next one."""

from dataclasses import dataclass
from time import perf_counter, sleep
from typing import Any

import numpy as np
from numpy.typing import NDArray

#: Of how many overruns it is kept, and shown, when they were.
KEPT, SHOWN = 100, 5
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
    #: When the first ones of these were due to begin, in the run's time (s).
    overruns_at: tuple[float, ...]
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
        over = np.flatnonzero(late + busy > step)
        at = tuple((over[:KEPT] * step).tolist())
        return cls(steps=len(late), step=step, overruns=len(over), overruns_at=at, **figures)

    def sentence(self) -> str:
        """The figures as one line."""
        shown = ", ".join(f"{t:.6g}" for t in self.overruns_at[:SHOWN])
        more = ", …" if self.overruns > SHOWN else ""
        which = f" (at t = {shown}{more} s)" if shown else ""
        return (
            f"{self.steps} steps of {1e3 * self.step:g} ms by the clock: {self.overruns} overruns{which}; began "
            f"{_micro(self.late_median)} µs late in the middle, {_micro(self.late_99)} µs 99 % of them, "
            f"{_micro(self.late_max)} µs the latest; took {_micro(self.busy_median)} µs in the middle, "
            f"{_micro(self.busy_max)} µs the longest"
        )

    def as_json(self) -> dict[str, Any]:
        """For metrics.json, times in seconds."""
        return {key: getattr(self, key) for key in self.__dataclass_fields__}


def _micro(seconds: float) -> str:
    """Microseconds, with two digits where there are few."""
    micro = 1e6 * seconds
    return f"{micro:.0f}" if micro >= 10.0 else f"{micro:.2g}"
