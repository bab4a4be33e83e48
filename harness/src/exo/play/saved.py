"""A run that was played, as the tables of a scenario, and as a file that `exo run` repeats bit for bit."""

from collections.abc import Mapping, Sequence
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from exo import folder
from exo.naming import file_name
from exo.play.bench import Bench

#: (time, value) pairs of a profile, straight in between.
Points = Sequence[tuple[float, float]]
#: Half a day of names beside each other.
MANY = 10_000


def tables(
    bench: Bench,
    *,
    settings: Mapping[str, float | str],
    profiles: Mapping[str, Points],
    duration: float,
    name: str = "played",
) -> dict[str, Any]:
    """The scenario's tables.

    `settings`: a value for each knob; `profiles`: points of the hand's axes (N), of live knobs and of switches, by id.
    """
    fixed = {key: settings[knob.id] for knob in bench.knobs if not knob.live for key in knob.keys}
    live = {key: f"profile.{knob.id}" for knob in bench.knobs if knob.live for key in knob.keys}
    pushed = {key: f"profile.{axis}" for axis, keys in bench.force.items() for key in keys}
    switched = {key: f"profile.{one}" for one, keys in bench.switches.items() for key in keys}
    return {
        "id": name,
        "base": bench.base,
        "title": "A run that was played by hand",
        "about": f"Played on the bench {bench.kind}: the hand's force and what was set are profiles.",
        "source": "exo play",
        "duration": duration,
        "step": bench.step,
        "signals": list(dict.fromkeys([*bench.shown, *(keys[0] for keys in bench.force.values())])),
        "parameters": {**bench.parameters, **fixed},
        "inputs": {**pushed, **live, **switched},
        "profiles": {one: [{"kind": "table", "points": [list(p) for p in points]}] for one, points in profiles.items()},
        "cases": [{"id": name, "label": "played"}],
        "figures": [
            {
                "id": "played",
                "title": "What was played",
                "panels": [
                    {
                        "y_label": f"{title} [{unit}]",
                        "curves": [{"case": name, "column": column, "label": column} for column in columns],
                    }
                    for title, unit, columns in bench.panels
                ],
            }
        ],
    }


def thinned(points: Points) -> list[tuple[float, float]]:
    """Without the points inside a stretch of one value: what is left is the same line, bit for bit."""
    kept = [
        point
        for i, point in enumerate(points)
        if i in (0, len(points) - 1) or not points[i - 1][1] == point[1] == points[i + 1][1]
    ]
    return kept if len(kept) > 1 else [*kept, (kept[0][0] + 1.0, kept[0][1])]


def write(found: dict[str, Any], place: Path, name: str) -> Path:
    """`<place>/<name>.toml`, or with a number behind where that is taken.

    ValueError, if a file cannot have this name.
    """
    file_name(name)
    for number in range(1, MANY):
        path = place / (f"{name}.toml" if number == 1 else f"{name}-{number}.toml")
        if not path.exists():
            folder.write_file(path, _toml(found, path.stem).encode())
            return path
    raise ValueError(f"{place} has {MANY} files {name}*.toml; expected another name")


def _toml(found: dict[str, Any], name: str) -> str:
    lines = [f"# Played on {datetime.now(UTC):%Y-%m-%d %H:%M} UTC with `exo play`; `exo run` repeats it."]
    for key, value in found.items():
        if key in ("profiles", "cases", "figures"):
            continue
        if isinstance(value, dict):
            lines += ["", f"[{key}]", *(f"{_text(one)} = {_value(v)}" for one, v in value.items())]
        else:
            lines.append(f"{key} = {_value(value)}")
    # Keys of the head come before the first table.
    head = [line for line in lines if "=" in line and not line.startswith('"')]
    lines = [lines[0], *head, *(line for line in lines[1:] if line not in head)]
    lines += ["", "[profiles]"]
    for one, segments in found["profiles"].items():
        pairs = ", ".join(f"[{t!r}, {v!r}]" for t, v in segments[0]["points"])
        lines.append(f'{one} = [{{ kind = "table", points = [{pairs}] }}]')
    lines += ["", "[cases.played]", 'label = "played"', ""]
    for figure in found["figures"]:
        lines += [f"[figures.{figure['id']}]", f"title = {_text(figure['title'])}", "panels = ["]
        for panel in figure["panels"]:
            curves = ", ".join(
                f'{{ case = "played", column = {_text(one["column"])}, label = {_text(one["label"])} }}'
                for one in panel["curves"]
            )
            lines.append(f"    {{ y_label = {_text(panel['y_label'])}, curves = [{curves}] }},")
        lines.append("]")
    return "\n".join(lines).replace(f'id = "{found["id"]}"', f'id = "{name}"', 1) + "\n"


def _text(value: str) -> str:
    return '"' + value.replace("\\", "\\\\").replace('"', '\\"') + '"'


def _value(value: object) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return _text(value)
    if isinstance(value, list):
        return "[" + ", ".join(_value(one) for one in value) + "]"
    return repr(value)
