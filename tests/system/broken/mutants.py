"""The broken FMUs: one change each, and the rule that must find it.

Each starts from a good FMU of this project, unless a part is broken that these lack (types, a crashing library): then
from the FMU in C.
"""

import zlib
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from broken.parts import INDEX, XML, Parts

TC, ARM, PLAIN = "TestbedController", "ExoskeletonArm", "Plain"


@dataclass(frozen=True)
class Mutant:
    """A change, the rule that must find it, and whether fmpy finds it as well."""

    rule: str
    what: str
    change: Callable[[Parts], Any]
    base: str = TC
    #: None: fmpy is not asked, as the archive is not safe.
    fmpy: bool | None = False
    #: Macros of the FMU in C.
    macros: tuple[str, ...] = ()
    #: Options of `check`.
    options: dict[str, Any] = field(default_factory=dict)

    @property
    def id(self) -> str:
        """For pytest."""
        return f"{self.rule}: {self.what}"


def variable(name: str) -> str:
    """The path of a variable."""
    return f"ModelVariables/ScalarVariable[@name='{name}']"


def unit(name: str) -> str:
    """The path of a unit."""
    return f"UnitDefinitions/Unit[@name='{name}']"


def nothing(_: Parts) -> None:
    """For what macros or options alone break."""


def xml(old: str, new: str) -> Callable[[Parts], None]:
    """Replaces text in the description."""
    return lambda parts: parts.replace(XML, old, new)


def page(addition: str) -> Callable[[Parts], None]:
    """Adds to the body of the documentation's page."""
    return lambda parts: parts.replace(INDEX, "</body>", f"{addition}</body>")


def edit(path: str, **how: Any) -> Callable[[Parts], None]:
    """Changes an element of the description."""
    return lambda parts: parts.edit(path, **how)


def insert(path: str, text: str) -> Callable[[Parts], None]:
    """Adds an element to the description."""
    return lambda parts: parts.insert(path, text)


def add(name: str, data: bytes = b"x", **how: Any) -> Callable[[Parts], None]:
    """Adds an entry."""
    return lambda parts: parts.add(name, data, **how)


def rename(old: str, new: str) -> Callable[[Parts], None]:
    """Renames entries by the beginning of their names."""

    def change(parts: Parts) -> None:
        assert any(name.startswith(old) for name in parts.entries)
        parts.entries = {
            new + name.removeprefix(old) if name.startswith(old) else name: d for name, d in parts.entries.items()
        }

    return change


def remove(beginning: str) -> Callable[[Parts], None]:
    """Removes entries by the beginning of their names."""

    def change(parts: Parts) -> None:
        assert any(name.startswith(beginning) for name in parts.entries)
        parts.entries = {name: data for name, data in parts.entries.items() if not name.startswith(beginning)}

    return change


def set_to(name: str, value: Any) -> Callable[[Parts], None]:
    """How the archive is written."""
    return lambda parts: setattr(parts, name, value)


def put(name: str, data: bytes) -> Callable[[Parts], None]:
    """Replaces an entry's bytes."""
    return lambda parts: parts.entries.update({name: data})


def library(old: bytes, new: bytes) -> Callable[[Parts], None]:
    """Replaces bytes of the same length in the library."""
    assert len(old) == len(new)
    return lambda parts: parts.replace(parts.library, old, new)


def encrypted(parts: Parts) -> None:
    """Sets the flag of encryption of model.png in both headers."""
    data = b"PK\x03\x04\x14\x00"
    parts.patches = [
        (data + b"\x00\x00", data + b"\x01\x00"),
        (b"PK\x01\x02\x14\x03\x14\x00\x00\x00", b"PK\x01\x02\x14\x03\x14\x00\x01\x00"),
    ]


def wrong_checksum(parts: Parts) -> None:
    """Another checksum for the description, in both headers."""
    good = zlib.crc32(parts.entries[XML])
    parts.patches = [(good.to_bytes(4, "little"), (good ^ 1).to_bytes(4, "little"))]


def laughs(parts: Parts) -> None:
    """Entities that expand to 10⁹ letters."""
    lines = "".join(f'<!ENTITY l{i} "{f"&l{i - 1};" * 10}">' for i in range(1, 10))
    parts.replace(XML, "<fmiModelDescription", f'<!DOCTYPE x [<!ENTITY l0 "ha">{lines}]><fmiModelDescription')
    parts.replace(XML, 'description="', 'description="&l9;')


