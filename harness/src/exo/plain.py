"""Values of Python and NumPy as a TOML file has them."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from exo.errors import ScenarioError


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
