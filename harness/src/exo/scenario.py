"""Scenarios as data: a TOML file becomes frozen objects, or an error that names file, key, value and expectation."""

import json
import math
from collections.abc import Iterable, Mapping
from importlib.resources.abc import Traversable
from pathlib import Path
from typing import Annotated, Any, Literal, Self

from pydantic import (
    AfterValidator,
    BaseModel,
    BeforeValidator,
    ConfigDict,
    Field,
    StringConstraints,
    ValidationError,
    model_validator,
)

from exo import expansion, refused
from exo.errors import ScenarioError, close_matches
from exo.naming import expand_names, expand_values, expand_wires, file_name, line, text
from exo.plain import plain_values

Coupling = Literal["zero_delay", "one_sample_delay", "exchange_at_once"]
Value = bool | int | float | str
#: Names a file or a folder of the results, on every system.
Identifier = Annotated[str, AfterValidator(file_name)]
ComponentName = Annotated[str, StringConstraints(pattern=r"^[A-Za-z_]\w*$")]
#: One line, and several: what is shown, also in XML and on terminals.
Line = Annotated[str, AfterValidator(line)]
Text = Annotated[str, AfterValidator(text)]
#: `component.variable`, the name of an FMU's variable in a scenario.
Qualified = Annotated[str, StringConstraints(pattern=r"^[A-Za-z_]\w*\.\S+$")]
#: Arrays may be written at once, see `exo.naming`; what is kept has one entry an element.
Parameters = Annotated[dict[str, Value], BeforeValidator(expand_values)]
QualifiedParameters = Annotated[dict[Qualified, Value], BeforeValidator(expand_values)]
#: The same as a source, with a minus where its sign is turned over.
Source = Annotated[str, StringConstraints(pattern=r"^-?[A-Za-z_]\w*\.\S+$")]
Wires = Annotated[dict[Qualified, Source], BeforeValidator(expand_wires)]
Columns = Annotated[tuple[Qualified, ...], BeforeValidator(expand_names)]
Positive = Annotated[float, Field(gt=0.0)]
NotNegative = Annotated[float, Field(ge=0.0)]

#: Component name that stands for the scenario's profiles in `inputs`. A Boolean input is true from a half on,
#: an Integer takes the nearest one.
PROFILE = "profile"
#: Before a source of an input: the input gets its negative.
MINUS = "-"
#: Component name that stands for what is computed from a recording (`exo.derived`).
DERIVED = "derived"
#: Files and folders that lie beside the scenarios' folders.
RESERVED = ("junit.xml", "report.html", "tune")
#: Of one case: 1e8 steps of 1 ms are a day; all columns of a run are kept in memory.
MAX_STEPS = 1e8


class Data(BaseModel):
    """Frozen, strict, and without unknown keys."""

    model_config = ConfigDict(frozen=True, extra="forbid", strict=True, allow_inf_nan=False)


class Segment(Data):
    """One term of a force profile: a shape in a window (N, s, Hz, rad). Phase and cycles count from `t_on`."""

    kind: Literal["sine", "constant", "square", "table"]
    amplitude: float = 1.0
    frequency: NotNegative = 0.0
    phase: float = 0.0
    t_on: float = 0.0
    t_off: float | None = None
    ramp: NotNegative = 0.0
    #: `table` only: (time since t_on, value) pairs, linear in between, held outside.
    points: tuple[tuple[float, float], ...] = ()

    @model_validator(mode="after")
    def _fits_its_kind(self) -> Self:
        if self.kind in ("sine", "square") and self.frequency == 0.0:
            raise ValueError(f"a {self.kind} segment needs a frequency above 0 Hz")
        if (self.kind == "table") != bool(self.points):
            raise ValueError("points belong to a table segment, and a table segment needs points")
        if any(b[0] <= a[0] for a, b in zip(self.points, self.points[1:], strict=False)):
            raise ValueError("the times of a table must increase")
        if self.t_off is not None and self.t_off <= self.t_on:
            raise ValueError(f"t_off {self.t_off} s must lie after t_on {self.t_on} s")
        return self