def utf16(parts: Parts) -> None:
    """The description in UTF-16."""
    text = parts.entries[XML].decode().replace('encoding="UTF-8"', 'encoding="UTF-16"')
    parts.entries[XML] = text.encode("utf-16")


def emptied(parts: Parts) -> None:
    """A folder for libraries without any."""
    remove("binaries/")(parts)
    parts.entries["binaries/win64/"] = b""


def latin1(parts: Parts) -> None:
    """The description in Latin-1, with a letter that shows it."""
    text = parts.entries[XML].decode().replace('encoding="UTF-8"', 'encoding="ISO-8859-1"')
    parts.entries[XML] = text.replace('description="', 'description="größer: ', 1).encode(
        "latin-1", "xmlcharrefreplace"
    )


INITIAL = "ModelStructure/InitialUnknowns"
OUTPUTS = "ModelStructure/Outputs"
UNSAFE: dict[str, Any] = {"fmpy": None}
TIME = """<ScalarVariable name="t" valueReference="99999" description="d" causality="independent"
    variability="continuous"><Real unit="s"/></ScalarVariable>"""
CHOICE = """<ScalarVariable name="m" valueReference="9" description="d" causality="parameter" variability="fixed">
    <Enumeration declaredType="Mode" start="3"/></ScalarVariable>"""

