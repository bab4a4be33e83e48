"""A page in Debian's Chromium, without a window and without a network, and what it complains of."""

import shutil
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Browser, Page, sync_playwright

#: How long the page may take for what a click has asked of it (s).
PATIENCE = 20.0
NAMES = ("chromium", "chromium-browser", "google-chrome")
ARGUMENTS = ["--no-sandbox", "--disable-gpu", "--disable-background-networking"]


@contextmanager
def chromium() -> Iterator[Browser]:
    """The browser on PATH; skips where there is none."""
    path = next((found for name in NAMES if (found := shutil.which(name))), None)
    if path is None:
        pytest.skip(f"no browser on PATH: looked for {', '.join(NAMES)}")
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=path, args=ARGUMENTS)
        try:
            yield browser
        finally:
            browser.close()


@contextmanager
def shown(
    browser: Browser, file: Path, *, width: int = 1400, dark: bool = False, scripts: bool = True, at: str = ""
) -> Iterator[Page]:
    """The page of `file`; at the end it must have complained of nothing, and asked for nothing but itself."""
    context = browser.new_context(
        viewport={"width": width, "height": 900},
        color_scheme="dark" if dark else "light",
        java_script_enabled=scripts,
        reduced_motion="reduce",
    )
    page = context.new_page()
    said: list[str] = []
    asked: list[str] = []
    page.on("console", lambda message: said.append(message.text) if message.type == "error" else None)
    page.on("pageerror", lambda error: said.append(str(error)))
    page.on("request", lambda request: asked.append(request.url))
    page.goto(file.as_uri() + at)
    yield page
    assert said == []
    # What the page makes of its own data is no request.
    assert [url for url in asked if not url.startswith(("data:", "blob:"))] == [file.as_uri()]
    context.close()


def box_of(page: Page, selector: str) -> dict[str, float]:
    """Where the first such element is, px: once it is there, for what is drawn anew is gone for a moment."""
    found: list[Any] = []
    until(page, lambda: bool(found.append(page.locator(selector).first.bounding_box()) or found[-1]))
    return dict(found[-1])


def until(page: Page, holds: Callable[[], bool]) -> None:
    """Waits until something holds; the page's policy leaves no script that would tell."""
    end = time.monotonic() + PATIENCE
    while not holds():
        assert time.monotonic() < end, "it did not come to hold"
        page.wait_for_timeout(20)
