"""Scenario files with values, keys and tables that nobody meant: refused with a sentence, or good."""

import copy
import json
import random
import tomllib
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from exo import preflight, scenario
from exo.errors import ExoError
from exo.expansion import home
from exo.fmu import Archive
from exo.master import plan

from commands import SHORT

FILES = ("wall", "arm_contact", "gain_guide", "budget", "arm_supervision")
#: What stands where something else is meant.
ODD: tuple[Any, ...] = (
    0, -1, True, 1e308, 10**400, float("nan"), float("inf"), "", "x", "{law}", "{x.y}", "..", "[1..3]", "a.b",
    "a[1..2]", "a.b[3..1]", "profile.x", "\u0000", [], [[]], [{}], ["a", 1], [{"id": "a"}, {"id": "a"}], {}, {"": 1},
    {".": 1}, {"id": 3}, {"a": {"b": 1}}, {"a": "{law}"}, {"over": 1}, {"a.b": [1]}, {"law": []}, {"like": [1]},
    {"parameters": 3}, {"x": {"over": {"law": 3}}},
)  # fmt: skip
KEYS = ("x", "a.b", "{law}", "over", "id", "like", "", "cases")
#: Of each file. Seeds are counted on, so that a failure can be repeated.
CHANGES = 60


def toml(value: Any) -> str:
    """A value as TOML, tables inline."""
    match value:
        case bool():
            return str(value).lower()
        case str():
            return json.dumps(value)
        case list():
            return f"[{', '.join(map(toml, value))}]"
        case dict():
            return f"{{{', '.join(f'{json.dumps(key)} = {toml(one)}' for key, one in value.items())}}}"
    return repr(value)


def places(value: Any, path: tuple[Any, ...] = ()) -> Iterator[tuple[Any, ...]]:
    """The way to every value in a table."""
    if path:
        yield path
    for key, one in value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ():
        yield from places(one, (*path, key))


def changed(data: dict[str, Any], rng: random.Random) -> str:
    """The file with one or two changes: another value, a key that is missing, a key that is called otherwise."""
    data = copy.deepcopy(data)
    for _ in range(rng.choice((1, 1, 2))):
        path = rng.choice(list(places(data)))
        inside: Any = data
        for key in path[:-1]:
            inside = inside[key]
        match rng.choice("vvvvvdr"):
            case "d":
                del inside[path[-1]]
            case "r" if isinstance(inside, dict):
                inside[rng.choice(KEYS)] = inside.pop(path[-1])
            case _:
                inside[path[-1]] = copy.deepcopy(rng.choice(ODD))
    return "".join(f"{json.dumps(key)} = {toml(value)}\n" for key, value in data.items())


@pytest.mark.parametrize("file", ["short", *FILES])
def test_an_odd_file_is_refused_with_a_sentence_or_is_good(file: str, fmu_dir: Path) -> None:
    archives = {path.name: Archive(path) for path in fmu_dir.glob("*.fmu")}
    text = SHORT if file == "short" else (home() / f"{file}.toml").read_text(encoding="utf-8")
    refused = []
    for seed in range(CHANGES):
        odd = changed(tomllib.loads(text), random.Random(f"{file} {seed}"))
        try:
            data = scenario.parse(text=odd, origin=f"{file}.toml", folder=home())
            if {part.archive for part in data.components.values()} <= set(archives):
                plans = {case.id: plan(scenario=data, case=case) for case in data.cases}
                preflight.functions(data)
                preflight.check(scenario=data, plans=plans, archives=archives)
        except ExoError as error:
            refused.append(str(error))
        except Exception as error:
            raise AssertionError(f"seed {seed}: {type(error).__name__}: {error}") from error
    assert all(10 < len(sentence) < 20_000 for sentence in refused)
    assert CHANGES / 2 < len(refused) < CHANGES
