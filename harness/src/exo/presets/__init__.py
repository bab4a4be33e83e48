"""Presets: gains of a controller that belong together and were measured together, by name.

Each is a TOML file of this folder: `title`, `about` (one sentence), `archive` and `parameters`, by the names of the
archive's own variables. The scenario `arm_presets` measures them, docs/tuning.md has the table. A preset is used as

* `exo run SCENARIO --preset stiff_grip`,
* `preset = "stiff_grip"` in a case of a scenario,
* the parameter set `preset-stiff_grip` of an SSP archive.
"""

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from importlib import resources

from exo.errors import ScenarioError, close_matches


@dataclass(frozen=True)
class Preset:
    """Values for the variables of one archive; a name may be a range of an array, `K[1..3]`."""

    name: str
    title: str
    about: str
    archive: str
    parameters: Mapping[str, float]

    def qualified(self, components: Mapping[str, str]) -> dict[str, float]:
        """`component.name` → value for each component that is the preset's archive.

        `components` is component → archive. `ScenarioError` where none is the preset's.
        """
        found = {
            f"{component}.{name}": value
            for component, archive in components.items()
            if archive == self.archive
            for name, value in self.parameters.items()
        }
        if not found:
            have = ", ".join(f"{name} = {archive}" for name, archive in components.items())
            raise ScenarioError(f"preset {self.name}: got {have}; expected a component that is {self.archive}")
        return found


def names() -> tuple[str, ...]:
    """The presets, by name."""
    files = resources.files(__name__).iterdir()
    return tuple(sorted(file.name.removesuffix(".toml") for file in files if file.name.endswith(".toml")))


def load(name: str) -> Preset:
    """The preset of this name; `ScenarioError` where there is none."""
    if name not in names():
        raise ScenarioError(f"unknown preset {name}{close_matches(name, names())}; expected {', '.join(names())}")
    data = tomllib.loads((resources.files(__name__) / f"{name}.toml").read_text(encoding="utf-8"))
    return Preset(name=name, **data)
