"""Format, machine, exports and needs of a library's file, by LIEF; nothing of it is run."""

import re
from collections.abc import Callable
from pathlib import Path
from typing import Any


def inspect(task: dict[str, Any], tell: Callable[[dict[str, Any]], None]) -> None:
    """Format, machine, exports and needs of a library; nothing of it is run."""
    import lief  # noqa: PLC0415  only this task needs it

    lief.logging.disable()
    library: Any = lief.parse(task["library"])
    if library is None:
        tell({"library": {"format": "no known format", "machine": "no machine"}})
        return
    formats = {lief.Binary.FORMATS.ELF: "ELF", lief.Binary.FORMATS.PE: "PE", lief.Binary.FORMATS.MACHO: "MachO"}
    kind = formats.get(library.format, str(library.format))
    # A universal Mach-O file has a part for each machine; LIEF's parts live no longer than their container.
    container = lief.MachO.parse(task["library"]) if kind == "MachO" else None
    if container is not None:
        wanted = [index for index in range(container.size) if machine_of(container.at(index)) == task["machine"]]
        library = container.at(wanted[0] if wanted else 0)
    facts: dict[str, Any] = {"format": kind, "machine": machine_of(library), "glibc": []}
    facts["needs"] = [str(getattr(needed, "name", needed)) for needed in library.libraries]
    facts["exports"] = exported(library)
    facts["shared"] = is_shared(library) and is_whole(library, Path(task["library"]).stat().st_size)
    if isinstance(library, lief.ELF.Binary):
        versions = [
            auxiliary.name for need in library.symbols_version_requirement for auxiliary in need.get_auxiliary_symbols()
        ]
        numbers = [re.fullmatch(r"GLIBC_([0-9]{1,9}(?:\.[0-9]{1,9})*)", str(name)) for name in versions]
        facts["glibc"] = [number[1] for number in numbers if number]
    tell({"library": facts})


def machine_of(library: Any) -> str:
    """x86_64, x86, aarch64, or LIEF's name."""
    header = library.abstract.header
    name = str(header.architecture).rsplit(".", 1)[-1].lower()
    x86 = "x86_64" if header.is_64 else "x86"
    return {"x86_64": x86, "x86": x86, "arm64": "aarch64"}.get(name, name)


def exported(library: Any) -> list[str]:
    """Names of exported symbols; Mach-O's leading underscore is cut off."""
    import lief  # noqa: PLC0415

    if isinstance(library, lief.PE.Binary):
        found = library.get_export()
        return [] if found is None else [str(entry.name) for entry in found.entries]
    if isinstance(library, lief.MachO.Binary):
        # The loader reads the export trie; a file without one exports by its symbol table, as old linkers wrote it.
        symbols = library.exported_symbols or [symbol for symbol in library.symbols if is_public(symbol.raw_type)]
        return [str(symbol.name).removeprefix("_") for symbol in symbols]
    return [str(symbol.name) for symbol in library.exported_symbols]


def is_public(raw_type: int) -> bool:
    """Whether a Mach-O symbol's n_type says external, defined, and neither private nor of the debugger."""
    stab, private, kind, external = 0xE0, 0x10, 0x0E, 0x01
    return raw_type & external != 0 and raw_type & (stab | private) == 0 and raw_type & kind != 0


def is_shared(library: Any) -> bool:
    """Whether a process can load it as a library."""
    import lief  # noqa: PLC0415

    if isinstance(library, lief.PE.Binary):
        return bool(library.header.has_characteristic(lief.PE.Header.CHARACTERISTICS.DLL))
    if isinstance(library, lief.MachO.Binary):
        return bool(library.header.file_type == lief.MachO.Header.FILE_TYPE.DYLIB)
    return bool(library.header.file_type == lief.ELF.Header.FILE_TYPE.DYN)


def is_whole(library: Any, size: int) -> bool:
    """Whether all that is to be loaded lies within the file, and there is something."""
    import lief  # noqa: PLC0415

    if isinstance(library, lief.PE.Binary):
        ends = [section.pointerto_raw_data + section.sizeof_raw_data for section in library.sections]
    elif isinstance(library, lief.MachO.Binary):
        ends = [segment.file_offset + segment.file_size for segment in library.segments]
    else:
        loaded = [segment for segment in library.segments if segment.type == lief.ELF.Segment.TYPE.LOAD]
        ends = [segment.file_offset + segment.physical_size for segment in loaded]
    return bool(ends) and max(ends) <= size