class Component(Data):
    """One FMU instance: its archive in the FMU folder and the start values that every case shares."""

    archive: Annotated[str, StringConstraints(pattern=r"^\w+\.fmu$")]
    parameters: Parameters = {}


class Case(Data):
    """One run. Whatever stands here replaces what the scenario says."""

    id: Identifier
    label: Line = ""
    parameters: QualifiedParameters = {}
    inputs: Wires = {}
    profiles: dict[str, tuple[Segment, ...]] = {}
    coupling: Coupling | None = None
    duration: Positive | None = None
    step: Positive | None = None


class Check(Data):
    """What a metric must be. `within` is absolute, `relative` a share of `value`; without any of them: information.

    With `at_most` or `at_least`, `within` is the rounding that the bound may carry; its cause stands in `because`.
    """

    value: float | None = None
    within: NotNegative | None = None
    relative: NotNegative | None = None
    at_most: float | None = None
    at_least: float | None = None
    because: Line = ""

    @model_validator(mode="after")
    def _is_one_kind(self) -> Self:
        kinds = [k for k in ("value", "at_most", "at_least") if getattr(self, k) is not None]
        if len(kinds) > 1:
            raise ValueError(f"one of value, at_most, at_least, not {' and '.join(kinds)}")
        if self.value is not None and (self.within is None) == (self.relative is None):
            raise ValueError("value needs exactly one of within and relative")
        if self.value is None and self.relative is not None:
            raise ValueError("relative belongs to value")
        return self


class Metric(Data):
    """A number taken from a run by a function of `exo.metrics`; its id in the results is `<id>/<case>`."""

    id: Identifier
    title: Line
    unit: Line
    function: str
    arguments: dict[str, Any] = {}
    #: Case ids; all when absent.
    cases: Annotated[tuple[Identifier, ...], Field(min_length=1)] | None = None
    #: For every case that has no entry in `expected`.
    check: Check = Check()
    expected: dict[Identifier, Check] = {}
    source: Line
    #: Parameters on which the expectation rests, as `controller.tau_max` or `plant.*`, and `duration`, `step`: one that
    #: the command line changes turns the verdict into information. All when absent; none is an invariant.
    rests_on: tuple[str, ...] | None = None
    #: Case id → key in paper.toml.
    paper: dict[Identifier, str] = {}


class Ratio(Data):
    """A number over two metrics: the first divided by the second."""

    id: Identifier
    title: Line
    of: tuple[str, str]
    check: Check
    source: Line
    #: Key in paper.toml, or nothing.
    paper: str = ""
    #: As in a metric.
    rests_on: tuple[str, ...] | None = None


class Curve(Data):
    """One line of a panel."""

    case: Identifier
    column: Qualified
    label: Line = ""
    color: str = ""
    dashed: bool = False


class Bands(Data):
    """Coloured bands behind the curves: where a column that counts has which value."""

    case: Identifier
    column: Qualified
    #: What the values 0, 1, … mean.
    labels: Annotated[tuple[Line, ...], Field(min_length=1)]


class Panel(Data):
    """One pair of axes. `y_range` and the marks are in the unit of the axis."""

    title: Line = ""
    y_label: Line
    curves: tuple[Curve, ...]
    y_range: tuple[float, float] | None = None
    x_range: tuple[float, float] | None = None
    #: Horizontal lines, and what they are: for instance the wall or a limit.
    marks: tuple[float, ...] = ()
    mark_label: str = ""
    bands: Bands | None = None


class Poses(Data):
    """Instants of a run at which the arm is drawn from the side."""

    case: Identifier
    #: Component that is the arm: its `q_joint`, `p`, `p_pad`, link lengths, table and payload are drawn.
    plant: str
    times: tuple[NotNegative, ...]


