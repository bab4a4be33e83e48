"""FMUs by variable name: an extracted archive, and instances of it with a fast path for the simulation loop.

fmpy loads the library and reads the description. Inside the loop the C functions are called directly with addresses in
NumPy buffers, because fmpy's convenience calls cost more than the models.
"""

import os
import threading
import zipfile
from collections import deque
from collections.abc import Mapping
from contextlib import ExitStack
from ctypes import byref, c_char_p, c_double, c_int, c_size_t, c_void_p
from math import isfinite
from pathlib import Path
from types import TracebackType
from typing import Any, Literal, Self

import fmpy
import numpy as np
from fmpy.fmi2 import FMU2Slave
from lxml import etree
from numpy.typing import NDArray

from exo.errors import FmuError, close_matches
from exo.extraction import Extraction, opened
from exo.folder import working
from exo.messages import ENVIRONMENTS, MESSAGES, callbacks
from exo.variables import DTYPES, Kind, References, choices, unit_of

__all__ = ["DTYPES", "Archive", "Instance", "Kind", "References", "choices", "find_fmu_dir", "unit_of"]

#: A start value as C takes it: kind and number; or a text, which only start values can be.
Start = tuple[Kind, float | int] | tuple[Literal["String"], str]
LARGEST, LARGEST_INTEGER = float(np.finfo(np.float64).max), int(np.iinfo(np.int32).max)
#: Letters of another program's message.
QUOTED = 400
#: Letters of a number that is too large.
SHOWN = 20
STATUS = ("OK", "Warning", "Discard", "Error", "Fatal", "Pending")
FATAL = STATUS.index("Fatal")
DISCARD = STATUS.index("Discard")
#: Of fmi2StatusKind.
LAST_SUCCESSFUL_TIME, TERMINATED = 2, 3


def find_fmu_dir(given: Path | None = None) -> Path:
    """The folder of archives: `given`, else the environment's EXO_FMU_DIR, else `target/fmu` here or further up."""
    if given is not None:
        return Path(given)
    if named := os.environ.get("EXO_FMU_DIR"):
        return Path(named)
    here = working()
    for folder in (here, *here.parents):
        if (folder / "target" / "fmu").is_dir():
            return folder / "target" / "fmu"
    raise FmuError(f"no target/fmu in {here} or above: run `cargo xtask fmu` first, or set EXO_FMU_DIR")


