"""What MkDocs is told besides the pages: those that are made from sources, and links that leave the folder."""

import re
import sys
from pathlib import Path
from typing import Any

from mkdocs.config.defaults import MkDocsConfig
from mkdocs.structure.files import File, Files
from mkdocs.structure.pages import Page

sys.path.insert(0, str(Path(__file__).parent))

import moving
import reference  # beside this file, which MkDocs loads by its path

ROOT = Path(__file__).resolve().parents[2]
#: `[text](../place)`: a link to a file of the repository, which the site does not have.
OUTSIDE = re.compile(r"\[([^\]]+)\]\(\.\./[^)]*\)")


#: Where a page has something that moves.
MOVING = re.compile(r"<!-- moving: ([\w-]+) -->")
#: Material for MkDocs would fetch this from the network; the copy beside this file is of version 1.0.4.
SHIM = "https://unpkg.com/iframe-worker/shim"
SHIM_HERE = "assets/iframe-worker/shim.js"


def on_files(files: Files, *, config: MkDocsConfig) -> Files:
    """Adds the pages that `reference` makes, and what is beside this file."""
    for path, text in reference.pages(ROOT).items():
        files.append(File.generated(config, path, content=text))
    for path, text in moving.sources().items():
        files.append(File.generated(config, path, content=text))
    here = Path(__file__).parent
    for path, source in (
        (SHIM_HERE, "iframe-worker/shim.js"),
        ("assets/extra.css", "extra.css"),
    ):
        files.append(File.generated(config, path, content=(here / source).read_text(encoding="utf-8")))
    return files


def on_page_markdown(markdown: str, **_more: Any) -> str:
    """A link out of the folder becomes its text."""
    return OUTSIDE.sub(r"\1", markdown)


def on_page_content(html: str, *, page: Page, **_more: Any) -> str:
    """What moves takes the place of its mark."""
    return MOVING.sub(lambda found: moving.player(found[1], "../" * page.url.count("/")), html)


def on_post_page(output: str, *, page: Page, **_more: Any) -> str:
    """The search's shim is the copy that lies in the site."""
    return output.replace(SHIM, "../" * page.url.count("/") + SHIM_HERE)


def on_post_template(output_content: str, **_more: Any) -> str:
    """The page for what is not there is at an unknown depth, and needs no search from a file."""
    return output_content.replace(SHIM, SHIM_HERE)
