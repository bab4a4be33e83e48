"""SSP 1.0 archives: `SystemStructure.ssd`, the FMUs and one `.ssv` a parameter set, of a `System`.

* Connectors: every input that is wired and every Real, Integer and Boolean output. What is not wired keeps the start
  value of its FMU; a connector without a connection would be set to zero by fmpy.
* Parameters are files, not inline values, which fmpy ignores. The description binds the default set; another one is
  chosen in fmpy by `read_ssv(archive, resource="resources/<set>.ssv")`, elsewhere by `exo ssp --set` or by changing the
  binding.
* A system with inputs binds one file, whose names are `component.variable`. A system without inputs has no connector of
  its own, connects components only and binds one file at each component, because Ecos and libcosim read nothing else.
  The files of one case bear the same set name: Ecos chooses a set by it.
* The annotations `org.openmodelica` name the master algorithm and the result file: OMSimulator's command line wants the
  first and complains of deprecated content without the second.
* Two runs give the same bytes: one date, fixed order, and entries that are stored, so that no version of a compressor
  has a say (the FMUs are compressed already).
"""

import zipfile
from collections.abc import Iterable, Mapping
from io import BytesIO
from pathlib import Path
from typing import Any

from lxml import etree

from exo.errors import FmuError
from exo.fmu import Archive
from exo.scenario import Value
from exo.systems.system import ENGAGE, System

SSD = "http://ssp-standard.org/SSP1/SystemStructureDescription"
SSC = "http://ssp-standard.org/SSP1/SystemStructureCommon"
SSV = "http://ssp-standard.org/SSP1/SystemStructureParameterValues"
OMS = "https://raw.githubusercontent.com/OpenModelica/OMSimulator/master/schema/oms.xsd"
VERSION = "1.0"
TOOL = "exo"
#: The earliest date that the format knows.
DATE = (1980, 1, 1, 0, 0, 0)
#: Exponents of a unit, by the name that SSP and FMI give them.
EXPONENTS = ("kg", "m", "s", "A", "K", "mol", "cd", "rad")
TYPES = ("Real", "Integer", "Boolean")
#: What OMSimulator records, with its own defaults: every step, ten rows at a time, all signals.
RECORDING = {"loggingInterval": "0.0", "bufferSize": "10", "signalFilter": ""}


def write(*, system: System, archives: Mapping[str, Archive], folder: Path) -> Path:
    """Writes `<folder>/<system>.ssp`; `archives` are FMUs by archive name."""
    path = folder / f"{system.name}.ssp"
    folder.mkdir(parents=True, exist_ok=True)
    path.write_bytes(content(system=system, archives=archives))
    return path


def content(*, system: System, archives: Mapping[str, Archive]) -> bytes:
    """The archive's bytes."""
    files = {"SystemStructure.ssd": description(system=system, archives=archives)}
    for name in system.parameter_sets:
        for component in bound_at(system):
            files[resource(name, component)] = parameter_set(
                system=system, archives=archives, name=name, component=component
            )
    for archive in sorted(set(system.components.values())):
        files[f"resources/{archive}"] = archives[archive].path.read_bytes()
    buffer = BytesIO()
    with zipfile.ZipFile(buffer, "w", zipfile.ZIP_STORED) as target:
        for name, data in files.items():
            entry = zipfile.ZipInfo(name, DATE)
            entry.create_system = 3
            entry.external_attr = 0o100644 << 16
            target.writestr(entry, data)
    return buffer.getvalue()


def bound_at(system: System) -> tuple[str | None, ...]:
    """Where parameters are bound: at the system, which is None, or without inputs at each component."""
    return (None,) if system.inputs else tuple(system.components)


def resource(parameter_set_name: str, component: str | None = None) -> str:
    """Where a parameter set lies in the archive, the whole of it or a component's part."""
    part = f".{component}" if component else ""
    return f"resources/{parameter_set_name}{part}.ssv"


def description(*, system: System, archives: Mapping[str, Archive]) -> bytes:
    """`SystemStructure.ssd`."""
    root = etree.Element(
        f"{{{SSD}}}SystemStructureDescription",
        nsmap={"ssd": SSD, "ssc": SSC, "oms": OMS},
        attrib={"version": VERSION, "name": system.name, "description": system.title, "generationTool": TOOL},
    )
    top = _ssd(root, "System", name=system.name, description=system.title)
    units: dict[str, Any] = {}
    connectors = _ssd(top, "Connectors") if system.inputs else None
    for name, targets in system.inputs.items():
        component, variable = targets[0].split(".", 1)
        archive = archives[system.components[component]]
        _connector(connectors, name, "input", archive.variable(variable).type, _unit(archive, variable, units))
    if system.inputs:
        _bind(top, resource(system.default))
    elements = _ssd(top, "Elements")
    wired = [*system.connections, *(target for targets in system.inputs.values() for target in targets)]
    for name, file in system.components.items():
        inputs = [w.split(".", 1)[1] for w in wired if w.startswith(f"{name}.")]
        component = _component(elements, name, archives[file], inputs, units)
        if not system.inputs:
            _bind(component, resource(system.default, name))
    connections = _ssd(top, "Connections")
    for source, targets in system.inputs.items():
        for target in targets:
            _connection(connections, None, source, target)
    for target, origin in system.connections.items():
        element, connector = origin.split(".", 1)
        _connection(connections, element, connector, target)
    _master(top, system.step)
    _units(etree.SubElement(root, f"{{{SSD}}}Units"), units.values())
    experiment = _ssd(root, "DefaultExperiment", startTime="0.0", stopTime=repr(system.duration))
    _omsimulator(experiment, RECORDING | {"resultFile": f"{system.name}_res.csv"})
    return _bytes(root)


