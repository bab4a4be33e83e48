"""An FMU and its variables, known before anything of it runs."""

from collections.abc import Mapping
from dataclasses import dataclass
from os import PathLike
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

from exo.api.frozen import Picklable
from exo.api.shown import SHOWN, columns
from exo.errors import FmuError, close_matches
from exo.fmu import Archive, choices, find_fmu_dir, unit_of

if TYPE_CHECKING:
    import pandas as pd

#: What a short table has of each variable.
SHORT = ("name", "causality", "type", "unit", "start", "description")


@dataclass(frozen=True, kw_only=True)
class Variable(Picklable):
    """A variable as the FMU's description declares it."""

    name: str
    #: `parameter`, `calculatedParameter`, `input`, `output`, `local` or `independent`.
    causality: str
    #: `constant`, `fixed`, `tunable`, `discrete` or `continuous`.
    variability: str
    #: `Real`, `Integer`, `Boolean`, `String` or `Enumeration`.
    type: str
    #: As the FMU writes it, for instance `N.m`; empty where it gives none.
    unit: str
    #: In `unit`; None where the FMU gives none.
    start: float | int | bool | str | None
    minimum: float | None
    maximum: float | None
    description: str
    #: Of a choice: its items by name.
    choices: Mapping[str, int]


@dataclass(frozen=True, kw_only=True, repr=False)
class Fmu(Picklable):
    """An FMU for co-simulation, FMI 2.0: what `exo.load` gives. `fmu["q"]` is a variable."""

    path: Path
    #: The model's name.
    name: str
    version: str
    description: str
    #: What has exported it.
    tool: str
    #: The step that it proposes (s); None where it proposes none.
    step: float | None
    #: What of the description breaks the standard, as fmpy says it; empty, if nothing does. `exo validate` says more.
    problems: str
    #: In the order of the description.
    variables: Mapping[str, Variable]

    def __getitem__(self, name: str) -> Variable:
        """The variable of this name. FmuError names close matches, if there is none."""
        try:
            return self.variables[name]
        except KeyError:
            known = close_matches(name, self.variables)
            raise FmuError(f"{self.path.name}: no variable {name}{known}") from None

    @property
    def inputs(self) -> dict[str, Variable]:
        """The inputs by name."""
        return self._of("input")

    @property
    def outputs(self) -> dict[str, Variable]:
        """The outputs by name."""
        return self._of("output")

    @property
    def parameters(self) -> dict[str, Variable]:
        """The parameters by name."""
        return self._of("parameter")

    def _of(self, causality: str) -> dict[str, Variable]:
        return {name: one for name, one in self.variables.items() if one.causality == causality}

    def frame(self) -> "pd.DataFrame":
        """The variables as a table: index `name`; columns `causality`, `variability`, `type`, `unit`, `start`, `min`,
        `max`, `description`."""
        import pandas as pd  # noqa: PLC0415

        rows = [
            {
                "name": one.name,
                "causality": one.causality,
                "variability": one.variability,
                "type": one.type,
                "unit": one.unit,
                "start": one.start,
                "min": one.minimum,
                "max": one.maximum,
                "description": one.description,
            }
            for one in self.variables.values()
        ]
        columns = ["name", "causality", "variability", "type", "unit", "start", "min", "max", "description"]
        table = pd.DataFrame(rows, columns=columns, dtype=object).set_index("name")
        return table.astype({"min": float, "max": float})

    def __repr__(self) -> str:
        rows = [
            (one.name, one.causality, one.type, one.unit, "" if one.start is None else str(one.start), one.description)
            for one in self.variables.values()
        ]
        return f"{self._title()}\n{columns(SHORT, rows)}"

    def _repr_html_(self) -> str:
        """What a notebook shows."""
        import html  # noqa: PLC0415

        return f"<p>{html.escape(self._title())}</p>{self._short().to_html(max_rows=SHOWN, index=False)}"

    def _title(self) -> str:
        what = f"{self.path.name} {self.version}".strip()
        counts = f"{len(self.inputs)} inputs, {len(self.outputs)} outputs, {len(self.parameters)} parameters"
        broken = f"; `exo validate {self.path.name}` says where it breaks the standard" if self.problems else ""
        return f"{what}: {counts}{broken}"

    def _short(self) -> Any:
        return self.frame().reset_index()[list(SHORT)].fillna("")


def load(fmu: str | PathLike[str], *, fmu_dir: str | PathLike[str] | None = None) -> Fmu:
    """Reads an FMU's description; no machine code runs.

    `fmu` is a file, or the name of one in `fmu_dir`, else in the folder that `EXO_FMU_DIR` names, else in `target/fmu`
    here or further up. FmuError, if there is none, or it is no FMI 2.0 FMU for co-simulation.
    """
    if not isinstance(fmu, str | PathLike):
        raise FmuError(f"load: got a value of type {type(fmu).__name__}; expected the path of an FMU")
    path = _found(Path(fmu), None if fmu_dir is None else Path(fmu_dir))
    archive = Archive(path, strict=False)
    description = archive.description
    experiment = description.defaultExperiment
    return Fmu(
        path=path,
        name=str(description.modelName),
        version=str(description.version or ""),
        description=str(description.description or ""),
        tool=str(description.generationTool or ""),
        step=_number(experiment.stepSize if experiment else None),
        problems=archive.problems,
        variables=MappingProxyType({name: _variable(archive, name) for name in archive.variables}),
    )


def _found(path: Path, fmu_dir: Path | None) -> Path:
    if path.is_file() and fmu_dir is None:
        return path
    if path.name and path.is_dir():
        raise FmuError(f"{path}: is a folder; expected an FMU")
    try:
        folder = find_fmu_dir(fmu_dir)
    except FmuError:
        raise FmuError(f"{path}: no such file; expected an FMU") from None
    if path.parent == Path() and (folder / path).is_file():
        return folder / path
    known = close_matches(path.name, [one.name for one in folder.glob("*.fmu")]) if folder.is_dir() else ""
    raise FmuError(f"{path}: no such file; expected an FMU, or the name of one in {folder}{known}")


def _variable(archive: Archive, name: str) -> Variable:
    declared = archive.variable(name)
    return Variable(
        name=name,
        causality=str(declared.causality),
        variability=str(declared.variability),
        type=str(declared.type),
        unit=unit_of(declared),
        start=_start(declared),
        minimum=_number(declared.min),
        maximum=_number(declared.max),
        description=str(declared.description or ""),
        choices=MappingProxyType(choices(declared)),
    )


def _start(declared: Any) -> float | int | bool | str | None:
    if declared.start is None:
        return None
    match declared.type:
        case "Real":
            return float(declared.start)
        case "Integer" | "Enumeration":
            return int(declared.start)
        case "Boolean":
            return str(declared.start).lower() in ("true", "1")
    return str(declared.start)


def _number(text: object) -> float | None:
    return None if text is None else float(str(text))
