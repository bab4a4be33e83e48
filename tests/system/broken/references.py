"""Broken references: one change of those of a good FMU, and the rule that must find it."""

from collections.abc import Callable

from broken.mutants import Mutant, put, remove
from broken.parts import Parts

FOLDER = "extra/org.fmi-standard.fmi-ls-ref"
MANIFEST, EXP = f"{FOLDER}/fmi-ls-manifest.xml", f"{FOLDER}/smoke-tests.exp"
INPUT, RESULT = f"{FOLDER}/wall-in.csv", f"{FOLDER}/wall-ref.csv"
PARAMETERS = f"{FOLDER}/parameters/wall-passive_bounded_5_0.5.ssv"
WALL = '<Experiment name="wall" '


def text(entry: str, old: str, new: str) -> Callable[[Parts], None]:
    """Replaces text of an entry."""
    return lambda parts: parts.replace(entry, old, new)


def cell(entry: str, row: int, column: str, new: str) -> Callable[[Parts], None]:
    """Another text in a cell; row 1 is the header."""

    def change(parts: Parts) -> None:
        lines = parts.entries[entry].decode().splitlines()
        cells = lines[row - 1].split(",")
        cells[lines[0].split(",").index(column)] = new
        lines[row - 1] = ",".join(cells)
        parts.entries[entry] = ("\n".join(lines) + "\n").encode()

    return change


def line(entry: str, row: int, new: str) -> Callable[[Parts], None]:
    """Another line."""

    def change(parts: Parts) -> None:
        lines = parts.entries[entry].decode().splitlines()
        lines[row - 1] = new
        parts.entries[entry] = ("\n".join(lines) + "\n").encode()

    return change


def without_tolerance(parts: Parts) -> None:
    """No experiment states one."""
    parts.entries[EXP] = parts.entries[EXP].replace(b' tolerance="1e-06"', b"")


FILES = [
    Mutant("reference-xml", "half a manifest", lambda p: p.entries.update({MANIFEST: p.entries[MANIFEST][:400]})),
    Mutant("reference-xml", "an entity", text(EXP, "<Experiments", '<!DOCTYPE x [<!ENTITY a "b">]><Experiments')),
    Mutant("reference-xml", "a parameter set that is none", put(PARAMETERS, b"K = 30")),
    Mutant("reference-manifest", "an unknown role", text(MANIFEST, 'role="result"', 'role="results"')),
    Mutant(
        "reference-manifest",
        "a purpose that no role has",
        text(MANIFEST, "experiment/smoke-test", "experiment/unit-test"),
    ),
    Mutant("reference-manifest", "another standard's", text(MANIFEST, '"org.fmi-standard.fmi-ls-ref"', '"org.other"')),
    Mutant("reference-manifest", "no file", text(MANIFEST, 'source="requirements.md" ', "")),
    Mutant("reference-manifest", "an unknown element", text(MANIFEST, "<Label ", "<Tag ")),
    Mutant("reference-related", "no requirements", remove(f"{FOLDER}/requirements.md")),
    Mutant("reference-missing", "no inputs", remove(INPUT)),
    Mutant("reference-missing", "no results", remove(RESULT)),
    Mutant("reference-missing", "out of the archive", text(EXP, '"wall-in.csv"', '"../../../wall-in.csv"')),
    Mutant("reference-experiment", "no name", text(EXP, WALL, "<Experiment ")),
    Mutant("reference-experiment", "a second one of the name", text(EXP, WALL, WALL.replace("wall", "free_motion"))),
    Mutant("reference-experiment", "it ends before it begins", text(EXP, 'stopTime="2.4"', 'stopTime="-1"')),
    Mutant("reference-experiment", "no step", text(EXP, 'stepSize="0.002"', 'stepSize="0"')),
    Mutant("reference-experiment", "a step for ever", text(EXP, 'stepSize="0.002"', 'stepSize="1e-30"')),
    Mutant("reference-experiment", "a tolerance that is no number", text(EXP, '"1e-06"', '"NaN"')),
    Mutant("reference-experiment", "two kinds", text(EXP, "<Parameters", "<SteadyState/><Parameters")),
    Mutant("reference-experiment", "no file's address", text(EXP, 'source="wall-in.csv"', 'file="wall-in.csv"')),
]
TABLES = [
    Mutant("reference-series", "NaN", cell(INPUT, 7, "q", "nan")),
    Mutant("reference-series", "a word", cell(RESULT, 7, "tau_a", "much")),
    Mutant("reference-series", "a short row", line(RESULT, 9, "0.28,1.5")),
    Mutant("reference-series", "back in time", cell(INPUT, 9, "time", "0.001")),
    Mutant("reference-series", "semicolons", lambda p: p.entries.update({INPUT: p.entries[INPUT].replace(b",", b";")})),
    Mutant("reference-series", "a header alone", put(RESULT, b"time,tau_a\n")),
    Mutant("reference-series", "a column twice", line(RESULT, 1, "time,tau_a,tau_a,q_n,dq_n,e_nr,saturated,a,b")),
    Mutant("reference-series", "after the end", text(EXP, 'stopTime="2.4"', 'stopTime="1.2"')),
    Mutant("reference-series", "no text", put(RESULT, b"\xff\xfe\x00")),
    Mutant("reference-variable", "an unknown result", line(RESULT, 1, "time,a,b,c,d,e,f,g,h")),
    Mutant("reference-variable", "an unknown input", line(INPUT, 1, "time,q,tau_hand")),
    Mutant("reference-variable", "an element of no vector", line(INPUT, 1, "time,q[1],tau_h")),
    Mutant("reference-variable", "an output as input", line(INPUT, 1, "time,q,tau_a")),
    Mutant("reference-parameter", "a word", text(PARAMETERS, '"30.0"', '"high"')),
    Mutant("reference-parameter", "infinity", text(PARAMETERS, '"30.0"', '"inf"')),
    Mutant(
        "reference-parameter",
        "a fraction of a choice",
        text(PARAMETERS, 'Integer value="4"/', 'Integer value="4.5"/'),
    ),
    Mutant("reference-parameter", "an output", text(PARAMETERS, 'name="K"', 'name="tau_a"')),
    Mutant("reference-parameter", "no value", text(PARAMETERS, 'value="30.0"', "")),
    Mutant("reference-parameter-unknown", "a misspelt one", text(PARAMETERS, 'name="K_P"', 'name="K_p"')),
    Mutant("reference-unit", "grams", text(PARAMETERS, 'unit="kg"', 'unit="g"')),
]
PLAYED = [
    Mutant("reference-run", "a parameter that the FMU refuses", text(PARAMETERS, '"30.0"', '"-1"')),
    Mutant("reference-result", "another number", cell(RESULT, 20, "tau_a", "99")),
    Mutant("reference-result", "another millionth", cell(RESULT, 61, "q_n", "0.09179")),
    Mutant("reference-result", "another input", cell(INPUT, 500, "q", "0.3")),
    Mutant("reference-result", "another parameter", text(PARAMETERS, '"30.0"', '"30.01"')),
    Mutant("reference-result", "another truth", cell(RESULT, 20, "saturated", "1")),
    Mutant(
        "reference-result-unstated",
        "another number, no tolerance",
        lambda p: (without_tolerance(p), cell(RESULT, 20, "tau_a", "99")(p)),
    ),
]
REFERENCES = FILES + TABLES + PLAYED
