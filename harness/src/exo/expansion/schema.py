"""The JSON Schema of scenario files as they are written: before bases, axes and known metrics are expanded.

It is made from the models of `exo.scenario`, so that a key stands in one place. A file may leave out what a base or a
known metric says, may write `{axis}` for a value, and may have the short ways of docs/scenarios.md. What a file must
have in full is checked when it is read.
"""

import copy
from typing import Any

from exo.expansion.axes import PLACEHOLDER
from exo.expansion.figures import OF_A_CURVE, SHARED
from exo.scenario import Scenario

SCHEMA_ID = "urn:exo:scenario:1"
Schema = dict[str, Any]

SCALAR: Schema = {"type": ["string", "number", "boolean"]}
#: `[axes]`: a list of values, or a table of fields for each value.
AXIS: Schema = {
    "type": ["array", "object"],
    "minItems": 1,
    "items": SCALAR,
    "minProperties": 1,
    "additionalProperties": {"type": "object"},
}
#: Arrays at once, and fields of the elements of an array.
VALUE: Schema = {
    "type": [*SCALAR["type"], "array"],
    "items": {"type": [*SCALAR["type"], "object"]},
}
OVER: Schema = {
    "description": "Of each axis only these values.",
    "type": "object",
    "additionalProperties": {"type": "array"},
}
#: Models that a base, a known entry or what is around them may complete.
PARTIAL = ("Scenario", "Component", "Case", "Metric", "Ratio", "Figure", "Panel", "Curve", "Bands")
BY_ID = {"cases": "Case", "metrics": "Metric", "ratios": "Ratio", "figures": "Figure"}


def schema() -> Schema:
    """The schema, draft 2020-12."""
    whole = Scenario.model_json_schema()
    models: dict[str, Schema] = {name: _model(one) for name, one in whole.pop("$defs").items()}
    models["Scenario"] = _model(whole)
    for name in PARTIAL:
        models[name].pop("required", None)
    properties = {name: model["properties"] for name, model in models.items()}
    for name in ("Case", "Metric", "Ratio", "Figure", "Panel", "Curve"):
        properties[name]["over"] = OVER
    properties["Metric"]["like"] = {"description": "The known metric to start from.", "type": "string"}
    for name in ("expected", "paper"):
        properties["Metric"][name] = {"type": "object", "additionalProperties": _columns(properties["Metric"][name])}
    curve = {key: properties["Curve"][key] for key in OF_A_CURVE}
    panel = properties["Panel"] | curve
    properties["Figure"].update({key: panel[key] for key in SHARED})
    properties["Panel"].update(curve)
    properties["Case"]["preset"] = {"description": "Gains that belong together, by name.", "type": "string"}
    models["Case"]["patternProperties"] = {r"\.": VALUE}
    properties["Case"]["parameters"] = properties["Component"]["parameters"] = _table(VALUE)
    profiles = _table({"type": ["array", "string"], "items": {"$ref": "#/$defs/Segment"}})
    for name in ("Case", "Scenario"):
        properties[name]["inputs"] = _table({"type": "string"})
        properties[name]["profiles"] = profiles
    top = models.pop("Scenario")
    top["properties"] |= {key: _by_id(model) for key, model in BY_ID.items()}
    top["properties"] |= {
        "base": {"description": "A base, a scenario, or a path that ends in .toml.", "type": "string"},
        "wiring": {"enum": ["by_name", "explicit"]},
        "axes": _table(AXIS),
        "parameters": {"type": "object", "propertyNames": {"pattern": r"^\w+\..+$"}, "additionalProperties": VALUE},
        "known": {
            "type": "object",
            "additionalProperties": False,
            "properties": {"metrics": _table({"$ref": "#/$defs/Metric"}), "profiles": profiles},
        },
    }
    top["title"] = "Scenario file of exo"
    return {"$schema": "https://json-schema.org/draft/2020-12/schema", "$id": SCHEMA_ID, **top, "$defs": models}


def _model(model: Schema) -> Schema:
    """A model whose values may be placeholders."""
    found = copy.deepcopy(model)
    found["properties"] = {key: _or_placeholder(one) for key, one in found.get("properties", {}).items()}
    return found


def _or_placeholder(value: Schema) -> Schema:
    if "$ref" in value or (value.get("type") in ("string", "object") and not {"enum", "const"} & set(value)):
        return value
    return {"anyOf": [value, {"type": "string", "pattern": f"^{PLACEHOLDER.pattern}$"}]}


def _columns(rows: Schema) -> Schema:
    """A row of `expected` or `paper`: as in the model, or with a list that has one value for each value of an axis."""
    if rows["additionalProperties"].get("$ref", "").endswith("/Check"):
        check = Scenario.model_json_schema()["$defs"]["Check"]
        properties = {
            key: {"anyOf": [_or_placeholder(one), {"type": "array"}]} for key, one in check["properties"].items()
        }
        return {"type": "object", "additionalProperties": False, "properties": properties}
    return {"type": "string"}


def _table(values: Schema) -> Schema:
    return {"type": "object", "additionalProperties": values}


def _by_id(model: str) -> Schema:
    """A table of entries by id, or an array of them. Not as `anyOf`: a slip in one entry is told at its place so."""
    one = {"$ref": f"#/$defs/{model}"}
    return {"type": ["object", "array"], "additionalProperties": one, "items": one}
