"""A whole system as one FMU, for tools that know no SSP: a container of fmu-manipulation-toolbox.

The container steps its FMUs one after the other, each with what those before it have just put out: the harness'
`zero_delay`, so that the parameters are those of the scenario, without the `delay` of the SSP sets. Every parameter and
every output appears as `component.variable`. Parameters start with the FMUs' own values: start values of the container
itself would win over what the importer sets. Inputs are those of the system (`tau_h`, `vacuum`, `engage`) and, as
`component.variable`, those that nothing is wired to.

The toolbox is BSD-2-Clause, and so is the library that it puts into the container, which is the toolbox' own binary for
the platforms that all FMUs have (it knows linux64 with glibc 2.34, win64 and darwin64). Its licence is added to the
archive. Author, date and identifier, which the toolbox takes from the machine and the moment, are replaced, so that two
builds give the same bytes; the variable `time`, which it declares, is dropped. Units and FMU states are lost in a
container.
"""

import logging
import shutil
import uuid
import zipfile
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from importlib import metadata
from io import BytesIO
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from fmu_manipulation_toolbox.container import FMUContainer
from lxml import etree

from exo.errors import FmuError
from exo.fmu import Archive
from exo.folder import write_file
from exo.systems.ssp import DATE, TYPES
from exo.systems.system import System

TOOLBOX = "fmu_manipulation_toolbox"
LICENCE = f"documentation/licenses/{TOOLBOX}.txt"
#: Namespace of the containers' identifiers.
NAMESPACE = uuid.UUID("6f1f6a9e-7b0c-5c55-9d6e-3f0d6a0f2f11")


def write(*, system: System, archives: Mapping[str, Archive], folder: Path) -> Path:
    """Writes `<folder>/<system>.fmu`; `archives` are FMUs by archive name. ExoError, if it cannot be written."""
    path = folder / f"{system.name}.fmu"
    write_file(path, content(system=system, archives=archives))
    return path


def content(*, system: System, archives: Mapping[str, Archive]) -> bytes:
    """The archive's bytes."""
    with TemporaryDirectory() as name, _complaints() as complaints:
        folder = Path(name)
        for file in sorted(set(system.components.values())):
            shutil.copy(archives[file].path, folder / file)
        container = FMUContainer(system.name, folder)
        container.start_time, container.stop_time = 0.0, system.duration
        _wire(container, system, archives)
        container.make_fmu(f"{system.name}.fmu", step_size=system.step, sequential=True)
        if complaints:
            raise FmuError(f"{system.name}: the container's builder says: {'; '.join(complaints)}")
        with zipfile.ZipFile(folder / f"{system.name}.fmu") as built:
            files = {entry: built.read(entry) for entry in built.namelist() if not entry.endswith("/")}
    return _packed(files)


def _wire(container: FMUContainer, system: System, archives: Mapping[str, Archive]) -> None:
    fmus = system.components
    for file in fmus.values():
        container.get_fmu(file)
    driven = set(system.connections)
    for name, targets in system.inputs.items():
        driven.update(targets)
        for target in targets:
            component, variable = target.split(".", 1)
            container.add_input(name, fmus[component], variable)
    for target, origin in system.connections.items():
        (to, variable), (component, output) = target.split(".", 1), origin.split(".", 1)
        container.add_link(fmus[component], output, fmus[to], variable)
    for component, file in fmus.items():
        for name in archives[file].names("parameter", "input", "output"):
            described, key = archives[file].variable(name), f"{component}.{name}"
            if described.type not in TYPES or key in driven:
                continue
            if described.causality == "output":
                container.add_output(file, name, key)
            else:
                container.add_input(key, file, name)


def _packed(files: dict[str, bytes]) -> bytes:
    """The files in alphabetical order with one date, the description without traces of the machine."""
    root = etree.fromstring(files["modelDescription.xml"])
    _without_time(root)
    del root.attrib["generationDateAndTime"], root.attrib["author"]
    root.set("license", "MIT OR Apache-2.0; the container's own library: BSD-2-Clause")
    root.set("guid", "")
    known = b"".join(name.encode() + files[name] for name in sorted(files) if name != "modelDescription.xml")
    root.set("guid", f"{{{uuid.uuid5(NAMESPACE, (etree.tostring(root) + known).hex())}}}")
    files["modelDescription.xml"] = etree.tostring(root, xml_declaration=True, encoding="UTF-8", pretty_print=True)
    files[LICENCE] = _licence()
    buffer = BytesIO()
    with zipfile.ZipFile(buffer, "w", zipfile.ZIP_DEFLATED) as target:
        for name in sorted(files):
            entry = zipfile.ZipInfo(name, DATE)
            entry.create_system = 3
            entry.external_attr = 0o100644 << 16
            entry.compress_type = zipfile.ZIP_DEFLATED
            target.writestr(entry, files[name])
    return buffer.getvalue()


def _without_time(root: Any) -> None:
    """Drops the independent variable `time`: nobody needs it declared, and libcosim's library logs an error for it."""
    variables = root.find("ModelVariables")
    (time,) = variables.findall("ScalarVariable[@causality='independent']")
    position = variables.index(time) + 1
    variables.remove(time)

    def moved(index: str) -> str:
        return str(int(index) - (int(index) > position))

    for unknown in root.iterfind("ModelStructure//Unknown"):
        unknown.set("index", moved(unknown.get("index")))
        if depends := unknown.get("dependencies"):
            unknown.set("dependencies", " ".join(map(moved, depends.split())))


def _licence() -> bytes:
    """The licence text that the toolbox is installed with."""
    for file in metadata.files(TOOLBOX) or []:
        if file.name.upper().startswith("LICENSE") and "dist-info" in file.parts[0]:
            return Path(str(file.locate())).read_bytes()
    raise FmuError(f"{TOOLBOX} is installed without its licence, which must go into the container")


@contextmanager
def _complaints() -> Iterator[list[str]]:
    """The toolbox' messages from error on; its warnings (a loop of links, which is meant) are not passed on."""
    found: list[str] = []

    class Collector(logging.Handler):
        def emit(self, record: logging.LogRecord) -> None:
            found.append(record.getMessage())

    logger, handler = logging.getLogger(TOOLBOX), Collector(level=logging.ERROR)
    before, logger.propagate = logger.propagate, False
    logger.addHandler(handler)
    try:
        yield found
    finally:
        logger.removeHandler(handler)
        logger.propagate = before
