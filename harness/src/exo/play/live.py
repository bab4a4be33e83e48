"""The run behind the page: the FMUs, stepped by the clock, in chunks between which the hand is asked."""

import threading
from collections.abc import Mapping
from contextlib import ExitStack
from copy import copy
from dataclasses import dataclass
from pathlib import Path
from time import perf_counter, sleep
from typing import Any

import numpy as np
from numpy.typing import NDArray

from exo import profile, replay
from exo import scenario as scenarios
from exo.coupled import Coupled
from exo.errors import ExoError
from exo.fmu import Archive
from exo.loop import Engine
from exo.plan import plan
from exo.play import saved
from exo.play.bench import Bench
from exo.play.contact import Contact
from exo.play.hand import Hand
from exo.scenario import Segment

#: s between two looks at the hand: a spring of 1000 N/m on 5 kg swings within forty of them.
CHUNK_S = 0.01
#: s between two looks at whether there is something to do.
IDLE_S = 0.02
#: What is felt and what is kept is rounded to this (N): a file of forces is then half as long.
FORCE_DIGITS = 4
#: From this delay on the clock is set anew, and the page says that it is not real time (s).
LATE_S = 0.1
#: How long that is said (s).
SAID_S = 2.0


@dataclass(frozen=True)
class State:
    """What the page draws: the newest row of what is shown, and how the run is doing."""

    #: Counts runs: a page that sees another one begins anew.
    run: int
    time: float
    values: Mapping[str, float]
    force: tuple[float, ...]
    word: str
    stuck: float
    let_go: float | None
    #: Share of real time that the last second had; 1 where the machine keeps up.
    speed: float
    #: `running`, `slower than real time`, `paused`, `ended`; or, where it has `failed`, a sentence about what did.
    status: str
    failed: bool
    settings: Mapping[str, float | str]
    switches: Mapping[str, bool]
    #: N/m
    stiffness: float
    #: Where the hand wants the handle (m, an axis each); None while it does not grip.
    target: tuple[float, ...] | None
    #: What it pushes with besides (N, an axis each).
    push: tuple[float, ...]
    paused: bool
    #: The hand repeats an earlier run by itself.
    repeats: bool

    def as_json(self) -> dict[str, Any]:
        """Numbers with six digits: a page has no use for more."""
        return {
            "run": self.run,
            "time": round(self.time, 4),
            "values": {key: float(f"{value:.6g}") for key, value in self.values.items()},
            "force": [float(f"{one:.6g}") for one in self.force],
            "word": self.word,
            "stuck": round(self.stuck, 2),
            "let_go": self.let_go,
            "speed": round(self.speed, 3),
            "status": self.status,
            "failed": self.failed,
            "settings": dict(self.settings),
            "switches": dict(self.switches),
            "stiffness": self.stiffness,
            "target": self.target,
            "push": self.push,
            "paused": self.paused,
            "repeats": self.repeats,
        }


