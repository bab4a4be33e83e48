"""The archive: read without trusting it. Nothing is extracted before all names and sizes have been checked."""

import re
import stat
import zipfile
import zlib
from collections import Counter
from collections.abc import Iterator, Mapping
from contextlib import ExitStack
from dataclasses import dataclass
from pathlib import Path, PurePosixPath

from exo.errors import FmuError
from exo.validate.rule import Finding, Severity, error, printable, warning

DESCRIPTION = "modelDescription.xml"
#: Extensions of the documents of an SSP archive.
DOCUMENTS = (".ssd", ".ssv", ".ssm", ".ssb")

READABLE = error(
    "archive-readable", "the file is a ZIP archive whose entries can all be read, unencrypted, with good checksums"
)
METHOD = error("archive-method", "entries are stored or deflated")
SIZE = error("archive-size", "no entry and no total is larger than any real FMU, nor compressed beyond belief")
DUPLICATE = error("archive-duplicate", "no name occurs twice")
PATH = error(
    "archive-path",
    "names are relative and stay in the archive: no `..`, leading slash, drive, empty part, control character",
)
BACKSLASH = error("archive-backslash", "names use forward slashes")
LENGTH = error(
    "archive-length", "no name is longer than 1000 bytes, and no part of one than 255: systems cannot extract it"
)
LINK = error("archive-link", "entries are files and folders, not links, pipes or devices")
ASCII = error("archive-ascii", "names are printable ASCII")
CASE = error("archive-case", "names stay unique when case is folded, and no file is also a folder")
WINDOWS = warning(
    "archive-windows",
    "Windows can have files of these names: no device, no sign that means something there, no blank or dot at the end",
)
EXTENSION = warning("archive-extension", "the file is called .fmu, an SSP archive .ssp")
DESCRIBED = error(
    "archive-description", "modelDescription.xml, in an SSP archive SystemStructure.ssd, lies at the root"
)

#: Largest number of entries, bytes of one entry, bytes of all, bytes of the description. Real FMUs with maps and data
#: reach hundreds of megabytes; a description of 100 000 variables has about 30 MB.
MAX_ENTRIES, MAX_ENTRY, MAX_TOTAL, MAX_DESCRIPTION = 50_000, 1 << 30, 2 << 30, 128 << 20
#: Deflate reaches 1032:1 on constant bytes; tables and text reach 50:1. Judged from a megabyte on.
MAX_RATIO, RATIO_FROM = 500, 1 << 20


#: Longest part of a name: that of all common file systems. Longest name: leaves room for a folder before it.
MAX_PART, MAX_NAME = 255, 1000
#: Parts of names that Windows refuses or changes: its own devices, signs with a meaning, blanks and dots at the end.
#: The parts `.` and `..` are the path's matter.
FOREIGN = re.compile(r'(?i)^(con|prn|aux|nul|com\d|lpt\d)(\..*)?$|[<>"|?*:]|[^. ][. ]+$')
#: What is wrong, yet does not hinder reading: the other rules are asked all the same.
READABLE_STILL = frozenset((BACKSLASH.id, ASCII.id))


@dataclass(frozen=True)
class Contents:
    """The entries of an archive that is safe to read. Names have forward slashes, whatever the archive has."""

    archive: zipfile.ZipFile
    #: Files by name, in the archive's order; folders are left out.
    files: Mapping[str, zipfile.ZipInfo]
    #: Names of folders, those that only files imply too.
    folders: frozenset[str]

    def read(self, name: str) -> bytes:
        """The bytes of a file."""
        return self.archive.read(self.files[name])

    def extract(self, folder: Path) -> None:
        """Writes all files below `folder`; raises FmuError when the system refuses, as a full disk does."""
        try:
            for name in self.files:
                target = folder.joinpath(*PurePosixPath(name).parts)
                target.parent.mkdir(parents=True, exist_ok=True)
                target.write_bytes(self.read(name))
            for name in self.folders:
                folder.joinpath(*PurePosixPath(name).parts).mkdir(parents=True, exist_ok=True)
        except (OSError, ValueError) as problem:
            raise FmuError(f"{self.archive.filename}: cannot be extracted into {folder}: {problem}") from problem


def open_archive(
    path: Path, stack: ExitStack, *, extension: str = ".fmu", described: str = DESCRIPTION
) -> tuple[Contents | None, list[Finding]]:
    """What the archive holds, or None when it is not safe to go on, and what is wrong with it.

    `described` is the file that must lie at the root. The archive stays open until the stack is left.
    """
    found: list[Finding] = []
    if path.suffix != extension:
        found.append(EXTENSION.at("file name", path.suffix or "no extension", extension))
    try:
        archive = stack.enter_context(zipfile.ZipFile(path))
        entries = {entry: _name(entry) for entry in archive.infolist()}
        for judge in (_sizes, _each, _together):
            found += judge(entries)
            if _hinders(found):
                return None, found
        found += _readable(archive, entries)
    except (zipfile.BadZipFile, OSError, ValueError, NotImplementedError, EOFError) as problem:
        found.append(READABLE.at("archive", problem, "a ZIP archive"))
    if _hinders(found):
        return None, found
    contents = Contents(
        archive=archive,
        files={name: entry for entry, name in entries.items() if not name.endswith("/")},
        folders=frozenset(folder for name in entries.values() for folder in _folders(name)),
    )
    if described not in contents.files:
        deeper = [name for name in contents.files if name.casefold().split("/")[-1] == described.casefold()]
        found.append(DESCRIBED.at("archive", f"found only {deeper[0]}" if deeper else "missing", described))
        return None, found
    return contents, found


