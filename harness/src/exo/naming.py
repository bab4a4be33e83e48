"""Arrays in scenarios: short ways to write FMI's structured names such as `p[1]` and `segment[2].t_on`, of which FMUs
know only the elements."""

import re
from collections.abc import Mapping
from typing import Any

RANGE = re.compile(r"\[(\d+)\.\.(\d+)\]")


def elements(name: str) -> list[str]:
    """`plant.p[1..3]` is `plant.p[1]`, `plant.p[2]`, `plant.p[3]`; a name without a range is itself."""
    found = RANGE.search(name)
    if not found:
        return [name]
    first, last = (int(number) for number in found.groups())
    if last < first:
        raise ValueError(f"{name}: the range must increase")
    return [f"{name[: found.start()]}[{i}]{name[found.end() :]}" for i in range(first, last + 1)]


def expand_names(names: Any) -> Any:
    """All elements of every name of an array."""
    return tuple(one for name in names for one in elements(name)) if _is_array_of_texts(names) else names


def expand_wires(wires: Any) -> Any:
    """`"controller.q[1..3]" = "plant.q[1..3]"` connects element by element."""
    if not isinstance(wires, Mapping) or not _is_array_of_texts(list(wires.values())):
        return wires
    expanded: dict[str, str] = {}
    for target, source in wires.items():
        to, origin = elements(target), elements(source)
        if len(to) != len(origin):
            raise ValueError(f"{target} has {len(to)} elements and {source} has {len(origin)}: expected as many")
        expanded.update(zip(to, origin, strict=True))
    return expanded


def expand_values(values: Any) -> Any:
    """Start values by element: `"K[1..3]" = 500.0` sets all three to one value, `K = [1.0, 2.0, 3.0]` each to its own,
    and `segment = [{ axis = 1 }, { axis = 3 }]` sets `segment[1].axis` and `segment[2].axis`."""
    if not isinstance(values, Mapping):
        return values
    expanded: dict[str, Any] = {}
    for key, value in values.items():
        if not isinstance(value, list):
            expanded.update(dict.fromkeys(elements(key), value))
            continue
        for i, element in enumerate(value, start=1):
            fields = element.items() if isinstance(element, Mapping) else [("", element)]
            expanded.update({f"{key}[{i}]{field and '.'}{field}": content for field, content in fields})
    return expanded


def _is_array_of_texts(names: Any) -> bool:
    return isinstance(names, list) and all(isinstance(name, str) for name in names)
