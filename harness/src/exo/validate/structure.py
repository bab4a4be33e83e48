"""ModelStructure: which variables are unknown, and on what they depend. Indices are 1-based positions."""

from collections import Counter
from collections.abc import Iterator
from itertools import pairwise

from lxml import etree

from exo.validate.description import Description, Variable, integers, place
from exo.validate.rule import Finding, error

INDEX = error("structure-index", "indices are positions of variables, counted from 1")
OUTPUTS = error("structure-outputs", "Outputs lists outputs only, each once")
INITIAL_ONCE = error("structure-initial-once", "InitialUnknowns lists a variable once")
INITIAL_SORTED = error("structure-initial-sorted", "InitialUnknowns are sorted by index")
INITIAL_UNKNOWN = error(
    "structure-initial-unknown", "InitialUnknowns are calculated: none has an exact start or is an input"
)
INITIAL_KIND = error("structure-initial-kind", "dependenciesKind in InitialUnknowns is dependent or constant")
KIND = error("structure-kind", "dependenciesKind is one of the standard's words, one for each dependency")
KIND_REAL = error("structure-kind-real", "a dependenciesKind other than dependent stands at Real unknowns only")
SORTED = error("structure-dependencies-sorted", "dependencies are sorted by index, without duplicates")
KNOWN = error(
    "structure-dependencies-known",
    "a variable depends on known ones: inputs, states, the independent variable; initially also exact ones",
)

KINDS = ("dependent", "constant", "fixed", "tunable", "discrete")


def findings(description: Description) -> Iterator[Finding]:
    """All of this module's rules."""
    for section in ("Outputs", "Derivatives", "InitialUnknowns"):
        unknowns = description.all(f"ModelStructure/{section}/Unknown")
        for unknown in unknowns:
            yield from _unknown(description, section, unknown)
        yield from _list(section, unknowns)


def _list(section: str, unknowns: list[etree._Element]) -> Iterator[Finding]:
    indices = [index for unknown in unknowns for index in integers(unknown.get("index")) or []]
    if not unknowns:
        return
    where = place(unknowns[0], section)
    for index, times in Counter(indices).items():
        if times > 1 and section != "Derivatives":
            rule = OUTPUTS if section == "Outputs" else INITIAL_ONCE
            yield rule.at(where, f"index {index} {times} times", "once")
    if section == "InitialUnknowns":
        for before, after in pairwise(indices):
            if after < before:
                yield INITIAL_SORTED.at(where, f"index {after} after {before}", "ascending indices")
                break


def _unknown(description: Description, section: str, unknown: etree._Element) -> Iterator[Finding]:
    variables = description.variables
    index = unknown.get("index", "")
    where = place(unknown, f"{section} index {index}")
    positions = integers(index) or []
    variable = _at(variables, positions[0]) if len(positions) == 1 else None
    if variable is None:
        yield INDEX.at(where, f"index {index}", f"1 to {len(variables)}")
    elif section == "Outputs" and variable.causality != "output":
        yield OUTPUTS.at(where, f"{variable.name} has causality {variable.causality}", "output")
    elif section == "InitialUnknowns" and (variable.has_start or variable.causality == "independent"):
        value = f"{variable.name}: causality {variable.causality}, initial {variable.initial or 'none'}"
        yield INITIAL_UNKNOWN.at(where, value, "initial calculated or approx")
    dependencies = integers(unknown.get("dependencies"))
    for one in dependencies or []:
        known = _at(variables, one)
        if known is None:
            yield INDEX.at(where, f"dependency {one}", f"1 to {len(variables)}")
        elif not _is_known(description, section, known):
            value = f"depends on {known.name}, causality {known.causality}, initial {known.initial or 'none'}"
            yield KNOWN.at(where, value, "a known variable")
    if dependencies and any(a >= b for a, b in pairwise(dependencies)):
        yield SORTED.at(where, f"dependencies {unknown.get('dependencies')}", "ascending indices")
    yield from _kinds(section, unknown, variable, dependencies)


def _kinds(
    section: str, unknown: etree._Element, variable: Variable | None, dependencies: list[int] | None
) -> Iterator[Finding]:
    text = unknown.get("dependenciesKind")
    if text is None:
        return
    kinds = text.split()
    where = place(unknown, f"{section} index {unknown.get('index')}")
    if len(kinds) != len(dependencies or []):
        yield KIND.at(where, f"{len(kinds)} kinds", f"{len(dependencies or [])}, one for each dependency")
    for kind in dict.fromkeys(kinds):
        if kind not in KINDS:
            yield KIND.at(where, kind, f"one of {', '.join(KINDS)}")
        elif section == "InitialUnknowns" and kind not in ("dependent", "constant"):
            yield INITIAL_KIND.at(where, kind, "dependent or constant")
        elif kind != "dependent" and variable is not None and variable.kind != "Real":
            yield KIND_REAL.at(where, f"{kind} for {variable.kind} {variable.name}", "dependent")


def _is_known(description: Description, section: str, variable: Variable) -> bool:
    if variable.causality in ("input", "independent"):
        return True
    if section == "InitialUnknowns":
        return variable.initial == "exact"
    return variable.index in description.states


def _at(variables: tuple[Variable, ...], index: int) -> Variable | None:
    return variables[index - 1] if 1 <= index <= len(variables) else None
