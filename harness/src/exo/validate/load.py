"""One instance, run in a process of its own: does the library keep what the description says?"""

import re
import sys
from collections.abc import Iterator
from itertools import chain
from math import isfinite
from pathlib import Path, PurePosixPath
from platform import machine
from typing import Any

from exo.validate import child
from exo.validate.binaries import PLATFORMS
from exo.validate.child import Answer
from exo.validate.description import Description, Variable, integers, listed, number
from exo.validate.rule import Finding, error, printable, warning

LIBRARY = error("load-library", "the system accepts the library, provided that it has all that the library needs")
CRASH = error("load-crash", "loading, one step and freeing neither end the process nor hang")
VERSION = error("load-version", "fmi2GetVersion says 2.0 and fmi2GetTypesPlatform says default")
INSTANTIATE = error("load-instantiate", "fmi2Instantiate accepts the guid of the description")
GUID = warning("load-guid", "fmi2Instantiate refuses another guid")
STATUS = error("load-status", "a plain run returns fmi2OK from every call")
READ = error("load-read", "every variable can be read after initialization")
START = error("load-start", "start values in the library are those of the description; of locals, constants only")
BOUNDS = error("load-bounds", "values after initialization and after a step are finite and within min and max")
STREAMS = warning("load-streams", "nothing is written to the standard streams")


def host_platforms() -> tuple[str, ...]:
    """The folders of binaries/ whose libraries can be loaded here."""
    arch = {"AMD64": "x86_64", "arm64": "aarch64"}.get(machine(), machine())
    system = {"win32": "windows", "darwin": "darwin"}.get(sys.platform, sys.platform)
    pair = f"{arch}-{system}"
    old = {"x86_64-linux": "linux64", "x86_64-windows": "win64", "x86_64-darwin": "darwin64"}
    return (old[pair], pair) if pair in old else (pair,)


def library(description: Description, folder: Path) -> Path | None:
    """The library that can be loaded here, None when the archive has none for this machine."""
    for name in host_platforms():
        if description.identifier is not None and name in PLATFORMS:
            path = folder / "binaries" / name / f"{description.identifier}{PLATFORMS[name].extension}"
            if path.is_file():
                return path
    return None


#: What loaders say of a library that is not there, or not new enough: glibc, glibc, musl, macOS.
MISSING = (
    re.compile(r"([^\s:]+): cannot open shared object file"),
    re.compile(r"version [`'\"]?([^`'\"\s]+)['\"]? not found"),
    re.compile(r"Error loading shared library ([^\s:]+): No such file"),
    re.compile(r"Library not loaded: (\S+)"),
)


def missing(refusal: str) -> str | None:
    """What this machine lacks, by the loader's sentence; None when the library itself is at fault."""
    return next((found[1] for sentence in MISSING if (found := sentence.search(refusal))), None)


def findings(description: Description, folder: Path, path: Path, skipped: list[str]) -> Iterator[Finding]:
    """All of this module's rules; adds to `skipped` when this machine cannot judge."""
    variables = {v.index: v for v in description.variables if v.kind and _reference(v) is not None}
    if not (folder / "resources").exists():  # it may be a file
        (folder / "resources").mkdir()
    experiment = description.first("DefaultExperiment")
    times = {} if experiment is None else {key: number(experiment.get(key)) for key in ("startTime", "stepSize")}
    step = times.get("stepSize")
    task = {
        "task": "load",
        "library": str(path),
        "guid": description.root.get("guid", ""),
        "resources": (folder / "resources").resolve().as_uri(),
        "start": times.get("startTime") or 0.0,
        "step": step if step is not None and 0.0 < step < 1e6 else 1e-3,
        "exact": [_task(v) for v in variables.values() if _has_told_start(v)],
        "all": [_task(v) for v in variables.values()],
    }
    answer = child.run(task)
    where = f"binaries/{PurePosixPath(path.relative_to(folder / 'binaries').as_posix())}"
    for refusal in answer.facts("refused"):
        if lacking := missing(refusal):
            skipped.append(f"loading: {where} needs {printable(lacking)}, which this machine lacks")
        else:
            yield LIBRARY.at(where, refusal.replace(str(path), path.name), "a library that can be loaded")
    yield from _calls(answer, where)
    for index, value in chain.from_iterable(answer.facts("exact")):
        yield from _start(variables[index], value)
    read = {v.index: v for v in variables.values()}
    for moment in ("initialized", "stepped"):
        for index, value in chain.from_iterable(answer.facts(moment)):
            yield from _value(description, read, index, value, moment)


