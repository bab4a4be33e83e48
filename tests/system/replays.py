"""Runs that are replayed, and pages that replay them in a browser."""

import json
import shutil
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from exo import experiment as experiments
from exo import loop, replay, scenario
from exo.experiment import Experiment

WEB = Path(__file__).resolve().parents[2] / "harness" / "src" / "exo" / "web"
WEBGL = ("--use-angle=swiftshader", "--enable-unsafe-swiftshader")
NO_WEBGL = ("--disable-3d-apis",)
ARMS = ("standard_17.5kg", "passive_bounded_17.5kg")
MASSES = ("standard_5_0.5", "passive_bounded_5_0.5")


def run(name: str, *cases: str, fmu_dir: Path, **changed: Any) -> Experiment:
    """Some cases of a built-in scenario, without figures and verdicts."""
    full = scenario.load(name)
    chosen = tuple(case for case in full.cases if case.id in cases)
    data = full.model_copy(update={"cases": chosen, "figures": (), "ratios": (), "metrics": (), **changed})
    given = {key: value for key, value in changed.items() if key in {"duration", "step"}}
    return experiments.run(scenario=data, fmu_dir=fmu_dir, engine=loop.fastest(), given=given)


def lifted(fmu_dir: Path) -> Experiment:
    """Experiment 3 until the payload is in the air, standard law and proposed law."""
    return run("arm_payload", *ARMS, fmu_dir=fmu_dir, duration=12.0)


def pushed(fmu_dir: Path) -> Experiment:
    """The wall, standard law and proposed law."""
    return run("wall", *MASSES, fmu_dir=fmu_dir, duration=45.0)


def carried(fmu_dir: Path) -> Experiment:
    """Both arms until the payload is in the air."""
    return run("arm_both", "unequal", fmu_dir=fmu_dir, duration=9.0)


@dataclass(frozen=True)
class Opened:
    """A page with a replay, and what it has complained of and asked for."""

    page: Any
    complaints: list[str]
    requests: list[str]

    def state(self) -> Any:
        """What is drawn now."""
        return self.page.evaluate("handle.state()")

    def at(self, time: float) -> Any:
        """What is drawn at an instant that somebody else has set."""
        return self.page.evaluate(f"(bus.set({time}, 'plots'), handle.state())")

    def text(self) -> str:
        """What can be read."""
        return str(self.page.inner_text("body")).replace("\u00a0", " ")


Opening = Callable[..., Opened]


def browsers() -> Iterator[Callable[..., Any]]:
    """Starts browsers by their switches, each once."""
    path = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
    if path is None:
        pytest.skip("no browser: neither chromium nor chromium-browser nor google-chrome is on the PATH")
    tool = pytest.importorskip("playwright.sync_api", reason="playwright is not installed").sync_playwright
    with tool() as playwright:
        started: dict[tuple[str, ...], Any] = {}

        def browser(*switches: str) -> Any:
            if switches not in started:
                arguments = ["--no-sandbox", "--disable-background-networking", *switches]
                started[switches] = playwright.chromium.launch(executable_path=path, args=arguments)
            return started[switches]

        yield browser
        for one in started.values():
            one.close()


def pages(start: Callable[..., Any], tmp_path: Path) -> Iterator[Opening]:
    """Opens pages with a scene or with a geometry to feed, and finds at the end that they had no complaint."""
    pages: list[Opened] = []

    def open_page(
        what: Any,
        *,
        width: int = 900,
        dark: bool = False,
        options: str = "{}",
        switches: tuple[str, ...] = WEBGL,
        **how: Any,
    ) -> Opened:
        mounted = "mount(place, given, bus, options)" if "cases" in what else "live(place, given, options)"
        file = tmp_path / "page.html"
        file.write_text(
            "<!doctype html><html lang='en'><meta charset='utf-8'><meta name='viewport' content='width=device-width'>"
            f"<title>replay</title><body style='margin:8px;background:{'#101418' if dark else '#ffffff'}'>"
            "<div id='place'></div>"
            f"<script>{(WEB / 'timebus.js').read_text(encoding='utf-8')}</script>"
            f"<script>{(WEB / 'replay' / 'replay.js').read_text(encoding='utf-8')}</script>"
            f"<script>const given = {json.dumps(what)}, options = {options}, place = document.getElementById('place');"
            f"const bus = createTimeBus(given.range); const handle = exoReplay.{mounted};</script>",
            encoding="utf-8",
        )
        page = start(*switches).new_page(viewport={"width": width, "height": 900}, **how)
        one = Opened(page, [], [])
        page.on("console", lambda said: one.complaints.append(said.text) if said.type in ("error", "warning") else None)
        page.on("pageerror", lambda error: one.complaints.append(str(error)))
        page.on("request", lambda request: one.requests.append(request.url))
        page.goto(file.as_uri())
        pages.append(one)
        return one

    yield open_page
    for one in pages:
        one.page.close()
        # Of the software WebGL, not of the page.
        assert [text for text in one.complaints if "GPU stall due to ReadPixels" not in text] == []
        assert all(url.startswith(("file:", "data:", "blob:")) for url in one.requests)
        assert len(one.requests) == 1


def scene(experiment: Experiment) -> dict[str, Any]:
    """The scene of an experiment that has one."""
    document = replay.scene(experiment)
    assert document is not None
    return document


def place(experiment: Experiment, case: str, name: str, time: float) -> list[float]:
    """A recorded vector at an instant."""
    recorded = experiment.recordings[case]
    tick = round(time / recorded.step)
    return [float(recorded[f"{name}[{k}]"][tick]) for k in (1, 2, 3)]


def instants(document: dict[str, Any], case: str, count: int = 12) -> list[float]:
    """Some instants of a case that were kept."""
    column = document["cases"][case]["frames"]["t"]
    time = np.cumsum(column["steps"]) * column["unit"]
    return [float(t) for t in time[:: max(1, len(time) // count)]]
