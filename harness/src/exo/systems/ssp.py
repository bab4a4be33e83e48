"""SSP archives of a `System`: `SystemStructure.ssd`, the FMUs and one `.ssv` a parameter set.

* Connectors: every input that is wired and every Real, Integer and Boolean output. What is not wired keeps the start
  value of its FMU; a connector without a connection would be set to zero by fmpy.
* Parameters are files. The description binds the default set; another one is chosen in fmpy by
  `read_ssv(archive, resource="resources/<set>.ssv")`, elsewhere by `exo ssp --set` or by changing the binding. A form
  (`form.py`) can put them into the description instead, which libcosim and Ecos read as well.
* A system with inputs binds one file, whose names are `component.variable`. A system without inputs has no connector of
  its own, connects components only and binds one file at each component, because Ecos and libcosim read nothing else.
  The files of one case bear the same set name: Ecos chooses a set by it.
* SSP 2.0 has each parameter set as a variant besides: a description `<set>.ssd`, which binds it. The component's
  `MetaData` says where in the FMU its documentation lies. FMI 3.0 twins have array connectors; a vector of FMI 2.0
  variables is then one connection and one parameter.
* The annotations `org.openmodelica` name the master algorithm and the result file: OMSimulator's command line wants the
  first and complains of deprecated content without the second.
* Two runs give the same bytes: one date, fixed order, and entries that are stored, so that no version of a compressor
  has a say (the FMUs are compressed already).
"""

import zipfile
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from io import BytesIO
from itertools import product
from pathlib import Path
from typing import Any

from lxml import etree

from exo.errors import FmuError
from exo.fmu import Archive
from exo.folder import write_file
from exo.systems.document import SSC, SSD, SSV, TOOL, TYPES, dimensions, text, write_enumerations, write_units
from exo.systems.form import SSP_1, Form, Part, parts
from exo.systems.interface import Unit, Variable
from exo.systems.ssv import element as parameter_element
from exo.systems.ssv import parameter_set
from exo.systems.system import System

__all__ = ["SSC", "SSD", "SSV", "TYPES", "content", "description", "parameter_set", "resource", "write"]

OMS = "https://raw.githubusercontent.com/OpenModelica/OMSimulator/master/schema/oms.xsd"
DEFAULT = "SystemStructure.ssd"
#: The earliest date that the format knows.
DATE = (1980, 1, 1, 0, 0, 0)
#: What OMSimulator records, with its own defaults: every step, ten rows at a time, all signals.
RECORDING = {"loggingInterval": "0.0", "bufferSize": "10", "signalFilter": ""}
LICENCE = "MIT OR Apache-2.0"


@dataclass
class Used:
    """What connectors use of what the document must define."""

    units: dict[str, Unit] = field(default_factory=dict)
    #: By name, one variable of each.
    enumerations: dict[str, Variable] = field(default_factory=dict)


def write(*, system: System, archives: Mapping[str, Archive], folder: Path, form: Form = SSP_1) -> Path:
    """Writes `<folder>/<system>.ssp`; `archives` are FMUs by archive name. ExoError, if it cannot be written."""
    path = folder / f"{system.name}.ssp"
    write_file(path, content(system=system, archives=archives, form=form))
    return path


def content(*, system: System, archives: Mapping[str, Archive], form: Form = SSP_1) -> bytes:
    """The archive's bytes."""
    archived = parts(archives, form)
    files = {DEFAULT: _described(system, archived, form)}
    if form.variants:
        for name in system.parameter_sets:
            if name != system.default:
                files[f"{name}.ssd"] = _described(variant(system, name), archived, form)
    if not form.inline:
        for name in system.parameter_sets:
            for component in bound_at(system):
                files[resource(name, component)] = text(
                    parameter_element(system=system, archived=archived, name=name, component=component, form=form)
                )
    for file, part in sorted(archived.items()):
        if file in system.components.values():
            files[f"resources/{file}"] = part.path.read_bytes()
    buffer = BytesIO()
    with zipfile.ZipFile(buffer, "w", zipfile.ZIP_STORED) as target:
        for name, data in files.items():
            entry = zipfile.ZipInfo(name, DATE)
            entry.create_system = 3
            entry.external_attr = 0o100644 << 16
            target.writestr(entry, data)
    return buffer.getvalue()


