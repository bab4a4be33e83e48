"""`exo identify-tool`."""

from collections.abc import Iterable
from math import isfinite
from pathlib import Path
from typing import Annotated

import typer

from exo import readings, tool
from exo.errors import ScenarioError
from exo.screen import console, sentences


def identify_tool(
    file: Annotated[
        Path, typer.Argument(metavar="READINGS", help="CSV: q[1..3], ft.force[1..3], ft.torque[1..3], a row a reading.")
    ],
    mount: Annotated[str, typer.Option(help="ft.mount of the sensor: roll,pitch,yaw in rad.")] = "0,0,0",
) -> None:
    """Prints mass and centre of gravity of what hangs on the force sensor, from readings at rest in several poses."""
    with sentences():
        angles = parse_angles(mount)
        q, force, torque = readings.read(file)
        found = tool.identify(R=tool.orientation(q=q, mount=angles), force=force, torque=torque)

    def numbers(values: Iterable[float]) -> str:
        return f"[{', '.join(f'{x:.5f}' for x in values)}]"

    console.print(
        f'"controller.ft.mass" = {found.mass:.5f}  # kg, standard error {found.mass_error:.2g}\n'
        f'"controller.ft.cog" = {numbers(found.cog)}  # m, standard errors {numbers(found.cog_error)}\n'
        f"# bias: {numbers(found.bias_force)} N, {numbers(found.bias_torque)} N·m; a tare finds it anew\n"
        f"# left of {len(q)} readings: {found.force_rest:.2g} N, {found.torque_rest:.2g} N·m root mean square",
        markup=False,
    )


def parse_angles(text: str) -> list[float]:
    """Three angles between commas."""
    try:
        angles = [float(part) for part in text.split(",")]
    except ValueError:
        angles = []
    if len(angles) != 3 or not all(isfinite(angle) for angle in angles):
        raise ScenarioError(f"--mount {text}: expected roll,pitch,yaw in rad")
    return angles
