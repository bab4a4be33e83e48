"""The benches of `exo play`: what is coupled, what can be set, what is shown."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Literal

from exo.errors import ScenarioError, close_matches

Kind = Literal["testbed", "arm"]


@dataclass(frozen=True, kw_only=True)
class Knob:
    """Something that the page sets: a number between `low` and `high`, or one of `choices`.

    `live` knobs act at once, as profiles of tunable parameters do; the others begin a new run.
    """

    id: str
    label: str
    #: Parameters that get the number, by `component.name`.
    keys: tuple[str, ...]
    start: float | str
    unit: str = ""
    low: float = 0.0
    high: float = 0.0
    choices: tuple[str, ...] = ()
    live: bool = False

    def value(self, given: object) -> float | str:
        """What was given, if it fits; ScenarioError names the knob, the value and what was expected."""
        if self.choices:
            if given in self.choices:
                return str(given)
            raise ScenarioError(f"{self.id} = {given!r:.40}: expected one of {', '.join(self.choices)}")
        if isinstance(given, bool) or not isinstance(given, int | float) or not self.low <= given <= self.high:
            raise ScenarioError(
                f"{self.id} = {given!r:.40}: expected a number from {self.low:g} to {self.high:g} {self.unit}".rstrip()
            )
        return float(given)

    def as_json(self) -> dict[str, Any]:
        """For the page."""
        return {key: getattr(self, key) for key in ("id", "label", "start", "unit", "low", "high", "choices", "live")}


@dataclass(frozen=True, kw_only=True)
class Bench:
    """What a page plays with."""

    kind: Kind
    title: str
    #: Scenario that everything else is taken from.
    base: str
    #: s
    step: float
    #: A run ends after this time (s): all of it is kept, so that it can be saved.
    longest: float
    parameters: Mapping[str, Any]
    #: Axis of the hand → inputs that get its force (N).
    force: Mapping[str, tuple[str, ...]]
    #: Position and velocity of the handle, an axis each.
    position: tuple[str, ...]
    velocity: tuple[str, ...]
    #: Most that the hand pushes with (N), an axis.
    strongest: float
    knobs: tuple[Knob, ...]
    #: Switches: id → Boolean inputs.
    switches: Mapping[str, tuple[str, ...]]
    #: What is recorded and sent to the page.
    shown: tuple[str, ...]
    #: Of those, the ones that are plotted, each group a panel: title, unit, columns.
    panels: tuple[tuple[str, str, tuple[str, ...]], ...]

    def knob(self, name: str) -> Knob:
        """The knob of this id; ScenarioError, if there is none."""
        for one in self.knobs:
            if one.id == name:
                return one
        known = [one.id for one in self.knobs]
        raise ScenarioError(f"no knob {name:.40}{close_matches(name[:40], known)}")


LAWS = ("standard", "passive", "passive_applied", "passive_bounded")


def _each(name: str) -> tuple[str, ...]:
    return tuple(f"{name}[{i}]" for i in (1, 2, 3))


TESTBED = Bench(
    kind="testbed",
    title="Testbed: a mass, a wall that no sensor sees, and your hand",
    base="testbed",
    step=0.002,
    longest=180.0,
    parameters={"plant.F_c": 0.64, "plant.b": 0.19, "plant.wall.q": 0.3},
    force={"x": ("controller.tau_h", "plant.tau_h")},
    position=("plant.q",),
    velocity=("plant.dq",),
    # Less than the 12.5 N of the drive: a hand that could tear the mass off would not see it stick.
    strongest=10.0,
    knobs=(
        Knob(id="law", label="law", keys=("controller.law",), start="standard", choices=LAWS),
        Knob(id="K", label="gain K", keys=("controller.K",), start=30.0, unit="N·s/m", low=1.0, high=60.0, live=True),
        Knob(id="M_n", label="nominal mass M_n", keys=("controller.M_n",), start=5.0, unit="kg", low=0.1, high=20.0,
             live=True),
        Knob(id="D_n", label="nominal damping D_n", keys=("controller.D_n",), start=0.5, unit="N·s/m", low=0.1,
             high=20.0, live=True),
        Knob(id="mass", label="mass of the machine", keys=("plant.M",), start=6.0, unit="kg", low=1.0, high=30.0),
        Knob(id="wall", label="place of the wall", keys=("plant.wall.q",), start=0.3, unit="m", low=0.1, high=1.0),
    ),
    switches={},
    shown=(
        "plant.q", "plant.dq", "plant.tau_e", "plant.tau_f", "controller.q_n", "controller.e_nr", "controller.tau_a",
        "controller.energy.tank", "controller.energy.share", "controller.saturated",
    ),
    panels=(
        ("position", "m", ("plant.q", "controller.q_n")),
        ("force", "N", ("controller.tau_h", "controller.tau_a")),
        ("tank", "J", ("controller.energy.tank",)),
    ),
)  # fmt: skip

ARM = Bench(
    kind="arm",
    title="Arm: lead the handle, press on the table, pick up the payload",
    base="arm",
    step=0.001,
    longest=120.0,
    parameters={"plant.table.z": -0.41710},
    force={
        axis: (f"controller.f_h[{i}]", f"plant.f_h[{i}]") for i, axis in enumerate(("x", "y", "z"), start=1)
    },
    position=_each("plant.p"),
    velocity=_each("plant.dp"),
    strongest=60.0,
    knobs=(
        Knob(id="law", label="law", keys=("controller.law",), start="passive_bounded", choices=LAWS),
        Knob(id="K", label="gain K", keys=_each("controller.K"), start=1000.0, unit="N·s/m", low=100.0, high=1500.0,
             live=True),
        Knob(id="Lambda_n", label="nominal mass Λ_n", keys=_each("controller.Lambda_n"), start=5.0, unit="kg", low=1.0,
             high=30.0, live=True),
        Knob(id="D_n", label="nominal damping D_n", keys=_each("controller.D_n"), start=20.0, unit="N·s/m", low=5.0,
             high=200.0, live=True),
        Knob(id="payload", label="payload", keys=("plant.payload.m",), start=17.5, unit="kg", low=0.5, high=30.0),
        Knob(id="table", label="height of the table", keys=("plant.table.z",), start=-0.41710, unit="m", low=-0.6,
             high=-0.38),
    ),
    switches={"vacuum": ("plant.vacuum",)},
    shown=(
        *_each("plant.p"), *_each("plant.dp"), *_each("plant.q"), *_each("plant.q_joint"), *_each("plant.p_pad"),
        *_each("plant.f_e"), "plant.attached", "plant.tension", *_each("controller.p_n"), *_each("controller.e_nr"),
        *_each("controller.q_n"), *_each("controller.tau_a"), "controller.energy.tank", "controller.energy.share",
        "controller.saturated",
    ),
    panels=(
        ("height of the handle", "m", ("plant.p[3]", "controller.p_n[3]")),
        ("hand along z, contact", "N", ("controller.f_h[3]", "plant.f_e[3]")),
        ("torques", "N·m", _each("controller.tau_a")),
        ("tank", "J", ("controller.energy.tank",)),
    ),
)  # fmt: skip

BENCHES: Mapping[str, Bench] = {bench.kind: bench for bench in (TESTBED, ARM)}


def named(name: str) -> Bench:
    """The bench of this name; ScenarioError, if there is none."""
    if name not in BENCHES:
        raise ScenarioError(f"no bench {name}{close_matches(name, BENCHES)}")
    return BENCHES[name]
