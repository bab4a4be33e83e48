"""One instance, run in a process of its own: does the library keep what the description says?"""

import re
import sys
from collections.abc import Collection, Iterator
from functools import partial
from itertools import chain, starmap
from math import isfinite
from pathlib import Path, PurePosixPath
from platform import machine
from struct import pack, unpack
from typing import Any

from exo.validate import behaviour, child, tasks
from exo.validate.behaviour import Verdict
from exo.validate.binaries import PLATFORMS
from exo.validate.child import Answer
from exo.validate.description import Description, listed
from exo.validate.rule import Finding, error, printable, warning
from exo.validate.values import bounds
from exo.validate.variable import Variable, number
from exo.validate.versions import FLOATS, FMI2, Version

LIBRARY = error("load-library", "the system accepts the library, provided that it has all that the library needs")
CRASH = error("load-crash", "loading, one step and freeing neither end the process nor hang")
VERSION = error("load-version", "fmi2GetVersion says 2.0, fmi2GetTypesPlatform default, fmi3GetVersion 3.0")
INSTANTIATE = error("load-instantiate", "instantiating accepts the guid, the instantiationToken, of the description")
GUID = warning("load-guid", "instantiating refuses another one")
STATUS = error("load-status", "a plain run returns fmi2OK, fmi3OK, from every call")
READ = error("load-read", "every variable can be read after initialization")
START = error("load-start", "start values in the library are those of the description; of locals, constants only")
BOUNDS = error("load-bounds", "values after initialization and after a step are finite and within min and max")
STREAMS = warning("load-streams", "nothing is written to the standard streams")


def host_platforms(version: Version = FMI2) -> tuple[str, ...]:
    """The folders of binaries/ whose libraries can be loaded here."""
    arch = {"AMD64": "x86_64", "arm64": "aarch64"}.get(machine(), machine())
    system = {"win32": "windows", "darwin": "darwin"}.get(sys.platform, sys.platform)
    pair = f"{arch}-{system}"
    old = {"x86_64-linux": "linux64", "x86_64-windows": "win64", "x86_64-darwin": "darwin64"}
    return (old[pair], pair) if pair in old and version is FMI2 else (pair,)


def library(description: Description, folder: Path) -> Path | None:
    """The library that can be loaded here, None when the archive has none for this machine."""
    for name in host_platforms(description.version):
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


def findings(
    description: Description, folder: Path, path: Path, skipped: list[str], verdicts: list[Verdict] | None = None
) -> Iterator[Finding]:
    """All of this module's rules, with `verdicts` the dynamic ones; adds to `skipped` what cannot be judged here."""
    variables = {v.index: v for v in description.variables if tasks.is_read(description, v)}
    if not (folder / "resources").exists():  # it may be a file
        (folder / "resources").mkdir()
    task = tasks.of(description, path, folder / "resources")
    answer = child.run(
        task
        | {
            "task": "load",
            "exact": [tasks.read(description, v) for v in variables.values() if _has_told_start(v)],
            "all": [tasks.read(description, v) for v in variables.values()],
        }
    )
    where = f"binaries/{PurePosixPath(path.relative_to(folder / 'binaries').as_posix())}"
    for refusal in answer.facts("refused"):
        if lacking := missing(refusal):
            skipped.append(f"loading: {where} needs {printable(lacking)}, which this machine lacks")
        else:
            yield LIBRARY.at(where, refusal.replace(str(path), path.name), "a library that can be loaded")
    yield from _calls(description, answer, where)
    for index, value in chain.from_iterable(answer.facts("exact")):
        yield from _start(variables[index], value)
    read = {v.index: v for v in variables.values()}
    for moment in ("initialized", "stepped"):
        for index, value in chain.from_iterable(answer.facts(moment)):
            yield from _value(description, read, index, value, moment)
    if verdicts is not None:
        broken = bool(answer.ended) or answer.facts("instantiated") != [True]
        yield from behaviour.findings(description, task, where, verdicts, broken=broken)