class Live:
    """One bench in a thread of its own; use with `with`. All methods may be called from any thread."""

    def __init__(
        self,
        bench: Bench,
        *,
        fmu_dir: Path,
        engine: Engine,
        settings: Mapping[str, float | str] | None = None,
        clock: bool = True,
    ) -> None:
        """`clock` = False steps as fast as it can: for tests."""
        self.bench = bench
        self.engine = engine
        self._fmu_dir = fmu_dir
        self._clock = clock
        self._lock = threading.Lock()
        self._settings = {knob.id: knob.start for knob in bench.knobs} | dict(settings or {})
        self._hand = Hand(axes=len(bench.force), strongest=bench.strongest, stiffness=200.0)
        self._switches = dict.fromkeys(bench.switches, False)
        self._paused = False
        self._again = True
        self._stopping = False
        self._state: State | None = None
        self._points: dict[str, list[tuple[float, float]]] = {}
        self._began: dict[str, float | str] = {}
        self._coupled: Coupled | None = None
        self._geometry: tuple[int, dict[str, Any] | None] = (0, None)
        self._thread = threading.Thread(target=self._work, name="exo play", daemon=True)

    def __enter__(self) -> "Live":
        self._thread.start()
        return self

    def __exit__(self, *_: object) -> None:
        self._stopping = True
        self._thread.join(timeout=5.0)

    @property
    def state(self) -> State | None:
        """The newest one; None before the first run has begun."""
        return self._state

    @property
    def geometry(self) -> tuple[int, dict[str, Any] | None]:
        """The number of the run, and its plant as `exo.replay.geometry` has it."""
        return self._geometry

    def begun(self, *, within: float = 30.0) -> State:
        """The first state, when the first run has begun. ExoError, if it cannot begin."""
        until = perf_counter() + within
        while (state := self._state) is None or not (state.values or state.failed):
            if perf_counter() > until:
                raise ExoError(f"no run has begun within {within:g} s")
            sleep(0.01)
        if state.failed:
            raise ExoError(state.status)
        return state

    def columns(self) -> dict[str, NDArray[np.float64]]:
        """What is shown, a row for each step that has been made. For a run that is paused or has ended."""
        with self._lock:
            coupled = self._coupled
            ends = min((found[-1][0] for found in self._points.values()), default=0.0)
        if coupled is None:
            return {}
        recording = coupled.recording(lazily=True)
        rows = round(ends / self.bench.step)
        return {name: np.array(recording.columns[name][:rows], dtype=np.float64) for name in self.bench.shown}

    def set(self, name: str, given: object) -> None:
        """A knob: a live one acts from the next chunk on, another one begins a new run."""
        knob = self.bench.knob(name)
        with self._lock:
            value = knob.value(given)
            if self._settings[name] != value:
                self._settings[name] = value
                self._again = self._again or not knob.live

    def switch(self, name: str, on: object) -> None:
        """A switch, on or off."""
        if name not in self._switches or not isinstance(on, bool):
            raise ExoError(f"switch {name!r:.40} = {on!r:.40}: expected one of {', '.join(self._switches) or 'none'}")
        with self._lock:
            self._switches[name] = on

    def hand(self, *, target: object = ..., push: object = ..., stiffness: object = ...) -> None:
        """Where the hand wants the handle (m), what it pushes besides (N), how stiff it is (N/m)."""
        with self._lock:
            # All of it or nothing.
            hand = copy(self._hand)
            if stiffness is not ...:
                hand.stiffen(stiffness)
            if target is not ...:
                hand.aim(target)
            if push is not ...:
                hand.press(push)
            self._hand = hand

    def pause(self, on: object) -> None:
        """Holds the clock, or lets it go on."""
        if not isinstance(on, bool):
            raise ExoError(f"pause = {on!r:.40}: expected true or false")
        self._paused = on

    def again(self, *, same_hand: bool = False) -> None:
        """Begins a new run; with `same_hand` the forces of this one push until somebody takes the handle."""
        with self._lock:
            script = tuple(tuple(self._points.get(axis, ())) for axis in self.bench.force)
            self._hand.let_go()
            self._hand.script = script if same_hand and all(len(one) > 1 for one in script) else ()
            self._again = True

    def other(self, name: str, given: object) -> None:
        """A knob set for a new run, in which the hand pushes as it did in this one."""
        with self._lock:
            self._settings[name] = self.bench.knob(name).value(given)
        self.again(same_hand=True)

    def tables(self, name: str = "played") -> dict[str, Any]:
        """The run so far as a scenario's tables. ExoError, if nothing has been played yet."""
        with self._lock:
            points = {key: list(found) for key, found in self._points.items()}
            began = dict(self._began)
        ends = min((found[-1][0] for found in points.values() if found), default=0.0)
        if ends <= 0.0:
            raise ExoError("nothing has been played yet; expected a run that has begun")
        profiles = {key: saved.thinned(found) for key, found in points.items()}
        return saved.tables(self.bench, settings=began, profiles=profiles, duration=ends, name=name)

    def _work(self) -> None:
        """One run after the other, until it is told to stop."""
        run = 0
        with ExitStack() as stack:
            opened: dict[str, Archive] = {}
            while not self._stopping:
                run += 1
                self._again = False
                try:
                    self._run(run, opened, stack)
                except ExoError as error:
                    self._tell(run=run, status=" ".join(str(error).split()), failed=True)
                except Exception as error:  # a page that stands still without a word helps nobody
                    said = " ".join(str(error).split())
                    self._tell(run=run, status=f"an error of exo itself: {type(error).__name__}: {said}", failed=True)
                while not self._again and not self._stopping:
                    sleep(IDLE_S)

    def _run(self, run: int, opened: dict[str, Archive], stack: ExitStack) -> None:
        bench = self.bench
        with self._lock:
            settings = dict(self._settings)
            self._began = settings
            self._points = {}
            self._coupled = None
        begin: dict[str, list[tuple[float, float]]] = {
            **{axis: [(0.0, 0.0), (1.0, 0.0)] for axis in (*bench.force, *bench.switches)},
            **{knob.id: [(0.0, float(settings[knob.id])), (1.0, float(settings[knob.id]))] for knob in self._live()},
        }
        tables = saved.tables(bench, settings=settings, profiles=begin, duration=bench.longest)
        scenario = scenarios.from_tables(tables, origin="exo play")
        of = plan(scenario=scenario, case=scenario.cases[0])
        # Extracted once: the next run begins sooner.
        for name in sorted(set(of.components.values()) - set(opened)):
            opened[name] = stack.enter_context(Archive(self._fmu_dir / name))
        with Coupled(of, opened, kept=bench.shown) as coupled:
            coupled.start(of)
            self._geometry = (run, replay.geometry(coupled.recording(lazily=True).parameters))
            with self._lock:
                self._points = {key: [(0.0, found[0][1])] for key, found in begin.items()}
                self._coupled = coupled
            self._loop(run, coupled, of.steps)

    def _live(self) -> list[Any]:
        return [knob for knob in self.bench.knobs if knob.live]

    def _loop(self, run: int, coupled: Coupled, steps: int) -> None:
        bench = self.bench
        chunk = round(CHUNK_S / bench.step) or 1
        time = coupled.time
        contact = Contact()
        origin, slow_until, speed, done = perf_counter(), 0.0, 1.0, 0
        second = (perf_counter(), 0)
        # A run that begins while the clock is held shows where it stands, and nothing of the run before.
        self._tell(run=run, status="paused" if self._paused else "running", values=self._values(coupled, 0))
        while done < steps and not self._again and not self._stopping:
            if self._paused:
                self._tell(run=run, status="paused")
                sleep(IDLE_S)
                origin = perf_counter() - done * bench.step
                second = (perf_counter(), done)
                continue
            end = min(done + chunk, steps)
            here = self._values(coupled, done)
            force = self._feed(coupled, time, done, end, here)
            coupled.advance(until=end, engine=self.engine)
            done = end
            here = self._values(coupled, done)
            pressed, pull = _contact(bench, here, force)
            contact.look(time=done * bench.step, passed=chunk * bench.step, pressed=pressed, pull=pull)
            now = perf_counter()
            if now - second[0] >= 1.0:
                speed = (done - second[1]) * bench.step / (now - second[0])
                second = (now, done)
            status = "running" if now > slow_until else "slower than real time"
            self._tell(
                run=run, status=status, time=done * bench.step, values=here, force=tuple(force),
                contact=contact, speed=speed,
            )  # fmt: skip
            if self._clock:
                due = origin + done * bench.step
                if now > due + LATE_S:
                    origin = now - done * bench.step
                    slow_until = now + SAID_S
                elif (left := due - now) > 0.0:
                    sleep(left)
        if done >= steps:
            self._tell(run=run, status="ended")

    def _values(self, coupled: Coupled, row: int) -> dict[str, float]:
        """What is shown, in a row of the outputs."""
        return {name: float(coupled.shown(name, row)) for name in self.bench.shown}

    def _feed(self, coupled: Coupled, time: Any, first: int, end: int, here: Mapping[str, float]) -> list[float]:
        """Fills the inputs of the steps from `first` to before `end`: straight from the last values to the new ones."""
        bench = self.bench
        with self._lock:
            position, velocity = ([here[name] for name in names] for names in (bench.position, bench.velocity))
            force = self._hand.force(position, velocity, time=end * bench.step)
            force = [round(one, FORCE_DIGITS) for one in force]
            wanted = dict(zip(bench.force, force, strict=True))
            wanted |= {knob.id: float(self._settings[knob.id]) for knob in self._live()}
            wanted |= {name: float(on) for name, on in self._switches.items()}
            keys = {knob.id: knob.keys for knob in self._live()} | dict(bench.force) | dict(bench.switches)
            until = round(end * bench.step, 9)
            for name, value in wanted.items():
                self._points[name].append((until, value))
                # A tick may lie a rounding before its point: then it belongs to the stretch before, as in the file.
                segment = Segment(kind="table", points=tuple(self._points[name][-3:]))
                column = profile.evaluate(segments=(segment,), time=time[first:end])
                for key in keys[name]:
                    coupled.feed(key, first, column)
        return force

    def _tell(self, *, run: int, status: str, **more: Any) -> None:
        """A new state; what is not given stays as it was, in a run that goes on."""
        old = self._state if self._state is not None and self._state.run == run else None
        contact: Contact | None = more.get("contact")
        with self._lock:
            settings, switches = dict(self._settings), dict(self._switches)
            stiffness, target, push = self._hand.stiffness, self._hand.target, tuple(self._hand.push)
            repeats = bool(self._hand.script)
        self._state = State(
            run=run,
            time=more.get("time", old.time if old else 0.0),
            values=more.get("values", old.values if old else {}),
            force=more.get("force", old.force if old else (0.0,) * len(self.bench.force)),
            word=contact.word if contact else old.word if old else "free",
            stuck=contact.stuck if contact else old.stuck if old else 0.0,
            let_go=contact.let_go if contact else old.let_go if old else None,
            speed=more.get("speed", 1.0),
            status=status,
            failed=more.get("failed", False),
            settings=settings,
            switches=switches,
            stiffness=stiffness,
            target=None if target is None else tuple(target),
            push=push,
            paused=self._paused,
            repeats=repeats,
        )


def _contact(bench: Bench, here: Mapping[str, float], force: list[float]) -> tuple[float, float]:
    """The contact's force, what the hand pulls away with (N)."""
    if bench.kind == "testbed":
        return abs(here["plant.tau_e"]), -force[0]
    return abs(here["plant.f_e[3]"]), force[2]
