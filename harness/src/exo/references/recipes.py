"""Which runs the archives carry as references: `recipes.toml` as data."""

import json
import tomllib
from importlib import resources
from typing import Annotated

from pydantic import BeforeValidator, Field, ValidationError

from exo.errors import ScenarioError
from exo.naming import expand_names
from exo.scenario import Data, Identifier, Line, Positive, QualifiedParameters, Segment

#: Arrays may be written at once: `q[1..3]`.
Names = Annotated[tuple[str, ...], BeforeValidator(expand_names), Field(min_length=1)]


class Part(Data):
    """What is recorded of one component."""

    outputs: Names


class Run(Data):
    """A case of a scenario, drawn together: a shorter time, and a hand that hurries."""

    title: Line
    scenario: Identifier
    case: Identifier
    #: s
    duration: Positive
    #: What the operator does, in place of the case's segments and of its profile `tau_h`.
    hand: QualifiedParameters
    #: In place of the case's other profiles.
    profiles: dict[str, tuple[Segment, ...]] = Field(default_factory=dict)
    record: Annotated[dict[str, Part], Field(min_length=1)]


class Recipes(Data):
    """All runs by name, which is the experiment's."""

    #: Of the paper's requirements, the runs that show a part of them.
    shows: dict[Identifier, tuple[Identifier, ...]]
    runs: dict[Identifier, Run]


def load() -> Recipes:
    """The file as it is now; ScenarioError says what is wrong in it."""
    text = (resources.files("exo.references") / "recipes.toml").read_text(encoding="utf-8")
    try:
        # As JSON: its arrays are tuples to a strict model, those of Python are not.
        return Recipes.model_validate_json(json.dumps(tomllib.loads(text)))
    except ValidationError as error:
        raise ScenarioError(f"recipes.toml: {error}") from error
