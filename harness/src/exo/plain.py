"""Values of Python and NumPy as a TOML file has them, and those of a file."""

import tomllib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from exo.errors import ScenarioError


def read_tables(path: Path, *, what: str) -> dict[str, Any]:
    """The tables of a TOML file that is a `what`, such as a study. ScenarioError says why there are none."""
    try:
        # Editors of Windows put a mark before the first letter.
        text = path.read_text(encoding="utf-8-sig")
        return dict(plain_values(tomllib.loads(text), where=f"{path}: {what}"))
    except OSError as error:
        raise ScenarioError(f"{path}: cannot be read: {error.strerror or error}; expected a .toml file") from error
    except UnicodeDecodeError as error:
        raise ScenarioError(f"{path}: cannot be read: byte {error.start} is no UTF-8; expected a text file") from error
    except (tomllib.TOMLDecodeError, RecursionError) as error:
        raise ScenarioError(f"{path}: {error}; expected TOML") from error


def plain_values(value: Any, *, where: str) -> Any:
    """Python's and NumPy's values as TOML has them. ScenarioError names the place of another one."""
    match value:
        case Mapping():
            for key in value:
                if not isinstance(key, str):
                    raise ScenarioError(f"{where}: key {key!r}: expected a text")
            return {key: plain_values(one, where=f"{where}.{key}") for key, one in value.items()}
        case np.ndarray() | np.generic():
            return value.tolist()
        case list() | tuple():
            return [plain_values(one, where=f"{where}[{place}]") for place, one in enumerate(value)]
        case bool() | int() | float() | str():
            return value
    raise ScenarioError(f"{where}: got {value!r:.60}; expected a number, a text, true or false, a list or a dictionary")
