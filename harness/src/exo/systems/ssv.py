"""Parameter sets of a system: `.ssv` files, or the same element inside the description that binds it."""

from collections.abc import Mapping
from typing import Any

from lxml import etree

from exo.errors import FmuError
from exo.fmu import Archive
from exo.scenario import Value
from exo.systems.document import SSC, SSV, TOOL, dimensions, text, write_units
from exo.systems.form import SSP_1, Form, Part, parts
from exo.systems.interface import Unit, Variable, position
from exo.systems.system import ENGAGE, System

FLOATING = ("Real", "Float64", "Float32")


def parameter_set(
    *, system: System, archives: Mapping[str, Archive], name: str, component: str | None = None, form: Form = SSP_1
) -> bytes:
    """One `.ssv`: the start values of a case, and `engage` for tools that exchange before the first step; with a
    component its part, by the names of its own variables."""
    return text(element(system=system, archived=parts(archives, form), name=name, component=component, form=form))


def element(*, system: System, archived: Mapping[str, Part], name: str, component: str | None, form: Form) -> Any:
    """The element `ParameterSet` of `parameter_set`."""
    root = etree.Element(
        f"{{{SSV}}}ParameterSet",
        nsmap={"ssv": SSV, "ssc": SSC},
        attrib={"version": form.version, "name": name, "generationTool": TOOL},
    )
    parameters = etree.SubElement(root, f"{{{SSV}}}Parameters")
    units: dict[str, Unit] = {}
    if component is None:
        _parameter(parameters, ENGAGE, "Boolean", ["true"], "")
    for key, (variable, values) in _grouped(system.parameter_sets[name], system, archived, component).items():
        written = _parameter(parameters, key, variable.type, values, variable.unit)
        dimensions(written, variable)
        if variable.type in FLOATING and variable.unit:
            part = component or key.split(".", 1)[0]
            units[variable.unit] = archived[system.components[part]].interface.units[variable.unit]
    if units:
        write_units(etree.SubElement(root, f"{{{SSV}}}Units"), units.values())
    return root


def _grouped(
    given: Mapping[str, Value], system: System, archived: Mapping[str, Part], component: str | None
) -> dict[str, tuple[Variable, list[str]]]:
    """Each variable that is set, by its name in the set, with the texts of its values; what a case does not say of an
    array stays at the start value."""
    found: dict[str, tuple[Variable, list[str]]] = {}
    for key, value in given.items():
        part, name = key.split(".", 1)
        if component not in (None, part):
            continue
        archive = archived[system.components[part]]
        variable, indices = archive.element(name)
        written = _written(archive, name, variable, value)
        shown = variable.name if component else f"{part}.{variable.name}"
        if not variable.shape:
            found[shown] = variable, [written]
            continue
        if len(variable.start) != variable.count:
            raise FmuError(f"{archive.path}: {variable.name}: {len(variable.start)} start values for {variable.count}")
        if shown not in found:
            found[shown] = (
                variable,
                [_item(archive, variable, int(one)) if variable.items else one for one in variable.start],
            )
        _, values = found[shown]
        values[position(variable.shape, indices)] = written
    return found


def _written(part: Part, name: str, variable: Variable, value: Value) -> str:
    """The value as SSP writes it, checked by the FMI 2.0 archive."""
    kind, number = part.archive.start_value(name, value)
    if kind == "String":
        return str(number)
    # fmpy reads the text "false" as true.
    if kind == "Boolean" and not number:
        raise FmuError(f"{part.path.name}: {name}: a parameter set cannot say false, which fmpy takes for true")
    if variable.type == "Boolean":
        return "true" if number else "false"
    if variable.type == "Enumeration":
        return _item(part, variable, int(number))
    return repr(float(number)) if variable.type in FLOATING else str(int(number))


def _item(part: Part, variable: Variable, number: int) -> str:
    for item, value in (variable.items or {}).items():
        if value == number:
            return item
    raise FmuError(f"{part.path}: {variable.name}: no item has the value {number}")


def _parameter(parent: Any, name: str, kind: str, values: list[str], unit: str) -> Any:
    parameter = etree.SubElement(parent, f"{{{SSV}}}Parameter", name=name)
    value = etree.SubElement(parameter, f"{{{SSV}}}{kind}")
    if kind == "Enumeration" and len(values) > 1:
        for one in values:
            etree.SubElement(value, f"{{{SSV}}}Value", value=one)
    else:
        value.set("value", " ".join(values))
    if kind in FLOATING and unit:
        value.set("unit", unit)
    return parameter
