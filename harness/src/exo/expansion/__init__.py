"""From what a scenario file says to what a scenario is: bases, axes, known metrics, shared panels, wiring by name.

Everything here works on the tables of the TOML file, before `exo.scenario` checks them. Its manual: docs/scenarios.md.

| file | what it expands |
|---|---|
| `base.py` | `base`: the file starts from another one |
| `axes.py` | `axes` and `{axis}` in ids: one entry for each value |
| `entries.py` | cases, metrics and ratios, by id, over axes, from `known` |
| `figures.py` | panels and curves over axes, with what they share written once |
| `wiring.py` | `wiring = "by_name"`: the known pairs |
"""

from typing import Any

from exo import presets
from exo.errors import ScenarioError, close_matches
from exo.expansion import entries, figures, wiring
from exo.expansion.axes import Axes
from exo.expansion.base import home, joined, placed, read, text_of

__all__ = ["expanded", "home", "joined", "placed", "read", "text_of"]


def expanded(data: dict[str, Any], *, origin: str) -> dict[str, Any]:
    """A scenario's tables in full, from those of a file and its bases; `origin` is the file's name for messages."""
    plain = dict(data)
    axes = Axes(plain.pop("axes", {}), where=f"{origin}: axes")
    known = _known(plain.pop("known", {}), where=f"{origin}: known")
    plain.setdefault("id", origin.removesuffix(".toml"))
    _check_components(plain.get("components", {}), where=f"{origin}: parameters")
    if "profiles" in plain:
        plain["profiles"] = entries.profiles(plain["profiles"], known["profiles"], where=f"{origin}: profiles")
    for key, expand in (("cases", entries.cases), ("metrics", entries.metrics), ("ratios", entries.ratios)):
        if key in plain:
            plain[key] = expand(plain[key], axes=axes, known=known, where=f"{origin}: {key}")
    if "cases" in plain:
        archives = _archives(plain.get("components", {}))
        plain["cases"] = [_with_preset(case, archives, where=f"{origin}: cases") for case in plain["cases"]]
    if "figures" in plain:
        plain["figures"] = figures.expand(plain["figures"], axes=axes, where=f"{origin}: figures")
    axes.check_all_is_used()
    return wiring.wired(plain, origin=origin)


def _known(known: Any, *, where: str) -> dict[str, Any]:
    kinds: dict[str, Any] = {"metrics": {}, "profiles": {}}
    if not isinstance(known, dict):
        raise ScenarioError(f"{where}: got {known!r}; expected the tables metrics and profiles")
    for kind, table in known.items():
        if kind not in kinds:
            raise ScenarioError(f"{where}.{kind}: unknown key{close_matches(kind, kinds)}")
        if not isinstance(table, dict):
            raise ScenarioError(f"{where}.{kind}: got {table!r}; expected a table by name")
        for name, one in table.items():
            if kind == "metrics" and not isinstance(one, dict):
                raise ScenarioError(f"{where}.{kind}.{name}: got {one!r}; expected the keys of a metric")
    return kinds | known


def _archives(components: Any) -> dict[str, str]:
    """Component → archive; what is wrong with them is told later."""
    parts = components.items() if isinstance(components, dict) else ()
    return {name: str(part["archive"]) for name, part in parts if isinstance(part, dict) and "archive" in part}


def _with_preset(case: dict[str, Any], archives: dict[str, str], *, where: str) -> dict[str, Any]:
    """The preset's values where the case names one; what the case says itself comes last."""
    if "preset" not in case:
        return case
    place = f"{where}.{case.get('id', '?')}.preset"
    name = case["preset"]
    if not isinstance(name, str):
        raise ScenarioError(f"{place}: got {name!r}; expected one of {', '.join(presets.names())}")
    try:
        values = presets.load(name).qualified(archives)
    except ScenarioError as error:
        raise ScenarioError(f"{place}: {error}") from error
    plain = {key: value for key, value in case.items() if key != "preset"}
    own = plain.get("parameters", {})
    return plain | {"parameters": values | own if isinstance(own, dict) else own}


def _check_components(components: Any, *, where: str) -> None:
    """`parameters` may name a component that no file has."""
    if not isinstance(components, dict):
        return
    there = [name for name, part in components.items() if not isinstance(part, dict) or "archive" in part]
    for name, part in components.items():
        if name not in there and set(part) == {"parameters"} and isinstance(part["parameters"], dict):
            keys = ", ".join(f"{name}.{key}" for key in part["parameters"])
            raise ScenarioError(f"{where}: {keys}: unknown component {name}{close_matches(name, there)}")