def variant(system: System, name: str) -> System:
    """The system with another default set. Its description bears the set's name, the system in it keeps its own."""
    return replace(system, default=name, variant=name, duration=system.durations.get(name, system.duration))


def bound_at(system: System) -> tuple[str | None, ...]:
    """Where parameters are bound: at the system, which is None, or without inputs at each component."""
    return (None,) if system.inputs else tuple(system.components)


def resource(parameter_set_name: str, component: str | None = None) -> str:
    """Where a parameter set lies in the archive, the whole of it or a component's part."""
    part = f".{component}" if component else ""
    return f"resources/{parameter_set_name}{part}.ssv"


def description(*, system: System, archives: Mapping[str, Archive], form: Form = SSP_1) -> bytes:
    """`SystemStructure.ssd`, or a variant."""
    return _described(system, parts(archives, form), form)


def _described(system: System, archived: Mapping[str, Part], form: Form) -> bytes:
    prefixes = {"ssd": SSD, "ssc": SSC, "oms": OMS}
    # libcosim and Ecos look for elements by their prefix.
    root = etree.Element(
        f"{{{SSD}}}SystemStructureDescription",
        nsmap=prefixes | {"ssv": SSV} if form.inline else prefixes,
        attrib={"version": form.version, "name": system.variant or system.name, "description": system.title},
    )
    if form.version != "1.0":
        root.set("license", LICENCE)
    root.set("generationTool", TOOL)
    top = _ssd(root, "System", name=system.name, description=system.title)
    used = Used()
    connectors = _ssd(top, "Connectors") if system.inputs else None
    for name, targets in system.inputs.items():
        component, variable = targets[0].split(".", 1)
        part = archived[system.components[component]]
        _connector(connectors, name, "input", of=(part, part.element(variable)[0]), used=used)
    if system.inputs:
        _bind(top, system, archived, None, form)
    elements = _ssd(top, "Elements")
    wired = [*system.connections, *(target for targets in system.inputs.values() for target in targets)]
    for name, file in system.components.items():
        inputs = [w.split(".", 1)[1] for w in wired if w.startswith(f"{name}.")]
        component = _component(elements, name=name, file=file, part=archived[file], inputs=inputs, used=used)
        if not system.inputs:
            _bind(component, system, archived, name, form)
        if form.version != "1.0":
            _documentation(component)
    connections = _ssd(top, "Connections")
    for start, end in _wires(system, archived):
        _ssd(connections, "Connection", **start, **end)
    _master(top, system.step)
    if used.enumerations:
        write_enumerations(_ssd(root, "Enumerations"), used.enumerations)
    write_units(_ssd(root, "Units"), used.units.values())
    experiment = _ssd(root, "DefaultExperiment", startTime="0.0", stopTime=repr(system.duration))
    _omsimulator(experiment, RECORDING | {"resultFile": f"{system.variant or system.name}_res.csv"})
    return text(root)


def _bind(parent: Any, system: System, archived: Mapping[str, Part], component: str | None, form: Form) -> None:
    binding = _ssd(_ssd(parent, "ParameterBindings"), "ParameterBinding")
    if form.inline:
        values = _ssd(binding, "ParameterValues")
        values.append(
            parameter_element(system=system, archived=archived, name=system.default, component=component, form=form)
        )
    else:
        binding.set("source", resource(system.default, component))


def _component(parent: Any, *, name: str, file: str, part: Part, inputs: list[str], used: "Used") -> Any:
    component = _ssd(
        parent,
        "Component",
        name=name,
        type="application/x-fmu-sharedlibrary",
        source=f"resources/{file}",
        implementation="CoSimulation",
    )
    connectors = _ssd(component, "Connectors")
    archive = part.archive
    outputs = [name for name in archive.names("output") if archive.variable(name).type in TYPES]
    for variable in part.variables([*sorted(inputs, key=list(archive.variables).index), *outputs]):
        _connector(connectors, variable.name, variable.causality, of=(part, variable), used=used)
    return component


