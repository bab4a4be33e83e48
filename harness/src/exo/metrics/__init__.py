"""Numbers from recordings: pure functions by subject, found by name from a scenario's `function`.

| module | what it measures |
|---|---|
| `basic` | extremes, means, rates and steps of a column in a window; the residual of a balance |
| `events` | when something happens, how often, how far it throws the hand |
| `coupling` | the spring between nominal and robot, its reaction under a load, its torque while it fades in |
| `wall` | the nominal while the mass rests at a wall |
| `response` | velocity over force at one sine, against closed forms and the desired model |
| `growth` | how fast a swing grows or decays, against the eigenvalues of the sampled loop |
| `impedance` | what a hand gets: impedance over frequency, and how stiff it may be |
| `theorems` | L2 gains, and how one signal comes up to another |

`registry` finds and calls them, `loops` reads the closed forms' parameters from a recording. All quantities are
keyword-only and SI. A window takes the ticks after ≤ t < before. What does not happen is NaN, which fails every check.
"""

from exo.metrics import basic, coupling, events, growth, impedance, response, theorems, wall
from exo.metrics.registry import COMPONENTS, IN_ITS_UNIT, REGISTRY, call, check, complete, evaluate

__all__ = [
    "COMPONENTS",
    "IN_ITS_UNIT",
    "REGISTRY",
    "basic",
    "call",
    "check",
    "complete",
    "coupling",
    "evaluate",
    "events",
    "growth",
    "impedance",
    "response",
    "theorems",
    "wall",
]
