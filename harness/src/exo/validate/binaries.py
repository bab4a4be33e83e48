"""Shared libraries: which platforms there are, and what each library exports, needs and gives away."""

import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path, PurePosixPath
from typing import Any

from exo.validate import child
from exo.validate.archive import Contents
from exo.validate.description import Description, listed
from exo.validate.rule import Finding, error, warning
from exo.validate.versions import FMI2, VERSIONS, Version

PLATFORM = warning(
    "binary-platform", "folders in binaries/ are architecture-system pairs, or in FMI 2.0 the platforms of the standard"
)
NAME = error("binary-name", "each platform's folder has <modelIdentifier> with the system's extension")
NONE = error("binary-none", "there is a binary or source code, unless the FMU needs a tool")
WANTED = error("binary-wanted", "the platforms asked for with --platform are there")
FORMAT = error("binary-format", "a library is a shared library of its platform's system and machine")
EXPORTS = error(
    "binary-exports",
    "all functions of its version of FMI for co-simulation or scheduled execution are exported, supported or not",
)
EXTRA = warning("binary-extra", "nothing else is exported: the symbols of two FMUs in one process could collide")
PATHS = warning("binary-paths", "no path of the build machine's users is in the binary")
GLIBC = error("binary-glibc", "no symbol is newer than --max-glibc")
NEEDS = error("binary-needs", "with --max-glibc: only the C library's own libraries are needed")


@dataclass(frozen=True)
class Platform:
    """What a folder of binaries/ must hold; names of formats and machines as the child process gives them."""

    format: str
    machine: str
    extension: str


PLATFORMS = {
    "linux64": Platform("ELF", "x86_64", ".so"),
    "linux32": Platform("ELF", "x86", ".so"),
    "win64": Platform("PE", "x86_64", ".dll"),
    "win32": Platform("PE", "x86", ".dll"),
    "darwin64": Platform("MachO", "x86_64", ".dylib"),
    "x86-linux": Platform("ELF", "x86", ".so"),
    "x86_64-linux": Platform("ELF", "x86_64", ".so"),
    "aarch64-linux": Platform("ELF", "aarch64", ".so"),
    "x86-windows": Platform("PE", "x86", ".dll"),
    "x86_64-windows": Platform("PE", "x86_64", ".dll"),
    "aarch64-windows": Platform("PE", "aarch64", ".dll"),
    "x86_64-darwin": Platform("MachO", "x86_64", ".dylib"),
    "aarch64-darwin": Platform("MachO", "aarch64", ".dylib"),
}
#: How FMI 3.0 names any platform: architecture, system, for static libraries also ABI.
TUPLE = re.compile(
    r"(?:aarch32|aarch64|riscv32|riscv64|x86|x86_64|ppc32|ppc64)-(?:darwin|linux|windows)(?:-[a-z][a-z0-9_]*)?"
)
#: What any library may export: one may serve both versions, and all interfaces.
FUNCTIONS = frozenset(name for version in VERSIONS.values() for names in version.functions.values() for name in names)
#: Libraries that every glibc system has.
SYSTEM = re.compile(r"lib(c|m|dl|pthread|rt)\.so\.\d+|ld-linux[-_a-z0-9]*\.so\.\d+")
HOMES = re.compile(rb"(?:/home/|/Users/|/root/|[A-Za-z]:\\Users\\)[\x21-\x7e]{2,120}")


def findings(
    contents: Contents,
    description: Description,
    folder: Path,
    *,
    platforms: tuple[str, ...] = (),
    max_glibc: str | None = None,
) -> Iterator[Finding]:
    """All of this module's rules on the archive that lies extracted in `folder`."""
    # Some exporters write a folder for each platform and leave those empty that they were not asked for.
    there = sorted({name.split("/")[1] for name in contents.files if re.match(r"binaries/[^/]+/", name)})
    for wanted in platforms:
        if wanted not in there:
            yield WANTED.at(f"binaries/{wanted}", f"only {', '.join(there) or 'none'}", wanted)
    tool = description.capability("needsExecutionTool")
    if not there and not tool and not any(name.startswith("sources/") for name in contents.files):
        yield NONE.at("binaries", "no binary and no source", "a library for at least one platform")
    for name in there:
        platform = platforms_of(description.version).get(name)
        if platform is None:
            # Of the other platforms of FMI 3.0 no file is known that could be compared.
            if description.version is FMI2 or not TUPLE.fullmatch(name):
                yield PLATFORM.at(f"binaries/{name}", name, f"one of {', '.join(platforms_of(description.version))}")
            continue
        # A name that is no C identifier, as ../../evil, leads to no file of this folder.
        library = f"binaries/{name}/{description.identifier or '<modelIdentifier>'}{platform.extension}"
        if library in contents.files:
            yield from _library(library, folder, description, platform, max_glibc)
        else:
            others = [PurePosixPath(file).name for file in contents.files if file.startswith(f"binaries/{name}/")]
            yield NAME.at(f"binaries/{name}", listed(others), library)


def _library(
    library: str, folder: Path, description: Description, platform: Platform, max_glibc: str | None
) -> Iterator[Finding]:
    path = folder.joinpath(*PurePosixPath(library).parts)
    answer = child.run({"task": "inspect", "library": str(path), "machine": platform.machine})
    facts: dict[str, Any] = next(iter(answer.facts("library")), {})
    if answer.ended or facts.get("format") != platform.format or facts.get("machine") != platform.machine:
        value = answer.ended or f"{facts.get('format')} for {facts.get('machine')}"
        yield FORMAT.at(library, value, f"{platform.format} for {platform.machine}")
        return
    if not facts["shared"]:
        yield FORMAT.at(library, "no shared library, or a part of one", "a whole shared library")
        return
    exports = set(facts["exports"])
    needed = description.version.needed([name for name in description.version.interfaces if description.all(name)])
    if missing := sorted(needed - exports):
        yield EXPORTS.at(library, f"without {listed(missing)}", f"all {len(needed)} functions")
    if extra := sorted(exports - FUNCTIONS):
        yield EXTRA.at(library, f"{len(extra)} more symbols: {', '.join(extra[:5])}", "functions of the standard only")
    if homes := sorted(set(HOMES.findall(path.read_bytes()))):
        yield PATHS.at(library, homes[0].decode("ascii"), "no such path")
    if max_glibc is not None and platform.format == "ELF":
        yield from _needs(library, facts, max_glibc)


def platforms_of(version: Version) -> dict[str, Platform]:
    """The folders of binaries/ that a version knows; FMI 3.0 names them by architecture and system."""
    return PLATFORMS if version is FMI2 else {name: PLATFORMS[name] for name in PLATFORMS if TUPLE.fullmatch(name)}


def _needs(library: str, facts: dict[str, Any], max_glibc: str) -> Iterator[Finding]:
    newest = max(facts["glibc"], key=numbers, default="0")
    if numbers(newest) > numbers(max_glibc):
        yield GLIBC.at(library, f"GLIBC_{newest}", f"at most GLIBC_{max_glibc}")
    if foreign := [name for name in facts["needs"] if not SYSTEM.fullmatch(name)]:
        yield NEEDS.at(library, f"needs {', '.join(foreign)}", "libc, libm, libdl, libpthread, librt, ld-linux only")


def numbers(text: str) -> tuple[int, ...]:
    """`2.17` as numbers."""
    return tuple(int(part) for part in text.split("."))
