"""Judges SSP archives, versions 1.0 and 2.0: the archive, each document, what they say of one another, the FMUs inside.

1. `archive.py` of the package above: the ZIP file, read without trusting it.
2. `package.py`: files and folders, variants, where sources lead.
3. `document.py`: each `.ssd`, `.ssv`, `.ssm`, `.ssb`, in a file or inside another: XML, schema, units, enumerations.
4. `elements.py`, `connections.py`, `bindings.py` with `kinds.py`: components against their FMUs, connections,
   parameters.
5. The FMUs by `exo validate`, the SSP archives inside by this package.

Not checked: geometry, signatures and metadata beyond the schema, clocks beyond it, Modelica models, what lies outside
the archive. Rules: `rule.py`; each is listed in docs/validate-ssp.md and shown to fire by a broken archive.
"""

import io
import zipfile
from collections.abc import Callable, Iterable
from contextlib import ExitStack, suppress
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any, Protocol
from urllib.parse import unquote

from lxml import etree

from exo.errors import FmuError
from exo.systems import interface
from exo.systems.document import SSC, SSD
from exo.systems.interface import Interface
from exo.validate.archive import DESCRIPTION, Contents, open_archive
from exo.validate.rule import Finding
from exo.validate.ssp import bindings, connections, elements, package
from exo.validate.ssp.bindings import BOTH, Names, Parameter
from exo.validate.ssp.document import ROOTS, Document, judged, parse
from exo.validate.ssp.elements import Element
from exo.validate.ssp.package import DEFAULT, MISSING, resolve
from exo.validate.ssp.rule import RULES, error, warning
from exo.validate.workspace import workspace

__all__ = ["RULES", "findings"]

EXPERIMENT = error("experiment", "the default experiment ends after it begins")
FMU = error("component-fmu", "the source of an FMU component is an FMU with a description that can be read")
KIND = warning("component-type", "a component is an FMU, a description or an SSP archive: others are not judged")
SYSTEM = error("component-system", "the source of a component that is a system is one")

FMU_TYPE, SSD_TYPE, SSP_TYPE = (
    "application/x-fmu-sharedlibrary",
    "application/x-ssp-definition",
    "application/x-ssp-package",
)
#: Archives in archives that are opened.
MAX_DEPTH = 3


class Report(Protocol):
    """What the judge of FMUs says."""

    @property
    def findings(self) -> tuple[Finding, ...]: ...

    @property
    def skipped(self) -> tuple[str, ...]: ...


Judge = Callable[[Path], Report]


def findings(path: Path, judge: Judge, depth: int = 0) -> tuple[list[Finding], list[str]]:
    """What is wrong with an archive, and sentences on what could not be looked at. `judge` judges an FMU."""
    with ExitStack() as stack:
        contents, found = open_archive(path, stack, extension=".ssp", described=DEFAULT)
        if contents is None:
            return found, ["all but the archive: it is not safe or not an SSP archive"]
        found += package.findings(contents)
        judged_archive = _Archive(contents, judge, stack.enter_context(workspace()), depth, found)
        judged_archive.look()
        return found, judged_archive.skipped


