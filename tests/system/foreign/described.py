"""FMI 3.0 descriptions with the variables of FMI 2.0 ones, made from the standard alone.

`q[1]`, `q[2]`, … are an array, and an Integer whose description lists its items is an enumeration. There is no library:
they are for what reads descriptions.
"""

import re
import zipfile
from pathlib import Path
from typing import Any

from lxml import etree

from exo.fmu import Archive, choices

TYPES = {"Real": "Float64", "Integer": "Int32", "Boolean": "Boolean"}


def write(archive: Archive, folder: Path) -> Path:
    """The FMU's twin in the folder, under its name."""
    path = folder / archive.path.name
    with zipfile.ZipFile(path, "w") as target:
        target.writestr("modelDescription.xml", etree.tostring(described(archive)))
        target.writestr("documentation/index.html", "<html></html>")
    return path


def described(archive: Archive) -> Any:
    """The description of the twin."""
    root = etree.Element("fmiModelDescription", fmiVersion="3.0", modelName=archive.path.stem, instantiationToken="{1}")
    etree.SubElement(root, "CoSimulation", modelIdentifier=archive.path.stem)
    units = etree.SubElement(root, "UnitDefinitions")
    for unit in archive.description.unitDefinitions:
        base = etree.SubElement(etree.SubElement(units, "Unit", name=unit.name), "BaseUnit")
        for key in ("kg", "m", "s", "rad"):
            if value := int(getattr(unit.baseUnit, key)):
                base.set(key, str(value))
    types = etree.SubElement(root, "TypeDefinitions")
    variables = etree.SubElement(root, "ModelVariables")
    groups: dict[str, list[Any]] = {}
    for name, variable in archive.variables.items():
        if variable.type in TYPES:
            groups.setdefault(re.sub(r"\[\d+\]", "", name), []).append(variable)
    for name, members in groups.items():
        first = members[0]
        items = choices(first) if first.type == "Integer" else {}
        element = etree.SubElement(variables, "Enumeration" if items else TYPES[first.type], name=name)
        element.set("causality", first.causality)
        element.set("variability", first.variability)
        unit = first.unit or getattr(first.declaredType, "unit", None)
        if unit:
            element.set("unit", unit)
        if all(one.start is not None for one in members):
            element.set("start", " ".join(str(one.start) for one in members))
        if items:
            kind = f"Kind_{name}"
            element.set("declaredType", kind)
            listed = etree.SubElement(types, "EnumerationType", name=kind)
            for item, value in items.items():
                etree.SubElement(listed, "Item", name=item, value=str(value))
        if "[" in first.name:
            etree.SubElement(element, "Dimension", start=str(len(members)))
    return root
