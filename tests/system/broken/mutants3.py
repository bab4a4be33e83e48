"""Mutants of the FMI 3.0 FMU in C: description, terminals, sources, folders."""

from collections.abc import Callable
from typing import Any

from broken.moving import BEHAVIOUR, MOVING3, RUN3
from broken.mutants import Mutant, edit, insert, put, remove, rename, xml
from broken.parts import BUILD, TERMINALS, Parts


def typed(name: str) -> str:
    """The path of a variable."""
    return f"ModelVariables/*[@name='{name}']"


def drop(path: str) -> Callable[[Parts], None]:
    """Removes an element of the description."""
    return lambda parts: parts.drop(path)


def terminals(path: str, **how: Any) -> Callable[[Parts], None]:
    """Changes an element of the terminals."""
    return lambda parts: parts.edit(path, file=TERMINALS, **how)


def build(path: str, **how: Any) -> Callable[[Parts], None]:
    """Changes an element of the build description."""
    return lambda parts: parts.edit(path, file=BUILD, **how)


def mutant(rule: str, what: str, change: Callable[[Parts], Any], *, fmpy: bool | None = False) -> Mutant:
    """A mutant of the FMI 3.0 FMU."""
    return Mutant(rule, f"{what}, {MOVING3}", change, MOVING3, fmpy=fmpy)


def scheduled(parts: Parts) -> None:
    """Neither co-simulation nor anything else."""
    parts.edit("CoSimulation", tag="ModelExchange", remove=tuple(FLAGS))


FLAGS = (
    "canHandleVariableCommunicationStepSize",
    "fixedInternalStepSize",
    "hasEventMode",
    "providesIntermediateUpdate",
    "canReturnEarlyAfterIntermediateUpdate",
)
OUTPUT = "ModelStructure/Output"
SECOND_TIME = '<Float64 name="t" valueReference="99" description="d" causality="independent"/>'

