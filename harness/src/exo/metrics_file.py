"""Reads a metrics.json that a run has left: what is wrong in it is one sentence that names the file and the place."""

import json
from functools import cache
from importlib import resources
from pathlib import Path
from typing import Any

import jsonschema

from exo.errors import ExoError

SCHEMA_ID = "urn:exo:metrics:1"
#: Letters of a value, and of what was expected in its place.
QUOTED, LISTED = 80, 160
#: What commands read that take the results of any version.
NUMBERS = {
    "type": "object",
    "required": ["metrics"],
    "properties": {
        "metrics": {
            "type": "object",
            "additionalProperties": {
                "type": "object",
                "required": ["verdict", "value", "unit"],
                "properties": {
                    "verdict": {"enum": ["pass", "fail", "info"]},
                    "value": {"type": ["number", "null"]},
                    "unit": {"type": "string"},
                },
            },
        }
    },
}


def schema() -> dict[str, Any]:
    """The published schema of metrics.json."""
    text = (resources.files("exo") / "metrics.schema.json").read_text(encoding="utf-8")
    return dict(json.loads(text))


def read(path: Path) -> dict[str, Any]:
    """A metrics.json of this version, as the schema has it. ExoError, if it is none."""
    document = _json(path)
    there = document.get("schema") if isinstance(document, dict) else None
    if isinstance(document, dict) and there != SCHEMA_ID:
        raise ExoError(f"{path}: expected schema {SCHEMA_ID}, got {there}")
    _check(_validator(), document, path)
    return dict(document)


def numbers(path: Path) -> dict[str, Any]:
    """The metrics of a metrics.json of any version: each has verdict, value (null is undefined) and unit.

    ExoError, if they have not.
    """
    document = _json(path)
    check_numbers(document, path)
    return dict(document["metrics"])


def check_numbers(document: Any, path: Path) -> None:
    """ExoError, if `document`, which was read from `path`, has no metrics with verdict, value and unit."""
    _check(jsonschema.Draft202012Validator(NUMBERS), document, path)


@cache
def _validator() -> Any:
    found = schema()
    # One by one the parameters of all cases would be three quarters of the time, and nothing computes with them.
    found["$defs"]["values"] = {"type": "object"}
    return jsonschema.Draft202012Validator(found)


def _json(path: Path) -> Any:
    try:
        return json.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise ExoError(f"{path}: cannot be read: {error.strerror or error}") from error
    except (ValueError, RecursionError) as error:
        raise ExoError(f"{path}: not a file of exo's results: {error}") from error


def _check(validator: Any, document: Any, path: Path) -> None:
    error = jsonschema.exceptions.best_match(validator.iter_errors(document))
    if error is None:
        return
    # Of null or a table: what the table lacks says more than that it is not null.
    error = next((one for one in error.context if one.validator != "type"), error)
    place = ".".join(str(step) for step in error.absolute_path) or "the whole"
    if error.validator in ("required", "additionalProperties"):
        said = f"{error.message:.{LISTED}}"
    else:
        got, wanted = (json.dumps(one, ensure_ascii=False) for one in (error.instance, error.validator_value))
        said = f"got {got:.{QUOTED}}; expected {error.validator} {wanted:.{LISTED}}"
    raise ExoError(f"{path}: not a file of exo's results: {place}: {said}; run the scenario again") from error
