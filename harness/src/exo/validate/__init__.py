"""Judges FMI 2.0 and 3.0 FMUs, this project's or any other's: fmpy's validation, and what that misses.

1. `archive.py`: the ZIP file, read without trusting it. What is merely wrong in it does not hide what comes after; what
   is not safe ends the check.
2. `prolog.py`, `description.py`: the XML, without document types and entities, becomes one form for both versions of
   the standard; `versions.py` has the words of each.
3. `fmpy`: schema, required start values, causality with variability, completeness of ModelStructure.
4. `header.py`, `variables.py`, `values.py`, `naming.py`, `units.py` with `si.py`, `structure.py`, and for FMI 3.0
   `arrays.py`, `clocks.py`: what schema and fmpy do not see.
5. `layout.py`, `documentation.py`, `terminals.py`, `sources.py`: folders, dead links, files beside the description.
6. `binaries.py`: format, exports and needs of every platform's library (parsed by LIEF, not run).
7. `load.py`: the library of this machine, run through one step.
8. `behaviour.py`: on demand, the dynamic rules: states, reset, two instances, step sizes, …
9. `exo.references`: the experiments that the archive carries, replayed.

Steps 6 to 8 happen in `exo.probe`, step 9 in `exo.references.player`, in processes of their own (`child.py`): a crash
is a finding, not an end. Loading runs the FMU's machine code with the rights of the caller; `run=False` leaves steps 7
to 9 out. What is extracted lies in a folder that goes with the check (`workspace.py`).

SSP archives are judged by `ssp/`, which asks for the FMUs in them here.

Not checked: model exchange (a ModelExchange element is only seen by the schema), FMI 1.0 (refused by `xml-version`),
source code FMUs beyond the files that `sources/` must have, libraries of other machines beyond their file. Rules:
`rule.py`; each is listed in docs/validate.md and shown to fire by a broken FMU.
"""

from contextlib import ExitStack
from dataclasses import asdict, dataclass
from functools import partial
from pathlib import Path
from typing import Any

from fmpy import read_model_description
from fmpy.model_description import ValidationError

from exo.errors import FmuError
from exo.validate import (
    arrays,
    binaries,
    clocks,
    description,
    documentation,
    header,
    layout,
    load,
    naming,
    references,  # noqa: F401  its rules are listed, and asked by exo.references
    sources,
    ssp,
    structure,
    terminals,
    units,
    values,
    variables,
)
from exo.validate.archive import DESCRIPTION, Contents, open_archive
from exo.validate.behaviour import Verdict
from exo.validate.description import Description
from exo.validate.rule import RULES, Finding, Severity, error
from exo.validate.versions import FMI3
from exo.validate.workspace import workspace

__all__ = ["RULES", "Finding", "Report", "Severity", "Verdict", "check", "problems"]

FMPY = error("fmpy", "fmpy's validation finds nothing")


@dataclass(frozen=True)
class Report:
    """What was found in one FMU, and what could not be looked at."""

    path: Path
    findings: tuple[Finding, ...]
    #: Sentences: steps that were left out, and why.
    skipped: tuple[str, ...]
    #: Sentences: by how much the outputs of each experiment that was replayed differ from its reference results.
    replayed: tuple[str, ...] = ()
    #: Of the dynamic rules, if they were asked.
    verdicts: tuple[Verdict, ...] = ()

    def failed(self, *, strict: bool = False) -> bool:
        """Whether there is an error; if strict, a warning suffices."""
        return any(strict or finding.severity is Severity.ERROR for finding in self.findings)

    def as_json(self, *, strict: bool = False) -> dict[str, Any]:
        """For other programs: `fmu`, `failed`, `findings` (rule, severity, where, value, expected), `skipped`,
        `verdicts` (rule, verdict, reason) of the dynamic rules, `replayed`.
        """
        return {
            "fmu": str(self.path),
            "failed": self.failed(strict=strict),
            "findings": [asdict(finding) for finding in self.findings],
            "skipped": self.skipped,
            "replayed": self.replayed,
            "verdicts": [asdict(verdict) for verdict in self.verdicts],
        }


