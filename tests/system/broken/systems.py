"""An SSP archive that breaks no rule, written by hand, and archives in which one thing of it was changed.

Two FMUs are coupled: `Plant` (FMI 2.0, scalars) and `Drive` (FMI 3.0, a vector). A dictionary, a mapping and a variant
are there because rules speak of them.
"""

import io
import zipfile
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

HERE = Path(__file__).parent / "system"
DEFAULT = "SystemStructure.ssd"
DRIVEN, MASS = "resources/Drive.fmu", "resources/Plant.fmu"
SET = "resources/all.ssv"


def zipped(files: dict[str, bytes]) -> bytes:
    """An archive's bytes."""
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w", zipfile.ZIP_DEFLATED) as target:
        for name, data in files.items():
            target.writestr(name, data)
    return buffer.getvalue()


def text(name: str) -> str:
    """One of the good files."""
    return (HERE / name).read_text(encoding="utf-8")


def fmu(description: str) -> bytes:
    """An FMU that is a description and a page."""
    return zipped({"modelDescription.xml": description.encode(), "documentation/index.html": b"<html></html>"})


def good() -> dict[str, bytes]:
    """The files of the good archive."""
    default = text(DEFAULT)
    return {
        DEFAULT: default.encode(),
        "Light.ssd": default.replace('version="2.0" name="Good"', 'version="2.0" name="Light"').encode(),
        **{f"resources/{name}": text(name).encode() for name in ("all.ssv", "raw.ssv", "names.ssm", "signals.ssb")},
        "documentation/index.html": b"<html></html>",
        "extra/org.example/notes.txt": b"notes",
        MASS: fmu(text("Plant.xml")),
        DRIVEN: fmu(text("Drive.xml")),
    }


@dataclass(frozen=True)
class Mutant:
    """One change, the rule that it breaks, and what the finding says of place and value."""

    rule: str
    change: Callable[[dict[str, bytes]], None]
    where: str
    value: str

    @property
    def id(self) -> str:
        """For the test's name."""
        return f"{self.rule} {self.value}"[:60]


def _text(file: str, old: str, new: str) -> Callable[[dict[str, bytes]], None]:
    def change(files: dict[str, bytes]) -> None:
        assert old.encode() in files[file], old
        files[file] = files[file].replace(old.encode(), new.encode(), 1)

    return change


def in_default(old: str, new: str) -> Callable[[dict[str, bytes]], None]:
    """Replaces the first occurrence in the default description."""
    return _text(DEFAULT, old, new)


def _add(name: str, data: bytes = b"") -> Callable[[dict[str, bytes]], None]:
    return lambda files: files.update({name: data})


def _rename(name: str, other: str) -> Callable[[dict[str, bytes]], None]:
    return lambda files: files.update({other: files.pop(name)})


CONNECTION = '<ssd:Connection startConnector="hand" endElement="plant" endConnector="hand"/>'
COUNT = '<ssd:Connector name="count" kind="output"><ssc:Integer/></ssd:Connector>'
PARAMETER = '<ssv:Parameter name="plant.M"><ssv:Real value="7000" unit="g"/></ssv:Parameter>'
MASS_VALUE = '<ssv:Real value="7000" unit="g"/>'
SYSTEM_HAND = 'kind="input"><ssc:Real unit="N"/>'
TO_HAND = 'endElement="plant" endConnector="hand"'
VERSION = 'version="2.0" name="Good"'
DRIVE = '<ssd:Component name="drive" source="resources/Drive.fmu">'
INLINE = "<ssd:ParameterBinding><ssd:ParameterValues>"
MAPPING = '<ssd:ParameterMapping source="resources/names.ssm"/>'
SSM, SSB = "resources/names.ssm", "resources/signals.ssb"
THREE, TWO = 'unit="N"/><ssc:Dimension size="3"/>', 'unit="N"/><ssc:Dimension size="2"/>'
ENTRY = '<ssm:MappingEntry source="mass"'
HEAD = '<?xml version="1.0" encoding="UTF-8"?>\n'

