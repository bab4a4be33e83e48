"""Documentation: pages whose links and pictures exist in the archive."""

import posixpath
from collections.abc import Iterator
from html.parser import HTMLParser
from urllib.parse import unquote, urlsplit

from exo.validate.archive import Contents
from exo.validate.rule import Finding, Rule, error, printable, warning

INDEX = warning("documentation-index", "documentation/index.html is the way in")
ENCODING = error("documentation-encoding", "pages are UTF-8")
DEAD = error("documentation-link", "relative links and pictures lead to files of the archive, in the same case")
ANCHOR = error("documentation-anchor", "links to a part of a page lead to an id that is there")
LOCAL = error("documentation-local", "no link leads to a file of the machine that built the FMU")
NETWORK = warning("documentation-network", "pictures, styles and scripts do not come from the network")

#: Attributes that name another file, by element; what is loaded at once, not only when followed.
LINKS = ("href", "src", "poster", "data")
LOADED = ("img", "script", "link", "iframe", "object", "video", "audio", "source", "embed", "image", "use")


class Page(HTMLParser):
    """Links and ids of a page."""

    def __init__(self, text: str) -> None:
        super().__init__(convert_charrefs=True)
        #: (line, element, target)
        self.links: list[tuple[int, str, str]] = []
        self.ids: set[str] = set()
        self.feed(text)
        self.close()

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        for key, value in attrs:
            if value is None:
                continue
            if key == "id" or (key == "name" and tag == "a"):
                self.ids.add(value)
            elif key in LINKS or key == "xlink:href":
                self.links.append((self.getpos()[0], tag, value.strip()))
            elif key == "srcset" and not value.lstrip().startswith("data:"):
                targets = [part.split()[0] for part in value.split(",") if part.split()]
                self.links += [(self.getpos()[0], tag, target) for target in targets]


def findings(contents: Contents) -> Iterator[Finding]:
    """All of this module's rules."""
    if "documentation/index.html" not in contents.files:
        others = [name for name in contents.files if name.startswith("documentation/")]
        yield INDEX.at("documentation", f"only {others[0]}" if others else "missing", "documentation/index.html")
    pages: dict[str, Page] = {}
    for name in contents.files:
        if name.startswith("documentation/") and name.lower().endswith((".html", ".htm", ".xhtml")):
            try:
                pages[name] = Page(contents.read(name).decode("utf-8-sig"))
            except UnicodeDecodeError as problem:
                yield ENCODING.at(name, problem, "UTF-8")
    for name, page in pages.items():
        for line, tag, target in page.links:
            for rule, expected in _link(contents, pages, name, tag, target):
                yield rule.at(f"{name}:{line} <{tag}>", target, expected)


def _link(contents: Contents, pages: dict[str, Page], page: str, tag: str, target: str) -> Iterator[tuple[Rule, str]]:
    """The rules that a link breaks, with what was expected."""
    try:
        parts = urlsplit(target)
    except ValueError as problem:
        yield DEAD, f"a link: {problem}"
        return
    absolute = parts.path.startswith(("/", "\\")) and not parts.netloc
    if parts.scheme == "file" or len(parts.scheme) == 1 or absolute:
        yield LOCAL, "a link that is relative to the page"
    elif parts.scheme in ("http", "https") or parts.netloc:
        if tag in LOADED:
            yield NETWORK, "a file of the archive"
    elif not parts.scheme:
        path = posixpath.normpath(posixpath.join(posixpath.dirname(page), unquote(parts.path))) if parts.path else page
        if path not in contents.files and path not in contents.folders:
            near = [name for name in contents.files if name.casefold() == path.casefold()]
            yield DEAD, f"a file of the archive; there is {near[0] if near else 'none'}"
        elif path in pages and unquote(parts.fragment) not in ("", "top", *pages[path].ids):
            yield ANCHOR, f"an element with the id {printable(parts.fragment)} in {printable(path)}"
