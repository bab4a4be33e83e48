"""The archive's folders: what lies where, and what a tool looks for there."""

from collections.abc import Iterator

from exo.validate.archive import Contents
from exo.validate.rule import Finding, error, warning

ROOT = warning("layout-root", "the root holds only what the standard names there")
EXTRA = warning("layout-extra", "folders in extra/ are reverse domain names")
PICTURE = error("layout-picture", "model.png is a PNG picture")
LICENSES = warning("layout-licenses", "documentation/licenses, if there, has license.txt or license.html")
LICENSED = warning(
    "layout-license-text", "a description that names a license comes with its text in documentation/licenses"
)

FILES = {"modelDescription.xml", "model.png"}
FOLDERS = {"binaries", "documentation", "extra", "resources", "sources", "terminalsAndIcons"}
PNG = b"\x89PNG\r\n\x1a\n"


def findings(contents: Contents, license_name: str | None) -> Iterator[Finding]:
    """All of this module's rules; `license_name` is the description's attribute."""
    for name in contents.files:
        if "/" not in name and name not in FILES:
            yield ROOT.at(name, "a file at the root", f"one of {', '.join(sorted(FILES))}")
    for folder in sorted(contents.folders):
        if "/" not in folder and folder not in FOLDERS:
            yield ROOT.at(folder, "a folder at the root", f"one of {', '.join(sorted(FOLDERS))}")
    for name in contents.files:
        top, *rest = name.split("/")
        if top == "extra" and (len(rest) < 2 or "." not in rest[0]):
            yield EXTRA.at(name, rest[0], "extra/<reverse domain>/, as in extra/org.example/")
    if "model.png" in contents.files and (signature := contents.read("model.png")[: len(PNG)]) != PNG:
        yield PICTURE.at("model.png", signature, "the signature of PNG")
    texts = [name for name in contents.files if name.startswith("documentation/licenses/")]
    entry = any(name in ("documentation/licenses/license.txt", "documentation/licenses/license.html") for name in texts)
    if texts and not entry:
        yield LICENSES.at("documentation/licenses", texts[0], "license.txt or license.html as the way in")
    if license_name and not texts:
        yield LICENSED.at("documentation/licenses", "missing", f"the text of {license_name}")
