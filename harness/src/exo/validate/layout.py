"""The archive's folders: what lies where, and what a tool looks for there."""

from collections.abc import Iterator

from exo.validate.archive import Contents
from exo.validate.description import Description
from exo.validate.rule import Finding, error, warning

ROOT = warning("layout-root", "the root holds only what the standard names there")
EXTRA = warning("layout-extra", "folders in extra/ are reverse domain names")
PICTURE = error("layout-picture", "model.png, icon.png and diagram.png are PNG pictures")
VECTOR = error("layout-vector", "icon.svg comes with icon.png, and diagram.svg with diagram.png", only="3.0")
LICENSES = warning(
    "layout-licenses", "documentation/licenses, if there, has license.txt or license.html, in FMI 3.0 also license.spdx"
)
LICENSED = warning(
    "layout-license-text", "a description that names a license comes with its text in documentation/licenses"
)

#: FMI 3.0 has no model.png: its picture is terminalsAndIcons/icon.png.
FILES = {"2.0": {"modelDescription.xml", "model.png"}, "3.0": {"modelDescription.xml"}}
FOLDERS = {"binaries", "documentation", "extra", "resources", "sources", "terminalsAndIcons"}
#: The way in to the licenses.
ENTRIES = {"2.0": ("license.txt", "license.html"), "3.0": ("license.txt", "license.html", "license.spdx")}
PICTURES = ("model.png", "terminalsAndIcons/icon.png", "documentation/diagram.png")
VECTORS = ("terminalsAndIcons/icon", "documentation/diagram")
PNG = b"\x89PNG\r\n\x1a\n"


def findings(contents: Contents, description: Description) -> Iterator[Finding]:
    """All of this module's rules."""
    version = description.version.name
    files, entries = FILES[version], [f"documentation/licenses/{name}" for name in ENTRIES[version]]
    for name in contents.files:
        if "/" not in name and name not in files:
            yield ROOT.at(name, "a file at the root", f"one of {', '.join(sorted(files))}")
    for folder in sorted(contents.folders):
        if "/" not in folder and folder not in FOLDERS:
            yield ROOT.at(folder, "a folder at the root", f"one of {', '.join(sorted(FOLDERS))}")
    for name in contents.files:
        top, *rest = name.split("/")
        if top == "extra" and (len(rest) < 2 or "." not in rest[0]):
            yield EXTRA.at(name, rest[0], "extra/<reverse domain>/, as in extra/org.example/")
    for name in PICTURES:
        if name in contents.files and (signature := contents.read(name)[: len(PNG)]) != PNG:
            yield PICTURE.at(name, signature, "the signature of PNG")
    for name in VECTORS if version == "3.0" else ():
        if f"{name}.svg" in contents.files and f"{name}.png" not in contents.files:
            yield VECTOR.at(f"{name}.svg", f"no {name}.png", f"{name}.png as well")
    texts = [name for name in contents.files if name.startswith("documentation/licenses/")]
    if texts and not any(name in entries for name in texts):
        yield LICENSES.at("documentation/licenses", texts[0], f"{' or '.join(ENTRIES[version])} as the way in")
    license_name = description.root.get("license")
    if license_name and not texts:
        yield LICENSED.at("documentation/licenses", "missing", f"the text of {license_name}")
