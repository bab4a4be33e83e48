"""Fair comparisons on a machine that does other things, too.

What is compared runs in turns, so that what else the machine does meets all. A ratio is the median of the ratios of the
rounds, a time the median of the rounds. Where the system lets a process stay on one core, it does. What runs in one
thread is judged by the processor time of that thread; what has threads of its own (other co-simulation tools) by the
clock or by its process' time, whichever is less, so that neither a second core nor a busy machine is held against it.

pyperf, which times Python code in fresh processes, compares runs that were made one after the other; what is compared
here are C calls, several of them in one process.
"""

import os
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from statistics import median


@dataclass(frozen=True)
class Times:
    """Seconds of each, by round."""

    seconds: Mapping[str, list[float]]

    def median(self, name: str) -> float:
        """The median time (s)."""
        return median(self.seconds[name])

    def ratios(self, name: str, beside: str) -> list[float]:
        """`name` over `beside` in each round."""
        return [a / b for a, b in zip(self.seconds[name], self.seconds[beside], strict=True)]

    def ratio(self, name: str, beside: str) -> float:
        """The median of the rounds' ratios."""
        return median(self.ratios(name, beside))

    def spread(self, name: str, beside: str) -> tuple[float, float]:
        """The quarter and three quarters of the rounds' ratios."""
        return quarters(self.ratios(name, beside))


def quarters(values: list[float]) -> tuple[float, float]:
    """What a quarter of the values is below, and a quarter above."""
    ordered = sorted(values)
    return ordered[len(ordered) // 4], ordered[-1 - len(ordered) // 4]


def in_turns(work: Mapping[str, Callable[[], float]], rounds: int, *, warm_up: bool = True) -> Times:
    """Each does its work once a round and says how many seconds it took. One round before warms up."""
    for once in work.values() if warm_up else ():
        once()
    seconds: dict[str, list[float]] = {name: [] for name in work}
    names = list(work)
    for turn in range(rounds):
        # Another one goes first each time: what follows the slowest one is not always the same.
        for name in names[turn % len(names) :] + names[: turn % len(names)]:
            seconds[name].append(work[name]())
    return Times(seconds)


@contextmanager
def pinned() -> Iterator[None]:
    """On one core, the last of those that this process may use; elsewhere than on Linux as before."""
    if not hasattr(os, "sched_setaffinity"):
        yield
        return
    allowed = os.sched_getaffinity(0)
    os.sched_setaffinity(0, {max(allowed)})
    try:
        yield
    finally:
        os.sched_setaffinity(0, allowed)


def cores() -> int:
    """How many cores this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
