"""What does not move: lengths, places and masses from the parameters of a plant's FMU."""

from collections.abc import Mapping
from typing import Any

from exo.replay.parts import Plant, plant
from exo.replay.sticking import ARM_MARGIN, TESTBED_MARGIN

#: Beyond this a surface stands for "none in reach" (m).
FAR = 5.0
#: Of the steel plate that is drawn as the payload, which in the model is a point: sides (m) and density (kg/m³).
PLATE, PLATE_OF_TWO, STEEL = (0.24, 0.18), (0.24, 0.20), 7850.0


def geometry(parameters: Mapping[str, float | int | bool]) -> dict[str, Any] | None:
    """The geometry of the plant among these parameters, by `component.name`; None where none of them is a plant.

    A testbed: `wall` (m, or null), `M` (kg). An arm: `A1`, `L1`, `handle`, `pad` (m), `table` and `wall` (m, or null),
    `bases` with the shoulder of each arm and `payload`: mass (kg), weight (N) and the size of the plate (m), or null.
    """
    found = plant(parameters)
    return None if found is None else of(found, parameters)


def of(plant: Plant, parameters: Mapping[str, float | int | bool]) -> dict[str, Any]:
    """The geometry of this plant."""

    def value(name: str) -> float:
        return float(parameters[f"{plant.name}.{name}"])

    if plant.kind == "testbed":
        wall = value("wall.q")
        return {"kind": "testbed", "M": value("M"), "wall": wall if abs(wall) < 1e6 else None, "margin": TESTBED_MARGIN}
    y = value("base.y") if plant.kind == "arms" else 0.0
    return {
        "kind": "arm",
        "bases": [[0.0, y, 0.0], [0.0, -y, 0.0]] if plant.kind == "arms" else [[0.0, 0.0, 0.0]],
        "A1": value("A1"),
        "L1": value("L1"),
        "handle": [value("handle.x"), value("handle.z")],
        "pad": [value("pad.x"), value("pad.z")],
        "table": value("table.z") if abs(value("table.z")) < FAR else None,
        "wall": value("wall.x") if abs(value("wall.x")) < FAR else None,
        "payload": _payload(plant, parameters, y),
        "margin": ARM_MARGIN,
    }


def _payload(plant: Plant, parameters: Mapping[str, float | int | bool], y: float) -> dict[str, Any] | None:
    mass = float(parameters[f"{plant.name}.payload.m"])
    if mass == 0.0:
        return None
    length, width = (PLATE_OF_TWO[0], PLATE_OF_TWO[1] + 2.0 * y) if plant.kind == "arms" else PLATE
    gravity = sum(float(parameters.get(f"{plant.name}.gravity[{i}]", 0.0)) ** 2 for i in (1, 2, 3)) ** 0.5
    return {
        "mass": mass,
        "weight": mass * gravity,
        "size": [length, width, round(min(0.12, max(0.012, mass / (STEEL * length * width))), 4)],
    }