@dataclass
class _Archive:
    contents: Contents
    judge: Judge
    folder: Path
    depth: int
    found: list[Finding]
    skipped: list[str] = field(default_factory=list)
    documents: dict[str, Document] = field(default_factory=dict)
    #: By file; None for an FMU that could not be read.
    interfaces: dict[str, Interface | None] = field(default_factory=dict)
    _packages: set[str] = field(default_factory=set)
    #: Elements whose content was judged: a definition is used in several places.
    _inside: dict[Any, Document | None] = field(default_factory=dict)
    #: Ids of systems by document; names of files by what lies inside, None for what is no archive.
    _systems: dict[str, frozenset[str]] = field(default_factory=dict)
    _names: dict[str, frozenset[str] | None] = field(default_factory=dict)

    def look(self) -> None:
        """All rules but those of the archive itself."""
        for file in self.contents.files:
            if Path(file).suffix in ROOTS:
                document, problems = parse(file, self.contents.read(file))
                self.found += problems
                if document is not None:
                    self.documents[file] = document
                    if file.endswith(".ssv"):
                        self.found += bindings.parameters(document)[1]
        self.found += package.variants(self.documents)
        for document in list(self.documents.values()):
            if document.file.endswith(".ssd"):
                self.structure(document)

    def structure(self, document: Document) -> None:
        """One description."""
        for one in document.all("ssd:DefaultExperiment"):
            try:
                start, stop = float(one.get("startTime", "0")), float(one.get("stopTime", "inf"))
            except ValueError:
                continue  # the schema says so
            if not stop > start:
                where = document.place(one, "DefaultExperiment")
                self.found.append(EXPERIMENT.at(where, f"from {start:g} to {stop:g} s", "an end after the start"))
        self.metadata(document)
        for top in document.all("ssd:System"):
            interfaces = {
                node: known
                for node in top.iter(f"{{{SSD}}}Component")
                if (known := self.component(document, node)) is not None
            }
            root = elements.read(document, top, interfaces, self.found)
            self.found += elements.dictionaries(document, top, self.entries(document, top), {})
            valued = self.bound(document, root)
            for element in elements.every(root):
                if element.tag == "System":
                    inputs = {
                        (child.name, name) for child in element.children.values() for name in valued.get(id(child), ())
                    }
                    self.found += connections.findings(document, element, inputs)

    def component(self, document: Document, node: Any) -> Interface | None:
        """What the component's source is; its interface, if it is an FMU that can be read."""
        where = document.place(node, f"Component {node.get('name', '')}")
        source, kind = node.get("source"), node.get("type", FMU_TYPE)
        if source is None:
            return None
        if source.startswith("#"):
            if source[1:] not in self.systems(document):
                self.found.append(SYSTEM.at(where, source, "the id of a System in this document"))
            return None
        file, problems = resolve(self.contents, document, where, source)
        self.found += problems
        if not file:
            return None
        if kind == FMU_TYPE:
            return self.fmu(file, where)
        if kind == SSD_TYPE and not file.endswith(".ssd"):
            self.found.append(SYSTEM.at(where, source, "a description, .ssd"))
        elif kind == SSP_TYPE:
            self.package(file)
        elif kind != SSD_TYPE:
            known = f"{FMU_TYPE}, {SSD_TYPE} or {SSP_TYPE}"
            self.found.append(KIND.at(where, f"type {kind or 'of no letters'}", known))
            self.skipped.append(f"{file}: a component of another type")
        return None

    def systems(self, document: Document) -> frozenset[str]:
        """The ids of the document's systems."""
        if document.file not in self._systems:
            known = (one.get("id") for one in document.root.iter(f"{{{SSD}}}System"))
            self._systems[document.file] = frozenset(name for name in known if name)
        return self._systems[document.file]

    def metadata(self, document: Document) -> None:
        """Where metadata, signatures and icons lie; what lies in a resource is looked for in that."""
        for node in document.root.iter(f"{{{SSC}}}MetaData", f"{{{SSC}}}Signature", f"{{{SSD}}}ElementGeometry"):
            name = etree.QName(node).localname
            where = document.place(node, name)
            source = node.get("iconSource" if name == "ElementGeometry" else "source")
            if name != "ElementGeometry" and (source is None) == (node.find(f"{{{SSC}}}Content") is None):
                value = "neither" if source is None else "both"
                self.found.append(BOTH.at(where, value, "a source or one ssc:Content"))
            elif source is not None and node.get("sourceBase", "file") == "file":
                self.found += resolve(self.contents, document, where, source)[1]
            elif source is not None and node.get("sourceBase") == "resource":
                self.within(document, node, where, source)

    def within(self, document: Document, node: Any, where: str, source: str) -> None:
        """Metadata that lie in the FMU or archive of the element around."""
        of = node.getparent().get("source")
        if of is None:
            self.found.append(BOTH.at(where, "sourceBase resource", "an element around it that has a source"))
            return
        file, _ = resolve(self.contents, document, where, of)
        if not file:
            return  # the component says so
        if file not in self._names:
            self._names[file] = None
            with suppress(zipfile.BadZipFile), zipfile.ZipFile(io.BytesIO(self.contents.read(file))) as inner:
                self._names[file] = frozenset(inner.namelist())
        names = self._names[file]
        if names is not None and unquote(source) not in names:
            self.found.append(MISSING.at(where, f"{source} in {file}", "a file of that archive"))

    def fmu(self, file: str, where: str) -> Interface | None:
        """The FMU's interface; each FMU is judged once."""
        if file not in self.interfaces:
            self.interfaces[file] = None
            path = self._extracted(file, ".fmu")
            report = self.judge(path)
            versions = [finding for finding in report.findings if finding.rule == "xml-version"]
            if versions:
                self.skipped.append(f"{file}: {versions[0].value}: {versions[0].expected}")
            within = [replace(one, where=f"{file}: {one.where}") for one in report.findings if one not in versions]
            self.found += within
            self.skipped += [f"{file}: {sentence}" for sentence in report.skipped if not versions]
            with ExitStack() as stack:
                contents, _ = open_archive(path, stack)
                try:
                    if contents is None:
                        raise FmuError("it is no FMU that is safe to read")
                    self.interfaces[file] = interface.read(contents.read(DESCRIPTION))
                except FmuError as problem:
                    self.found.append(FMU.at(where, f"{file}: {problem}", "an FMU"))
        return self.interfaces[file]

    def package(self, file: str) -> None:
        """An SSP archive inside; each is judged once."""
        if file in self._packages:
            return
        self._packages.add(file)
        if self.depth >= MAX_DEPTH:
            self.skipped.append(f"{file}: an archive in {self.depth} archives")
            return
        found, skipped = findings(self._extracted(file, ".ssp"), self.judge, self.depth + 1)
        self.found += [replace(one, where=f"{file}: {one.where}") for one in found]
        self.skipped += [f"{file}: {sentence}" for sentence in skipped]

    def _extracted(self, file: str, extension: str) -> Path:
        path = self.folder / f"{len(self.interfaces) + len(self._packages)}{extension}"
        try:
            path.write_bytes(self.contents.read(file))
        except OSError as problem:
            raise FmuError(f"{self.contents.archive.filename}: {file} cannot be extracted: {problem}") from problem
        return path

    def entries(self, document: Document, top: Any) -> dict[Any, frozenset[str]]:
        """The entries of each dictionary that could be read."""
        found = {}
        for node in top.iter(f"{{{SSD}}}SignalDictionary"):
            name = f"SignalDictionary {node.get('name', '')}"
            inner = self.content(document, node, node, name, "ssb:SignalDictionary")
            if inner is not None:
                found[node] = frozenset(one.get("name", "") for one in inner.all("ssb:DictionaryEntry"))
        return found

    def content(self, document: Document, node: Any, holder: Any, name: str, path: str) -> Document | None:
        """The document that `node` has as its source, or that `holder` has inside, if that could be read."""
        if node in self._inside:
            return self._inside[node]
        where = document.place(node, name)
        source = node.get("source")
        inner = [] if holder is None else document.all(path, holder)
        result: Document | None = None
        others = holder is not None and any(map(_is_content, holder))
        if (source is not None) == others or len(inner) > 1:
            self.found.append(BOTH.at(where, "both" if source is not None else "neither", f"a source or one {path}"))
        elif inner:
            result = document.inside(inner[0])
            self.found += judged(result)
            if path == "ssv:ParameterSet":
                self.found += bindings.parameters(result)[1]
        elif source is not None:
            if node.get("sourceBase", "SSD") == "component":
                self.skipped.append(f"{where}: {source}, which lies in the component")
            else:
                file, problems = resolve(self.contents, document, where, source)
                self.found += problems
                result = self.documents.get(file)
        self._inside[node] = result
        return result

    def bound(self, document: Document, root: Element) -> dict[int, set[str]]:
        """Judges all bindings; the names of inputs that get a value, by the identity of their element."""
        valued: dict[int, set[str]] = {}
        for element in elements.every(root):
            names = Names(element)
            for node in document.all("ssd:ParameterBindings/ssd:ParameterBinding", element.node):
                for name, parameter, changed in self.given(document, node, element):
                    self.found += bindings.applied(names, name, parameter, changed=changed)
                    for target in names.find(name)[0]:
                        valued.setdefault(target.owner, set()).add(target.name)
        return valued

    def given(self, document: Document, node: Any, element: Element) -> Iterable[tuple[str, Parameter, bool]]:
        """Names and parameters of one binding."""
        name = f"ParameterBinding of {element.name}"
        if node.get("type", "application/x-ssp-parameter-set") != "application/x-ssp-parameter-set":
            self.skipped.append(f"{document.place(node, name)}: {node.get('type')}, another format")
            return []
        holder = next(iter(document.all("ssd:ParameterValues", node)), None)
        values = self.content(document, node, holder, name, "ssv:ParameterSet")
        if values is None:
            return []
        prefix = node.get("prefix", "")
        listed = [replace(one, name=prefix + one.name) for one in bindings.parameters(values)[0]]
        for mapping in document.all("ssd:ParameterMapping", node):
            inner = self.content(
                document, mapping, mapping, f"ParameterMapping of {element.name}", "ssm:ParameterMapping"
            )
            if inner is None:
                return []
            result, problems = bindings.mapped(inner, listed)
            self.found += problems
            return result
        return [(one.name, one, False) for one in listed]


def _is_content(child: Any) -> bool:
    """Whether it is more than a comment or what is said of the content."""
    return isinstance(child.tag, str) and etree.QName(child).localname not in ("MetaData", "Signature", "Annotations")