MUTANTS = (
    Mutant("ssp-layout", _add("notes.txt"), "notes.txt", "a file at the root"),
    Mutant("ssp-layout", _add("fmus/x.txt"), "fmus", "a folder at the root"),
    Mutant(
        "ssp-documentation",
        _rename("documentation/index.html", "documentation/main.html"),
        "documentation",
        "no index.html",
    ),
    Mutant(
        "ssp-variant-name",
        _text("Light.ssd", 'name="Light"', 'name="Good"'),
        "Light.ssd:",
        "Good, as SystemStructure.ssd",
    ),
    Mutant("ssp-source-outside", in_default("resources/Plant.fmu", "../Plant.fmu"), "Component plant", "../Plant.fmu"),
    Mutant(
        "ssp-source-outside",
        in_default("resources/Plant.fmu", "https://example.org/Plant.fmu"),
        "Component plant",
        "https:",
    ),
    Mutant(
        "ssp-source-missing",
        in_default("resources/Plant.fmu", "resources/plant.fmu"),
        "Component plant",
        "resources/plant.fmu",
    ),
    Mutant("ssp-source-missing", in_default("resources/all.ssv", "all.ssv"), "ParameterBinding of Good", "all.ssv"),
    Mutant(
        "ssp-source-missing",
        in_default("documentation/index.html", "index.html"),
        "MetaData",
        "index.html in resources",
    ),
    Mutant(
        "ssp-source-missing",
        in_default('documentation/index.html" sourceBase="resource"', 'main.html"'),
        "MetaData",
        "main.html",
    ),
    Mutant("ssp-binding-source", in_default(' source="documentation/index.html"', ""), "MetaData", "neither"),
    Mutant("ssp-parses", _text(SET, "</ssv:ParameterSet>", ""), SET, "no element found"),
    Mutant("ssp-doctype", _text(SET, HEAD, HEAD + '<!DOCTYPE a [<!ENTITY b "c">]>'), f"{SET}:2", "<!DOCTYPE"),
    Mutant("ssp-encoding", _text(SET, "UTF-8", "ISO-8859-1"), f"{SET}:1", "ISO-8859-1"),
    Mutant("ssp-root", _add("resources/b.ssv", text("names.ssm").encode()), "resources/b.ssv:", "ParameterMapping"),
    Mutant(
        "ssp-version", in_default(VERSION, VERSION.replace("2.0", "3.0")), "SystemStructureDescription", "version 3.0"
    ),
    Mutant(
        "ssp-schema",
        in_default('<ssd:System name="Good">', '<ssd:System name="Good" kind="x">'),
        "SystemStructure.ssd:",
        "'kind'",
    ),
    Mutant(
        "ssp-schema",
        in_default('version="2.0" name="inline"', 'version="1.0" name="inline"'),
        "SystemStructure.ssd:",
        "Float64",
    ),
    Mutant("ssp-schema", in_default(VERSION, VERSION.replace("2.0", "1.0")), "SystemStructure.ssd:", "Float64"),
    Mutant("ssp-unit-undefined", in_default('<ssc:Real unit="m"/>', '<ssc:Real unit="mm"/>'), "in Connector q", "mm"),
    Mutant("ssp-unit-undefined", _text(SET, 'unit="g"', 'unit="lb"'), "in Parameter plant.M", "lb"),
    Mutant(
        "ssp-enumeration-undefined",
        in_default("<ssc:Integer/>", '<ssc:Enumeration name="E"/>'),
        "in Connector count",
        "E",
    ),
    Mutant(
        "ssp-element-name", in_default('Component name="drive"', 'Component name="plant"'), "Component plant", "'plant'"
    ),
    Mutant("ssp-connector-name", in_default(COUNT, COUNT + COUNT), "connector plant.count", "count"),
    Mutant("ssp-connector-unknown", in_default('name="count"', 'name="counts"'), "connector plant.counts", "counts"),
    Mutant("ssp-connector-kind", in_default(COUNT, COUNT.replace("output", "input")), "connector plant.count", "input"),
    Mutant("ssp-connector-type", in_default("<ssc:Integer/>", "<ssc:Boolean/>"), "connector plant.count", "Boolean"),
    Mutant(
        "ssp-connector-unit",
        in_default('<ssc:Real unit="m"/>', '<ssc:Real unit="kg"/>'),
        "connector plant.q",
        "kg (kg)",
    ),
    Mutant("ssp-connector-dimension", in_default(THREE, TWO), "connector drive.tau", "dimensions 2"),
    Mutant(
        "ssp-implementation",
        in_default('implementation="CoSimulation"', 'implementation="ModelExchange"'),
        "Component plant",
        "ModelExchange",
    ),
    Mutant(
        "ssp-dictionary",
        in_default('dictionary="signals"', 'dictionary="signal"'),
        "SignalDictionaryReference bus",
        "signal",
    ),
    Mutant("ssp-dictionary", _text(SSB, 'name="position"', 'name="speed"'), "connector position", "position"),
    Mutant("ssp-connection-end", in_default(TO_HAND, TO_HAND.replace("hand", "arm")), "hand → plant.arm", "plant.arm"),
    Mutant("ssp-connection-end", in_default(TO_HAND, TO_HAND.replace("plant", "arm")), "hand → arm.hand", "arm.hand"),
    Mutant(
        "ssp-connection-kind",
        in_default('endElement="bus" endConnector="position"', 'endElement="plant" endConnector="count"'),
        "plant.q → plant.count",
        "element's output and element's output",
    ),
    Mutant(
        "ssp-connection-twice", in_default(CONNECTION, CONNECTION * 2), "hand → plant.hand", "plant.hand has a source"
    ),
    Mutant(
        "ssp-connection-twice",
        in_default(
            CONNECTION, CONNECTION + CONNECTION.replace(TO_HAND, 'endElement="drive" endConnector="f" endIndices="2"')
        ),
        "drive.tau → drive.f",
        "drive.f has a source",
    ),
    Mutant(
        "ssp-connection-type",
        in_default(SYSTEM_HAND, 'kind="input"><ssc:Integer/>'),
        "hand → plant.hand",
        "Integer and Real",
    ),
    Mutant(
        "ssp-connection-unit",
        in_default(SYSTEM_HAND, SYSTEM_HAND.replace("N", "m")),
        "hand → plant.hand",
        "m (m) and N (kg m s-2)",
    ),
    Mutant("ssp-connection-dimension", in_default(' startIndices="1"', ""), "drive.tau → plant.tau", "3 and none"),
    Mutant(
        "ssp-connection-dimension",
        in_default(' startIndices="1"', ' startIndices="4"'),
        "drive.tau → plant.tau",
        "indices 4 of drive.tau",
    ),
    Mutant("ssp-input-unconnected", in_default(CONNECTION, ""), "connector plant.hand", "no connection and no value"),
    Mutant(
        "ssp-binding-source",
        in_default(INLINE, INLINE.replace("Binding>", 'Binding source="resources/all.ssv">')),
        "ParameterBinding of drive",
        "both",
    ),
    Mutant("ssp-binding-source", in_default(MAPPING, "<ssd:ParameterMapping/>"), "ParameterMapping of Good", "neither"),
    Mutant("ssp-parameter-twice", _text(SET, PARAMETER, PARAMETER * 2), "parameter plant.M", "plant.M"),
    Mutant("ssp-parameter-unknown", _text(SET, '"plant.M"', '"plant.m"'), "parameter plant.m", "plant.m"),
    Mutant(
        "ssp-parameter-kind",
        _text(SET, f'"plant.M">{MASS_VALUE}', '"plant.q"><ssv:Real value="7"/>'),
        "parameter plant.q",
        "plant.q: continuous output",
    ),
    Mutant(
        "ssp-parameter-type",
        _text(SET, MASS_VALUE, '<ssv:Boolean value="true"/>'),
        "parameter plant.M",
        "Boolean for plant.M",
    ),
    Mutant("ssp-parameter-value", _text(SET, 'value="7000"', 'value="700"'), "parameter plant.M", "700 for plant.M"),
    Mutant(
        "ssp-parameter-value",
        _text(SET, 'value="held"', 'value="fixed"'),
        "parameter plant.mode",
        "fixed for plant.mode",
    ),
    Mutant("ssp-parameter-value", in_default('value="1 2 4"', 'value="1 -2 4"'), "parameter K", "-2 for drive.K"),
    Mutant("ssp-parameter-unit", _text(SET, 'unit="g"', 'unit="m"'), "parameter plant.M", "m (m)"),
    Mutant("ssp-parameter-dimension", in_default('value="1 2 4"', 'value="1 2"'), "parameter K", "2 values"),
    Mutant(
        "ssp-parameter-dimension",
        in_default('value="1 2 4"/><ssc:Dimension size="3"/>', 'value="1 2"/><ssc:Dimension size="2"/>'),
        "parameter K",
        "dimensions 2 for drive.K",
    ),
    Mutant("ssp-mapping-source", _text(SSM, 'source="mass"', 'source="Mass"'), "mapping Mass → plant.M", "Mass"),
    Mutant(
        "ssp-mapping-target",
        _text(SSM, ENTRY, '<ssm:MappingEntry source="other" target="plant.M"/>' + ENTRY),
        "mapping mass → plant.M",
        "plant.M, as other",
    ),
    Mutant(
        "ssp-component-type",
        in_default(DRIVE, DRIVE.replace(" source", ' type="application/x-fmu" source')),
        "Component drive",
        "type application/x-fmu",
    ),
    Mutant(
        "ssp-component-type",
        in_default(DRIVE, DRIVE.replace(" source", ' type="" source')),
        "Component drive",
        "type of no letters",
    ),
    Mutant("ssp-experiment", in_default('stopTime="1.0"', 'stopTime="0.0"'), "DefaultExperiment", "from 0 to 0 s"),
    Mutant("ssp-component-fmu", _add(MASS, b"no archive"), "Component plant", "resources/Plant.fmu: it is no FMU"),
    Mutant(
        "ssp-component-system",
        in_default(DRIVE, DRIVE.replace(" source", ' type="application/x-ssp-definition" source')),
        "Component drive",
        "resources/Drive.fmu",
    ),
)
