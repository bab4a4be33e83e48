"""One case from plan to recording: the master. What is wired and initialized: `exo.coupled`; what steps: `exo.loop`."""

from collections.abc import Mapping
from dataclasses import replace

from exo.coupled import TRUE_FROM, Coupled
from exo.fmu import Archive
from exo.loop import Engine
from exo.pace import Pace
from exo.plan import Plan, plan
from exo.recording import Recording

__all__ = ["TRUE_FROM", "Plan", "plan", "simulate"]


def simulate(
    *, plan: Plan, archives: Mapping[str, Archive], engine: Engine = "fmpy", real_time: bool = False
) -> Recording:
    """Runs one case, with `real_time` by the clock. `archives` are the opened FMUs by archive name; `engine` makes the
    steps."""
    with Coupled(plan, archives) as coupled:
        coupled.start(plan)
        pace = Pace(steps=plan.steps, step=plan.step) if real_time else None
        coupled.advance(engine=engine, pace=pace)
        coupled.terminate()
        recording = coupled.recording()
        return recording if pace is None else replace(recording, deadlines=pace.deadlines())
