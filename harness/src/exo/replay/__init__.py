"""What a run looks like: scenes of the arm and of the testbed, which `exo/web/replay/replay.js` draws and moves.

    document = replay.scene(experiment)          # a dict for JSON, or None where there is nothing to draw
    exoReplay.mount(element, document, bus)      // in the page, with the bus of exo/web/timebus.js

A scene has one case or more, of which the page shows two at a time:

| key | what it is |
|---|---|
| `kind` | `arm` (one arm or two) or `testbed` |
| `range` | first and last instant (s) |
| `pair` | the cases to begin with: the standard law and the proposed one, where there are both |
| `story` | what is worth watching: `from`, `to` (s) and the `speed` at which that takes 20 s at most; or null |
| `cases` | by id: `label`, `law` and what it is (`about`), `geometry` and what moves |

What moves is thinned out: between two instants that are kept every column is straight, up to a tolerance (`thinning`).
Every column is a list of whole numbers, `start` and differences, times `unit` (`packing`). Poses are joint angles: the
page computes the points with the plant's kinematics, from the lengths in `geometry`.

For a live page, `exoReplay.live(element, geometry)` takes what `geometry` gives.
"""

from exo.replay.scenery import scene
from exo.replay.shape import geometry

__all__ = ["geometry", "scene"]