ARCHIVE = [
    Mutant("archive-readable", "half of the file", set_to("keep", 0.5), **UNSAFE),
    Mutant("archive-readable", "no archive at all", set_to("keep", 0.0), **UNSAFE),
    Mutant("archive-readable", "a wrong checksum", wrong_checksum, **UNSAFE),
    Mutant("archive-readable", "an encrypted entry", encrypted, **UNSAFE),
    Mutant("archive-method", "bzip2", set_to("method", 12), **UNSAFE),
    Mutant("archive-size", "4 MB of zeros in 4 kB", add("resources/zeros", bytes(1 << 22)), **UNSAFE),
    Mutant("archive-duplicate", "two descriptions", add(XML, b"<x/>"), **UNSAFE),
    Mutant("archive-path", "out of the archive", add("resources/../../evil"), **UNSAFE),
    Mutant("archive-path", "an absolute name", add("/etc/evil"), **UNSAFE),
    Mutant("archive-path", "a drive", add("C:evil"), **UNSAFE),
    Mutant("archive-path", "an empty part", add("resources//x"), **UNSAFE),
    Mutant("archive-path", "an empty name", add(""), **UNSAFE),
    Mutant("archive-path", "out of the archive, the Windows way", add("resources\\..\\..\\evil"), **UNSAFE),
    Mutant("archive-path", "a control character", add("resources/a\x1b[2Jb"), **UNSAFE),
    Mutant("archive-length", "256 bytes in one part", add(f"resources/{'x' * 256}"), **UNSAFE),
    Mutant("archive-length", "128 letters of two bytes", add(f"resources/{'ä' * 128}"), **UNSAFE),
    Mutant("archive-length", "a thousand folders", add("x/" * 1000 + "x"), **UNSAFE),
    Mutant("archive-backslash", "a Windows path", add("resources\\map.csv"), **UNSAFE),
    Mutant("archive-link", "a symbolic link", add("resources/link", b"/etc/passwd", mode=0o120777), **UNSAFE),
    Mutant("archive-link", "a pipe", add("resources/pipe", b"", mode=0o010644), **UNSAFE),
    Mutant("archive-link", "a device", add("resources/disk", b"", mode=0o060644), **UNSAFE),
    Mutant("archive-windows", "a device", add("resources/Con.csv"), **UNSAFE),
    Mutant("archive-windows", "a star", add("resources/a*b"), **UNSAFE),
    Mutant("archive-windows", "a stream", add("resources/a:b"), **UNSAFE),
    Mutant("archive-windows", "a dot at the end", add("resources/map."), **UNSAFE),
    Mutant("archive-windows", "a blank at the end of a folder", add("resources/maps /a.csv"), **UNSAFE),
    Mutant("archive-ascii", "an umlaut", add("resources/größe.csv"), **UNSAFE),
    Mutant("archive-ascii", "a control character", add("resources/a\x1b[2Jb"), **UNSAFE),
    Mutant("archive-case", "two spellings", add("Documentation/index.html"), **UNSAFE),
    Mutant("archive-case", "a file that is a folder", add("documentation"), **UNSAFE),
    Mutant("archive-extension", "called .zip", set_to("extension", ".zip")),
    Mutant("archive-description", "all in one folder", rename("", "TestbedController/"), **UNSAFE),
    Mutant("archive-description", "no description", remove(XML), **UNSAFE),
]
TEXT = [
    Mutant("xml-parses", "an end tag is missing", xml("</ModelStructure>", ""), fmpy=True),
    Mutant(
        "xml-parses",
        "bytes that are no UTF-8",
        lambda p: p.replace(XML, b'description="', b'description="\xff'),
        fmpy=True,
    ),
    Mutant("xml-parses", "an empty file", put(XML, b""), fmpy=True),
    Mutant("xml-doctype", "entities without end", laughs, fmpy=None),
    Mutant("xml-declaration", "none", xml('<?xml version="1.0" encoding="UTF-8"?>', "")),
    Mutant("xml-declaration", "no encoding in it", xml(' encoding="UTF-8"?>', "?>")),
    Mutant("xml-declaration", "XML 1.1", xml('version="1.0" encoding', 'version="1.1" encoding')),
    Mutant("xml-mark", "a byte order mark", lambda p: p.replace(XML, b"<?xml", b"\xef\xbb\xbf<?xml")),
    Mutant("xml-encoding", "UTF-16", utf16),
    Mutant("xml-encoding", "Latin-1", latin1),
    Mutant("xml-root", "another root", edit(".", tag="modelDescription"), fmpy=True),
    Mutant("xml-version", "FMI 1.0", edit(".", fmiVersion="1.0"), fmpy=True),
    Mutant("fmpy", "an output is missing in Outputs", lambda p: p.drop(f"{OUTPUTS}/Unknown"), fmpy=True),
    Mutant("fmpy", "a misspelt capability", edit("CoSimulation", canRunAsynchronously="false"), fmpy=True),
]
HEAD = [
    Mutant("head-co-simulation", "no interface", lambda p: p.drop("CoSimulation")),
    Mutant("head-model-name", "an empty one", edit(".", modelName="")),
    Mutant("head-model-name", "a blank", edit(".", modelName=" ")),
    Mutant("head-model-identifier", "a hyphen", edit("CoSimulation", modelIdentifier="Testbed-Controller")),
    Mutant("head-guid", "an empty guid", edit(".", guid="")),
    Mutant("head-state", "serialized, not got", edit("CoSimulation", canGetAndSetFMUstate="false")),
    Mutant("head-memory", "needs an allocator", edit("CoSimulation", canNotUseMemoryManagementFunctions="false")),
    Mutant("head-experiment", "no stepSize", edit("DefaultExperiment", remove=("stepSize",))),
    Mutant("head-experiment", "no DefaultExperiment", lambda p: p.drop("DefaultExperiment")),
    Mutant("head-experiment-values", "stops before it starts", edit("DefaultExperiment", startTime="100")),
    Mutant("head-experiment-values", "stepSize 0", edit("DefaultExperiment", stepSize="0")),
    Mutant("head-experiment-values", "an infinite stop", edit("DefaultExperiment", stopTime="INF")),
    Mutant("head-log-categories", "one twice", insert("LogCategories", '<Category name="logAll"/>')),
]
VARIABLES = [
    Mutant("variable-name-once", "two of one name", edit(variable("D_n"), name="M_n"), fmpy=True),
    Mutant("variable-case", "m_n beside M_n", edit(variable("D_n"), name="m_n")),
    Mutant("variable-name", "a blank at the end", edit(variable("D_n"), name="D_n "), fmpy=True),
    Mutant("variable-array", "no second element", edit(variable("q[2]"), name="q2"), base=ARM),
    Mutant("variable-description", "no description", edit(variable("K"), remove=("description",))),
    Mutant(
        "variable-variability", "a Boolean without it", edit(variable("saturated"), remove=("variability",)), fmpy=True
    ),
    Mutant("variable-input-initial", "an input with initial", edit(variable("q"), initial="exact")),
    Mutant(
        "variable-independent",
        "time as a variable",
        insert("ModelVariables", TIME),
    ),
    Mutant("variable-multiple-set", "at a parameter", edit(variable("K"), canHandleMultipleSetPerTimeInstant="false")),
    Mutant(
        "variable-multiple-set",
        "at an input without model exchange",
        edit(variable("q"), canHandleMultipleSetPerTimeInstant="false"),
    ),
    Mutant("variable-structured", "a hyphen", edit(variable("D_n"), name="D-n"), fmpy=True),
    Mutant("variable-reference", "33 bits", edit(variable("K"), valueReference=str(1 << 32)), fmpy=True),
    Mutant("variable-alias", "two parameters with one reference", edit(variable("D_n"), valueReference="4352")),
    Mutant("variable-alias-unit", "a length and a velocity", edit(variable("dq_n"), valueReference="1024")),
    Mutant("variable-start-kind", "an Integer of 2.5", edit(f"{variable('law')}/Integer", start="2.5"), fmpy=True),
    Mutant(
        "variable-start-kind",
        "a Boolean that is maybe",
        edit(f"{variable('engage')}/Boolean", start="maybe"),
        fmpy=True,
    ),
    Mutant("variable-start-finite", "NaN", edit(f"{variable('K')}/Real", start="NaN")),
    Mutant("variable-start-range", "below min", edit(f"{variable('K')}/Real", start="-1")),
    Mutant("variable-start-range", "above max", edit(f"{variable('law')}/Integer", start="7")),
    Mutant("variable-start-range", "above the max of its type", edit(f"{variable('u')}/Real", start="11"), base=PLAIN),
    Mutant(
        "variable-start-item",
        "an item that is not there",
        insert(
            "ModelVariables",
            CHOICE,
        ),
        base=PLAIN,
    ),
    Mutant(
        "variable-start-calculated", "an output with a start", edit(f"{variable('tau_a')}/Real", start="0"), fmpy=True
    ),
    Mutant("variable-bounds", "min above max", edit(f"{variable('law')}/Integer", min="7")),
    Mutant(
        "variable-bounds", "of a type", edit("TypeDefinitions/SimpleType[@name='Angle']/Real", min="20"), base=PLAIN
    ),
    Mutant("variable-nominal", "nominal 0", edit(f"{variable('K')}/Real", nominal="0")),
    Mutant(
        "variable-display-unit",
        "without unit",
        edit(f"{variable('K')}/Real", remove=("unit",), displayUnit="m"),
        fmpy=True,
    ),
    Mutant(
        "variable-type",
        "a type that is not there",
        edit(f"{variable('u')}/Real", declaredType="Angel"),
        base=PLAIN,
        fmpy=True,
    ),
    Mutant(
        "variable-type",
        "a type of another kind",
        edit(f"{variable('u')}/Real", declaredType="Mode"),
        base=PLAIN,
        fmpy=None,
    ),
    Mutant(
        "type-name", "called like a variable", edit("TypeDefinitions/SimpleType[@name='Mode']", name="y"), base=PLAIN
    ),
    Mutant(
        "type-items",
        "two items with one value",
        edit("TypeDefinitions/SimpleType/Enumeration/Item[@name='on']", value="1"),
        base=PLAIN,
    ),
]
UNITS = [
    Mutant("unit-missing", "a Real without unit", edit(f"{variable('K')}/Real", remove=("unit",))),
    Mutant("unit-name", "defined twice", insert("UnitDefinitions", '<Unit name="kg"><BaseUnit kg="1"/></Unit>')),
    Mutant(
        "unit-undefined",
        "of a type",
        edit("TypeDefinitions/SimpleType[@name='Angle']/Real", unit="radian"),
        base=PLAIN,
        fmpy=True,
    ),
    Mutant("unit-unused", "candela", insert("UnitDefinitions", '<Unit name="cd"><BaseUnit cd="1"/></Unit>')),
    Mutant("unit-base", "no exponents", lambda p: p.drop(f"{unit('N')}/BaseUnit")),
    Mutant("unit-exponents", "a newton is a joule", edit(f"{unit('N')}/BaseUnit", m="2")),
    Mutant("unit-exponents", "m/s2 is m/s", edit(f"{unit('m/s2')}/BaseUnit", s="-1")),
    Mutant("unit-exponents", "an inertia without kg", edit(f"{unit('rad/s')}/BaseUnit", kg="1"), base=ARM),
    Mutant("unit-rad", "an angle without rad", edit(f"{unit('rad/s')}/BaseUnit", remove=("rad",)), base=ARM),
    Mutant("unit-factor", "a newton is a kilonewton", edit(f"{unit('N')}/BaseUnit", factor="1000")),
    Mutant("unit-factor", "a shifted second", edit(f"{unit('s')}/BaseUnit", offset="1")),
    Mutant(
        "unit-display",
        "degrees the wrong way",
        edit(f"{unit('rad')}/DisplayUnit", factor="0.017453292519943295"),
        base=ARM,
    ),
    Mutant(
        "unit-display", "an angle shown in metres", edit(f"{unit('rad')}/DisplayUnit", name="mm"), base=ARM, fmpy=None
    ),
    Mutant("unit-angle", "no degrees", lambda p: p.drop(f"{unit('rad')}/DisplayUnit"), base=PLAIN),
]
STRUCTURE = [
    Mutant("structure-index", "a value reference", edit(f"{OUTPUTS}/Unknown", index="768"), fmpy=True),
    Mutant(
        "structure-index", "counted from 0", edit(f"{INITIAL}/Unknown[@dependencies='1']", dependencies="0"), fmpy=None
    ),
    Mutant("structure-outputs", "an output twice", insert(OUTPUTS, '<Unknown index="7" dependencies=""/>')),
    Mutant(
        "structure-outputs", "an input among them", insert(OUTPUTS, '<Unknown index="1" dependencies=""/>'), fmpy=True
    ),
    Mutant("structure-initial-once", "an unknown twice", insert(INITIAL, '<Unknown index="16" dependencies=""/>')),
    Mutant("structure-initial-sorted", "the first one last", lambda p: p.rotate(INITIAL)),
    Mutant(
        "structure-initial-unknown", "a parameter", insert(INITIAL, '<Unknown index="30" dependencies=""/>'), fmpy=True
    ),
    Mutant("structure-initial-kind", "fixed", edit(f"{INITIAL}/Unknown[@dependencies='1']", dependenciesKind="fixed")),
    Mutant(
        "structure-kind",
        "two kinds for one",
        edit(f"{INITIAL}/Unknown[@dependencies='1']", dependenciesKind="dependent dependent"),
        fmpy=True,
    ),
    Mutant(
        "structure-kind",
        "a word of its own",
        edit(f"{INITIAL}/Unknown[@dependencies='1']", dependenciesKind="linear"),
        fmpy=True,
    ),
    Mutant(
        "structure-kind-real",
        "a discrete Boolean",
        edit(f"{OUTPUTS}/Unknown[@index='11']", dependencies="1", dependenciesKind="discrete"),
    ),
    Mutant("structure-dependencies-sorted", "descending", edit(f"{OUTPUTS}/Unknown", dependencies="2 1")),
    Mutant("structure-dependencies-known", "on a parameter", edit(f"{OUTPUTS}/Unknown", dependencies="28")),
    Mutant("structure-dependencies-known", "initially on an output", edit(f"{INITIAL}/Unknown", dependencies="7")),
]
FOLDERS = [
    Mutant("layout-root", "a file at the root", put("readme.txt", b"x")),
    Mutant("layout-root", "a folder at the root", put("doc/readme.txt", b"x")),
    Mutant("layout-extra", "no domain", put("extra/tool/x.xml", b"<x/>")),
    Mutant("layout-picture", "a JPEG", put("model.png", b"\xff\xd8\xff\xe0")),
    Mutant(
        "layout-licenses",
        "another way in",
        rename("documentation/licenses/license.txt", "documentation/licenses/a.txt"),
    ),
    Mutant("layout-license-text", "no texts", remove("documentation/licenses/")),
    Mutant("documentation-index", "called main.html", rename(INDEX, "documentation/main.html")),
    Mutant("documentation-encoding", "Latin-1 that says UTF-8", lambda p: p.replace(INDEX, b"</body>", b"\xe4</body>")),
    Mutant(
        "documentation-encoding",
        "an unknown charset",
        lambda p: p.replace(INDEX, b'charset="utf-8"', b'charset="base64"'),
    ),
    Mutant("documentation-link", "a page that is not there", page('<a href="more.html">more</a>')),
    Mutant("documentation-link", "another case", page('<a href="Licenses/license.txt">licence</a>')),
    Mutant("documentation-link", "a picture that is not there", page('<img src="frames.png" alt="frames">')),
    Mutant("documentation-link", "out of the archive", page('<a href="../../README.md">readme</a>')),
    Mutant("documentation-anchor", "an id that is not there", page('<a href="#Nowhere">there</a>')),
    Mutant("documentation-local", "a file of the builder", page('<img src="file:///home/me/frames.png" alt="">')),
    Mutant("documentation-network", "a style sheet of a server", page('<img src="https://example.org/x.png" alt="">')),
]
MACHINE_CODE = [
    Mutant("binary-platform", "an unknown platform", put("binaries/amiga/TestbedController.library", b"x")),
    Mutant(
        "binary-name",
        "another name",
        rename("binaries/linux64/TestbedController.so", "binaries/linux64/libcontroller.so"),
    ),
    Mutant("binary-name", "another folder's", edit("CoSimulation", modelIdentifier="../linux64/TestbedController")),
    Mutant("binary-none", "no binary", remove("binaries/")),
    Mutant("binary-none", "an empty folder", emptied),
    Mutant("binary-wanted", "no darwin64", nothing, options={"platforms": ("linux64", "darwin64")}),
    Mutant("binary-format", "a text", lambda p: p.entries.update({p.library: b"no library"})),
    Mutant(
        "binary-format",
        "an ELF file for Windows",
        lambda p: p.entries.update({"binaries/win64/TestbedController.dll": p.entries[p.library]}),
    ),
    Mutant("binary-format", "half of it", lambda p: p.entries.update({p.library: p.entries[p.library][:40]})),
    Mutant("binary-format", "for another machine", library(b"\x03\x00\x3e\x00", b"\x03\x00\xb7\x00")),
    Mutant("binary-format", "no shared library", library(b"\x03\x00\x3e\x00", b"\x01\x00\x3e\x00")),
    Mutant("binary-exports", "a misspelt function", library(b"fmi2DoStep\0", b"fmi2DoStop\0")),
    Mutant("binary-exports", "33 functions", nothing, PLAIN, macros=("-DINCOMPLETE",)),
    Mutant("binary-extra", "one more symbol", nothing, PLAIN, macros=("-DEXTRA",)),
    Mutant("binary-paths", "a path of the builder", nothing, PLAIN, macros=("-DHOME",)),
    Mutant("binary-glibc", "newer than 2.1", nothing, options={"max_glibc": "2.1"}),
    Mutant(
        "binary-needs",
        "libgcc_s",
        nothing,
        PLAIN,
        macros=("-Wl,--no-as-needed", "-lgcc_s"),
        options={"max_glibc": "99.0"},
    ),
]
RUN = [
    Mutant("load-crash", "aborts", nothing, PLAIN, macros=("-DCRASH",)),
    Mutant("load-library", "a function that is nowhere", nothing, PLAIN, macros=("-DUNDEFINED",)),
    Mutant("load-crash", "exits", nothing, PLAIN, macros=("-DEXIT=7",)),
    Mutant("load-crash", "exits as if all were well", nothing, PLAIN, macros=("-DEXIT=0",)),
    Mutant("load-crash", "kills itself", nothing, PLAIN, macros=("-DSIGNAL=SIGKILL",)),
    Mutant("load-version", "FMI 2.1", nothing, PLAIN, macros=('-DVERSION="2.1"',)),
    Mutant(
        "load-instantiate", "another guid in the description", edit(".", guid="{45c8ba4b-0000-0000-0000-000000000000}")
    ),
    Mutant("load-guid", "takes any guid", nothing, PLAIN, macros=("-DANY_GUID",)),
    Mutant("load-status", "a warning at each step", nothing, PLAIN, macros=("-DWARNS",)),
    Mutant("load-read", "a reference that the library lacks", edit(variable("M_n"), valueReference="4000000")),
    Mutant("load-start", "a Real", edit(f"{variable('K')}/Real", start="31.0")),
    Mutant("load-start", "a Boolean", edit(f"{variable('engage')}/Boolean", start="false")),
    Mutant("load-bounds", "an output above max", edit(f"{variable('q_n')}/Real", max="-1")),
    Mutant("load-streams", "talks", nothing, PLAIN, macros=("-DLOUD",)),
]
MUTANTS = ARCHIVE + TEXT + HEAD + VARIABLES + UNITS + STRUCTURE + FOLDERS + MACHINE_CODE + RUN
