"""How a system is written as an SSP archive: version, place of the parameters, variants, version of its FMUs."""

import zipfile
from collections.abc import Iterable, Mapping
from contextlib import ExitStack
from dataclasses import dataclass, field
from pathlib import Path

from exo.errors import FmuError
from exo.extraction import opened
from exo.fmu import Archive
from exo.systems import interface
from exo.systems.interface import Interface, Variable
from exo.validate.archive import DESCRIPTION


@dataclass(frozen=True, kw_only=True)
class Twin:
    """An FMI 3.0 archive that replaces the FMI 2.0 archive of the same name. Arrays are one variable in it."""

    path: Path
    interface: Interface

    @classmethod
    def of(cls, path: Path) -> "Twin":
        """Reads the description. Raises FmuError where there is no FMI 3.0 co-simulation FMU."""
        if not path.is_file():
            raise FmuError(f"{path}: no such FMU")
        with ExitStack() as stack:
            found = interface.read(opened(path, stack).read(DESCRIPTION))
        if not found.version.startswith("3.") or "CoSimulation" not in found.implementations:
            raise FmuError(f"{path}: expected an FMI 3.0 co-simulation FMU, got FMI {found.version}")
        return cls(path=path, interface=found)


@dataclass(frozen=True, kw_only=True)
class Form:
    """How an archive is written."""

    #: Of the standard: 1.0 or 2.0.
    version: str = "1.0"
    #: Parameter values stand in the description that binds them, not in files beside it.
    inline: bool = False
    #: Beside the default a description for each other parameter set, `<set>.ssd`.
    variants: bool = False
    #: FMI 3.0 archives by archive name; they need version 2.0.
    twins: Mapping[str, Twin] = field(default_factory=dict)

    def __post_init__(self) -> None:
        if self.version not in ("1.0", "2.0"):
            raise FmuError(f"SSP {self.version}: expected 1.0 or 2.0")
        if self.twins and self.version != "2.0":
            raise FmuError("SSP 1.0 knows no FMI 3.0: expected version 2.0")


SSP_1 = Form()
SSP_2 = Form(version="2.0", variants=True)


def forms(
    out: Path, files: Iterable[str], *, twins: Path | None, default_twins: Path, inline: bool
) -> dict[Path, Form]:
    """The forms that `exo ssp` writes, by folder: SSP 1.0 in `out`, SSP 2.0 in `ssp2`, and in `ssp2/fmi3` that with the
    FMI 3.0 archives of `twins`. Without `twins` those of `default_twins` serve, where all `files` are there."""
    found = {out: Form(inline=inline), out / "ssp2": Form(version="2.0", inline=inline, variants=True)}
    files = sorted(files)
    if twins is None and all((default_twins / file).is_file() for file in files):
        twins = default_twins
    if twins is not None:
        read = {file: Twin.of(twins / file) for file in files}
        found[out / "ssp2" / "fmi3"] = Form(version="2.0", inline=inline, variants=True, twins=read)
    return found


class Part:
    """A component's archive as the form has it: the FMI 2.0 archive's names, the twin's variables."""

    def __init__(self, archive: Archive, twin: Twin | None) -> None:
        self.archive = archive
        self.twin = twin
        self.path = twin.path if twin else archive.path
        self.interface = twin.interface if twin else _interface(archive)

    def element(self, name: str) -> tuple[Variable, tuple[int, ...]]:
        """The variable of an FMI 2.0 name, and the indices where it is an element of the twin's array."""
        self.archive.variable(name)
        try:
            return self.interface.element(name)
        except FmuError as missing:
            raise FmuError(f"{self.path}: {missing}") from None

    def variables(self, names: list[str]) -> list[Variable]:
        """The variables that these FMI 2.0 names belong to, each once, in the order of the names."""
        return list({variable.name: variable for variable, _ in map(self.element, names)}.values())


def _interface(archive: Archive) -> Interface:
    with zipfile.ZipFile(archive.path) as files:
        return interface.read(files.read(DESCRIPTION))


def parts(archives: Mapping[str, Archive], form: Form) -> dict[str, Part]:
    """The archives of a form, by archive name."""
    return {file: Part(archive, form.twins.get(file)) for file, archive in archives.items()}
