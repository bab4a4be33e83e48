"""Pages of the reference, each from its source: variables from the model descriptions, scenarios from their files."""

import json
import xml.etree.ElementTree as ET
from pathlib import Path

from exo import scenario as scenarios
from exo.expansion import schema

CAUSALITIES = ("input", "output", "parameter", "calculatedParameter", "local")


def pages(root: Path) -> dict[str, str]:
    """Path below the site → Markdown."""
    descriptions = sorted((root / "modelDescription").glob("*.xml"))
    found = {f"reference/fmus/{path.stem}.md": fmu(ET.parse(path).getroot()) for path in descriptions}
    found["reference/index.md"] = index(descriptions)
    found["reference/scenarios.md"] = every_scenario()
    found["reference/scenario-schema.md"] = scenario_schema()
    return found


def index(descriptions: list[Path]) -> str:
    """What there is to look up."""
    rows = [
        f"| [{path.stem}](fmus/{path.stem}.md) | {ET.parse(path).getroot().get('description')} |"
        for path in descriptions
    ]
    return "\n".join([
        "# Reference", "", "| FMU | What |", "|---|---|", *rows, "",
        "[Scenarios](scenarios.md), and the [keys of a scenario file](scenario-schema.md).",
    ])  # fmt: skip


def fmu(model: ET.Element) -> str:
    """The variables of one FMU, a table for each causality; arrays in one row."""
    lines = [f"# {model.get('modelName')}", "", f"{model.get('description')}.", ""]
    experiment = model.find("DefaultExperiment")
    if experiment is not None:
        lines += [
            f"Step: {experiment.get('stepSize')} s. FMI 2.0; the FMI 3.0 twin has the same variables.",
            "",
        ]
    types = {one.get("name"): one for one in model.iterfind("TypeDefinitions/SimpleType")}
    variables = list(model.iterfind("ModelVariables/ScalarVariable"))
    for causality in CAUSALITIES:
        own = [v for v in variables if v.get("causality", "local") == causality]
        rows = _rows(own, types)
        if rows:
            lines += [
                f"## {_heading(causality)}",
                "",
                "| Name | Type | Unit | Start | Limits | What |",
                "|---|---|---|---|---|---|",
                *rows,
                "",
            ]
    return "\n".join(lines)


def _heading(causality: str) -> str:
    return {
        "calculatedParameter": "Calculated parameters",
        "local": "Local variables",
    }.get(causality, f"{causality.capitalize()}s")


def _rows(variables: list[ET.Element], types: dict[str | None, ET.Element]) -> list[str]:
    """Consecutive elements of one array with one description are one row."""
    groups: list[tuple[str, list[ET.Element]]] = []
    for variable in variables:
        name = str(variable.get("name"))
        base = name[: name.rindex("[")] if name.endswith("]") else name
        if groups and name.endswith("]") and groups[-1][0] == base:
            groups[-1][1].append(variable)
        else:
            groups.append((base, [variable]))
    return [_row(base, members, types) for base, members in groups]


def _row(base: str, members: list[ET.Element], types: dict[str | None, ET.Element]) -> str:
    first = members[0][0]
    declared = types.get(first.get("declaredType"))
    inner = declared[0] if declared is not None else None

    def of(key: str, element: ET.Element = first) -> str:
        return element.get(key) or (inner.get(key, "") if inner is not None else "")

    name = base if len(members) == 1 and not str(members[0].get("name")).endswith("]") else f"{base}[1..{len(members)}]"
    starts = list(dict.fromkeys(member[0].get("start", "") for member in members))
    start = starts[0] if len(starts) == 1 else ", ".join(member[0].get("start", "") for member in members)
    low, high = of("min"), of("max")
    limits = f"{low or '−∞'} … {high or '∞'}" if low or high else ""
    kind = "Enumeration" if inner is not None and inner.tag == "Enumeration" else first.tag
    cells = (
        f"`{name}`",
        kind,
        of("unit"),
        start,
        limits,
        str(members[0].get("description", "")),
    )
    return "| " + " | ".join(cell.replace("|", r"\|") for cell in cells) + " |"


def every_scenario() -> str:
    """What each scenario shows, and what it is judged by."""
    lines = ["# Scenarios", "", "`exo run NAME` runs one, `exo reproduce` all.", ""]
    for name in sorted(scenarios.built_in()):
        one = scenarios.load(name)
        lines += [
            f"## {name}",
            "",
            f"**{one.title}.** {' '.join(one.about.split())}",
            "",
        ]
        judged = dict.fromkeys(metric.title for metric in one.metrics)
        lines += [
            f"{len(one.cases)} cases, {one.duration:g} s. Numbers: {'; '.join(judged)}.",
            "",
        ]
    return "\n".join(lines)


def scenario_schema() -> str:
    """The keys of a scenario file, and the whole schema."""
    data = schema.schema()
    rows = []
    for key, value in sorted(data.get("properties", {}).items()):
        rows.append(f"| `{key}` | {' '.join(str(value.get('description', value.get('title', ''))).split())} |")
    return "\n".join([
        "# Keys of a scenario file", "",
        "`exo schema` prints the whole JSON Schema; editors that know it for TOML complete and check files.", "",
        "| Key | What |", "|---|---|", *rows, "",
        "## The whole schema", "", "```json", json.dumps(data, indent=1, ensure_ascii=False), "```",
    ])  # fmt: skip
