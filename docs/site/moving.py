"""What moves in the pages: `python docs/site/moving.py` runs the FMUs and writes `wall-scene.json` beside this file.

`hooks` puts it into the page where the Markdown says `<!-- moving: wall-scene -->`, with the script that plays it.
"""

import json
from pathlib import Path

from exo import experiment, replay, scenario
from exo.fmu import find_fmu_dir
from exo.selection import narrowed

HERE = Path(__file__).resolve().parent
WEB = HERE.parents[1] / "harness/src/exo/web"
SCENARIO, CASES = "wall", ("standard_5_0.5", "passive_bounded_5_0.5")
SCRIPTS = ("assets/timebus.js", "assets/replay.js")


def recorded() -> str:
    """The scene of the wall under two laws, run now."""
    run = experiment.run(scenario=narrowed(scenario.load(SCENARIO), cases=CASES), fmu_dir=find_fmu_dir(None))
    return json.dumps(replay.scene(run, CASES), ensure_ascii=False, separators=(",", ":")) + "\n"


def sources() -> dict[str, str]:
    """Path below the site → script."""
    return {"assets/timebus.js": _text(WEB / "timebus.js"), "assets/replay.js": _text(WEB / "replay/replay.js")}


def player(name: str, up: str) -> str:
    """The HTML of a scene, for a page that lies `up` from the site's root."""
    scene = _text(HERE / f"{name}.json").replace("</", "<\\/")
    scripts = "".join(f'<script src="{up}{path}"></script>' for path in SCRIPTS)
    return (
        f'<div class="moving" id="{name}"></div>{scripts}<script>(() => {{ const scene = {scene.strip()}; '
        f'exoReplay.mount(document.getElementById("{name}"), scene, createTimeBus(scene.range)); }})();</script>'
    )


def _text(path: Path) -> str:
    return path.read_text(encoding="utf-8")


if __name__ == "__main__":
    (HERE / "wall-scene.json").write_text(recorded(), encoding="utf-8")
