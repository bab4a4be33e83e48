"""What is read only and goes to other processes nevertheless."""

from types import MappingProxyType
from typing import Any

import numpy as np
from numpy.typing import NDArray


class Picklable:
    """Read-only mappings, which pickle refuses, travel as dictionaries and are read only again where they arrive. So
    `multiprocessing` and `copy.deepcopy` take what has them."""

    def __getstate__(self) -> dict[str, Any]:
        return {name: dict(one) if isinstance(one, MappingProxyType) else one for name, one in vars(self).items()}

    def __setstate__(self, state: dict[str, Any]) -> None:
        for name, one in state.items():
            # The class is frozen.
            object.__setattr__(self, name, MappingProxyType(one) if isinstance(one, dict) else one)


def read_only(values: NDArray[Any]) -> NDArray[Any]:
    """The same values, which nobody can write: in tests and notebooks many look at one run."""
    seen = np.asarray(values).view()
    seen.flags.writeable = False
    return seen
