"""Names in scenarios: which ids can name files, and short ways to write arrays.

FMUs know only the elements of arrays, by FMI's structured names such as `p[1]` and `segment[2].t_on`.
"""

import re
from collections.abc import Mapping
from typing import Any

#: An element's number has few digits: a longer one would take minutes to read.
RANGE = re.compile(r"\[(\d+)\.\.(\d+)\]")
#: Elements of one range. The longest array of an FMU here has 16.
MAX_ELEMENTS = 10_000
IDENTIFIER = re.compile(r"[A-Za-z0-9_+-][A-Za-z0-9_.+-]*")
#: Letters of an id: a file system takes 255 bytes for a name, and endings come behind.
MAX_LETTERS = 120
#: Names that Windows gives to devices, whatever ending follows.
DEVICES = {"CON", "PRN", "AUX", "NUL", *(f"{port}{i}" for port in ("COM", "LPT") for i in range(10))}
#: What XML has no way to write, and what moves a terminal's cursor.
CONTROL = re.compile(r"[\x00-\x1f\x7f-\x9f\ufffe\uffff]")


def file_name(name: str) -> str:
    """`name`, if it can name a file on every system; else ValueError."""
    if not IDENTIFIER.fullmatch(name):
        raise ValueError(f"id {name!r}: expected letters, digits and _ . + -, and no dot in front")
    if name.endswith("."):
        raise ValueError(f"id {name!r}: ends in a dot, which Windows drops; expected another end")
    if name.split(".", 1)[0].upper() in DEVICES:
        raise ValueError(f"id {name!r}: Windows has a device of this name; expected another one")
    if len(name) > MAX_LETTERS:
        raise ValueError(f"id {name[:20]!r}…: {len(name)} letters; expected at most {MAX_LETTERS}")
    return name


def line(text: str) -> str:
    """`text`, if it is one line of printable letters; else ValueError."""
    if found := CONTROL.search(text):
        raise ValueError(f"{text[:60]!r} has the control character U+{ord(found[0]):04X}; expected one line of text")
    return text


def text(text: str) -> str:
    """`text`, if it is printable letters, tabs and ends of lines; else ValueError."""
    line(re.sub(r"[\t\r\n]", " ", text))
    return text


def elements(name: str) -> list[str]:
    """`plant.p[1..3]` is `plant.p[1]`, `plant.p[2]`, `plant.p[3]`; a name without a range is itself."""
    found = RANGE.search(name)
    if not found:
        return [name]
    if max(len(number) for number in found.groups()) > len(str(MAX_ELEMENTS)) + 1:
        raise ValueError(f"{name[:80]}: expected a range of at most {MAX_ELEMENTS} elements")
    first, last = (int(number) for number in found.groups())
    if last < first:
        raise ValueError(f"{name}: the range must increase")
    if last - first >= MAX_ELEMENTS:
        raise ValueError(f"{name}: {last - first + 1} elements; expected at most {MAX_ELEMENTS}")
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