class Archive:
    """An extracted `.fmu`: description and library, shared by all its instances. Use with `with`.

    FmuError names what is wrong: no file, no archive that is safe to extract, no description of a co-simulation FMU.
    """

    def __init__(self, path: Path, *, strict: bool = True) -> None:
        """`strict`: a description that breaks FMI's rules is an error; else `problems` has what fmpy says of it."""
        if not path.is_file():
            raise FmuError(f"{path}: no such FMU: run `cargo xtask fmu` first")
        self.path = path
        with ExitStack() as stack:
            self._files = tuple(opened(path, stack).files)
        self.description: Any
        self.description, self.problems = _description(path, strict=strict)
        self.variables: dict[str, Any] = {v.name: v for v in self.description.modelVariables}
        self._extraction = Extraction(path)
        self._references: dict[tuple[tuple[str, ...], Kind], References] = {}

    def __enter__(self) -> Self:
        self._extraction.__enter__()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._extraction.close()

    @property
    def folder(self) -> str:
        """Where the archive lies extracted."""
        return str(self._extraction.folder)

    @property
    def library(self) -> Path:
        """The extracted library of this machine."""
        name = f"binaries/{fmpy.platform}/{self.description.coSimulation.modelIdentifier}{fmpy.sharedLibraryExtension}"
        if name not in self._files:
            there = ", ".join(file for file in self._files if file.startswith("binaries/")) or "no library"
            raise FmuError(f"{self.path}: expected {name} for this machine; the archive has {there}")
        return self._extraction.folder / name

    def variable(self, name: str) -> Any:
        """The variable of this name, or an error that names close matches."""
        try:
            return self.variables[name]
        except KeyError:
            known = close_matches(name, self.variables)
            raise FmuError(f"{self.path.name}: no variable {name}{known}") from None

    def references(self, names: tuple[str, ...], kind: Kind) -> References:
        """Value references of these variables, made once."""
        if (names, kind) not in self._references:
            self._references[names, kind] = References(self, [*names], kind)
        return self._references[names, kind]

    def names(self, *causalities: str) -> list[str]:
        """Names of all variables with one of these causalities, in the order of the description."""
        return [name for name, v in self.variables.items() if v.causality in causalities]

    def parse(self, name: str, value: str) -> bool | int | float | str:
        """Text from a command line as a value of the variable's type."""
        variable = self.variable(name)
        try:
            match variable.type:
                case "Real" if isfinite(number := float(value)):
                    return number
                case "Real":
                    raise ValueError(value)  # metrics.json has no NaN and no infinity
                case "Boolean":
                    return {"true": True, "false": False}[value.lower()]
                case "Integer" | "Enumeration" if value.lstrip("-").isdigit() or not choices(variable):
                    return int(value)
        except (ValueError, KeyError):
            finite = " that is finite" if variable.type == "Real" else ""
            raise FmuError(f"{self.path.name}: {name}: expected {variable.type}{finite}, got {value!r}") from None
        return value

    def start_value(self, name: str, value: bool | int | float | str) -> Start:
        """The C type and number, or text, for a start value, checked against type, causality and enumeration items."""
        variable = self.variable(name)
        where = f"{self.path.name}: {name}"
        largest = LARGEST if variable.type == "Real" else LARGEST_INTEGER
        # What an input may be, NaN among it, the FMU says.
        is_input = variable.type == "Real" and variable.causality == "input"
        if not isinstance(value, str) and not is_input and not abs(value) <= largest:
            got = str(value) if len(str(value)) <= SHOWN else f"{str(value)[:SHOWN]}…"
            raise FmuError(f"{where}: expected a finite {variable.type} of at most {largest:g}, got {got}")
        if variable.causality not in ("parameter", "input"):
            raise FmuError(f"{where}: only parameters and inputs can be set, this is {variable.causality}")
        items = choices(variable)
        match variable.type, value:
            case "Boolean", bool():
                return "Boolean", int(value)
            case "String", str():
                return "String", value
            case "Real", int() | float() if not isinstance(value, bool):
                return "Real", float(value)
            case "Integer" | "Enumeration", str() | int() if items and not isinstance(value, bool):
                if value in items:
                    return "Integer", items[str(value)]
                if value in items.values():
                    return "Integer", int(value)
                raise FmuError(f"{where}: no item {value}{close_matches(str(value), items)}")
            case "Integer", int() if not isinstance(value, bool):
                return "Integer", value
        raise FmuError(f"{where}: expected {variable.type}, got {value!r}")


def _description(path: Path, *, strict: bool) -> tuple[Any, str]:
    """What fmpy reads of a co-simulation FMU, version 2.0, and what is wrong of it; empty, if nothing is."""
    problems = ""
    try:
        description = fmpy.read_model_description(str(path))
    except Exception as error:  # fmpy raises what its parser and its validation raise, and plain exceptions
        # It has been parsed by then, and fmpy asks None what it starts with.
        if isinstance(error, AttributeError) and _lacks_version(path):
            raise FmuError(f'{path}: modelDescription.xml: no fmiVersion; expected fmiVersion="2.0"') from None
        problems = _said(error)
        try:
            if strict:
                raise
            description = fmpy.read_model_description(str(path), validate=False)
        except Exception:
            raise FmuError(f"{path}: modelDescription.xml: {problems}") from error
    if description.fmiVersion != "2.0" or description.coSimulation is None:
        kind = "without co-simulation" if description.coSimulation is None else ""
        raise FmuError(
            f"{path}: expected an FMI 2.0 co-simulation FMU, got FMI {description.fmiVersion} {kind}".rstrip()
        )
    return description, problems


def _lacks_version(path: Path) -> bool:
    """Whether the description, which can be parsed, has no fmiVersion."""
    with zipfile.ZipFile(path) as archive, archive.open("modelDescription.xml") as file:
        return etree.parse(file, etree.XMLParser(resolve_entities=False)).getroot().get("fmiVersion") is None


def _said(error: Exception) -> str:
    """Another program's message in one line."""
    words = str(error).split()
    return type(error).__name__ if words in ([], ["None"]) else " ".join(words)[:QUOTED]


#: fmpy changes the working directory while it loads a library, which is one for all threads.
_LOADING = threading.Lock()


