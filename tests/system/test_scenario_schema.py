"""The published schema of scenario files: what an editor is told and what the loader takes are one."""

import copy
import json
import re
import tomllib
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import jsonschema
import pytest

from exo import scenario
from exo.errors import ScenarioError
from exo.expansion import home
from exo.expansion.schema import schema

from commands import exo

ROOT = Path(__file__).resolve().parents[2]
PUBLISHED = ROOT / "docs" / "scenario.schema.json"
FILES = sorted(path for folder in (home(), home() / "bases") for path in folder.iterdir() if path.suffix == ".toml")
#: A whole file, short enough to be looked through.
WHOLE = """
base = "testbed_wall"
title = "Mine"
about = "For this test."
source = "here"
duration = 2.0
[axes]
law = ["standard", "passive"]
[axes.nominal]
light = { M_n = 0.1 }
[components.plant.parameters]
M = 5.0
[parameters]
"controller.K" = 20.0
[[profiles.tau_h]]
kind = "constant"
amplitude = 3.0
[cases."{law}_{nominal}"]
label = "{law}"
"controller.law" = "{law}"
"controller.M_n" = "{nominal.M_n}"
[metrics.peak]
title = "largest error"
unit = "m"
function = "max_abs"
arguments = { column = "controller.e_nr" }
cases = ["{law}_{nominal}"]
check = { at_most = 3.0, because = "so it is" }
source = "here"
[figures.position]
title = "Position"
curves = [{ case = "{law}_{nominal}", label = "{law}" }]
panels = [{ y_label = "q [m]", column = "plant.q", marks = [0.3] }]
"""


@pytest.fixture(scope="module")
def validator() -> jsonschema.Draft202012Validator:
    """Of scenario files."""
    published = json.loads(exo("schema").stdout)
    assert published == schema()
    jsonschema.Draft202012Validator.check_schema(published)
    return jsonschema.Draft202012Validator(published)


def test_the_file_in_docs_is_what_exo_schema_prints() -> None:
    assert PUBLISHED.read_text(encoding="utf-8") == exo("schema").stdout, "`exo schema > docs/scenario.schema.json`"


def test_editors_find_the_schema_for_the_scenarios_here() -> None:
    config = tomllib.loads((ROOT / ".taplo.toml").read_text(encoding="utf-8"))
    (rule,) = config["rule"]
    assert ROOT / rule["schema"]["path"] == PUBLISHED
    found = {path for pattern in rule["include"] for path in ROOT.glob(pattern)}
    assert {path.resolve() for path in FILES} <= {path.resolve() for path in found}


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_every_scenario_file_follows_the_published_schema(
    path: Path, validator: jsonschema.Draft202012Validator
) -> None:
    validator.validate(tomllib.loads(path.read_text(encoding="utf-8")))


@pytest.mark.parametrize(
    ("text", "where"),
    [
        ("speed = 3", "$"),
        ('duration = "long"', "$.duration"),
        ("duration = 0.0", "$.duration"),
        ('wiring = "by_hand"', "$.wiring"),
        ('coupling = "late"', "$.coupling"),
        ("[metrics.a]\ntitel = 3", "$.metrics.a"),
        ("[metrics.a]\ncheck = { atmost = 3 }", "$.metrics.a.check"),
        ('[[metrics]]\nid = "a"\nunits = "m"', "$.metrics[0]"),
        ("[cases.a]\nlable = 3", "$.cases.a"),
        ('[[profiles.tau_h]]\nkind = "sinus"', "$.profiles.tau_h[0].kind"),
        ("[parameters]\nK = 3", "$.parameters"),
        ("cases = []\n[components.a]\narchiv = 3", "$.components.a"),
    ],
)
def test_a_wrong_file_does_not_follow_the_schema_where_it_is_wrong(
    text: str, where: str, validator: jsonschema.Draft202012Validator
) -> None:
    tables = tomllib.loads(text)
    assert where in [error.json_path for error in validator.iter_errors(tables)]
    with pytest.raises(ScenarioError):
        scenario.from_tables(tomllib.loads(WHOLE) | tables)


def places(value: Any, way: tuple[Any, ...] = ()) -> Iterator[tuple[Any, ...]]:
    """The way to every value."""
    yield way
    entries = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for key, one in entries:
        yield from places(one, (*way, key))


def changed(tables: Any, way: tuple[Any, ...], how: str) -> Any:
    """The tables with one slip at this place."""
    copied = copy.deepcopy(tables)
    holder: Any = copied
    for key in way[:-1]:
        holder = holder[key]
    if how == "unknown key":
        (holder[way[-1]] if way else copied)["zz"] = 1
    else:
        holder[way[-1]] = {"a table": [{}, {}], "a list": [[1.0]], "a text": "zz", "a number": -7.25}[how]
    return copied


def test_the_whole_file_is_good_for_both(validator: jsonschema.Draft202012Validator) -> None:
    tables = tomllib.loads(WHOLE)
    validator.validate(tables)
    assert [case.id for case in scenario.from_tables(tables).cases] == ["standard_light", "passive_light"]


#: What the loader alone can know: what names mean, and what a base, an axis or what is around an entry completes.
BEYOND_THE_SCHEMA = (
    "unknown base|nothing uses it|no known (profile|metric)|unknown case|missing; expected a value|axes|_light"
)


def test_what_editors_are_told_is_wrong_the_loader_refuses_and_the_other_way_round(
    validator: jsonschema.Draft202012Validator,
) -> None:
    """One slip at each place of a file: another type, or a key that nothing knows."""
    tables = tomllib.loads(WHOLE)
    told_only, refused_only, both = [], [], 0
    for way in places(tables):
        target: Any = tables
        for key in way:
            target = target[key]
        slips = ["a table", "a list", "a text", "a number"] if way else []
        for how in [*slips, *(["unknown key"] if isinstance(target, dict) else [])]:
            slip = changed(tables, way, how)
            told = not validator.is_valid(slip)
            try:
                scenario.from_tables(slip)
                refused = ""
            except ScenarioError as error:
                refused = str(error)
            both += told and bool(refused)
            if told and not refused:
                told_only.append((way, how))
            if refused and not told and not re.search(BEYOND_THE_SCHEMA, refused):
                refused_only.append((way, how, refused))
    assert both > 150
    assert not told_only, "the loader takes what editors are told is wrong"
    assert not refused_only, "editors are told that it is good"