def parameter_set(*, system: System, archives: Mapping[str, Archive], name: str, component: str | None = None) -> bytes:
    """One `.ssv`: the start values of a case, and `engage` for tools that exchange before the first step; with a
    component its part, by the names of its own variables."""
    root = etree.Element(
        f"{{{SSV}}}ParameterSet",
        nsmap={"ssv": SSV, "ssc": SSC},
        attrib={"version": VERSION, "name": name, "generationTool": TOOL},
    )
    parameters = etree.SubElement(root, f"{{{SSV}}}Parameters")
    units: dict[str, Any] = {}
    if component is None:
        _parameter(parameters, ENGAGE, "Boolean", 1, "")
    for key, value in system.parameter_sets[name].items():
        part, variable = key.split(".", 1)
        if component not in (None, part):
            continue
        archive = archives[system.components[part]]
        kind, number = _checked(archive, variable, value)
        _parameter(parameters, variable if component else key, kind, number, _unit(archive, variable, units))
    if units:
        _units(etree.SubElement(root, f"{{{SSV}}}Units"), units.values())
    return _bytes(root)


def _checked(archive: Archive, name: str, value: Value) -> tuple[str, float | int]:
    kind, number = archive.start_value(name, value)
    # fmpy reads the text "false" as true.
    if kind == "Boolean" and not number:
        raise FmuError(f"{archive.path.name}: {name}: a parameter set cannot say false, which fmpy takes for true")
    return kind, number


def _parameter(parent: Any, name: str, kind: str, number: float, unit: str) -> None:
    parameter = etree.SubElement(parent, f"{{{SSV}}}Parameter", name=name)
    value = etree.SubElement(parameter, f"{{{SSV}}}{kind}")
    value.set("value", ("true" if number else "false") if kind == "Boolean" else repr(number))
    if kind == "Real" and unit:
        value.set("unit", unit)


def _bind(parent: Any, source: str) -> None:
    _ssd(_ssd(parent, "ParameterBindings"), "ParameterBinding", source=source)


def _component(parent: Any, name: str, archive: Archive, inputs: list[str], units: dict[str, Any]) -> Any:
    component = _ssd(
        parent,
        "Component",
        name=name,
        type="application/x-fmu-sharedlibrary",
        source=f"resources/{archive.path.name}",
        implementation="CoSimulation",
    )
    connectors = _ssd(component, "Connectors")
    outputs = [name for name in archive.names("output") if archive.variable(name).type in TYPES]
    for variable in [*sorted(inputs, key=list(archive.variables).index), *outputs]:
        described = archive.variable(variable)
        _connector(connectors, variable, described.causality, described.type, _unit(archive, variable, units))
    return component


def _connector(parent: Any, name: str, kind: str, type_name: str, unit: str) -> None:
    connector = _ssd(parent, "Connector", name=name, kind=kind)
    of = etree.SubElement(connector, f"{{{SSC}}}{type_name}")
    if unit:
        of.set("unit", unit)


def _connection(parent: Any, element: str | None, connector: str, target: str) -> None:
    component, variable = target.split(".", 1)
    start = {"startElement": element} if element else {}
    _ssd(parent, "Connection", **start, startConnector=connector, endElement=component, endConnector=variable)


def _master(parent: Any, step: float) -> None:
    tolerances = {"absoluteTolerance": "0.0001", "relativeTolerance": "0.0001"}
    attributes = {"description": "oms-ma", "stepSize": repr(step)} | tolerances
    etree.SubElement(_omsimulator(parent), f"{{{OMS}}}FixedStepMaster", attrib=attributes)


def _omsimulator(parent: Any, attributes: Mapping[str, str] | None = None) -> Any:
    """An annotation for OMSimulator, with the attributes of its `SimulationInformation`."""
    annotation = etree.SubElement(_ssd(parent, "Annotations"), f"{{{SSC}}}Annotation", type="org.openmodelica")
    annotations = etree.SubElement(annotation, f"{{{OMS}}}Annotations")
    return etree.SubElement(annotations, f"{{{OMS}}}SimulationInformation", attrib=dict(attributes or {}))


def _unit(archive: Archive, name: str, units: dict[str, Any]) -> str:
    """The variable's unit, remembered for the document's table."""
    variable = archive.variable(name)
    unit = str(variable.unit or getattr(variable.declaredType, "unit", None) or "")
    if unit:
        units[unit] = next(one for one in archive.description.unitDefinitions if one.name == unit)
    return unit


def _units(parent: Any, units: Iterable[Any]) -> None:
    for unit in sorted(units, key=lambda one: str(one.name)):
        base = etree.SubElement(etree.SubElement(parent, f"{{{SSC}}}Unit", name=unit.name), f"{{{SSC}}}BaseUnit")
        for exponent in EXPONENTS:
            if unit.baseUnit is not None and (value := int(getattr(unit.baseUnit, exponent))):
                base.set(exponent, str(value))


def _ssd(parent: Any, tag: str, **attributes: str) -> Any:
    return etree.SubElement(parent, f"{{{SSD}}}{tag}", **attributes)


def _bytes(root: Any) -> bytes:
    return bytes(etree.tostring(root, xml_declaration=True, encoding="UTF-8", pretty_print=True))