def check(
    path: Path,
    *,
    run: bool = True,
    dynamic: bool = False,
    platforms: tuple[str, ...] = (),
    max_glibc: str | None = None,
) -> Report:
    """Judges an FMU: with `run` its library is loaded, with `dynamic` as well the dynamic rules are asked; `platforms`
    must be there, ELF libraries need no newer glibc.

    Raises FmuError where there is no file, or no room to extract it.
    """
    from exo.references.replay import look  # noqa: PLC0415  which needs the archive of this package

    _ask_for_file(path)
    if path.suffix == ".ssp":
        inside = partial(check, run=run, dynamic=dynamic, platforms=platforms, max_glibc=max_glibc)
        of_system, left_out = ssp.findings(path, inside)
        return Report(path, tuple(of_system), tuple(left_out))
    with ExitStack() as stack:
        contents, found = open_archive(path, stack)
        if contents is None:
            return Report(path, tuple(found), ("all but the archive: it is not safe or not an FMU",))
        described, problems_of_xml = description.parse(contents.read(DESCRIPTION))
        found += problems_of_xml
        if described is None:
            return Report(path, tuple(found), ("all but archive and XML: the description cannot be read",))
        found += [FMPY.at(DESCRIPTION, problem, "a valid description") for problem in problems(path)]
        found += _of_files(contents, described)
        folder = stack.enter_context(workspace())
        contents.extract(folder)
        of_binaries = list(binaries.findings(contents, described, folder, platforms=platforms, max_glibc=max_glibc))
        found += of_binaries
        library = load.library(described, folder)
        of_library = {finding.rule for finding in of_binaries if library and library.match(finding.where)}
        unusable = of_library & {binaries.EXPORTS.id, binaries.FORMAT.id}
        skipped: list[str] = []
        verdicts: list[Verdict] = []
        if not run:
            skipped.append("loading: not wanted")
        elif described.identifier is None:
            skipped.append("loading: modelIdentifier is no C identifier")
        elif library is None:
            skipped.append(f"loading: no library for {' or '.join(load.host_platforms(described.version))}")
        elif unusable:
            skipped.append(f"loading: {', '.join(sorted(unusable))}")
        else:
            found += load.findings(described, folder, library, skipped, verdicts if dynamic else None)
        played = look(contents, path, run=run and library is not None and not unusable)
        skipped += played.skipped
    return Report(
        path, (*found, *played.findings), tuple(skipped), verdicts=tuple(verdicts), replayed=tuple(played.sentences())
    )


def _of_files(contents: Contents, described: Description) -> list[Finding]:
    """What can be said without the libraries."""
    found: list[Finding] = []
    for judge in (header, variables, values, naming, units, structure):
        found += judge.findings(described)
    if described.version is FMI3:
        for judge in (arrays, clocks):
            found += judge.findings(described)
        found += sources.findings(contents, described)
    found += layout.findings(contents, described)
    found += documentation.findings(contents)
    found += terminals.findings(contents, described)
    return found


def problems(path: Path) -> list[str]:
    """What fmpy finds wrong: schema, ModelStructure, start values, causality with variability, units.

    Its parser of structured names is left out: `naming.py` does that in a thousandth of the time.
    """
    _ask_for_file(path)
    try:
        read_model_description(str(path), validate=True, validate_variable_names=False, validate_model_structure=True)
    except ValidationError as invalid:
        return [str(problem) for problem in invalid.problems]
    except Exception as other:  # fmpy raises what its parts raise: ValueError, KeyError, BadZipFile, XMLSyntaxError, …
        return [str(other) or type(other).__name__]
    return []


def _ask_for_file(path: Path) -> None:
    if path.is_file():
        return
    if path.exists():
        raise FmuError(f"{path}: is no file; expected an FMU or an SSP archive")
    if path.suffix == ".ssp":
        raise FmuError(f"{path}: no such SSP archive: run `cargo xtask ssp` first")
    raise FmuError(f"{path}: no such FMU: run `cargo xtask fmu` first")
