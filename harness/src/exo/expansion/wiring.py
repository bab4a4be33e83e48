"""`wiring = "by_name"`: the inputs of the known pairs of FMUs, from `wiring.toml`. What `inputs` says replaces them."""

import tomllib
from functools import cache
from importlib import resources
from typing import Any

from exo.errors import ScenarioError, close_matches

PROFILE = "profile"


@cache
def pairs() -> dict[str, dict[str, list[str]]]:
    """Archive that takes → archive that gives, or `profile` → names."""
    return tomllib.loads((resources.files("exo") / "wiring.toml").read_text(encoding="utf-8"))


def wired(data: dict[str, Any], *, origin: str) -> dict[str, Any]:
    """`data` with its inputs in full. A profile that then feeds nothing is an error: its name is misspelt."""
    plain = dict(data)
    kind = plain.pop("wiring", "explicit")
    if kind == "explicit":
        return plain
    if kind != "by_name":
        raise ScenarioError(f"{origin}: wiring: got {kind!r}; expected 'explicit' or 'by_name'")
    components, profiles, own = (plain.get(key, {}) for key in ("components", "profiles", "inputs"))
    if not all(isinstance(table, dict) for table in (components, profiles, own)):
        return plain  # what is no table is named where the whole is checked
    archives = {name: str(part.get("archive")) for name, part in components.items() if isinstance(part, dict)}
    inputs = dict(own)
    taken = {_array(key) for key in inputs}  # an array is wired as a whole
    for name, archive in archives.items():
        for giver, variables in pairs().get(archive, {}).items():
            for variable in variables:
                key = f"{name}.{variable}"
                if _array(key) in taken:
                    continue
                if giver == PROFILE:
                    if variable in profiles:
                        inputs[key] = f"{PROFILE}.{variable}"
                    continue
                sources = [other for other, one in archives.items() if one == giver]
                if len(sources) > 1:
                    raise ScenarioError(
                        f"{origin}: wiring: {key}: {giver} is {' and '.join(sources)}; expected one, or {key} in inputs"
                    )
                for source in sources:
                    inputs[key] = f"{source}.{variable}"
    _check_profiles(profiles, [inputs, *(case.get("inputs", {}) for case in plain.get("cases", []))], origin)
    return plain | {"inputs": inputs}


def _array(key: str) -> str:
    return key.split("[", maxsplit=1)[0]


def _check_profiles(profiles: dict[str, Any], wires: list[Any], origin: str) -> None:
    fed = {str(source).removeprefix("-") for inputs in wires if isinstance(inputs, dict) for source in inputs.values()}
    names = {name for givers in pairs().values() for name in givers.get(PROFILE, [])}
    for name in profiles:
        if f"{PROFILE}.{name}" not in fed:
            raise ScenarioError(
                f"{origin}: profiles.{name}: feeds no input; expected one that is wired by name"
                f"{close_matches(name, names)} or a line in inputs"
            )