def _calls(answer: Answer, where: str) -> Iterator[Finding]:
    if answer.ended:
        reason = answer.output.strip().splitlines()[-1:] if answer.ended.startswith("ended with") else []
        yield CRASH.at(where, "; ".join([f"{answer.last_call}: {answer.ended}", *reason]), "a run to its end")
    for fact, expected in (("version", "2.0"), ("types", "default")):
        for value in answer.facts(fact):
            if value != expected:
                yield VERSION.at(where, f"{fact} {value!r}", repr(expected))
    if answer.facts("instantiated") == [False]:
        yield INSTANTIATE.at(where, "refused", "an instance for the guid of the description")
    if answer.facts("other guid accepted") == [True]:
        yield GUID.at(where, "accepted a guid that is not the description's", "NULL")
    refused = dict.fromkeys(tuple(status) for status in answer.facts("status") if not status[0].startswith("fmi2Get"))
    for name, status in refused:
        yield STATUS.at(where, f"{name} returned fmi2{status}", "fmi2OK")
    if answer.output and not answer.ended.startswith("ended with"):
        yield STREAMS.at(where, f"wrote {answer.output.strip()!r}", "silence")


def _start(variable: Variable, value: Any) -> Iterator[Finding]:
    text = variable.type.get("start", "")
    if value is None:
        yield READ.at(variable.where, "cannot be read in initialization mode", "the start value")
    elif not _equal(variable.kind, text, value):
        yield START.at(variable.where, f"start {text!r}, but the library has {value!r}", "the same value")


def _equal(kind: str, text: str, value: Any) -> bool:
    if kind == "String":
        return bool(value == text)
    if kind == "Boolean":
        return bool(value) == (text.strip() in ("true", "1"))
    return bool(number(text) == value)


def _value(
    description: Description, variables: dict[int, Variable], index: int, value: Any, moment: str
) -> Iterator[Finding]:
    """Judges a value that was read; a variable is reported once."""
    variable = variables.get(index)
    if variable is None:
        return
    if value is None:
        found = READ.at(variable.where, f"cannot be read when {moment}", "a value")
    elif variable.kind in ("String", "Boolean"):
        return
    else:
        low, high = number(variable.type.get("min")), number(variable.type.get("max"))
        outside = (low is not None and value < low) or (high is not None and value > high)
        items = description.items(variable) if variable.kind == "Enumeration" else [value]
        if isfinite(value) and not outside and value in items:
            return
        expected = f"one of {listed(items)}" if value not in items else f"a finite value from {low} to {high}"
        found = BOUNDS.at(variable.where, f"{value!r} when {moment}", expected)
    del variables[index]
    yield found


def _has_told_start(variable: Variable) -> bool:
    """Whether the library has to show the start value before initialization ends.

    An importer does not set a local variable, so the FMU may compute it as early as it likes, or not at all. A constant
    never changes.
    """
    told = variable.causality != "local" or variable.variability == "constant"
    return told and variable.has_start and variable.type.get("start") is not None


def _task(variable: Variable) -> tuple[int, str, int]:
    kind = "Integer" if variable.kind == "Enumeration" else variable.kind
    return variable.index, kind, _reference(variable) or 0


def _reference(variable: Variable) -> int | None:
    found = integers(variable.own.get("valueReference"))
    return found[0] if found and len(found) == 1 and 0 <= found[0] < 1 << 32 else None
