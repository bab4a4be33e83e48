"""The paper's published numbers, from the one file that holds them."""

import tomllib
from dataclasses import dataclass
from functools import cache
from importlib import resources

from exo.errors import ScenarioError, close_matches


@dataclass(frozen=True, kw_only=True)
class Published:
    """A number as printed; `rounding` is half a unit of its last digit.

    `because`: why a number measured here may be off by more. `within` or `relative`: by how much, where the comparison
    is fair.
    """

    label: str
    quantity: str
    value: float
    unit: str
    rounding: float
    because: str
    within: float | None = None
    relative: float | None = None

    @property
    def is_fair(self) -> bool:
        """Whether a number measured here is judged by this one."""
        return self.within is not None or self.relative is not None

    def explains(self, value: float) -> str:
        """Why `value` is off by more than the rounding; empty if it is not."""
        return "" if abs(value - self.value) <= self.rounding else self.because


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
