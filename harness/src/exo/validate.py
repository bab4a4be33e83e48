"""fmpy's validation of archives."""

from pathlib import Path

from fmpy.validation import validate_fmu

from exo.errors import FmuError


def problems(path: Path) -> list[str]:
    """What fmpy finds wrong: schema, names, ModelStructure, start values, causality with variability, units."""
    if not path.is_file():
        raise FmuError(f"{path}: no such FMU: run `cargo xtask fmu` first")
    return [str(problem) for problem in validate_fmu(str(path))]