#: Entries with their names.
Entries = Mapping[zipfile.ZipInfo, str]


def _name(entry: zipfile.ZipInfo) -> str:
    """The name with forward slashes. orig_filename: zipfile cuts names at NUL and, on Windows, turns backslashes."""
    return entry.orig_filename.replace("\\", "/")


def _hinders(found: list[Finding]) -> bool:
    """Whether any of them makes it unsafe or impossible to read on."""
    return any(finding.severity is Severity.ERROR and finding.rule not in READABLE_STILL for finding in found)


def _sizes(entries: Entries) -> Iterator[Finding]:
    if len(entries) > MAX_ENTRIES:
        yield SIZE.at("archive", f"{len(entries)} entries", f"at most {MAX_ENTRIES}")
    total = sum(entry.file_size for entry in entries)
    if total > MAX_TOTAL:
        yield SIZE.at("archive", f"{total} bytes when extracted", f"at most {MAX_TOTAL}")
    for entry, name in entries.items():
        limit = MAX_DESCRIPTION if name == DESCRIPTION or name.endswith(DOCUMENTS) else MAX_ENTRY
        if entry.file_size > limit:
            yield SIZE.at(printable(name), f"{entry.file_size} bytes", f"at most {limit}")
        elif entry.file_size > max(RATIO_FROM, MAX_RATIO * entry.compress_size):
            value = f"{entry.file_size} bytes out of {entry.compress_size}"
            yield SIZE.at(printable(name), value, f"at most {MAX_RATIO} to one")


def _each(entries: Entries) -> Iterator[Finding]:
    for entry, name in entries.items():
        yield from _entry(entry, name)


def _entry(entry: zipfile.ZipInfo, name: str) -> Iterator[Finding]:
    where = printable(name) or "an entry without a name"
    parts = name.removesuffix("/").split("/")
    if "\\" in entry.orig_filename:
        yield BACKSLASH.at(where, entry.orig_filename, "forward slashes")
    if not name.isascii() or not name.isprintable():
        yield ASCII.at(where, ascii(name), "printable ASCII")
    if name.startswith("/") or name[1:2] == ":" or any(part in ("", ".", "..") for part in parts):
        yield PATH.at(where, name or "an empty name", "a relative name without `..`, `.` and empty parts")
    elif not name.isprintable():
        yield PATH.at(where, ascii(name), "a name without control characters")
    longest = max(_bytes(part) for part in parts)
    if longest > MAX_PART or _bytes(name) > MAX_NAME:
        value = f"{longest} bytes in one part, {_bytes(name)} in all"
        yield LENGTH.at(where, value, f"at most {MAX_PART} and {MAX_NAME} bytes")
    mode = entry.external_attr >> 16
    if stat.S_ISLNK(mode):
        yield LINK.at(where, "a symbolic link", "a file")
    elif stat.S_IFMT(mode) not in (0, stat.S_IFREG, stat.S_IFDIR):
        yield LINK.at(where, "neither a file nor a folder", "a file")
    if any(FOREIGN.search(part) for part in parts):
        yield WINDOWS.at(where, name, "a name that Windows can have, too")
    if entry.flag_bits & 1:
        yield READABLE.at(where, "encrypted", "an entry that anybody can read")
    if entry.compress_type not in (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED):
        yield METHOD.at(where, f"compression method {entry.compress_type}", "0 (stored) or 8 (deflated)")


def _together(entries: Entries) -> Iterator[Finding]:
    for name, times in Counter(entries.values()).items():
        if times > 1:
            yield DUPLICATE.at(printable(name), f"{times} entries", "one")
    files = {name for name in entries.values() if not name.endswith("/")}
    folders = {folder for name in entries.values() for folder in _folders(name)}
    for name in sorted(files & folders):
        yield CASE.at(printable(name), "a file and a folder", "one of them")
    spelt: dict[str, str] = {}
    for name in sorted(files | folders):
        other = spelt.setdefault(name.casefold(), name)
        if other != name:
            yield CASE.at(printable(name), f"also {printable(other)}", "names that differ by more than case")


def _readable(archive: zipfile.ZipFile, entries: Entries) -> Iterator[Finding]:
    for entry, name in entries.items():
        try:
            with archive.open(entry) as file:
                while file.read(1 << 20):
                    pass
        except (zipfile.BadZipFile, zlib.error, OSError, EOFError, ValueError, RuntimeError) as problem:
            yield READABLE.at(printable(name), problem or type(problem).__name__, "an entry that can be read")


def _bytes(name: str) -> int:
    """The length as a file system counts."""
    return len(name.encode())


def _folders(name: str) -> Iterator[str]:
    """The folders that an entry's name implies."""
    for parent in PurePosixPath(name if not name.endswith("/") else f"{name}x").parents:
        if str(parent) not in (".", "/"):
            yield str(parent)
