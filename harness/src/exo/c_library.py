"""The law's C library in the place of the controllers' FMUs: `exo run --c-library f64`.

`cargo xtask law` puts the library behind the functions of FMI 2.0 (`fmu/c/examples/fmi2.c`, `target/law/*/fmi2.so`).
Here an archive is made of it, with the description of the FMU in whose place it stands; so scenarios, engines, the pace
of `--real-time` and metrics are what they are for FMUs. What the library does not have, as the tick's number or the
advice about gains, is not in that description.
"""

import ctypes
import re
import shutil
import tempfile
import zipfile
from collections.abc import Iterator
from contextlib import contextmanager
from itertools import count
from pathlib import Path
from typing import Any

import fmpy
from lxml import etree

from exo.errors import ExoError
from exo.scenario import Scenario

#: Folder of `target/law` by precision, and how the functions begin.
PRECISIONS = {"f64": "exo_", "f32": "exo_f32_"}
#: The FMUs that the library can stand for, and how it calls the law.
LAWS = {"ArmController.fmu": "arm", "TestbedController.fmu": "axis"}
#: The name of the library in `target/law` and in the archive.
LIBRARY = "fmi2"
#: Of one number of a variable to that of the next: value references as fmi2.c counts them.
STRIDE = 256
OFFERED = ("canGetAndSetFMUstate", "canSerializeFMUstate", "providesDirectionalDerivative")
#: The library has a tick and no other step.
STEPS = "canHandleVariableCommunicationStepSize"


class _Variable(ctypes.Structure):
    """`exo_variable` of exo_law.h."""

    _fields_ = (
        ("name", ctypes.c_char * 40),
        ("role", ctypes.c_int32),
        ("kind", ctypes.c_int32),
        ("count", ctypes.c_int32),
        ("offset", ctypes.c_size_t),
        ("stride", ctypes.c_size_t),
    )


def check(scenario: Scenario, precision: str) -> None:
    """ExoError, if a scenario has no controller that the library can stand for."""
    there = sorted({part.archive for part in scenario.components.values()})
    if not set(there) & set(LAWS):
        raise ExoError(
            f"--c-library {precision}: {scenario.id} has {', '.join(there)}; expected {' or '.join(LAWS)} among them"
        )


@contextmanager
def archives(fmu_dir: Path, precision: str) -> Iterator[Path]:
    """A folder with the archives of `fmu_dir`, in which the controllers are the C library, "f64" or "f32".

    ExoError, if there is no such precision, or `cargo xtask law` has not built the library beside `fmu_dir`.
    """
    if precision not in PRECISIONS:
        raise ExoError(f"--c-library {precision}: expected one of {', '.join(PRECISIONS)}")
    library = fmu_dir.resolve().parent / "law" / precision / f"{LIBRARY}{fmpy.sharedLibraryExtension}"
    if not library.is_file():
        raise ExoError(f"--c-library {precision}: {library}: no such file: run `cargo xtask law` first")
    with tempfile.TemporaryDirectory(prefix="exo-law-") as name:
        folder = Path(name)
        for path in sorted(fmu_dir.glob("*.fmu")):
            if path.name in LAWS:
                _pack(path, folder / path.name, library, precision)
            else:
                _link(path.resolve(), folder / path.name)
        yield folder


def _link(path: Path, place: Path) -> None:
    try:
        place.symlink_to(path)
    except OSError:  # a system that allows no links
        shutil.copyfile(path, place)


def _pack(path: Path, place: Path, library: Path, precision: str) -> None:
    try:
        with zipfile.ZipFile(path) as archive:
            root = etree.fromstring(archive.read("modelDescription.xml"))
    except (OSError, KeyError, zipfile.BadZipFile, etree.XMLSyntaxError) as error:
        raise ExoError(f"{path}: {error}; expected an FMU") from error
    describe(root, _variables(library, precision, LAWS[path.name]), LAWS[path.name])
    root.set("generationTool", f"exo, C library {precision}")
    with zipfile.ZipFile(place, "w") as archive:
        archive.writestr("modelDescription.xml", etree.tostring(root, encoding="UTF-8", xml_declaration=True))
        archive.write(library, f"binaries/{fmpy.platform}/{library.name}")


def _variables(library: Path, precision: str, law: str) -> dict[str, tuple[int, int]]:
    """What the library says of its variables: name → number, how many elements."""
    function = getattr(ctypes.CDLL(str(library)), f"{PRECISIONS[precision]}{law}_variable")
    function.argtypes = [ctypes.c_size_t, ctypes.POINTER(_Variable)]
    found: dict[str, tuple[int, int]] = {}
    one = _Variable()
    for number in count():
        if function(number, ctypes.byref(one)) != 0:
            break
        found[one.name.decode()] = number, one.count
    return found


def describe(root: Any, variables: dict[str, tuple[int, int]], law: str) -> None:
    """Makes the library's description of the FMU's: its variables and their value references, and what it offers."""
    root.set("guid", f"exo-law {law}")
    interface = root.find("CoSimulation")
    interface.set("modelIdentifier", LIBRARY)
    interface.set(STEPS, "false")
    for offer in OFFERED:
        interface.attrib.pop(offer, None)
    for files in interface.findall("SourceFiles"):
        interface.remove(files)
    listed = root.find("ModelVariables")
    indices: dict[int, int] = {}
    for i, variable in enumerate(list(listed), start=1):
        name, element = _split(variable.get("name"))
        number, elements = variables.get(name, (0, 0))
        if not 0 <= element < elements:
            listed.remove(variable)
            continue
        variable.set("valueReference", str(number * STRIDE + element))
        indices[i] = len(indices) + 1
    for kind in root.find("ModelStructure"):
        for unknown in list(kind):
            index = int(unknown.get("index"))
            if index not in indices:
                kind.remove(unknown)
                continue
            unknown.set("index", str(indices[index]))
            # All that a tick puts out may depend on all that it gets.
            for attribute in ("dependencies", "dependenciesKind"):
                unknown.attrib.pop(attribute, None)


def _split(name: str) -> tuple[str, int]:
    """`K[2]` → `K`, 1; a name without an index is its only element."""
    match = re.fullmatch(r"(.*)\[(\d+)\]", name)
    return (match[1], int(match[2]) - 1) if match else (name, 0)
