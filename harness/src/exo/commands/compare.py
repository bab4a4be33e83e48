"""`exo compare`."""

import json
from math import inf, isfinite
from pathlib import Path
from typing import Annotated

import typer

from exo import compare as comparison
from exo import screen
from exo.commands.options import AsJson
from exo.errors import ExoError
from exo.screen import console, sentences


def compare(
    a: Path,
    b: Path,
    *,
    tolerance: Annotated[float, typer.Option(help="Largest difference, as a share of the larger magnitude.")] = 1e-12,
    as_json: AsJson = False,
) -> None:
    """Compares two result folders or two signal files; exit code 1 beyond the tolerance."""
    with sentences():
        if not 0.0 <= tolerance < inf:  # what is missing is infinitely far away
            raise ExoError(f"--tolerance {tolerance:g}: expected a finite share of 0 or more")
        differences = comparison.compare(a, b)
        beyond = sorted((d for d in differences if not d.share <= tolerance), key=lambda d: -d.share)
        largest = max((d.share for d in differences), default=0.0)
        if as_json:
            answer = {
                "a": str(a),
                "b": str(b),
                "tolerance": tolerance,
                "compared": len(differences),
                "largest": largest if isfinite(largest) else None,
                "beyond": [d.as_json() for d in beyond],
            }
            typer.echo(json.dumps(answer, indent=2, ensure_ascii=False, allow_nan=False))
        else:
            screen.print_differences(beyond)
            console.print(
                f"{len(differences)} numbers and signals compared, {len(beyond)} differ by more than {tolerance:g}; "
                f"largest difference {largest:.3g}"
            )
    raise typer.Exit(1 if beyond else 0)
