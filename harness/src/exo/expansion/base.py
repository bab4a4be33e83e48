"""`base`: a scenario starts from another file, and whatever stands in it replaces what the base says."""

import tomllib
from collections.abc import Mapping
from importlib import resources
from importlib.resources.abc import Traversable
from pathlib import Path
from typing import Any

from exo.errors import ScenarioError, close_matches

#: What is joined entry by entry, and how deep; everything else is replaced as a whole.
JOINED = {"axes": 1, "inputs": 1, "profiles": 1, "known": 2, "components": 3}
#: The largest scenario of the harness has a hundredth of it.
MAX_BYTES = 1_000_000


def text_of(file: Traversable, *, origin: str) -> str:
    """A file's text; `origin` is its name for messages."""
    try:
        data = file.read_bytes()
    except OSError as error:
        raise ScenarioError(f"{origin}: cannot be read: {error.strerror or error}") from error
    if len(data) > MAX_BYTES:
        raise ScenarioError(f"{origin}: {len(data)} bytes; expected a scenario of at most {MAX_BYTES}")
    try:
        return data.decode("utf-8-sig")  # some editors of Windows put a mark in front
    except UnicodeDecodeError as error:
        line = data.count(b"\n", 0, error.start) + 1
        byte = data[error.start]
        raise ScenarioError(
            f"{origin}: line {line}: byte 0x{byte:02x} is no UTF-8; expected a TOML file in UTF-8"
        ) from None


def read(text: str, *, origin: str) -> dict[str, Any]:
    """The tables of a TOML text, as `placed`."""
    try:
        data = tomllib.loads(text)
    except ValueError as error:  # beside TOMLDecodeError: an integer of thousands of digits
        raise ScenarioError(f"{origin}: not TOML: {error}") from error
    except RecursionError:
        raise ScenarioError(
            f"{origin}: nested too deeply; expected tables and arrays as in docs/scenarios.md"
        ) from None
    return placed(data, origin=origin)


def placed(tables: Mapping[str, Any], *, origin: str) -> dict[str, Any]:
    """The tables of a file with `parameters` put where they belong: into the components."""
    data = dict(tables)
    parameters = data.pop("parameters", {})
    if not isinstance(parameters, dict):
        raise ScenarioError(f'{origin}: parameters: got {parameters!r}; expected a table of "component.name" = value')
    components = data.get("components", {})
    if not isinstance(components, dict):
        raise ScenarioError(f"{origin}: components: got {components!r:.80}; expected a table of components by name")
    own: dict[str, Any] = {}
    for key, value in parameters.items():
        component, dot, name = key.partition(".")
        if not dot or not name:
            raise ScenarioError(f"{origin}: parameters.{key}: got {value!r}; expected a name as component.variable")
        own.setdefault(component, {"parameters": {}})["parameters"][name] = value
    return join(data, {"components": own}, JOINED) if own else data


def join(base: dict[str, Any], own: dict[str, Any], depths: dict[str, int]) -> dict[str, Any]:
    """`own` over `base`: tables named in `depths` entry by entry. What `own` says comes last, so that it also wins
    where ranges such as `K[1..3]` overlap; a component keeps its place, which is its turn to step."""
    found = dict(base)
    for key, value in own.items():
        depth = depths.get(key, 0)
        found[key] = _deep(found[key], value, depth) if depth and key in found else value
    return found


def _deep(base: Any, own: Any, depth: int) -> Any:
    if not depth or not isinstance(base, dict) or not isinstance(own, dict):
        return own
    if depth == 1:
        return {key: value for key, value in base.items() if key not in own} | own
    return base | {key: _deep(base.get(key), value, depth - 1) for key, value in own.items()}


def joined(data: dict[str, Any], *, origin: str, folder: Traversable, above: tuple[str, ...] = ()) -> dict[str, Any]:
    """`data` over its base, and that over its own; `folder` is where the file lies, which a base's path starts from."""
    if "base" not in data:
        return data
    own = dict(data)
    name = own.pop("base")
    if not isinstance(name, str):
        raise ScenarioError(f"{origin}: base: got {name!r}; expected the name of a base or a path that ends in .toml")
    file = folder / name if name.endswith(".toml") else named().get(name)
    if file is None:
        raise ScenarioError(
            f"{origin}: base: unknown base {name}{close_matches(name, named())}; expected one or a path"
        )
    if not file.is_file():
        raise ScenarioError(f"{origin}: base: no such file {name}; expected a path from the file's own folder")
    if str(file) in above:
        raise ScenarioError(f"{origin}: base: {name} starts from itself; expected bases that end")
    base = read(text_of(file, origin=file.name), origin=file.name)
    start = folder / Path(name).parent if name.endswith(".toml") else home()
    base = joined(base, origin=file.name, folder=start, above=(*above, str(file)))
    base.pop("id", None)
    return join(base, own, JOINED)


def home() -> Traversable:
    """Where the scenarios of the harness lie."""
    return resources.files("exo") / "scenarios"


def named() -> dict[str, Traversable]:
    """What `base` can name: the files of `scenarios/bases`, then the scenarios themselves."""
    folders = (home(), home() / "bases")
    files = (file for folder in folders for file in folder.iterdir() if file.name.endswith(".toml"))
    return {file.name.removesuffix(".toml"): file for file in sorted(files, key=lambda file: file.name)}
