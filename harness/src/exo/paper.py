"""The paper's published numbers, from the one file that holds them."""

import tomllib
from dataclasses import dataclass
from functools import cache
from importlib import resources

from exo.errors import ScenarioError, close_matches


@dataclass(frozen=True, kw_only=True)
class Published:
    """A number as printed; `rounding` is half a unit of its last digit."""

    label: str
    quantity: str
    value: float
    unit: str
    rounding: float


@cache
def published() -> dict[str, Published]:
    """All numbers by `<label>/<name>`."""
    data = tomllib.loads((resources.files("exo") / "paper.toml").read_text(encoding="utf-8"))
    return {
        f"{label}/{name}": Published(label=label, **entry)
        for label, names in data.items()
        for name, entry in names.items()
    }


def lookup(key: str) -> Published:
    """One number, or an error that names close matches."""
    try:
        return published()[key]
    except KeyError:
        raise ScenarioError(f"paper.toml has no {key}{close_matches(key, published())}") from None
