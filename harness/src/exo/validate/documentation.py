"""Documentation: pages whose links and pictures exist in the archive."""

import posixpath
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from urllib.parse import unquote, urlsplit

from lxml import etree

from exo.validate.archive import Contents
from exo.validate.rule import Finding, Rule, error, printable, warning

INDEX = warning("documentation-index", "documentation/index.html is the way in")
ENCODING = warning("documentation-encoding", "pages are in the charset that they declare, or in UTF-8")
DEAD = error("documentation-link", "relative links and pictures lead to files of the archive, in the same case")
ANCHOR = error("documentation-anchor", "links to a part of a page lead to an id that is there")
LOCAL = error("documentation-local", "no link leads to a file of the machine that built the FMU")
NETWORK = warning("documentation-network", "pictures, styles and scripts do not come from the network")

#: Attributes that name another file, by element; what is loaded at once, not only when followed.
LINKS = ("href", "src", "poster", "data", "xlink:href")
LOADED = ("img", "script", "link", "iframe", "object", "video", "audio", "source", "embed", "image", "use")
#: A declaration, as HTML and XML write it, within the first kilobyte.
CHARSET = re.compile(rb"""(?:charset|encoding)\s{0,9}=\s{0,9}["']?([A-Za-z0-9_:.-]{1,40})""", re.IGNORECASE)
BOMS = {b"\xef\xbb\xbf": "utf-8", b"\xff\xfe": "utf-16le", b"\xfe\xff": "utf-16be"}
#: Charsets of web pages. Python knows more codecs, some of which decode no text.
CHARSETS = re.compile(
    r"utf-?8|utf-?16(le|be)?|(us-)?ascii|latin-?1|iso-?8859-\d+|iso-2022-jp|(windows|cp)-?125\d|koi8-[ru]"
    r"|gbk|gb2312|gb18030|big5|euc-(jp|kr)|shift[-_]jis|macintosh",
    re.IGNORECASE,
)


@dataclass
class Page:
    """Links and ids of a page."""

    #: (line, element, target)
    links: list[tuple[int, str, str]] = field(default_factory=list)
    ids: set[str] = field(default_factory=set)

    @classmethod
    def of(cls, text: str) -> "Page":
        """Reads a page as a browser would: whatever is wrong with it, there is something to show."""
        page = cls()
        # Not html.parser of the standard library: it takes quadratic time on elements that never end.
        # huge_tree: elements nested 256 deep are deep, but not yet wrong.
        parser = etree.HTMLParser(encoding="utf-8", huge_tree=True, remove_comments=True, remove_pis=True)
        try:
            root = etree.fromstring(text.encode("utf-8", "replace"), parser)
        except etree.XMLSyntaxError:  # nothing in it
            return page
        for element in () if root is None else root.iter(etree.Element):
            for key, value in element.attrib.items():
                page._attribute(element.sourceline or 0, str(element.tag), str(key), str(value))
        return page

    def _attribute(self, line: int, tag: str, key: str, value: str) -> None:
        if key == "id" or (key == "name" and tag == "a"):
            self.ids.add(value)
        elif key in LINKS:
            self.links.append((line, tag, value.strip()))
        elif key == "srcset" and not value.lstrip().startswith("data:"):
            targets = [part.split()[0] for part in value.split(",") if part.split()]
            self.links += [(line, tag, target) for target in targets]


def findings(contents: Contents) -> Iterator[Finding]:
    """All of this module's rules."""
    if "documentation/index.html" not in contents.files:
        others = [name for name in contents.files if name.startswith("documentation/")]
        yield INDEX.at("documentation", f"only {others[0]}" if others else "missing", "documentation/index.html")
    pages: dict[str, Page] = {}
    for name in contents.files:
        if name.startswith("documentation/") and name.lower().endswith((".html", ".htm", ".xhtml")):
            text, problem = decoded(contents.read(name))
            pages[name] = Page.of(text)
            if problem:
                yield ENCODING.at(name, problem, "text in the charset that the page declares, or in UTF-8")
    spelt = {name.casefold(): name for name in contents.files}
    for name, page in pages.items():
        for line, tag, target in page.links:
            for rule, expected in _link(contents, pages, spelt, page=name, tag=tag, target=target):
                yield rule.at(f"{name}:{line} <{tag}>", target, expected)


def decoded(data: bytes) -> tuple[str, str]:
    """A page's text, and what is wrong with its charset; empty when nothing is."""
    bom = next((bom for bom in BOMS if data.startswith(bom)), b"")
    found = CHARSET.search(data[:1024])
    charset = BOMS[bom] if bom else found[1].decode("ascii") if found else "utf-8"
    problem = ""
    if not CHARSETS.fullmatch(charset):
        problem, charset = f"charset {charset} is unknown", "utf-8"
    elif not bom and charset.lower().startswith("utf-16") and b"\0" not in data[:100]:
        problem, charset = f"charset {charset} is declared in a text of single bytes", "utf-8"
    try:
        return data[len(bom) :].decode(charset), problem
    except (UnicodeDecodeError, LookupError) as error_of_codec:
        # What browsers take for a page that says nothing.
        return data.decode("cp1252", "replace"), problem or str(error_of_codec)


def _link(
    contents: Contents, pages: Mapping[str, Page], spelt: Mapping[str, str], *, page: str, tag: str, target: str
) -> Iterator[tuple[Rule, str]]:
    """The rules that a link breaks, with what was expected. `spelt`: names by what they are when case is folded."""
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
            yield DEAD, f"a file of the archive; there is {spelt.get(path.casefold(), 'none')}"
        elif path in pages and unquote(parts.fragment) not in ("", "top", *pages[path].ids):
            yield ANCHOR, f"an element with the id {printable(parts.fragment)} in {printable(path)}"
