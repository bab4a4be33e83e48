"""The documentation site builds without a dead link, asks nothing of the network, and its reference is the FMUs'."""

import os
import re
import subprocess
import sys
import xml.etree.ElementTree as ET
from html.parser import HTMLParser
from pathlib import Path

import pytest

from exo import scenario

from documents.names import ROOT

MODELS = sorted((ROOT / "modelDescription").glob("*.xml"))


def build(config: Path, out: Path) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, "-m", "mkdocs", "build", "--strict", "--config-file", str(config), "--site-dir", str(out)],
        capture_output=True,
        text=True,
        check=False,
        env={**os.environ, "NO_MKDOCS_2_WARNING": "1"},
    )


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    out = tmp_path_factory.mktemp("site")
    done = build(ROOT / "mkdocs.yml", out)
    assert done.returncode == 0, done.stderr
    return out


class Loaded(HTMLParser):
    """What a page loads by itself, and what it links to."""

    def __init__(self) -> None:
        super().__init__()
        self.loads: list[str] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        found = dict(attrs)
        if tag in ("script", "img", "iframe", "link") and found.get("rel") != "canonical":
            self.loads += [url for key in ("src", "href") if (url := found.get(key))]


def test_no_page_loads_anything_from_elsewhere(site: Path) -> None:
    pages = list(site.rglob("*.html"))
    assert len(pages) > 20
    for page in pages:
        reader = Loaded()
        reader.feed(page.read_text(encoding="utf-8"))
        assert reader.loads
        for url in reader.loads:
            assert not re.match(r"(https?:)?//", url), f"{page.name}: {url}"
            if page.name != "404.html" and not url.startswith("data:"):
                assert (page.parent / url.split("#")[0].split("?")[0]).exists(), f"{page.name}: {url}"


@pytest.mark.parametrize("model", MODELS, ids=[path.stem for path in MODELS])
def test_the_reference_of_an_fmu_has_each_of_its_variables(site: Path, model: Path) -> None:
    page = (site / f"reference/fmus/{model.stem}.html").read_text(encoding="utf-8")
    shown = set(re.findall(r"<code>([^<]+)</code>", page))
    for variable in ET.parse(model).getroot().iterfind("ModelVariables/ScalarVariable"):
        name = str(variable.get("name"))
        base = name[: name.rindex("[")] if name.endswith("]") else name
        assert base in shown or any(one.startswith(f"{base}[1..") for one in shown), name


def test_every_scenario_has_its_place(site: Path) -> None:
    page = (site / "reference/scenarios.html").read_text(encoding="utf-8")
    for name in scenario.built_in():
        assert f'<h2 id="{name}">' in page, name


def test_a_dead_link_ends_the_build(tmp_path: Path) -> None:
    docs = tmp_path / "docs"
    docs.mkdir()
    (docs / "index.md").write_text("# Here\n\n[there](there.md)\n", encoding="utf-8")
    text = (ROOT / "mkdocs.yml").read_text(encoding="utf-8")
    config = tmp_path / "mkdocs.yml"
    nav = text.index("nav:")
    config.write_text(text[:nav].replace("docs/site/hooks.py", str(ROOT / "docs/site/hooks.py")), encoding="utf-8")
    done = build(config, tmp_path / "out")
    assert done.returncode != 0
    assert "there.md" in done.stderr


def test_what_moves_in_the_page_of_the_law_is_what_the_fmus_do(site: Path) -> None:
    sys.path.insert(0, str(ROOT / "docs/site"))
    import moving  # noqa: PLC0415 (a module of the site, not of the tests)

    assert (ROOT / "docs/site/wall-scene.json").read_text(encoding="utf-8") == moving.recorded(), (
        "python docs/site/moving.py writes it"
    )
    page = (site / "law.html").read_text(encoding="utf-8")
    assert 'id="wall-scene"' in page
    assert "exoReplay.mount" in page
