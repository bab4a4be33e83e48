"""A file of requirements as data."""

import json
import tomllib
from collections.abc import Iterator
from fnmatch import fnmatchcase
from functools import cache
from importlib import resources
from pathlib import Path
from typing import Annotated, Any, Literal, Self

from pydantic import BeforeValidator, Field, ValidationError, field_validator, model_validator

from exo import refused
from exo.errors import ScenarioError
from exo.naming import elements
from exo.plain import read_tables
from exo.requirements import formula
from exo.scenario import Data, Identifier, Line, NotNegative

#: What a signal can be; exactly one of them is given.
KINDS = ("column", "norm", "moved", "largest", "work", "parameter")
SIGNAL_NAME = r"^[A-Za-z][A-Za-z0-9_]*$"


def _listed(names: object) -> object:
    """One name or several; `plant.p[1..3]` is three."""
    texts = [names] if isinstance(names, str) else names
    if not isinstance(texts, list | tuple) or not all(isinstance(text, str) for text in texts):
        return names
    return tuple(one for text in texts for one in elements(text))


Names = Annotated[tuple[str, ...], BeforeValidator(_listed), Field(min_length=1)]


class Signal(Data):
    """One signal of a formula, a number a tick. A text alone is `{ column = … }`.

    | key | the number |
    |---|---|
    | `column` | a recorded column |
    | `norm` | Euclidean norm of several columns |
    | `moved` | Euclidean norm of several columns, each less its first value |
    | `largest`, `over` | the largest absolute value of several columns, each divided by a parameter of `over` |
    | `work`, `along` | ∫ Σ force · velocity dt from the start: `work` the forces, `along` the velocities |
    | `parameter` | a parameter, the same at every tick |
    """

    column: str | None = None
    norm: Names | None = None
    moved: Names | None = None
    largest: Names | None = None
    over: Names | None = None
    work: Names | None = None
    along: Names | None = None
    parameter: str | None = None

    @model_validator(mode="before")
    @classmethod
    def _text_is_a_column(cls, data: object) -> object:
        return {"column": data} if isinstance(data, str) else data

    @model_validator(mode="after")
    def _is_one_kind(self) -> Self:
        kinds = [key for key in KINDS if getattr(self, key) is not None]
        if len(kinds) != 1:
            raise ValueError(f"one of {', '.join(KINDS)}; got {' and '.join(kinds) or 'none'}")
        for key, beside, needed in (("over", "largest", False), ("along", "work", True)):
            own, other = getattr(self, key), getattr(self, beside)
            if own is not None and other is None:
                raise ValueError(f"{key} belongs to {beside}")
            if other is not None and needed and own is None:
                raise ValueError(f"{beside} needs {key}")
            if own is not None and other is not None and len(own) != len(other):
                raise ValueError(f"{key} has {len(own)} names, {beside} {len(other)}; expected as many")
        return self


class Shown(Data):
    """Where a requirement is judged: the formula must hold in these cases of a scenario."""

    title: Line
    scenario: Identifier
    #: Case ids or patterns; all when absent.
    cases: Annotated[tuple[str, ...], Field(min_length=1)] = ("*",)
    #: rtamt's discrete-time signal temporal logic; bounds are seconds.
    formula: Line
    #: When it must hold (s): the formula looks at what comes after.
    at: NotNegative = 0.0
    #: Of the margin.
    unit: Line
    signals: dict[Annotated[str, Field(pattern=SIGNAL_NAME)], Signal]
    #: As in a metric: what the command line may not change without making the verdict information.
    rests_on: tuple[str, ...] | None = None

    @field_validator("formula")
    @classmethod
    def _is_temporal_logic(cls, text: str) -> str:
        formula.names(text)
        return text

    @model_validator(mode="after")
    def _knows_its_signals(self) -> Self:
        used = formula.names(self.formula)
        if missing := sorted(used - set(self.signals)):
            raise ValueError(f"formula {self.formula!r}: no signal {missing[0]}; expected one in signals")
        if idle := sorted(set(self.signals) - used):
            raise ValueError(f"signal {idle[0]}: the formula {self.formula!r} does not use it")
        return self

    def meant(self, cases: Iterator[str] | tuple[str, ...]) -> list[str]:
        """Of these case ids those that are judged."""
        return [case for case in cases if any(fnmatchcase(case, pattern) for pattern in self.cases)]


class Requirement(Data):
    """What is asked for, and where that is shown."""

    text: Line
    source: Line
    of: Literal["paper", "product"] = "product"
    shown: Annotated[dict[Identifier, Shown], Field(min_length=1)]


class Requirements(Data):
    """A whole file, by id."""

    requirements: Annotated[dict[Identifier, Requirement], Field(min_length=1)]

    def of_scenario(self, scenario: str) -> Iterator[tuple[str, str, Requirement, Shown]]:
        """Id, key, requirement and place for every place in a scenario."""
        for name, one in self.requirements.items():
            for key, shown in one.shown.items():
                if shown.scenario == scenario:
                    yield name, key, one, shown


@cache
def built_in() -> Requirements:
    """Those of the paper and of this project."""
    text = (resources.files("exo.requirements") / "requirements.toml").read_text(encoding="utf-8")
    return _judged(tomllib.loads(text), "requirements.toml")


def load(path: Path) -> Requirements:
    """A file's; ScenarioError says what is wrong in it and where."""
    return _judged(read_tables(path, what="requirements"), str(path))


def _judged(data: dict[str, Any], where: str) -> Requirements:
    try:
        return Requirements.model_validate_json(json.dumps(data))
    except ValidationError as error:
        raise ScenarioError("\n".join(refused.sentences(error, where, data, Requirements))) from error
