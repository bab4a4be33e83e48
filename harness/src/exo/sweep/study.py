"""A study as data: which parameters of a scenario vary, how they are sampled, what is measured and drawn.

    id = "gain_and_mass"
    title = "Error over gain and mass"
    scenario = "gain_study"                 # an id, or a file beside the study
    cases = ["K30"]
    metrics = ["error"]                     # all of the scenario without them

    [sampling]
    method = "grid"                         # grid, random, latin_hypercube, sobol
    samples = 1024                          # of all but a grid
    seed = 1

    [axes."controller.K"]
    values = [10.0, 20.0, 30.0]             # these; or a range:
    [axes."plant.M"]
    low = 2.0
    high = 8.0
    scale = "log"                           # linear without it
    count = 5                               # of a grid
    [axes."plant.friction.F_c"]
    mean = 1.2                              # or a normal distribution, not of a grid
    deviation = 0.1

    [[figures]]
    id = "map"
    title = "Largest error"
    kind = "map"                            # map, scatter, histogram, front
    x = "controller.K"
    y = "plant.M"
    color = "error"

Keys of axes are those of `exo.runs`.
"""

import json
import math
from itertools import product
from pathlib import Path
from typing import Annotated, Any, Literal, Self

import numpy as np
import scipy
from pydantic import Field, ValidationError, model_validator

from exo import refused
from exo import scenario as scenarios
from exo.errors import ExoError, close_matches
from exo.plain import read_tables
from exo.rows import unlike
from exo.scenario import Data, Identifier, Line, Positive, Scenario, Value

#: Runs of one study: their table is in memory.
MAX_RUNS = 10_000_000
#: A normal distribution has no value at a share of 0.
SMALLEST = 2.0**-53


class Axis(Data):
    """What one parameter takes: `values`; or `low` to `high`; or a normal distribution."""

    values: tuple[Value, ...] = ()
    low: float | None = None
    high: float | None = None
    count: Annotated[int, Field(ge=2)] | None = None
    scale: Literal["linear", "log"] = "linear"
    mean: float | None = None
    deviation: Positive | None = None
    #: For figures; the key without it.
    label: Line = ""

    @model_validator(mode="after")
    def _is_one_of_them(self) -> Self:
        ranged, normal = (
            self.low is not None or self.high is not None,
            self.mean is not None or self.deviation is not None,
        )
        if [bool(self.values), ranged, normal].count(True) != 1:
            raise ValueError("expected one of: values; low and high; mean and deviation")
        if wrong := unlike(self.values):
            raise ValueError(f"values: {wrong}")
        if ranged and (self.low is None or self.high is None or not self.low < self.high):
            raise ValueError(f"low {self.low}, high {self.high}: expected two numbers, the lower first")
        if ranged and self.scale == "log" and not (self.low or 0.0) > 0.0:
            raise ValueError(f"low {self.low}: expected a number above 0 on a log scale")
        if normal and (self.mean is None or self.deviation is None):
            raise ValueError("expected mean and deviation")
        for key in ("count", "scale"):
            if not ranged and key in self.model_fields_set:
                raise ValueError(f"{key} {getattr(self, key)}: belongs to low and high; expected none")
        if not math.isfinite(self._widest()):
            raise ValueError("what lies between its ends is no number of 64 bits; expected ends that are nearer")
        return self

    def _widest(self) -> float:
        """The largest number that `at` computes with."""
        if self.mean is not None and self.deviation is not None:
            return float(scipy.stats.norm.ppf(SMALLEST, scale=self.deviation)) - abs(self.mean)
        if self.low is None or self.high is None:
            return 0.0
        return self.high / self.low if self.scale == "log" else self.high - self.low

    def points(self, key: str) -> list[Value]:
        """The axis' values in a grid."""
        if self.values:
            for value in self.values:
                if self.values.count(value) > 1:
                    raise ExoError(f"axes.{key}: values: {value} stands twice; expected each point of a grid once")
            return list(self.values)
        if self.low is None or self.high is None or self.count is None:
            raise ExoError(f"axes.{key}: a grid needs values, or low, high and count")
        spaced = np.geomspace if self.scale == "log" else np.linspace
        return [float(x) for x in spaced(self.low, self.high, self.count)]

    def at(self, share: float) -> Value:
        """The value that a share of the axis, from 0 to 1, stands for."""
        if self.values:
            return self.values[min(int(share * len(self.values)), len(self.values) - 1)]
        if self.mean is not None and self.deviation is not None:
            return float(scipy.stats.norm.ppf(max(share, SMALLEST), loc=self.mean, scale=self.deviation))
        assert self.low is not None
        assert self.high is not None
        if self.scale == "log":
            found = float(self.low * (self.high / self.low) ** share)
        else:
            found = float(self.low + share * (self.high - self.low))
        # Rounding may lead beyond an end, where an FMU's range may end.
        return min(max(found, self.low), self.high)


