"""ModelStructure: which variables are unknown, and on what they depend.

FMI 2.0 names a variable by its 1-based position, FMI 3.0 by its value reference: a key, below.
"""

from collections import Counter
from collections.abc import Iterator
from itertools import pairwise

from lxml import etree

from exo.validate.description import Description, place
from exo.validate.rule import Finding, error
from exo.validate.variable import Variable, integers
from exo.validate.versions import FMI2

INDEX = error("structure-index", "indices are positions of variables, counted from 1; in FMI 3.0 value references")
OUTPUTS = error("structure-outputs", "Outputs lists outputs only, each once")
INITIAL_ONCE = error("structure-initial-once", "InitialUnknowns lists a variable once")
INITIAL_SORTED = error("structure-initial-sorted", "InitialUnknowns are sorted by index", only="2.0")
INITIAL_UNKNOWN = error(
    "structure-initial-unknown", "InitialUnknowns are calculated: none has an exact start or is an input"
)
INITIAL_KIND = error(
    "structure-initial-kind", "dependenciesKind in InitialUnknowns is dependent or constant", only="2.0"
)
KIND = error("structure-kind", "dependenciesKind is one of the standard's words, one for each dependency")
KIND_REAL = error(
    "structure-kind-real", "a dependenciesKind other than dependent stands at Real unknowns only", only="2.0"
)
SORTED = error("structure-dependencies-sorted", "dependencies are sorted by index, without duplicates", only="2.0")
KNOWN = error(
    "structure-dependencies-known",
    "a variable depends on known ones: inputs, states, the independent variable; initially also exact ones",
    only="2.0",
)
DERIVATIVES = error(
    "structure-derivatives",
    "ContinuousStateDerivative lists derivatives of continuous variables, each once",
    only="3.0",
)
CLOCKED = error("structure-clocked-states", "ClockedState lists the variables that have a previous value", only="3.0")

KINDS = ("dependent", "constant", "fixed", "tunable", "discrete")


def findings(description: Description) -> Iterator[Finding]:
    """All of this module's rules."""
    for section in description.version.sections:
        unknowns = description.unknowns(section)
        for unknown in unknowns:
            yield from _unknown(description, section, unknown)
        yield from _list(description, section, unknowns)
    if description.version is not FMI2:
        yield from _clocked(description)


def _list(description: Description, section: str, unknowns: list[etree._Element]) -> Iterator[Finding]:
    named_by = description.version.unknown
    indices = [index for unknown in unknowns for index in integers(unknown.get(named_by)) or []]
    if not unknowns:
        return
    where = place(unknowns[0], section)
    once = {"Outputs": OUTPUTS, "InitialUnknowns": INITIAL_ONCE}
    if description.version is not FMI2:
        once |= {"Derivatives": DERIVATIVES, "ClockedStates": CLOCKED}
    for index, times in Counter(indices).items():
        if times > 1 and section in once:
            yield once[section].at(where, f"{named_by} {index} {times} times", "once")
    if section == "InitialUnknowns" and description.version is FMI2:
        for before, after in pairwise(indices):
            if after < before:
                yield INITIAL_SORTED.at(where, f"index {after} after {before}", "ascending indices")
                break


def _unknown(description: Description, section: str, unknown: etree._Element) -> Iterator[Finding]:
    named_by = description.version.unknown
    key = unknown.get(named_by, "")
    where = place(unknown, f"{section} {named_by} {key}")
    keys = integers(key) or []
    variable = description.find(keys[0]) if len(keys) == 1 else None
    if variable is None:
        yield INDEX.at(where, f"{named_by} {key}", _keys(description))
    elif section == "Outputs" and variable.causality != "output":
        yield OUTPUTS.at(where, f"{variable.name} has causality {variable.causality}", "output")
    elif section == "InitialUnknowns" and (variable.has_start or variable.causality == "independent"):
        value = f"{variable.name}: causality {variable.causality}, initial {variable.initial or 'none'}"
        yield INITIAL_UNKNOWN.at(where, value, "initial calculated or approx")
    elif section == "Derivatives" and description.version is not FMI2:
        yield from _derivative(description, where, variable)
    dependencies = integers(unknown.get("dependencies"))
    for one in dependencies or []:
        known = description.find(one)
        if known is None:
            yield INDEX.at(where, f"dependency {one}", _keys(description))
        elif description.version is FMI2 and not _is_known(description, section, known):
            value = f"depends on {known.name}, causality {known.causality}, initial {known.initial or 'none'}"
            yield KNOWN.at(where, value, "a known variable")
    if description.version is FMI2 and dependencies and any(a >= b for a, b in pairwise(dependencies)):
        yield SORTED.at(where, f"dependencies {unknown.get('dependencies')}", "ascending indices")
    yield from _kinds(description, section, unknown, variable, dependencies)


def _keys(description: Description) -> str:
    return f"1 to {len(description.variables)}" if description.version is FMI2 else "a variable's value reference"


def _derivative(description: Description, where: str, variable: Variable) -> Iterator[Finding]:
    keys = integers(variable.type.get("derivative")) or []
    state = description.find(keys[0]) if len(keys) == 1 else None
    if state is None:
        yield DERIVATIVES.at(where, f"{variable.name} is the derivative of no variable", "a derivative")
    elif state.variability != "continuous" or state.causality not in ("local", "output"):
        value = f"{state.name}, whose derivative it is, is {state.variability} with causality {state.causality}"
        yield DERIVATIVES.at(where, value, "a continuous variable, local or output")


def _clocked(description: Description) -> Iterator[Finding]:
    """ClockedState against the attribute previous: both say which variables are clocked states."""
    listed = {
        key: one for one in description.unknowns("ClockedStates") for key in integers(one.get("valueReference")) or []
    }
    have = {v.reference: v for v in description.variables if "previous" in v.own and v.reference is not None}
    for key, element in listed.items():
        variable = description.find(key)
        if key not in have and variable is not None:
            where = place(element, f"ClockedState valueReference {key}")
            yield CLOCKED.at(where, f"{variable.name} has no previous", "a variable with the attribute previous")
    for key, variable in have.items():
        if key not in listed:
            yield CLOCKED.at(variable.where, "has previous, but no ClockedState", "an entry in ModelStructure")


def _kinds(
    description: Description,
    section: str,
    unknown: etree._Element,
    variable: Variable | None,
    dependencies: list[int] | None,
) -> Iterator[Finding]:
    text = unknown.get("dependenciesKind")
    if text is None:
        return
    kinds = text.split()
    named_by = description.version.unknown
    where = place(unknown, f"{section} {named_by} {unknown.get(named_by)}")
    if len(kinds) != len(dependencies or []):
        yield KIND.at(where, f"{len(kinds)} kinds", f"{len(dependencies or [])}, one for each dependency")
    for kind in dict.fromkeys(kinds):
        if kind not in KINDS:
            yield KIND.at(where, kind, f"one of {', '.join(KINDS)}")
        elif description.version is not FMI2:
            continue
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