class Figure(Data):
    """A picture and, beside it, its data. Panels fill the grid row by row."""

    id: Identifier
    title: Line
    kind: Literal["panels", "frequency_response", "arm_poses", "impedance", "hand_limits"] = "panels"
    #: The paper's label, when it is one of its figures.
    label: Line = ""
    columns: Annotated[int, Field(ge=1)] = 1
    panels: tuple[Panel, ...] = ()
    #: `arm_poses` only.
    poses: Poses | None = None
    x_label: Line = "time [s]"

    @model_validator(mode="after")
    def _fits_its_kind(self) -> Self:
        if (self.kind == "arm_poses") != (self.poses is not None):
            raise ValueError("poses belong to a figure of kind arm_poses, and such a figure needs poses")
        return self

    @property
    def cases(self) -> list[str]:
        """Cases that it names."""
        drawn = [self.poses.case] if self.poses else []
        banded = [panel.bands.case for panel in self.panels if panel.bands]
        return drawn + banded + [curve.case for panel in self.panels for curve in panel.curves]


class Scenario(Data):
    """An experiment: components, wiring, forces, cases, and what must come out."""

    id: Identifier
    title: Line
    about: Text
    source: Line
    duration: Positive
    #: Macro step, of the cases without one of their own (s): the controller's sample period.
    step: Positive
    coupling: Coupling = "zero_delay"
    #: In the order in which they step.
    components: Annotated[dict[ComponentName, Component], Field(min_length=1)]
    #: Input → source: an output of a component, or `profile.<name>`; of a Real with a minus before it: its negative.
    inputs: Wires
    #: Inputs that come one macro step later under `one_sample_delay`.
    delayed: Columns = ()
    profiles: dict[str, tuple[Segment, ...]] = {}
    cases: Annotated[tuple[Case, ...], Field(min_length=1)]
    #: Signals that are computed from the recorded ones, see `exo.derived`.
    derived: tuple[str, ...] = ()
    #: Columns that are stored with the results; all when empty. Metrics and figures see every column.
    signals: Columns = ()
    metrics: tuple[Metric, ...] = ()
    ratios: tuple[Ratio, ...] = ()
    figures: tuple[Figure, ...] = ()

    @model_validator(mode="after")
    def _names_what_exists(self) -> Self:
        cases = [case.id for case in self.cases]
        _unique("case", cases, folded=True)
        _unique("metric", [m.id for m in self.metrics] + [r.id for r in self.ratios])
        _unique("figure", [f.id for f in self.figures], folded=True)
        if self.id.casefold() in RESERVED:
            raise ValueError(f"id {self.id} is the name of a file beside the results; expected another one")
        for taken, what in ((PROFILE, "profiles"), (DERIVED, "derived signals")):
            if taken in self.components:
                raise ValueError(f"components.{taken}: this name stands for the {what}; expected another one")
        for case in self.cases:
            owner = f"case {case.id}"
            _known(owner, "component", (key.split(".", 1)[0] for key in case.parameters), self.components)
            _known(owner, "profile", case.profiles, self.profiles)
            self._check_wiring(owner, self.inputs | case.inputs)
            check_duration(owner, duration=case.duration or self.duration, step=case.step or self.step)
        for metric in self.metrics:
            owner = f"metric {metric.id}"
            _known(owner, "case", (*(metric.cases or ()), *metric.expected, *metric.paper), cases)
        for figure in self.figures:
            _known(f"figure {figure.id}", "case", figure.cases, cases)
        _known("delayed", "input", self.delayed, self.inputs)
        return self

    def _check_wiring(self, owner: str, inputs: dict[str, str]) -> None:
        _known(owner, "component", (key.split(".", 1)[0] for key in inputs), self.components)
        for source in inputs.values():
            component, name = source.removeprefix(MINUS).split(".", 1)
            if component == PROFILE:
                _known(owner, "profile", [name], self.profiles)
            else:
                _known(owner, "component", [component], [PROFILE, *self.components])


