"""The process that touches machine code: `probe.py <facts file>`, the task as JSON on stdin.

Task `inspect` parses a library's file; task `load` runs an instance through one step. Plain ctypes: what is under test
is the FMU, not a wrapper.
"""

import ctypes
import json
import re
import sys
from collections.abc import Callable
from ctypes import CFUNCTYPE, Structure, byref, c_char_p, c_double, c_int, c_size_t, c_uint, c_void_p
from pathlib import Path
from typing import Any

STATUS = ("OK", "Warning", "Discard", "Error", "Fatal", "Pending")
VALUES: dict[str, Any] = {"Real": c_double, "Integer": c_int, "Boolean": c_int, "String": c_char_p}
#: Values of variables in one fact. Those that were read before a crash are lost.
TOLD_AT_ONCE = 1000
#: A guid that no FMU has.
OTHER_GUID = b"{00000000-0000-0000-0000-00000000e0e0}"

Tell = Callable[[dict[str, Any]], None]
LOGGER = CFUNCTYPE(None, c_void_p, c_char_p, c_int, c_char_p, c_char_p)
ALLOCATE = CFUNCTYPE(c_void_p, c_size_t, c_size_t)
FREE = CFUNCTYPE(None, c_void_p)
FINISHED = CFUNCTYPE(None, c_void_p, c_int)


class Callbacks(Structure):
    """fmi2CallbackFunctions"""

    _fields_ = (
        ("logger", LOGGER),
        ("allocateMemory", ALLOCATE),
        ("freeMemory", FREE),
        ("stepFinished", FINISHED),
        ("componentEnvironment", c_void_p),
    )


class Slave:
    """The functions of one library. A call is told before it is made, unless the last one was of the same function."""

    def __init__(self, library: ctypes.CDLL, tell: Tell) -> None:
        self.tell = tell
        self.library = library
        self.last_call = ""
        self.statuses: set[tuple[str, int]] = set()
        libc = ctypes.CDLL("msvcrt" if sys.platform == "win32" else None)
        libc.calloc.restype, libc.calloc.argtypes = c_void_p, (c_size_t, c_size_t)
        libc.free.restype, libc.free.argtypes = None, (c_void_p,)
        self.callbacks = Callbacks(LOGGER(lambda *_: None), ALLOCATE(libc.calloc), FREE(libc.free), FINISHED(), None)

    def call(self, name: str, *arguments: Any, returns: Any = c_int) -> Any:
        """Calls a function; a status that is not OK is a fact when it comes for the first time."""
        if name != self.last_call:
            self.tell({"call": name})
            self.last_call = name
        function = getattr(self.library, name)
        function.restype = returns
        result = function(*arguments)
        if returns is c_int and result != 0 and (name, result) not in self.statuses:
            self.statuses.add((name, result))
            self.tell({"status": [name, STATUS[result] if 0 <= result < len(STATUS) else str(result)]})
        return result

    def instantiate(self, guid: bytes, resources: str) -> c_void_p | None:
        """An instance, or None when the FMU refuses."""
        component = self.call(
            "fmi2Instantiate",
            c_char_p(b"validated"),
            c_int(1),
            c_char_p(guid),
            c_char_p(resources.encode()),
            byref(self.callbacks),
            c_int(0),
            c_int(0),
            returns=c_void_p,
        )
        return None if component is None else c_void_p(component)

    def read(self, component: c_void_p, kind: str, reference: int) -> Any:
        """A variable's value, None when the FMU refuses."""
        value = VALUES[kind]()
        status = self.call(f"fmi2Get{kind}", component, byref(c_uint(reference)), c_size_t(1), byref(value))
        if status not in (0, 1):
            return None
        return (value.value or b"").decode("utf-8", "replace") if kind == "String" else value.value

    def read_all(self, component: c_void_p, fact: str, variables: list[tuple[int, str, int]]) -> None:
        """Reads variables one by one and tells index and value of many at a time: writing takes longer than reading."""
        for first in range(0, len(variables), TOLD_AT_ONCE):
            part = variables[first : first + TOLD_AT_ONCE]
            self.tell({fact: [[index, self.read(component, kind, reference)] for index, kind, reference in part]})


def load(task: dict[str, Any], tell: Tell) -> None:
    """Instantiates, initialises, reads, steps, reads again and frees."""
    try:
        library = ctypes.CDLL(task["library"])
    except OSError as problem:
        tell({"refused": str(problem)})
        return
    slave = Slave(library, tell)
    for name, fact in (("fmi2GetVersion", "version"), ("fmi2GetTypesPlatform", "types")):
        tell({fact: (slave.call(name, returns=c_char_p) or b"").decode("utf-8", "replace")})
    component = slave.instantiate(task["guid"].encode(), task["resources"])
    tell({"instantiated": component is not None})
    if component is None:
        return
    start, step = c_double(task["start"]), c_double(task["step"])
    none = c_double(0.0)
    slave.call("fmi2SetupExperiment", component, c_int(0), none, start, c_int(0), none)
    slave.call("fmi2EnterInitializationMode", component)
    slave.read_all(component, "exact", task["exact"])
    slave.call("fmi2ExitInitializationMode", component)
    slave.read_all(component, "initialized", task["all"])
    slave.call("fmi2DoStep", component, start, step, c_int(1))
    slave.read_all(component, "stepped", task["all"])
    slave.call("fmi2Terminate", component)
    slave.call("fmi2FreeInstance", component, returns=None)
    other = slave.instantiate(OTHER_GUID, task["resources"])
    tell({"other guid accepted": other is not None})
    if other is not None:
        slave.call("fmi2FreeInstance", other, returns=None)


def inspect(task: dict[str, Any], tell: Tell) -> None:
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


def main() -> None:
    """Runs the task from stdin."""
    task = json.load(sys.stdin)
    with Path(sys.argv[1]).open("a", encoding="utf-8") as file:

        def tell(fact: dict[str, Any]) -> None:
            file.write(json.dumps(fact) + "\n")
            file.flush()

        {"load": load, "inspect": inspect}[task["task"]](task, tell)
        tell({"done": True})


if __name__ == "__main__":
    main()