HEAD3 = [
    mutant("fmpy", "an output is missing", drop(f"{OUTPUT}[@valueReference='5']"), fmpy=True),
    mutant("fmpy", "an unknown is missing", drop("ModelStructure/InitialUnknown[@valueReference='3']"), fmpy=True),
    mutant("fmpy", "FMI 2.0's guid", edit(".", guid="{moving}"), fmpy=True),
    mutant("fmpy", "FMI 2.0's ScalarVariable", edit(typed("k"), tag="ScalarVariable"), fmpy=True),
    mutant("head-co-simulation", "model exchange only", scheduled),
    mutant("head-model-identifier", "a hyphen", edit("CoSimulation", modelIdentifier="Moving-1")),
    mutant("head-guid", "an empty token", edit(".", instantiationToken="")),
    mutant("head-state", "serialized, not got", edit("CoSimulation", canGetAndSetFMUState="false")),
    mutant("head-fixed-step", "no step", edit("CoSimulation", fixedInternalStepSize="0")),
    mutant("head-fixed-step", "an endless one", edit("CoSimulation", fixedInternalStepSize="INF")),
    mutant(
        "head-step-size",
        "none said",
        lambda p: (
            p.edit("CoSimulation", remove=("canHandleVariableCommunicationStepSize", "fixedInternalStepSize")),
            p.edit("DefaultExperiment", remove=("stepSize",)),
        ),
    ),
    mutant("head-early-return", "no intermediate update", edit("CoSimulation", remove=("providesIntermediateUpdate",))),
    mutant("head-event-mode", "a Clock that cannot tick", edit("CoSimulation", hasEventMode="false")),
]
VARIABLES3 = [
    mutant("variable-name-once", "an alias called as a variable", edit(f"{typed('x')}/Alias", name="u"), fmpy=True),
    mutant("variable-case", "an alias that differs by case", edit(f"{typed('x')}/Alias", name="U")),
    mutant("variable-name", "an alias of blanks", edit(f"{typed('x')}/Alias", name=" "), fmpy=None),
    mutant("variable-structured", "an alias", edit(f"{typed('x')}/Alias", name="x-mm"), fmpy=True),
    mutant("variable-reference-once", "two with one", edit(typed("k"), valueReference="0"), fmpy=True),
    mutant("variable-reference", "33 bits", edit(typed("on"), valueReference=str(1 << 32)), fmpy=True),
    mutant("variable-time", "two of them", insert("ModelVariables", SECOND_TIME), fmpy=True),
    mutant("variable-time", "none", drop(typed("time")), fmpy=True),
    mutant("variable-time", "a discrete one", edit(typed("time"), variability="discrete"), fmpy=True),
    mutant("variable-input-initial", "time with initial", edit(typed("time"), initial="exact"), fmpy=None),
    mutant("variable-intermediate", "a parameter", edit(typed("k"), intermediateUpdate="true")),
    mutant("variable-multiple-set", "no model exchange", edit(typed("u"), canHandleMultipleSetPerTimeInstant="true")),
    mutant("variable-description", "none", edit(typed("k"), remove=("description",))),
    mutant(
        "variable-display-unit",
        "an alias without unit",
        lambda p: (
            p.edit(typed("k"), remove=("unit",)),
            p.insert(typed("k"), '<Alias name="k_mm" displayUnit="mm"/>'),
        ),
        fmpy=None,
    ),
    mutant("variable-type", "none of this name", edit(typed("u"), declaredType="Sped"), fmpy=True),
    mutant("variable-type", "one of another kind", edit(typed("u"), declaredType="Mode"), fmpy=None),
    mutant("type-name", "called like a variable", edit("TypeDefinitions/EnumerationType", name="k"), fmpy=None),
    mutant(
        "type-items",
        "two with one value",
        edit("TypeDefinitions/EnumerationType/Item[@name='on']", value="1"),
        fmpy=None,
    ),
    mutant("variable-bounds", "of a type", edit("TypeDefinitions/Float64Type", min="20")),
    mutant("variable-start-kind", "half an Int32", edit(typed("ticks"), start="0.5"), fmpy=True),
    mutant("variable-start-kind", "a negative size", edit(typed("size"), start="-2"), fmpy=True),
    mutant("variable-start-kind", "half a byte", edit(f"{typed('blob')}/Start", value="0"), fmpy=None),
    mutant("variable-start-range", "an element", edit(typed("u"), start="0 11")),
    mutant("variable-start-item", "none of this value", edit(typed("mode"), start="3")),
    mutant("variable-start-finite", "an element", edit(typed("u"), start="0 NaN")),
    mutant("variable-start-calculated", "an output", edit(typed("steps"), start="0"), fmpy=True),
    mutant("variable-start-calculated", "time", edit(typed("time"), start="0"), fmpy=True),
    mutant("variable-start-count", "three for two", edit(typed("u"), start="0 0 0")),
    mutant("variable-start-count", "an empty attribute", edit(typed("k"), start="")),
    mutant(
        "dimension-total", "more bytes than there are", insert(typed("k"), '<Dimension start="18446744073709551615"/>')
    ),
    mutant(
        "dimension-total",
        "of two that are not too large",
        lambda p: (
            p.insert(typed("k"), '<Dimension start="100000"/>'),
            p.insert(typed("k"), '<Dimension start="100000"/>'),
        ),
    ),
    mutant("dimension-total", "by a structural parameter", edit(typed("size"), start=str(1 << 40))),
    mutant("dimension-size", "both", edit(f"{typed('u')}/Dimension", start="2")),
    mutant("dimension-size", "neither", edit(f"{typed('u')}/Dimension", remove=("valueReference",)), fmpy=True),
    mutant("dimension-size", "none at all", edit(f"{typed('u')}/Dimension", remove=("valueReference",), start="0")),
    mutant("dimension-reference", "a gain", edit(f"{typed('u')}/Dimension", valueReference="1")),
    mutant("dimension-reference", "no variable", edit(f"{typed('u')}/Dimension", valueReference="77"), fmpy=None),
    mutant("dimension-reference", "no axis at the beginning", edit(typed("size"), start="0")),
    mutant("dimension-none", "of the size", insert(typed("size"), '<Dimension start="1"/>')),
    mutant("clock-reference", "a gain", edit(typed("ticks"), clocks="1")),
    mutant("clock-reference", "no variable", edit(typed("ticks"), clocks="77"), fmpy=None),
    mutant("clock-reference", "itself", edit(typed("tick"), clocks="11")),
    mutant("clock-reference", "a continuous variable", edit(typed("der(x)"), clocks="11")),
    mutant(
        "clock-causality", "a parameter", edit(typed("tick"), causality="parameter", variability="fixed"), fmpy=None
    ),
    mutant("clock-causality", "an output at intervals", edit(typed("tick"), causality="output"), fmpy=None),
    mutant("clock-interval", "constant without one", edit(typed("tick"), remove=("intervalDecimal",))),
    mutant("clock-interval", "triggered with one", edit(typed("tick"), intervalVariability="triggered")),
    mutant("clock-interval", "no time at all", edit(typed("tick"), intervalDecimal="0")),
    mutant(
        "clock-interval",
        "a counter without resolution",
        edit(typed("tick"), intervalCounter="1", supportsFraction="true"),
    ),
    mutant("previous-reference", "itself", edit(typed("ticks"), previous="12")),
    mutant("previous-reference", "no variable", edit(typed("ticks"), previous="77"), fmpy=None),
    mutant("previous-reference", "of another kind", edit(typed("ticks"), previous="6")),
    mutant("previous-reference", "without clocks", edit(typed("ticks"), remove=("clocks",))),
    mutant("derivative-reference", "no variable", edit(typed("der(x)"), derivative="77"), fmpy=None),
    mutant("derivative-reference", "of a scalar", edit(typed("der(x)"), derivative="1"), fmpy=None),
]
UNITS3 = [
    mutant("unit-missing", "a gain", edit(typed("k"), remove=("unit",))),
    mutant("unit-undefined", "of a type", edit("TypeDefinitions/Float64Type", unit="knot"), fmpy=True),
    mutant("unit-factor", "a kilometre", edit("UnitDefinitions/Unit[@name='m']/BaseUnit", factor="1000")),
    mutant("unit-display", "a millimetre the wrong way", edit("UnitDefinitions/Unit/DisplayUnit", factor="0.001")),
]
STRUCTURE3 = [
    mutant("structure-index", "no variable", edit(OUTPUT, valueReference="77"), fmpy=True),
    mutant("structure-index", "a dependency on none", edit(OUTPUT, dependencies="77"), fmpy=None),
    mutant("structure-outputs", "an input", edit(f"{OUTPUT}[@valueReference='5']", valueReference="0"), fmpy=True),
    mutant("structure-outputs", "twice", insert("ModelStructure", '<Output valueReference="2"/>'), fmpy=None),
    mutant(
        "structure-initial-unknown",
        "a parameter",
        insert("ModelStructure", '<InitialUnknown valueReference="1"/>'),
        fmpy=True,
    ),
    mutant("structure-initial-once", "twice", insert("ModelStructure", '<InitialUnknown valueReference="5"/>')),
    mutant(
        "structure-kind",
        "two for one",
        edit("ModelStructure/ContinuousStateDerivative", dependenciesKind="tunable tunable"),
        fmpy=True,
    ),
    mutant(
        "structure-derivatives",
        "no derivative",
        edit("ModelStructure/ContinuousStateDerivative", valueReference="2"),
        fmpy=None,
    ),
    mutant("structure-derivatives", "of a parameter", edit(typed("der(x)"), derivative="1"), fmpy=None),
    mutant("structure-clocked-states", "not listed", drop("ModelStructure/ClockedState")),
    mutant("structure-clocked-states", "no previous", edit("ModelStructure/ClockedState", valueReference="13")),
]
BESIDE3 = [
    mutant("terminals-valid", "no XML", put(TERMINALS, b'<?xml version="1.0" encoding="UTF-8"?><a>')),
    mutant("terminals-valid", "another root", terminals(".", tag="terminals")),
    mutant("terminals-valid", "no matchingRule", terminals("Terminals/Terminal", remove=("matchingRule",))),
    mutant("terminals-version", "FMI 3.1", terminals(".", fmiVersion="3.1")),
    mutant("terminals-variable", "none", terminals("Terminals/Terminal/TerminalMemberVariable", variableName="w")),
    mutant(
        "terminals-name", "two members", terminals(".//TerminalMemberVariable[@variableName='x']", memberName="speed")
    ),
    mutant(
        "terminals-name",
        "two terminals",
        lambda p: p.insert("Terminals", '<Terminal name="flange" matchingRule="sequence"/>', file=TERMINALS),
    ),
    mutant(
        "terminals-member", "none", terminals(".//TerminalMemberVariable[@variableName='x']", remove=("memberName",))
    ),
    mutant("terminals-icon", "none", remove("terminalsAndIcons/flange.png")),
    mutant("sources-description", "none", remove(BUILD)),
    mutant(
        "sources-description",
        "no configuration",
        lambda p: p.replace(BUILD, "<SourceFileSet", "<Sources/><SourceFileSet"),
        fmpy=True,
    ),
    mutant("sources-version", "FMI 3.1", build(".", fmiVersion="3.1"), fmpy=True),
    mutant("sources-identifier", "another model", build("BuildConfiguration", modelIdentifier="Other")),
    mutant("sources-file", "a file", remove("sources/moving3.c")),
    mutant("sources-file", "a folder", build(".//IncludeDirectory", name="include")),
    mutant("layout-root", "FMI 2.0's picture", put("model.png", b"\x89PNG\r\n\x1a\n")),
    mutant("layout-picture", "a JPEG", put("terminalsAndIcons/icon.png", b"\xff\xd8\xff\xe0")),
    mutant("layout-vector", "no PNG beside it", rename("terminalsAndIcons/icon.png", "terminalsAndIcons/icon.svg")),
    mutant("binary-platform", "FMI 2.0's", rename("binaries/x86_64-linux", "binaries/linux64")),
    mutant("xml-version", "FMI 3.1", xml('fmiVersion="3.0"', 'fmiVersion="3.1"'), fmpy=None),
]
MUTANTS3 = HEAD3 + VARIABLES3 + UNITS3 + STRUCTURE3 + BESIDE3 + RUN3 + BEHAVIOUR
