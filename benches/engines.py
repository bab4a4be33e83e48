"""The native engine beside a loop in C by hand and beside the reference, `fmpy`.

All couple the testbed's pair, 20 000 macro steps of 2 ms, every output recorded.

| name | what |
|---|---|
| raw C loop | `loop.c`: what one writes by hand over the same instances and the same buffers |
| native | `exo run --engine native` |
| fmpy | `exo run`, the reference |
| own cost | native over FMUs that do nothing: what the engine adds to the calls |
| a run of a sweep | 10 s by `exo.batch`, reset and metrics included, beside the raw C loop alone |
"""

from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import replace
from statistics import median
from time import thread_time
from typing import Any

import numpy as np

from benches import c_loop
from benches.row import Bench, Found, Row
from benches.turns import Times, in_turns, pinned, quarters
from exo import master
from exo.coupled import Coupled
from exo.fmu import Archive
from exo.loop import Engine
from exo.plan import Plan
from exo.runs import Batch
from exo.scenario import load

STEPS, STEP = 20_000, 0.002
SCENARIO, CASE = "wall", "passive_bounded_5_0.5"
#: Seconds of a run of a sweep.
RUN_S = 10.0


@contextmanager
def coupled_testbed(bench: Bench, *, steps: int = STEPS) -> Iterator[tuple[Plan, Coupled]]:
    """The testbed's pair, wired, for so many macro steps."""
    scenario = load(SCENARIO)
    case = next(one for one in scenario.cases if one.id == CASE)
    plan = replace(master.plan(scenario=scenario, case=case), duration=steps * STEP)
    with ExitStack() as stack:
        files = sorted(set(plan.components.values()))
        archives = {file: stack.enter_context(Archive(bench.fmu_dir / file)) for file in files}
        yield plan, stack.enter_context(Coupled(plan, archives))


def engine(plan: Plan, coupled: Coupled, name: Engine) -> float:
    """Processor seconds of a run."""
    coupled.start(plan)
    began = thread_time()
    coupled.advance(engine=name)
    return thread_time() - began


def beside(times: Times, peer: str, name: str, *, limit: float | None = None, aim: float | None = None) -> Row:
    """The native engine beside another one, with what a macro step takes."""
    us = [1e6 * times.median(one) / STEPS for one in ("native", peer)]
    return Row(
        name=f"native engine / {name}",
        value=times.ratio("native", peer),
        spread=times.spread("native", peer),
        limit=limit,
        aim=aim,
        told=f"{us[0]:.2f} µs / {us[1]:.2f} µs a macro step",
    )


def measure(bench: Bench) -> Iterator[Found]:
    """The rows."""
    library = c_loop.load(bench)
    with (
        coupled_testbed(bench) as (plan, coupled),
        Batch(SCENARIO, cases=[CASE], fmu_dir=bench.fmu_dir) as runs,
        pinned(),
    ):

        def by_hand() -> float:
            coupled.start(plan)
            return c_loop.pair(library, coupled, STEPS, STEP)

        gains = iter(np.linspace(10.0, 50.0, 2 * (bench.rounds + 1)).tolist())

        def run_of_a_sweep() -> float:
            # In a sweep one run follows another: what the other loops have left in the caches is not its own.
            runs.run({"controller.K": next(gains), "duration": RUN_S})
            row: dict[str, Any] = {"controller.K": next(gains), "duration": RUN_S}
            began = thread_time()
            outcome = runs.run(row)
            took = thread_time() - began
            assert outcome.error is None, outcome.error
            return took

        times = in_turns(
            {
                "raw": by_hand,
                "native": lambda: engine(plan, coupled, "native"),
                "fmpy": lambda: engine(plan, coupled, "fmpy"),
                "empty": lambda: c_loop.empty(library, STEPS, STEP),
                "sweep": run_of_a_sweep,
            },
            bench.rounds,
        )
    yield beside(times, "raw", "raw C loop, testbed pair, recorded", limit=1.25, aim=1.1)
    yield beside(times, "fmpy", "fmpy engine, testbed pair, recorded", limit=1 / 4, aim=1 / 6)
    own = [1e9 * took / STEPS for took in times.seconds["empty"]]
    yield Row(
        name="native engine's own cost a macro step",
        value=median(own),
        spread=quarters(own),
        limit=120.0,
        aim=60.0,
        unit="ns",
        told="two FMUs that do nothing: a Set and three Gets each, and the wires",
    )
    shares = [share * RUN_S / STEP / STEPS for share in times.ratios("raw", "sweep")]
    yield Row(
        name="batch on one core, runs an hour / raw C loop",
        value=median(shares),
        spread=quarters(shares),
        limit=0.8,
        aim=0.9,
        least=True,
        told=f"{3600.0 / times.median('sweep'):,.0f} runs of {RUN_S:g} s an hour on one core; reset, metrics included",
    )