def check_duration(owner: str, *, duration: float, step: float) -> None:
    """Whether a run of `duration` (s) is a whole number of steps (s), and more than one."""
    steps = duration / step
    if not math.isfinite(steps) or steps > MAX_STEPS:
        raise ValueError(
            f"{owner}: duration {duration} s is {steps:.3g} steps of {step} s; expected at most {MAX_STEPS:g}"
        )
    if not math.isclose(steps, round(steps), rel_tol=1e-9):
        raise ValueError(f"{owner}: duration {duration} s is no multiple of the step {step} s")
    if round(steps) < 2:
        raise ValueError(f"{owner}: duration {duration} s is one step of {step} s; expected two or more")


def _unique(kind: str, ids: list[str], *, folded: bool = False) -> None:
    """No id stands twice; `folded`: nor differs from another by case only, because some file systems see no case."""
    seen: dict[str, str] = {}
    for name in ids:
        key = name.casefold() if folded else name
        if seen.get(key) == name:
            raise ValueError(f"{kind} id {name} stands twice")
        if key in seen:
            raise ValueError(f"{kind} ids {seen[key]} and {name} differ by case only; expected more")
        seen[key] = name


def _known(owner: str, kind: str, names: Iterable[str], known: Iterable[str]) -> None:
    known = frozenset(known)
    for name in names:
        if name not in known:
            raise ValueError(f"{owner}: unknown {kind} {name}{close_matches(name, known)}")


def parse(*, text: str, origin: str, folder: Traversable | None = None) -> Scenario:
    """A scenario from TOML text; `origin` is the file's name for messages, `folder` where a path to a base starts."""
    return _from_data(expansion.read(text, origin=origin), origin=origin, folder=folder)


def from_tables(tables: Mapping[str, Any], *, origin: str = "scenario") -> Scenario:
    """A scenario from the tables of such a file as Python's dictionaries and lists. Tuples are lists, what NumPy holds
    are numbers; a path to a base starts in the present folder."""
    data = expansion.placed(plain_values(tables, where=origin), origin=origin)
    return _from_data(data, origin=origin, folder=None)


def _from_data(data: dict[str, Any], *, origin: str, folder: Traversable | None) -> Scenario:
    try:
        data = expansion.joined(data, origin=origin, folder=folder or Path())
        data = expansion.expanded(data, origin=origin)
        # By way of JSON, where strict validation takes arrays for tuples.
        return Scenario.model_validate_json(json.dumps(data, default=str))
    except ValidationError as error:
        raise ScenarioError("\n".join(refused.sentences(error, origin, data, Scenario))) from error
    except RecursionError:
        raise ScenarioError(
            f"{origin}: nested too deeply; expected tables and arrays as in docs/scenarios.md"
        ) from None


def built_in() -> dict[str, Traversable]:
    """The scenarios that come with the harness: id → file."""
    files = (file for file in expansion.home().iterdir() if file.name.endswith(".toml"))
    return {file.name.removesuffix(".toml"): file for file in sorted(files, key=lambda f: f.name)}


def load(name: str) -> Scenario:
    """A built-in scenario by id, or one from a path that ends in `.toml`."""
    if name.endswith(".toml"):
        path = Path(name)
        if not path.is_file():
            raise ScenarioError(f"{name}: no such scenario file")
        return parse(text=expansion.text_of(path, origin=path.name), origin=path.name, folder=path.parent)
    known = built_in()
    if name not in known and (Path(name).suffix or Path(name).exists()):
        raise ScenarioError(f"{name}: expected the path of a TOML file, which ends in .toml, or an id of `exo list`")
    if name not in known:
        raise ScenarioError(f"unknown scenario {name}{close_matches(name, known)}")
    file = known[name]
    return parse(text=expansion.text_of(file, origin=file.name), origin=file.name, folder=expansion.home())
