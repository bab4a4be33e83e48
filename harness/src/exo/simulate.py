"""One case from plan to recording. What is wired and initialized: `exo.coupled`; what makes the steps: `exo.loop`."""

from collections.abc import Mapping

from exo.coupled import TRUE_FROM, Coupled
from exo.fmu import Archive
from exo.loop import Engine
from exo.plan import Plan, plan
from exo.recording import Recording

__all__ = ["TRUE_FROM", "Plan", "plan", "simulate"]


def simulate(*, plan: Plan, archives: Mapping[str, Archive], engine: Engine = "fmpy") -> Recording:
    """Runs one case. `archives` are the opened FMUs by archive name; `engine` makes the steps."""
    with Coupled(plan, archives) as coupled:
        coupled.start(plan)
        coupled.advance(engine=engine)
        coupled.terminate()
        return coupled.recording()