class Sampling(Data):
    """How the axes are sampled. A Sobol sequence is balanced for powers of 2 alone."""

    method: Literal["grid", "random", "latin_hypercube", "sobol"] = "grid"
    samples: Annotated[int, Field(ge=1)] | None = None
    seed: Annotated[int, Field(ge=0)] = 1

    @model_validator(mode="after")
    def _has_what_it_needs(self) -> Self:
        if (self.method == "grid") != (self.samples is None):
            raise ValueError(f"method {self.method}: expected {'no ' if self.method == 'grid' else ''}samples")
        if self.method == "sobol" and self.samples is not None and self.samples & (self.samples - 1):
            below = 1 << (self.samples.bit_length() - 1)
            raise ValueError(f"samples {self.samples}: expected a power of 2, as {below} or {2 * below}")
        return self


class Figure(Data):
    """A picture of the results.

    `map`: `color` over `x` and `y`, as the cells of a grid or as points. `scatter`: `y` over `x`. `histogram`: of `x`.
    `front`: `y` over `x`, both to be small or `larger`, with the runs that no other one beats in both.
    """

    id: Identifier
    title: Line
    kind: Literal["map", "scatter", "histogram", "front"]
    x: str
    y: str | None = None
    color: str | None = None
    #: A line where `contour`, or else `color` (of a map) or `y`, has this value.
    limit: float | None = None
    contour: str | None = None
    contour_label: Line = ""
    #: Only of the runs whose columns have these values.
    where: dict[str, float] = Field(default={})
    #: Of a front: on which axes more is better.
    larger: tuple[Literal["x", "y"], ...] = ()
    x_label: Line = ""
    y_label: Line = ""
    color_label: Line = ""
    #: What is drawn logarithmically; without it, each that shows an axis of scale log.
    log: tuple[Literal["x", "y", "color"], ...] | None = None

    @model_validator(mode="after")
    def _has_what_it_draws(self) -> Self:
        wanted = {"map": ("y", "color"), "scatter": ("y",), "histogram": (), "front": ("y",)}[self.kind]
        for name in wanted:
            if getattr(self, name) is None:
                raise ValueError(f"a {self.kind} needs {name}")
        return self


