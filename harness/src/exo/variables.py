"""What fmpy does not say of an FMU's variables at once: the kind that C knows, items of choices, the unit; and many of
one kind, ready for a call."""

import re
from ctypes import c_size_t, c_void_p
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from exo.fmu import Archive

Kind = Literal["Real", "Integer", "Boolean"]
#: How the values of each kind lie in memory.
DTYPES: dict[Kind, type[np.generic]] = {"Real": np.float64, "Integer": np.int32, "Boolean": np.int32}


def choices(variable: Any) -> dict[str, int]:
    """Items by name: of an enumeration's type, or of an Integer whose description ends with them (": 1 one, 2 two")."""
    if variable.type == "Enumeration":
        return {str(item.name): int(item.value) for item in variable.declaredType.items}
    listed = re.search(r": (\d+ \w+(?:, \d+ \w+)+)$", variable.description or "")
    return {name: int(number) for number, name in (item.split() for item in listed[1].split(", "))} if listed else {}


def unit_of(variable: Any) -> str:
    """The unit of a variable or of its type; empty where neither has one."""
    return str(variable.unit or getattr(variable.declaredType, "unit", None) or "")


class References:
    """Value references of variables of one kind, ready for C, and where their values lie."""

    def __init__(self, archive: "Archive", names: list[str], kind: Kind) -> None:
        self.names = names
        self.kind: Kind = kind
        self.array: NDArray[np.uint32] = np.array([archive.variable(n).valueReference for n in names], dtype=np.uint32)
        self.address: int = self.array.ctypes.data
        self.count = len(names)
        #: The same as C takes them, made once.
        self.arguments = c_void_p(self.address), c_size_t(self.count)

    def __bool__(self) -> bool:
        return bool(self.names)
