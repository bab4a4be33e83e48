"""The controllers' C library beside their FMUs: a call, and a run by the clock.

Both are driven by the same loop with the same inputs (`exo run --c-library`). The run by the clock is `exo run
--real-time`: how late steps began and how long they took is the machine's business, so a sheet of figures.
"""

from collections.abc import Iterator
from contextlib import ExitStack
from dataclasses import replace
from pathlib import Path

from benches import c_loop
from benches.row import Bench, Found, NotRun, Row, Sheet
from benches.turns import in_turns, pinned
from exo import c_library, master
from exo.coupled import Coupled
from exo.errors import ExoError
from exo.fmu import Archive
from exo.pace import Deadlines
from exo.plan import Plan
from exo.scenario import load

#: Scenario, case, steps that are compared.
CASES = (("wall", "passive_bounded_5_0.5", 5000), ("arm_payload", "passive_bounded_25kg", 5000))
#: Of a run by the clock (s).
BY_CLOCK_S = 5.0


def measure(bench: Bench) -> Iterator[Found]:
    """A row for each controller, and the deadlines."""
    lines = []
    for name, case, steps in CASES:
        scenario = load(name)
        plan = master.plan(scenario=scenario, case=next(one for one in scenario.cases if one.id == case))
        with ExitStack() as stack:
            try:
                folder = stack.enter_context(c_library.archives(bench.fmu_dir, "f64"))
            except ExoError as error:
                yield NotRun(name="C library", reason=str(error).replace(str(bench.fmu_dir.parent), "target"))
                return
            folders = {"FMU": bench.fmu_dir, "C library": folder}
            opened = {what: _opened(plan, of, stack) for what, of in folders.items()}
            yield _row(bench, replace(plan, duration=steps * plan.step), opened)
            paced = replace(plan, duration=BY_CLOCK_S)
            for what, archives in opened.items():
                run = master.simulate(plan=paced, archives=archives, engine="native", real_time=True)
                assert run.deadlines is not None
                lines.append((f"{plan.components['controller'].removesuffix('.fmu')}, {what}", *told(run.deadlines)))
    yield Sheet(
        title="By the clock",
        about=f"`exo run --real-time --engine native`, the controller with its plant, {BY_CLOCK_S:g} s; "
        "`--c-library f64` for the C library. An ordinary system, no real-time one: what is late is late by its doing.",
        header=(
            "controller",
            "steps",
            "of, ms",
            "overruns",
            "late, µs: median",
            "99 %",
            "most",
            "busy, µs: median",
            "most",
        ),
        lines=lines,
    )


def _opened(plan: Plan, folder: Path, stack: ExitStack) -> dict[str, Archive]:
    return {file: stack.enter_context(Archive(folder / file)) for file in sorted(set(plan.components.values()))}


def _row(bench: Bench, plan: Plan, opened: dict[str, dict[str, Archive]]) -> Row:
    """Set, step and get of the library beside those of the FMU; what the library lacks, neither is asked for."""
    library = c_loop.load(bench)
    file = plan.components["controller"]
    kept = [f"controller.{name}" for name in opened["C library"][file].names("output")]
    with ExitStack() as stack:
        work = {}
        for what, archives in opened.items():
            coupled = stack.enter_context(Coupled(plan, archives, kept=kept))
            coupled.start(plan)
            coupled.advance(engine="native")
            part = coupled._parts["controller"]
            inputs = {kind: rows.copy() for kind, rows in part.u.items()}

            def once(coupled: Coupled = coupled, inputs: dict = inputs) -> float:  # type: ignore[type-arg]
                coupled.start(plan)
                controller = coupled._parts["controller"]
                for kind, rows in inputs.items():
                    controller.u[kind][:] = rows
                return c_loop.alone(library, controller, plan.steps, plan.step)

            work[what] = once
        with pinned():
            times = in_turns(work, bench.rounds)
    ns = {what: 1e9 * times.median(what) / plan.steps for what in work}
    return Row(
        name=f"{file.removesuffix('.fmu')} / C library: set + step + get",
        value=times.ratio("FMU", "C library"),
        spread=times.spread("FMU", "C library"),
        told=f"{ns['FMU']:,.0f} ns / {ns['C library']:,.0f} ns; the library behind the same functions",
    )


def told(found: Deadlines) -> tuple[str, ...]:
    """The statistics, as the sheet's header names them."""
    late, busy = (found.late_median, found.late_99, found.late_max), (found.busy_median, found.busy_max)
    times = tuple(f"{1e6 * one:,.0f}" for one in (*late, *busy))
    return (f"{found.steps}", f"{1e3 * found.step:g}", f"{found.overruns}", *times)
