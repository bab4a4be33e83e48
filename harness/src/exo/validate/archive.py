"""The archive: read without trusting it. Nothing is extracted before all names and sizes have been checked."""

import stat
import zipfile
import zlib
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path, PurePosixPath

from exo.validate.rule import Finding, error, printable, warning

DESCRIPTION = "modelDescription.xml"

READABLE = error(
    "archive-readable", "the file is a ZIP archive whose entries can all be read, unencrypted, with good checksums"
)
METHOD = error("archive-method", "entries are stored or deflated")
SIZE = error("archive-size", "no entry and no total is larger than any real FMU, nor compressed beyond belief")
DUPLICATE = error("archive-duplicate", "no name occurs twice")
PATH = error(
    "archive-path", "names are relative and stay in the archive: no `..`, no leading slash, no drive, no empty part"
)
BACKSLASH = error("archive-backslash", "names use forward slashes")
LINK = error("archive-link", "entries are files and folders, not links")
ASCII = error("archive-ascii", "names are printable ASCII")
CASE = error("archive-case", "names stay unique when case is folded, and no file is also a folder")
EXTENSION = warning("archive-extension", "the file is called .fmu")
DESCRIBED = error("archive-description", "modelDescription.xml lies at the root")

#: Largest number of entries, bytes of one entry, bytes of all, bytes of the description. Real FMUs with maps and data
#: reach hundreds of megabytes; a description of 100 000 variables has about 30 MB.
MAX_ENTRIES, MAX_ENTRY, MAX_TOTAL, MAX_DESCRIPTION = 50_000, 1 << 30, 2 << 30, 128 << 20
#: Deflate reaches 1032:1 on constant bytes; tables and text reach 50:1. Judged from a megabyte on.
MAX_RATIO, RATIO_FROM = 500, 1 << 20


@dataclass(frozen=True)
class Contents:
    """The entries of an archive that is safe to read."""

    path: Path
    #: Names of files, in the archive's order; folders are left out.
    files: tuple[str, ...]
    #: Names of folders, those that only files imply too.
    folders: frozenset[str]

    def read(self, name: str) -> bytes:
        """The bytes of a file."""
        with zipfile.ZipFile(self.path) as archive:
            return archive.read(name)

    def extract(self, folder: Path) -> None:
        """Writes all files below `folder`."""
        with zipfile.ZipFile(self.path) as archive:
            for name in self.files:
                target = folder.joinpath(*PurePosixPath(name).parts)
                target.parent.mkdir(parents=True, exist_ok=True)
                target.write_bytes(archive.read(name))
        for name in self.folders:
            folder.joinpath(*PurePosixPath(name).parts).mkdir(parents=True, exist_ok=True)


def open_archive(path: Path) -> tuple[Contents | None, list[Finding]]:
    """What the archive holds, or None when it is not safe to go on, and what is wrong with it."""
    found: list[Finding] = []
    if path.suffix != ".fmu":
        found.append(EXTENSION.at("file name", path.suffix or "no extension", ".fmu"))
    try:
        with zipfile.ZipFile(path) as archive:
            entries = archive.infolist()
            found += _sizes(entries)
            if not found_errors(found):
                found += [finding for entry in entries for finding in _entry(entry)]
                found += _together(entries)
            if not found_errors(found):
                found += _readable(archive, entries)
    except (zipfile.BadZipFile, OSError, ValueError, NotImplementedError, EOFError) as problem:
        found.append(READABLE.at("archive", problem, "a ZIP archive"))
    if found_errors(found):
        return None, found
    contents = Contents(
        path=path,
        files=tuple(entry.filename for entry in entries if not entry.is_dir()),
        folders=frozenset(folder for entry in entries for folder in _folders(entry.filename)),
    )
    if DESCRIPTION not in contents.files:
        deeper = [name for name in contents.files if name.casefold().split("/")[-1] == DESCRIPTION.casefold()]
        found.append(DESCRIBED.at("archive", f"found only {deeper[0]}" if deeper else "missing", DESCRIPTION))
        return None, found
    return contents, found


def found_errors(found: list[Finding]) -> bool:
    """Whether any of them is an error."""
    return any(finding.severity == "error" for finding in found)


def _sizes(entries: list[zipfile.ZipInfo]) -> Iterator[Finding]:
    if len(entries) > MAX_ENTRIES:
        yield SIZE.at("archive", f"{len(entries)} entries", f"at most {MAX_ENTRIES}")
    total = sum(entry.file_size for entry in entries)
    if total > MAX_TOTAL:
        yield SIZE.at("archive", f"{total} bytes when extracted", f"at most {MAX_TOTAL}")
    for entry in entries:
        limit = MAX_DESCRIPTION if entry.filename == DESCRIPTION else MAX_ENTRY
        if entry.file_size > limit:
            yield SIZE.at(printable(entry.filename), f"{entry.file_size} bytes", f"at most {limit}")
        elif entry.file_size > max(RATIO_FROM, MAX_RATIO * entry.compress_size):
            value = f"{entry.file_size} bytes out of {entry.compress_size}"
            yield SIZE.at(printable(entry.filename), value, f"at most {MAX_RATIO} to one")


def _entry(entry: zipfile.ZipInfo) -> Iterator[Finding]:
    # orig_filename: zipfile cuts names at NUL and, on Windows, turns backslashes.
    name = entry.orig_filename
    where = printable(name)
    parts = name.removesuffix("/").split("/")
    if "\\" in name:
        yield BACKSLASH.at(where, name, "forward slashes")
    if not name.isascii() or not name.isprintable():
        yield ASCII.at(where, ascii(name), "printable ASCII")
    if name.startswith("/") or name[1:2] == ":" or any(part in ("", ".", "..") for part in parts):
        yield PATH.at(where, name, "a relative name without `..`, `.` and empty parts")
    if stat.S_ISLNK(entry.external_attr >> 16):
        yield LINK.at(where, "a symbolic link", "a file")
    if entry.flag_bits & 1:
        yield READABLE.at(where, "encrypted", "an entry that anybody can read")
    if entry.compress_type not in (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED):
        yield METHOD.at(where, f"compression method {entry.compress_type}", "0 (stored) or 8 (deflated)")


def _together(entries: list[zipfile.ZipInfo]) -> Iterator[Finding]:
    for name, times in Counter(entry.filename for entry in entries).items():
        if times > 1:
            yield DUPLICATE.at(printable(name), f"{times} entries", "one")
    files = {entry.filename for entry in entries if not entry.is_dir()}
    folders = {folder for entry in entries for folder in _folders(entry.filename)}
    for name in sorted(files & folders):
        yield CASE.at(printable(name), "a file and a folder", "one of them")
    spelt: dict[str, str] = {}
    for name in sorted(files | folders):
        other = spelt.setdefault(name.casefold(), name)
        if other != name:
            yield CASE.at(printable(name), f"also {printable(other)}", "names that differ by more than case")


def _readable(archive: zipfile.ZipFile, entries: list[zipfile.ZipInfo]) -> Iterator[Finding]:
    for entry in entries:
        try:
            with archive.open(entry) as file:
                while file.read(1 << 20):
                    pass
        except (zipfile.BadZipFile, zlib.error, OSError, EOFError, ValueError, RuntimeError) as problem:
            yield READABLE.at(printable(entry.filename), problem or type(problem).__name__, "an entry that can be read")


def _folders(name: str) -> Iterator[str]:
    """The folders that an entry's name implies."""
    for parent in PurePosixPath(name if not name.endswith("/") else f"{name}x").parents:
        if str(parent) not in (".", "/"):
            yield str(parent)
