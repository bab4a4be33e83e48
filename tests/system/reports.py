"""A report's page in a browser: its sections and plots."""

from playwright.sync_api import Locator, Page


def opened(page: Page, name: str) -> Locator:
    """An experiment, opened by its line and drawn."""
    section = page.locator(f"#{name}")
    section.locator("summary").first.click()
    section.locator(".uplot, figure img").first.wait_for()
    return section


def told(plot: Locator) -> tuple[float, dict[str, str]]:
    """The instant (s) of a plot and what it says of each curve."""
    text = plot.get_attribute("aria-valuetext") or ""
    instant, _, values = text.replace("−", "-").partition(" s: ")
    return float(instant), dict(part.split(" ", 1) for part in values.split("; "))


def ranges(plots: list[Locator]) -> list[tuple[str, ...]]:
    """First and last instant (s) that each plot shows."""
    return [(plot.get_attribute("data-from") or "", plot.get_attribute("data-to") or "") for plot in plots]