class Study(Data):
    """A study, as its file says."""

    id: Identifier
    title: Line
    about: str = ""
    scenario: str
    cases: tuple[str, ...] = ()
    metrics: tuple[str, ...] = ()
    branch_at: Positive | None = None
    sampling: Sampling = Sampling()
    axes: Annotated[dict[str, Axis], Field(min_length=1)]
    #: What every run sets besides.
    parameters: dict[str, Value] = Field(default={})
    figures: tuple[Figure, ...] = ()

    @model_validator(mode="after")
    def _sets_each_key_once(self) -> Self:
        for key in self.parameters:
            if key in self.axes:
                raise ValueError(f"parameters.{key}: is an axis, too; expected one of them")
        return self

    @model_validator(mode="after")
    def _draws_each_picture_once(self) -> Self:
        there: dict[str, str] = {}
        for figure in self.figures:
            name = figure.id.casefold()
            if name in there:
                raise ValueError(
                    f"figures {there[name]} and {figure.id} would be one file; expected another id for one of them"
                )
            there[name] = figure.id
        return self

    def logarithmic(self, figure: Figure) -> tuple[str, ...]:
        """Which of a figure's x, y and color are drawn logarithmically."""
        if figure.log is not None:
            return figure.log
        shown = {"x": figure.x, "y": figure.y, "color": figure.color}
        return tuple(place for place, key in shown.items() if key in self.axes and self.axes[key].scale == "log")

    @property
    def size(self) -> int:
        """Number of runs."""
        if self.sampling.samples is not None:
            return self.sampling.samples
        return math.prod(len(axis.values) or axis.count or 1 for axis in self.axes.values())

    def rows(self) -> list[dict[str, Value]]:
        """What each run sets, in order: the same for the same study and seed."""
        if self.size > MAX_RUNS:
            raise ExoError(f"{self.id}: {self.size} runs; expected at most {MAX_RUNS}")
        if self.sampling.samples is None:
            grid = product(*(axis.points(key) for key, axis in self.axes.items()))
            return [{**self.parameters, **dict(zip(self.axes, point, strict=True))} for point in grid]
        shares = _shares(self.sampling.method, len(self.axes), self.sampling.samples, self.sampling.seed)
        return [
            {
                **self.parameters,
                **{key: axis.at(float(u)) for (key, axis), u in zip(self.axes.items(), point, strict=True)},
            }
            for point in shares
        ]


def _shares(method: str, dimensions: int, samples: int, seed: int) -> np.ndarray[Any, np.dtype[np.float64]]:
    match method:
        case "latin_hypercube":
            return np.asarray(scipy.stats.qmc.LatinHypercube(dimensions, rng=seed).random(samples))
        case "sobol":
            return np.asarray(scipy.stats.qmc.Sobol(dimensions, rng=seed).random(samples))
    return np.random.default_rng(seed).random((samples, dimensions))


def built_in() -> dict[str, Path]:
    """The studies that come with the harness: id → file."""
    return {path.stem: path for path in sorted((Path(__file__).parents[1] / "studies").glob("*.toml"))}


def load(name: str | Path) -> tuple[Study, Scenario]:
    """A study by id, or from a path that ends in `.toml`, with its scenario.

    ExoError names file, key, value and what was expected.
    """
    path = Path(name)
    if path.suffix != ".toml":
        known = built_in()
        if str(name) not in known:
            raise ExoError(
                f"unknown study {name}{close_matches(str(name), known)}; expected one of these, or a .toml file"
            )
        path = known[str(name)]
    data = read_tables(path, what="study")
    _check_axes(data.get("axes"), where=f"{path}: axes")
    try:
        study = Study.model_validate_json(json.dumps(data))
    except ValidationError as error:
        raise ExoError("\n".join(refused.sentences(error, str(path), data, Study))) from error
    beside = path.parent / study.scenario
    name = str(beside) if study.scenario.endswith(".toml") else study.scenario
    return study, scenarios.load(name)


def _check_axes(axes: Any, *, where: str) -> None:
    """ExoError, if the name of an axis stands without quotes: to TOML its dots are tables in tables."""
    for first, axis in axes.items() if isinstance(axes, dict) else ():
        name, inner = first, axis
        while isinstance(inner, dict) and inner and all(isinstance(one, dict) for one in inner.values()):
            name, inner = f"{name}.{next(iter(inner))}", next(iter(inner.values()))
        if name != first:
            raise ExoError(f'{where}.{name}: expected the name in quotes, as [axes."{name}"]')


def check_figures(study: Study, columns: list[str]) -> None:
    """ExoError, if a figure draws what no column of the results has."""
    for figure in study.figures:
        for name in (figure.x, figure.y, figure.color, figure.contour, *figure.where):
            if name is not None and name not in columns:
                raise ExoError(f"{study.id}: figure {figure.id}: no column {name}{close_matches(name, columns)}")
            if name in study.axes and any(isinstance(value, str) for value in study.axes[name].values):
                raise ExoError(f"{study.id}: figure {figure.id}: {name} holds texts; expected numbers to draw")
