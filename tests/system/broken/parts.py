"""An FMU in parts: its entries in memory, changed one at a time and written as a new archive."""

import subprocess
import warnings
import zipfile
from dataclasses import dataclass, field
from pathlib import Path

from lxml import etree

HERE = Path(__file__).parent
XML = "modelDescription.xml"
INDEX = "documentation/index.html"
TERMINALS = "terminalsAndIcons/terminalsAndIcons.xml"
BUILD = "sources/buildDescription.xml"
PAGE = b'<!DOCTYPE html><meta charset="utf-8"><title>Plain</title><p id="top">Output equals input</p>'
#: The beginning of a picture, which is all that is looked at.
PNG = b"\x89PNG\r\n\x1a\n"


@dataclass
class Parts:
    """Entries of an archive, and how they are written."""

    entries: dict[str, bytes]
    #: Entries that are written after the others, even under a name that is there.
    more: list[tuple[zipfile.ZipInfo, bytes]] = field(default_factory=list)
    #: Changes of the finished file.
    patches: list[tuple[bytes, bytes]] = field(default_factory=list)
    keep: float = 1.0
    method: int = zipfile.ZIP_DEFLATED
    extension: str = ".fmu"

    @classmethod
    def of(cls, path: Path) -> "Parts":
        """The parts of a good FMU."""
        with zipfile.ZipFile(path) as archive:
            return cls({name: archive.read(name) for name in archive.namelist()})

    @property
    def library(self) -> str:
        """The name of the library for 64-bit Linux."""
        folders = ("binaries/linux64/", "binaries/x86_64-linux/")
        return next(name for name in self.entries if name.startswith(folders) and name.endswith(".so"))

    def add(self, name: str, data: bytes = b"", *, mode: int = 0o100644) -> None:
        """Adds an entry whose name is written as it is."""
        info = zipfile.ZipInfo("placeholder")
        info.filename, info.external_attr, info.compress_type = name, mode << 16, zipfile.ZIP_DEFLATED
        self.more.append((info, data))

    def replace(self, entry: str, old: str | bytes, new: str | bytes) -> None:
        """Replaces the first occurrence in an entry; there must be one."""
        old, new = (text.encode() if isinstance(text, str) else text for text in (old, new))
        assert old in self.entries[entry], f"{old!r} is not in {entry}"
        self.entries[entry] = self.entries[entry].replace(old, new, 1)

    def edit(
        self, path: str, *, file: str = XML, remove: tuple[str, ...] = (), tag: str | None = None, **attributes: str
    ) -> None:
        """Changes attributes of the first element at `path` of the description, or of another file."""
        root = etree.fromstring(self.entries[file])
        element = root if path == "." else root.find(path)
        assert element is not None, path
        for name in remove:
            del element.attrib[name]
        for name, value in attributes.items():
            element.set(name, value)
        if tag is not None:
            element.tag = tag
        self._put(root, file)

    def insert(self, path: str, xml: str, *, file: str = XML) -> None:
        """Appends an element to the one at `path`."""
        root = etree.fromstring(self.entries[file])
        parent = root.find(path)
        assert parent is not None, path
        parent.append(etree.fromstring(xml))
        self._put(root, file)

    def drop(self, path: str) -> None:
        """Removes the first element at `path`."""
        root = etree.fromstring(self.entries[XML])
        element = root.find(path)
        assert element is not None, path
        element.getparent().remove(element)
        self._put(root)

    def rotate(self, path: str) -> None:
        """Moves the first child of the element at `path` to the end."""
        root = etree.fromstring(self.entries[XML])
        parent = root.find(path)
        assert parent is not None, path
        parent.append(parent[0])
        self._put(root)

    def write(self, folder: Path, name: str = "broken") -> Path:
        """The archive as a file."""
        path = folder / f"{name}{self.extension}"
        with zipfile.ZipFile(path, "w", self.method) as archive:
            for entry, data in self.entries.items():
                archive.writestr(entry, data)
            for info, data in self.more:
                with warnings.catch_warnings():
                    warnings.simplefilter("ignore")  # zipfile warns of duplicates, which are meant
                    archive.writestr(info, data)
        data = path.read_bytes()
        for old, new in self.patches:
            assert old in data, old
            data = data.replace(old, new)
        path.write_bytes(data[: int(len(data) * self.keep)])
        return path

    def _put(self, root: etree._Element, file: str = XML) -> None:
        self.entries[file] = etree.tostring(root, xml_declaration=True, encoding="UTF-8")


def plain(folder: Path, *macros: str) -> Parts:
    """The FMU in C, compiled with macros that break it."""
    return Parts(
        {
            XML: (HERE / "plain.xml").read_bytes(),
            INDEX: PAGE,
            "binaries/linux64/Plain.so": compiled("plain.c", folder / "Plain.so", *macros),
        }
    )


def moving2(folder: Path, *macros: str) -> Parts:
    """The FMU in C that has a state, for FMI 2.0."""
    return Parts(
        {
            XML: (HERE / "moving2.xml").read_bytes(),
            INDEX: PAGE,
            "binaries/linux64/Moving.so": compiled("moving2.c", folder / "Moving.so", *macros),
        }
    )


def moving3(folder: Path, *macros: str) -> Parts:
    """The same for FMI 3.0, with terminals, an icon and its sources."""
    return Parts(
        {
            XML: (HERE / "moving3.xml").read_bytes(),
            INDEX: PAGE,
            "binaries/x86_64-linux/Moving.so": compiled("moving3.c", folder / "Moving.so", *macros),
            TERMINALS: (HERE / "moving3.terminals.xml").read_bytes(),
            "terminalsAndIcons/icon.png": PNG,
            "terminalsAndIcons/flange.png": PNG,
            BUILD: (HERE / "moving3.build.xml").read_bytes(),
            **{f"sources/{name}": (HERE / name).read_bytes() for name in ("moving3.c", "moving.h")},
        }
    )


#: The FMUs in C by name.
COMPILED = {"Plain": plain, "Moving2": moving2, "Moving3": moving3}


def compiled(source: str, library: Path, *macros: str) -> bytes:
    """A shared library, compiled with macros that break it."""
    command = ["cc", "-O1", "-shared", "-fPIC", "-fvisibility=hidden", *macros, "-o", library, HERE / source, "-lm"]
    subprocess.run(command, check=True, capture_output=True)
    return library.read_bytes()
