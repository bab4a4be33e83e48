"""What the XML files of an SSP archive share: namespaces, elements, units."""

from collections.abc import Iterable, Mapping
from typing import Any

from lxml import etree

from exo.systems.interface import BASE, Unit, Variable

SSD = "http://ssp-standard.org/SSP1/SystemStructureDescription"
SSC = "http://ssp-standard.org/SSP1/SystemStructureCommon"
SSV = "http://ssp-standard.org/SSP1/SystemStructureParameterValues"
SSM = "http://ssp-standard.org/SSP1/SystemStructureParameterMapping"
SSB = "http://ssp-standard.org/SSP1/SystemStructureSignalDictionary"
TOOL = "exo"
#: Types that the systems are made of, in FMI 2.0.
TYPES = ("Real", "Integer", "Boolean")


def dimensions(parent: Any, variable: Variable) -> None:
    """The shape of an array, in SSP 2.0."""
    for size in variable.shape:
        etree.SubElement(parent, f"{{{SSC}}}Dimension", size=str(size))


def write_units(parent: Any, units: Iterable[Unit]) -> None:
    """The children of `Units`, by name."""
    for unit in sorted(units, key=lambda one: one.name):
        base = etree.SubElement(etree.SubElement(parent, f"{{{SSC}}}Unit", name=unit.name), f"{{{SSC}}}BaseUnit")
        for key, exponent in zip(BASE, unit.exponents or (), strict=False):
            if exponent:
                base.set(key, str(exponent))
        if unit.factor != 1.0:
            base.set("factor", repr(unit.factor))
        if unit.offset != 0.0:
            base.set("offset", repr(unit.offset))


def write_enumerations(parent: Any, variables: Mapping[str, Variable]) -> None:
    """The children of `Enumerations`: declared types by name, each as a variable of it has it."""
    for name, variable in sorted(variables.items()):
        enumeration = etree.SubElement(parent, f"{{{SSC}}}Enumeration", name=name)
        for item, value in (variable.items or {}).items():
            etree.SubElement(enumeration, f"{{{SSC}}}Item", name=item, value=str(value))


def text(root: Any) -> bytes:
    """The document's bytes."""
    return bytes(etree.tostring(root, xml_declaration=True, encoding="UTF-8", pretty_print=True))
