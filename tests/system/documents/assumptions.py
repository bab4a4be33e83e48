"""The assumptions table of docs/specification.md: sources from assumptions.toml, effects from assumptions.json, values
and units from modelDescription/*.xml.

cd tests/system && python -m documents.assumptions
"""

import json
import re
import xml.etree.ElementTree as ET
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from exo.sensitivity import Figure, Parameter, Study, load

ROOT = Path(__file__).parents[3]
STUDY = ROOT / "docs/assumptions.toml"
EFFECTS = ROOT / "docs/assumptions.json"
DOCUMENT = ROOT / "docs/specification.md"
PLANTS = ("Testbed", "ExoskeletonArm")
BEGIN, END = "<!-- {}: made from docs/assumptions.toml and assumptions.json -->\n", "<!-- end -->"
#: Percent below which an effect is none.
NOTHING = 0.1


@dataclass(frozen=True)
class Declared:
    """A parameter as the FMU declares it."""

    start: str
    unit: str


def declared(plant: str) -> dict[str, Declared]:
    """All parameters of an FMU in its order."""
    tree = ET.parse(ROOT / f"modelDescription/{plant}.xml")
    found = {}
    for variable in tree.iter("ScalarVariable"):
        if variable.get("causality") == "parameter":
            kind = next(iter(variable))
            unit = kind.get("unit", "1")
            found[variable.get("name", "")] = Declared(
                kind.get("start", ""), "" if unit == "1" else f" {unit.replace('.', '·')}"
            )
    return found


def specified() -> dict[str, float]:
    """What section 4 of the specification says of the arm's joints and links, by the FMU's names."""
    _, text = DOCUMENT.read_text(encoding="utf-8").split("| by joint, or link |")
    text, _ = text.split("\n\n", 1)
    rows = re.findall(r"^\| `([\w.]+)` \| (\S+) \| (\S+) \| (\S+) \|.*\|$", text, flags=re.MULTILINE)
    return {
        f"{name}[{i}]": float(value.replace("−", "-"))
        for name, *values in rows
        for i, value in enumerate(values, start=1)
    }


def effects() -> dict[str, Any]:
    """What `exo sensitivity` has measured."""
    found: dict[str, Any] = json.loads(EFFECTS.read_text(encoding="utf-8"))
    return found


def table(plant: str) -> str:
    """A plant's parameters by group in Markdown."""
    study, measured, known = load(STUDY), effects(), declared(plant)
    figures = study.figures(plant)
    lines = [
        ["parameter", "value", "source", *(figure.title for figure in figures)],
        ["---"] * (3 + len(figures)),
        ["", "", "*the figure itself*", *(number(measured[figure.id]["value"], digits=4) for figure in figures)],
    ]
    group = ""
    for parameter in study.parameter:
        if parameter.plant != plant:
            continue
        if parameter.group != group:
            group = parameter.group
            lines.append([f"**{group}**", *[""] * (2 + len(figures))])
        lines += _rows(parameter, figures, measured, known)
    return "".join(f"| {' | '.join(line)} |\n" for line in lines)


def _rows(
    parameter: Parameter, figures: list[Figure], measured: dict[str, Any], known: dict[str, Declared]
) -> list[list[str]]:
    """One row an element; one for the whole array where all elements have the same cells."""
    source = f"{parameter.source}: {parameter.why}"
    cells = {name: [_cell(parameter, name, figure, measured) for figure in figures] for name in parameter.names}
    values = {name: _value(parameter, name, figures, measured, known) for name in parameter.names}
    first = parameter.names[0]
    if all(cells[name] == cells[first] for name in parameter.names):
        value = values[first] if len(set(values.values())) == 1 else "; ".join(values.values())
        return [[f"`{parameter.name}`", value, source, *cells[first]]]
    return [
        [f"`{name}`", values[name], source if name == first else "as above", *cells[name]] for name in parameter.names
    ]


def _value(
    parameter: Parameter, name: str, figures: list[Figure], measured: dict[str, Any], known: dict[str, Declared]
) -> str:
    """Start value with unit, other values of the scenarios, and what was changed when not 25 %."""
    start, unit = known[name].start, known[name].unit
    if start in ("true", "false"):
        return start
    text = f"{number(float(start))}{unit}"
    others: dict[str, list[str]] = {}
    for figure in figures:
        value = measured[figure.id]["parameters"][name]
        if value != float(start):
            scenarios = others.setdefault(number(value), [])
            scenarios += [f"`{figure.scenario}`"] * (f"`{figure.scenario}`" not in scenarios)
    text += "".join(f"; {value} in {', '.join(scenarios)}" for value, scenarios in others.items())
    return text + (f" (changed: {parameter.change})" if parameter.change else "")


def _cell(parameter: Parameter, name: str, figure: Figure, measured: dict[str, Any]) -> str:
    """The two effects in percent of the figure."""
    if figure.id in parameter.off:
        return "off"
    base = measured[figure.id]["value"]
    texts = [percent(base, value) for value in measured[figure.id]["changed"][name]]
    return "none" if set(texts) == {"0"} else " / ".join(texts)


def percent(base: float, value: float | None) -> str:
    """What a figure has changed by, with one digit after the point below 10 %."""
    if value is None:
        return "never"
    change = 100.0 * (value / base - 1.0)
    if abs(change) < NOTHING:
        return "0"
    return f"{change:+.{0 if abs(change) >= 10.0 else 1}f}".replace("-", "−")


def number(value: float, *, digits: int = 6) -> str:
    """A number as the table writes it."""
    return re.sub(r"e([+-])0?", lambda sign: "e" + sign[1].strip("+"), f"{value:.{digits}g}").replace("-", "−")


def filled(text: str) -> str:
    """The document with the tables as they are now."""
    for plant in PLANTS:
        begin = BEGIN.format(plant)
        before, rest = text.split(begin)
        _, after = rest.split(END, 1)
        text = f"{before}{begin}{table(plant)}{END}{after}"
    return text


def study() -> Study:
    """The study that the table is made of."""
    return load(STUDY)


if __name__ == "__main__":
    DOCUMENT.write_text(filled(DOCUMENT.read_text(encoding="utf-8")), encoding="utf-8")
