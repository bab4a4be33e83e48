"""A case that runs again and again: its instances stay, and so does what of a run is recorded.

The first run shows which columns the metrics look at: one that was not kept is kept from then on, and the run made
again. With a branch the first seconds run once, and each run goes on from the FMUs' states.
"""

from collections.abc import Callable, Iterable, Mapping
from contextlib import suppress
from math import ceil, floor, isclose, isfinite
from types import TracebackType
from typing import Self

from exo import derived
from exo.coupled import Coupled, NotKeptError, Saved
from exo.errors import FmuError, ScenarioError
from exo.fmu import Archive
from exo.loop import Engine
from exo.plan import Plan
from exo.recording import Recording


class Look:
    """A run that can be looked at: where a metric wants a column that was not kept, it is run again with that one."""

    def __init__(self, runs: "Repeated", of: Plan, signals: Iterable[str]) -> None:
        self._runs = runs
        self._plan = of
        self._signals = signals
        #: The recording, and with its derived signals: they are computed once for all metrics.
        self._seen: tuple[Recording, Recording] | None = None

    def measure(self, metric: Callable[..., float]) -> float:
        """`metric`, called with the `recording` and its derived signals."""
        while True:
            try:
                run = self._runs.recording(self._plan)
                if self._seen is None or self._seen[0] is not run:
                    self._seen = run, derived.added(run, self._signals)
                return metric(recording=self._seen[1])
            except NotKeptError as missing:
                self._runs.keep(missing.name)


class Repeated:
    """The instances of one case, and what is kept of a run."""

    def __init__(self, of: Plan, archives: Mapping[str, Archive], branch_at: float | None, engine: Engine) -> None:
        self.plan = of
        self._archives = archives
        self._branch = None if branch_at is None else _ticks(branch_at, of)
        self._engine = engine
        self._kept: dict[str, None] = {}
        self._coupled: Coupled | None = None
        self._saved: Saved | None = None
        self._ran: Plan | None = None
        self._recording: Recording | None = None

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._close()

    def _close(self) -> None:
        if self._coupled is not None:
            coupled, self._coupled = self._coupled, None
            try:
                # An instance that has failed may refuse; what is left goes with it.
                if self._saved is not None:
                    with suppress(FmuError):
                        coupled.free(self._saved)
            finally:
                self._saved = None
                coupled.__exit__(None, None, None)
        self._ran = self._recording = None

    def keep(self, name: str) -> None:
        """From now on records this column, too."""
        self._kept[name] = None
        self._close()

    def look(self, of: Plan, signals: Iterable[str]) -> Look:
        """A run with this plan, made now; `signals` are the derived ones that metrics may want."""
        self._run(of)
        return Look(self, of, signals)

    def recording(self, of: Plan) -> Recording:
        """The recording of the run with this plan, made again where what is kept has changed."""
        if self._ran is not of or self._recording is None:
            self._run(of)
        assert self._recording is not None
        return self._recording

    def _run(self, of: Plan) -> None:
        self._ran = None
        try:
            if self._coupled is None:
                self._coupled = Coupled(self.plan, self._archives, kept=self._kept).__enter__()
            if self._branch is None:
                self._coupled.start(of)
            else:
                self._branched(self._coupled, self._branch, of)
            self._coupled.advance(engine=self._engine)
            self._recording = self._coupled.recording(lazily=True)
            self._ran = of
        except BaseException:
            # Instances that have failed, or that stand in the middle of a run, are not used again.
            self._close()
            raise

    def _branched(self, coupled: Coupled, ticks: int, of: Plan) -> None:
        """The common part, run once; then what this row sets."""
        if self._saved is None:
            coupled.start(self.plan)
            coupled.advance(until=ticks, engine=self._engine)
            self._saved = coupled.save()
        else:
            coupled.restore(self._saved)
        own = self.plan.parameters
        for key, value in of.parameters.items():
            if key not in own or own[key] != value:
                coupled.set(key, value)


def _ticks(at: float, of: Plan) -> int:
    exact = at / of.step if isfinite(at) else 0.0
    ticks = round(exact)
    if not 0 < ticks < of.steps:
        raise ScenarioError(f"branch_at = {at:g} s: expected a time within the run, {of.step:g} to {of.duration:g} s")
    if not isclose(exact, ticks, rel_tol=1e-9):
        below, above = (f"{n * of.step:.12g}" for n in (floor(exact), ceil(exact)))
        raise ScenarioError(
            f"branch_at = {at:.12g} s: expected a multiple of the step {of.step:.12g} s, as {below} or {above} s"
        )
    return ticks