class Instance:
    """One instance, freed at the end of `with`. Any status but OK raises `FmuError` with the FMU's last message."""

    def __init__(self, archive: Archive, name: str) -> None:
        self.archive = archive
        self.name = name
        #: The last messages as (category, text).
        self.messages: deque[tuple[str, str]] = deque(maxlen=200)
        self._environment = next(ENVIRONMENTS)
        self._fatal = False
        #: Each is looked up once: that takes as long as a dozen steps.
        self._functions: dict[str, Any] = {}
        #: Start values by name as they were set last, with kind and number.
        self._starts: dict[str, tuple[bool | int | float | str, Start]] = {}
        self._callbacks = callbacks(self._environment)
        description = archive.description
        library = archive.library
        with _LOADING:
            here = working()
            try:
                self._slave: Any = FMU2Slave(
                    guid=description.guid,
                    unzipDirectory=archive.folder,
                    modelIdentifier=description.coSimulation.modelIdentifier,
                    instanceName=name,
                    libraryPath=str(library),
                )
            except Exception as error:  # of the system's loader and of fmpy, which leaves the working directory changed
                os.chdir(here)
                said = _said(error).replace(f"{archive.folder}/", "")
                raise FmuError(f"{archive.path}: {said}") from error

    def function(self, name: str) -> Any:
        """A C function without argument types: give it ctypes objects. fmpy's own object keeps its types."""
        if name not in self._functions:
            try:
                self._functions[name] = self._slave.dll[name]
            except AttributeError:
                raise FmuError(f"{self.archive.path}: its library has no {name}") from None
        return self._functions[name]

    def __enter__(self) -> Self:
        MESSAGES[self._environment] = self.messages
        try:
            self._instantiate()
        except FmuError:
            del MESSAGES[self._environment]
            raise
        return self

    def _instantiate(self) -> None:
        try:
            self._slave.instantiate(callbacks=self._callbacks, loggingOn=True)
        except Exception as error:
            raise FmuError(f"{self.name}: fmi2Instantiate failed: {self.last_message()}") from error
        self.component: int = self._slave.component

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        # After fmi2Fatal nothing may be called, and what the library still holds must stay where it is.
        if not self._fatal:
            self._slave.freeInstance()
            del MESSAGES[self._environment]

    def last_message(self) -> str:
        """The FMU's last log message, in one line."""
        return " ".join(self.messages[-1][1].splitlines()) if self.messages else "(the FMU logged nothing)"

    def fail(self, function: str, status: int) -> FmuError:
        """The error for a call that returned another status than OK."""
        if function == "fmi2DoStep" and status == DISCARD and (end := self._ended_at()) is not None:
            return FmuError(f"{self.name}: has ended the simulation at t = {end:.6g} s; expected a shorter duration")
        self._fatal = self._fatal or status == FATAL
        named = f"fmi2{STATUS[status]}" if 0 <= status < len(STATUS) else f"{status}, which is no status"
        return FmuError(f"{self.name}: {function} returned {named}: {self.last_message()}")

    def _ended_at(self) -> float | None:
        """When the FMU ended the simulation (s), where that is why it discarded a step."""
        ended, last = c_int(0), c_double(0.0)
        asked = (("fmi2GetBooleanStatus", TERMINATED, ended), ("fmi2GetRealStatus", LAST_SUCCESSFUL_TIME, last))
        for name, kind, answer in asked:
            try:
                if self.function(name)(c_void_p(self.component), c_int(kind), byref(answer)):
                    return None
            except FmuError:
                return None
        return last.value if ended.value else None

    def _call(self, name: str, *arguments: Any) -> None:
        status = int(self.function(name)(c_void_p(self.component), *arguments))
        if status:
            raise self.fail(name, status)

    def setup_experiment(self, *, start_time: float, stop_time: float) -> None:
        """fmi2SetupExperiment, without tolerance."""
        self._call("fmi2SetupExperiment", c_int(0), c_double(0.0), c_double(start_time), c_int(1), c_double(stop_time))

    def enter_initialization_mode(self) -> None:
        """fmi2EnterInitializationMode."""
        self._call("fmi2EnterInitializationMode")

    def exit_initialization_mode(self) -> None:
        """fmi2ExitInitializationMode."""
        self._call("fmi2ExitInitializationMode")

    def do_step(self, t: float, step: float) -> None:
        """fmi2DoStep."""
        self._call("fmi2DoStep", c_double(t), c_double(step), c_int(1))

    def reset(self) -> None:
        """fmi2Reset; an instance that refuses is made anew."""
        if int(self.function("fmi2Reset")(c_void_p(self.component))):
            # Not fmpy's freeInstance: it unloads the library, too.
            self._slave.fmi2FreeInstance(self._slave.component)
            self._slave.component = None
            self._instantiate()

    def terminate(self) -> None:
        """fmi2Terminate."""
        self._call("fmi2Terminate")

    def get_state(self) -> int:
        """fmi2GetFMUstate: a handle, to be freed."""
        state = c_void_p()
        self._call("fmi2GetFMUstate", byref(state))
        return int(state.value or 0)

    def set_state(self, state: int) -> None:
        """fmi2SetFMUstate."""
        self._call("fmi2SetFMUstate", c_void_p(state))

    def free_state(self, state: int) -> None:
        """fmi2FreeFMUstate."""
        self._call("fmi2FreeFMUstate", byref(c_void_p(state)))

    def set_start(self, name: str, value: bool | int | float | str) -> None:
        """Sets a parameter or an input by name; enumerations by item name or number."""
        self._set(name, self.archive.start_value(name, value))

    def _set(self, name: str, start: Start) -> None:
        if start[0] != "String":
            self.write(References(self.archive, [name], start[0]), np.array([start[1]], dtype=DTYPES[start[0]]))
            return
        reference = np.array([self.archive.variable(name).valueReference], dtype=np.uint32)
        self._call("fmi2SetString", c_void_p(reference.ctypes.data), c_size_t(1), byref(c_char_p(start[1].encode())))

    def set_starts(self, values: Mapping[str, bool | int | float | str]) -> None:
        """The same of many, those of one kind in one call."""
        kinds: dict[Kind, dict[str, float | int]] = {}
        for name, value in values.items():
            known = self._starts.get(name)
            # Of many runs most set the very same values: checked once.
            if known is None or known[0] is not value:
                known = self._starts[name] = (value, self.archive.start_value(name, value))
            start = known[1]
            if start[0] == "String":
                self._set(name, start)
            else:
                kinds.setdefault(start[0], {})[name] = start[1]
        for kind, numbers in kinds.items():
            self.write(self.archive.references(tuple(numbers), kind), np.array([*numbers.values()], dtype=DTYPES[kind]))

    def write(self, references: References, values: NDArray[Any]) -> None:
        """Sets all variables of `references` from a contiguous array of the kind's type."""
        self._transfer(f"fmi2Set{references.kind}", references, values)

    def read(self, references: References, values: NDArray[Any]) -> None:
        """Gets all variables of `references` into a contiguous array of the kind's type."""
        self._transfer(f"fmi2Get{references.kind}", references, values)

    def _transfer(self, function: str, references: References, values: NDArray[Any]) -> None:
        self._call(function, *references.arguments, c_void_p(values.ctypes.data))

    def text(self, name: str) -> str:
        """Current value of a String."""
        reference = np.array([self.archive.variable(name).valueReference], dtype=np.uint32)
        value = c_char_p()
        self._call("fmi2GetString", c_void_p(reference.ctypes.data), c_size_t(1), byref(value))
        return (value.value or b"").decode(errors="replace")

    def references(self, names: list[str]) -> dict[Kind, References]:
        """Variables grouped by kind, enumerations among the integers; strings are left out."""
        groups: dict[Kind, list[str]] = {kind: [] for kind in DTYPES}
        for name in names:
            kind = self.archive.variable(name).type
            kind = "Integer" if kind == "Enumeration" else kind
            if kind in groups:
                groups[kind].append(name)
        return {kind: References(self.archive, group, kind) for kind, group in groups.items()}

    def values(self, names: list[str]) -> dict[str, float | int | bool]:
        """Current values by name."""
        found: dict[str, float | int | bool] = {}
        for kind, references in self.references(names).items():
            if references:
                array = np.zeros(references.count, dtype=DTYPES[kind])
                self.read(references, array)
                items = array.astype(bool).tolist() if kind == "Boolean" else array.tolist()
                found.update(zip(references.names, items, strict=True))
        return {name: found[name] for name in names if name in found}
