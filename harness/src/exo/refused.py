"""Why the tables of a file were refused, a sentence each: pydantic's findings with key and value."""

from collections.abc import Iterator
from typing import Any

from pydantic import BaseModel, ValidationError

from exo.errors import close_matches
from exo.known_keys import keys_at

#: Problems of one file that are told, and letters of a value in them.
TOLD, QUOTED = 20, 200
#: What pydantic calls the types that `exo.scenario.Value` may have; each of them has its own finding.
ANY_VALUE = {"bool", "int", "float", "str"}


def sentences(error: ValidationError, origin: str, data: Any, kind: type[BaseModel]) -> list[str]:
    """`data` are the tables that were read as a `kind`, `origin` is the file's name."""
    found: dict[str, str] = {}
    for problem in error.errors(include_url=False):
        key = ".".join(_steps(problem, data))
        where = f"{origin}: {key}" if key else origin
        told = f"{where}: {_told(problem, kind)}"
        # A value of several possible types comes once for each of them.
        found.setdefault(where if problem["loc"][-1:] and problem["loc"][-1] in ANY_VALUE else told, told)
    lines = list(found.values())
    more = [f"{origin}: and {len(lines) - TOLD} more problems"] if len(lines) > TOLD else []
    return lines[:TOLD] + more


def _told(problem: Any, kind: type[BaseModel]) -> str:
    match problem["type"]:
        case "extra_forbidden":
            known = close_matches(str(problem["loc"][-1]), keys_at(kind, problem["loc"]))
            return f"unknown key, with value {_quoted(problem)}{known}"
        case "missing":
            return "missing; expected a value"
        case "value_error":
            return str(problem["ctx"]["error"])
        case "too_short":
            return f"got none; expected at least {problem['ctx']['min_length']}"
    if problem["loc"][-1:] and problem["loc"][-1] in ANY_VALUE:
        return f"got {_quoted(problem)}; expected a number that is finite, a text, or true or false"
    return f"got {_quoted(problem)}; expected: {problem['msg']}"


def _quoted(problem: Any) -> str:
    text = repr(problem["input"])
    return text if len(text) <= QUOTED else f"{text[:QUOTED]}…"


def _steps(problem: Any, data: Any) -> Iterator[str]:
    """The way to a value, with ids in place of numbers, and without what only pydantic knows of."""
    for step in problem["loc"]:
        there = isinstance(data, dict | list)
        try:
            data = data[step]
        except (KeyError, IndexError, TypeError):
            if step in ANY_VALUE and problem["type"] != "missing":
                return
            data = None
        named = there and isinstance(step, int) and isinstance(data, dict) and "id" in data
        yield str(data["id"] if named else step)