def _calls(description: Description, answer: Answer, where: str) -> Iterator[Finding]:
    if answer.ended:
        yield CRASH.at(where, answer.end, "a run to its end")
    prefix, token = description.version.prefix, description.version.token
    for fact, expected in (("version", description.version.name), ("types", "default")):
        for value in answer.facts(fact):
            if value != expected:
                yield VERSION.at(where, f"{fact} {value!r}", repr(expected))
    if answer.facts("instantiated") == [False]:
        yield INSTANTIATE.at(where, "refused", f"an instance for the {token} of the description")
    if answer.facts("other guid accepted") == [True]:
        yield GUID.at(where, f"accepted another {token} than the description's", "NULL")
    refused = dict.fromkeys(
        tuple(status) for status in answer.facts("status") if not status[0].startswith(f"{prefix}Get")
    )
    for name, status in refused:
        yield STATUS.at(where, f"{name} returned {prefix}{status}", f"{prefix}OK")
    if answer.output and not answer.ended.startswith("ended with"):
        yield STREAMS.at(where, f"wrote {answer.output.strip()!r}", "silence")


def _start(variable: Variable, value: Any) -> Iterator[Finding]:
    texts = variable.starts or ()
    if value is None:
        yield READ.at(variable.where, "cannot be read in initialization mode", "the start value")
        return
    values = value if isinstance(value, list) else [value]
    given = texts * len(values) if len(texts) == 1 else texts
    if len(given) == len(values) and not all(starmap(partial(_equal, variable.kind), zip(given, values, strict=True))):
        said = " ".join(texts)
        yield START.at(variable.where, f"start {said!r}, but the library has {value!r}", "the same value")


def _equal(kind: str, text: str, value: Any) -> bool:
    if kind in ("String", "Binary"):
        return bool(value == (text if kind == "String" else text.strip().lower()))
    if kind == "Boolean":
        return bool(value) == (text.strip() in ("true", "1"))
    if kind in FLOATS:
        return bool(_as_stored(kind, number(text)) == value)
    return bool(text.strip().lstrip("+-").isdigit() and int(text) == value)


def _as_stored(kind: str, value: float | None) -> float | None:
    """What is left of a number in a variable of this kind."""
    try:
        return float(unpack("f", pack("f", value))[0]) if kind == "Float32" and value is not None else value
    except OverflowError:
        return None


def _value(
    description: Description, variables: dict[int, Variable], index: int, value: Any, moment: str
) -> Iterator[Finding]:
    """Judges a value, or an array's values, that were read; a variable is reported once."""
    variable = variables.get(index)
    if variable is None:
        return
    if value is None:
        found = READ.at(variable.where, f"cannot be read when {moment}", "a value")
    elif variable.kind in ("String", "Boolean", "Binary"):
        return
    else:
        low, high = (_as_stored(variable.kind, bound) for bound in bounds(variable))
        items = description.items(variable) if variable.kind == "Enumeration" else None
        wrong = [
            one for one in (value if isinstance(value, list) else [value]) if not _is_within(one, low, high, items)
        ]
        if not wrong:
            return
        expected = f"a finite value from {low} to {high}"
        if items is not None and wrong[0] not in items:
            expected = f"one of {listed(items)}"
        found = BOUNDS.at(variable.where, f"{wrong[0]!r} when {moment}", expected)
    del variables[index]
    yield found


def _is_within(value: Any, low: float | None, high: float | None, items: Collection[int] | None) -> bool:
    outside: bool = (low is not None and value < low) or (high is not None and value > high)
    return bool(isfinite(value)) and not outside and (items is None or value in items)


def _has_told_start(variable: Variable) -> bool:
    """Whether the library has to show the start value before initialization ends.

    An importer does not set a local variable, so the FMU may compute it as early as it likes, or not at all. A constant
    never changes.
    """
    told = variable.causality != "local" or variable.variability == "constant"
    return told and variable.has_start and variable.starts is not None
