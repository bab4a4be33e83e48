"""Which component of a run is the plant, which one the law: told by their variables, whatever their names."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Literal

Kind = Literal["arm", "arms", "testbed"]

#: Of each plant the parameters that no other component has, in the order in which they are looked for.
KNOWN_BY: dict[Kind, tuple[str, ...]] = {
    "arms": ("A1", "L1", "pad.x", "base.y"),
    "arm": ("A1", "L1", "pad.x", "table.z"),
    "testbed": ("M", "F_c", "wall.q", "wall.k"),
}
#: What a controller gives a plant: under torque and as a servo's command.
DRIVEN = ("tau_a", "q_d")


@dataclass(frozen=True)
class Plant:
    """A component that is drawn."""

    name: str
    kind: Kind

    @property
    def sides(self) -> tuple[str, ...]:
        """Prefixes of the variables of each arm."""
        return ("left.", "right.") if self.kind == "arms" else ("",)


def plant(parameters: Iterable[str]) -> Plant | None:
    """The first component that is a plant, from the names of all parameters, `component.name`."""
    known = frozenset(parameters)
    for component in dict.fromkeys(name.split(".", 1)[0] for name in parameters):
        for kind, names in KNOWN_BY.items():
            if all(f"{component}.{name}" in known for name in names):
                return Plant(component, kind)
    return None


def source(inputs: Mapping[str, str], plant: Plant, side: str, *names: str) -> str | None:
    """The component that feeds one of these inputs of the plant, a vector's by its first element."""
    for name in names:
        for element in (name, f"{name}[1]"):
            if wire := inputs.get(f"{plant.name}.{side}{element}"):
                return wire.removeprefix("-").split(".", 1)[0]
    return None