def _documentation(component: Any) -> None:
    """Where the interface document lies: in the FMU."""
    attributes = {
        "kind": "general",
        "type": "text/html",
        "source": "documentation/index.html",
        "sourceBase": "resource",
    }
    etree.SubElement(component, f"{{{SSC}}}MetaData", attrib=attributes)


def _connector(parent: Any, name: str, kind: str, *, of: tuple[Part, Variable], used: "Used") -> None:
    part, variable = of
    connector = _ssd(parent, "Connector", name=name, kind=kind)
    kind_of = etree.SubElement(connector, f"{{{SSC}}}{variable.type}")
    if variable.unit:
        kind_of.set("unit", variable.unit)
        used.units[variable.unit] = part.interface.units[variable.unit]
    if variable.type == "Enumeration":
        kind_of.set("name", variable.enumeration)
        known = used.enumerations.setdefault(variable.enumeration, variable)
        if known.items != variable.items:
            raise FmuError(
                f"{part.path}: enumeration {variable.enumeration} has other items than in another FMU of the system"
            )
    dimensions(connector, variable)


def _wires(system: System, archived: Mapping[str, Part]) -> Iterator[tuple[dict[str, str], dict[str, str]]]:
    """Start and end of each connection, as attributes; a vector that goes to one of its shape is one connection."""
    wires = [(source, target) for source, targets in system.inputs.items() for target in targets]
    wires += [(origin, target) for target, origin in system.connections.items()]
    groups: dict[tuple[str, str, str, str], list[tuple[tuple[int, ...], tuple[int, ...]]]] = {}
    shapes: dict[tuple[str, str], tuple[int, ...]] = {}

    def end(key: str) -> tuple[tuple[str, str], tuple[int, ...]]:
        if key in system.inputs:
            return ("", key), ()
        component, name = key.split(".", 1)
        variable, indices = archived[system.components[component]].element(name)
        shapes[component, variable.name] = variable.shape
        return (component, variable.name), indices

    for source, target in wires:
        (start, of_start), (stop, of_stop) = end(source), end(target)
        groups.setdefault((*start, *stop), []).append((of_start, of_stop))
    for (element, connector, component, variable), pairs in groups.items():
        from_there = ({"startElement": element} if element else {}) | {"startConnector": connector}
        to_there = {"endElement": component, "endConnector": variable}
        shape = shapes.get((element, connector), ())
        every = list(product(*(range(1, size + 1) for size in shape)))
        whole = shape == shapes[component, variable] and sorted(pairs) == [(one, one) for one in every]
        for one, other in [((), ())] if whole else pairs:
            yield from_there | _indices("start", one), to_there | _indices("end", other)


def _indices(side: str, indices: tuple[int, ...]) -> dict[str, str]:
    return {f"{side}Indices": " ".join(map(str, indices))} if indices else {}


def _master(parent: Any, step: float) -> None:
    tolerances = {"absoluteTolerance": "0.0001", "relativeTolerance": "0.0001"}
    attributes = {"description": "oms-ma", "stepSize": repr(step)} | tolerances
    etree.SubElement(_omsimulator(parent), f"{{{OMS}}}FixedStepMaster", attrib=attributes)


def _omsimulator(parent: Any, attributes: Mapping[str, str] | None = None) -> Any:
    """An annotation for OMSimulator, with the attributes of its `SimulationInformation`."""
    annotation = etree.SubElement(_ssd(parent, "Annotations"), f"{{{SSC}}}Annotation", type="org.openmodelica")
    annotations = etree.SubElement(annotation, f"{{{OMS}}}Annotations")
    return etree.SubElement(annotations, f"{{{OMS}}}SimulationInformation", attrib=dict(attributes or {}))


def _ssd(parent: Any, tag: str, **attributes: str) -> Any:
    return etree.SubElement(parent, f"{{{SSD}}}{tag}", **attributes)
