"""The report's page in a browser: what one reads, searches and prints is there, and nothing leaves the file."""

import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Browser, Page

from contrast import faint
from exo import experiment, loop, report, results
from exo.scenario import load
from exo.selection import narrowed
from reports import opened

from browser import chromium, shown, until

SCENARIOS = ("gain_study", "wall", "frequency_response")


@pytest.fixture(scope="module")
def file(fmu_dir: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A page of time plots, of a picture, of a failed verdict, and of verdicts that have changed."""
    out = tmp_path_factory.mktemp("page")
    wall = narrowed(load("wall"), cases=["*_5_0.5"])
    study = load("gain_study")
    broken = study.model_copy(
        update={
            "metrics": tuple(
                metric.model_copy(update={"expected": {}, "check": metric.check.model_copy(update={"at_most": 0.0})})
                if metric.id == "max_error"
                else metric
                for metric in study.metrics
            )
        }
    )
    for scenario in (study, broken, wall, load("frequency_response")):
        done = experiment.run(scenario=scenario, fmu_dir=fmu_dir, engine=loop.fastest())
        results.write(experiment=done, out=out)
    return report.write(out=out, scenarios=list(SCENARIOS))


@pytest.fixture(scope="module")
def browser() -> Iterator[Browser]:
    """One for all tests."""
    with chromium() as found:
        yield found


def test_filters_and_search_show_the_verdicts_that_they_name(browser: Browser, file: Path) -> None:
    with shown(browser, file) as page:
        every = page.locator("#all-verdicts tbody tr")
        seen = page.locator("#all-verdicts tbody tr:visible")
        assert seen.count() == every.count() > 50
        failed = page.locator('#all-verdicts tr[data-v="fail"]').count()
        assert failed == 3
        page.get_by_role("button", name=re.compile("^Failed")).click()
        assert seen.count() == failed
        assert page.locator("details.experiment:visible").count() == 1
        assert f"{failed} of {every.count()} numbers, in 1 of 3 experiments." in page.inner_text("#shown")
        page.get_by_role("button", name=re.compile("^Changed")).click()
        assert seen.count() == page.locator("#all-verdicts tr[data-c]").count() > 0
        assert "was pass" in seen.first.inner_text()
        page.get_by_role("button", name=re.compile("^All")).click()
        page.fill("#search", "passive_bounded RELEASE")
        texts = seen.all_inner_texts()
        assert texts
        assert all("release_delay/passive_bounded" in text for text in texts)
        page.fill("#search", "no such thing")
        assert seen.count() == 0


def test_a_section_is_drawn_when_it_is_opened_and_given_back_when_it_is_closed(browser: Browser, file: Path) -> None:
    with shown(browser, file) as page:
        assert page.locator(".uplot canvas").count() == 0
        section = opened(page, "wall")
        assert section.locator(".uplot canvas").count() == 2
        assert section.locator(".own-verdicts tbody tr").count() == page.locator('tbody[data-of="wall"] tr').count() / 2
        section.locator("summary").first.click()
        until(page, lambda: page.locator(".uplot canvas").count() == 0)
        opened(page, "wall")
        picture = opened(page, "frequency_response").locator("figure img")
        assert picture.evaluate("image => image.decode().then(() => image.naturalWidth)") > 300


def test_a_link_to_an_experiment_opens_it(browser: Browser, file: Path) -> None:
    with shown(browser, file, at="#wall") as page:
        page.locator("#wall .uplot").first.wait_for()
    with shown(browser, file) as page:
        page.locator("#paper a", has_text="gain_study").first.click()
        page.locator("#gain_study .uplot").first.wait_for()
        assert page.locator("#gain_study").evaluate("one => one.open")


@pytest.mark.parametrize("width", [390, 800, 1400])
@pytest.mark.parametrize("dark", [False, True])
def test_nothing_is_wider_than_the_page_and_text_stands_out(
    browser: Browser, file: Path, width: int, dark: bool
) -> None:
    with shown(browser, file, width=width, dark=dark) as page:
        for name in SCENARIOS:
            opened(page, name)
        assert page.evaluate("document.documentElement.scrollWidth") <= width
        wide = page.evaluate(
            """width => [...document.querySelectorAll("main *")]
                .filter(one => !one.closest(".box, .u-wrap, svg") && one.getBoundingClientRect().right > width + 1)
                .map(one => one.className || one.tagName)""",
            width,
        )
        assert wide == []
        for selector in ("h1", ".soft", ".about", "a", ".counts", ".curve", ".value", "#search", "td"):
            assert contrast(page, selector) >= 4.5, selector
        assert faint(page, skipped=".er-on") == {}


def test_what_the_search_takes_can_be_read_on_a_telephone(browser: Browser, file: Path) -> None:
    with shown(browser, file, width=390) as page:
        room, text = page.locator("#search").evaluate(
            """one => {
              const style = getComputedStyle(one);
              const ctx = document.createElement("canvas").getContext("2d");
              ctx.font = style.font;
              const room = one.clientWidth - parseFloat(style.paddingLeft) - parseFloat(style.paddingRight);
              return [room, ctx.measureText(one.placeholder).width];
            }"""
        )
        assert 100.0 < text < room


def contrast(page: Page, selector: str) -> float:
    """Contrast of the first such text with what lies behind it, by WCAG 2.2 (1.4.3 asks for 4.5)."""
    ink, ground = page.locator(f"main {selector}:visible").first.evaluate(
        """one => {
          const clear = (element) => getComputedStyle(element).backgroundColor === "rgba(0, 0, 0, 0)";
          let behind = one;
          while (behind && clear(behind)) behind = behind.parentElement;
          return [getComputedStyle(one).color, getComputedStyle(behind || document.body).backgroundColor];
        }"""
    )

    def luminance(color: str) -> float:
        parts = [float(x) / 255.0 for x in re.findall(r"[\d.]+", color)[:3]]
        linear = [x / 12.92 if x <= 0.04045 else ((x + 0.055) / 1.055) ** 2.4 for x in parts]
        return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]

    low, high = sorted((luminance(ink), luminance(ground)))
    return (high + 0.05) / (low + 0.05)


def test_the_switch_makes_the_page_dark_and_redraws_the_plots(browser: Browser, file: Path) -> None:
    with shown(browser, file) as page:
        section = opened(page, "wall")

        def ground() -> str:
            return str(page.evaluate("getComputedStyle(document.body).backgroundColor"))

        def line() -> str:
            return str(section.locator('.curve[data-label="standard"] line').first.get_attribute("stroke"))

        light = (ground(), line())
        page.locator("#theme").click()
        assert page.locator("#theme").get_attribute("aria-label") == "Colours: light"
        assert (ground(), line()) == light
        page.locator("#theme").click()
        assert ground() != light[0]
        assert line() != light[1]
        # The choice outlives the page.
        page.evaluate("window.stays = localStorage.getItem('exo-theme')")
        assert page.evaluate("window.stays") == "dark"
        page.locator("#theme").click()
        assert (ground(), line()) == light


def test_without_scripts_the_numbers_stand_and_a_sentence_says_what_is_missing(browser: Browser, file: Path) -> None:
    with shown(browser, file, scripts=False) as page:
        assert page.locator("#all-verdicts tbody tr").count() > 50
        assert page.locator("#all-verdicts tbody tr").first.is_visible()
        assert page.get_by_text("Scripts are off").is_visible()
        assert not page.locator("#search").is_visible()
        page.locator("#wall summary").first.click()
        link = page.locator('#wall a[href="wall/release.png"]')
        assert link.is_visible()
        assert (file.parent / "wall" / "release.png").is_file()


def test_it_prints_what_is_open_in_light_colours_and_cuts_nothing_off(
    browser: Browser, file: Path, tmp_path: Path
) -> None:
    with shown(browser, file, dark=True) as page:
        opened(page, "wall")
        page.emulate_media(media="print")
        assert page.locator(".bar").is_hidden()
        assert page.locator(".timebar").is_hidden()
        assert page.locator("#all-verdicts").is_hidden()
        assert page.locator("#wall .own-verdicts tr").first.is_visible()
        for box in page.locator(".box:visible").all():
            assert box.evaluate("one => one.scrollHeight <= one.clientHeight + 1")
        page.emulate_media(media="null")
        page.evaluate("dispatchEvent(new Event('beforeprint'))")
        assert page.evaluate("document.documentElement.dataset.theme") == "light"
        page.evaluate("dispatchEvent(new Event('afterprint'))")
        assert page.evaluate("document.documentElement.dataset.theme") == "system"

        def pages() -> int:
            page.pdf(path=tmp_path / "page.pdf")
            return len(re.findall(rb"/Type\s*/Page\b", (tmp_path / "page.pdf").read_bytes()))

        few = pages()
        assert 3 <= few <= 9
        page.fill("#search", "a")
        assert pages() > few
