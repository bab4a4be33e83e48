"""Sweeps on all cores: runs an hour beside the raw C loop on as many threads, and Dask beside the local pool.

All run 10 s of the testbed. A sweep is timed from the first rows that came back to the last: no start of workers, which
Dask's have behind them, but batches, metrics, sending, and the table's parts on disk. The raw loop makes the same steps
and nothing else. What counts is `machine_time`: on a machine that does nothing else it is the time by the clock.
"""

import tempfile
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack, suppress
from dataclasses import replace
from importlib.util import find_spec
from pathlib import Path
from statistics import median

import psutil

from benches import c_loop
from benches.engines import CASE, RUN_S, SCENARIO, STEP, coupled_testbed
from benches.row import Bench, Found, NotRun, Row
from benches.turns import cores, in_turns, quarters
from exo import sweep
from exo.coupled import Coupled, _initialize
from exo.plan import Plan

#: Runs of a sweep; rounds, at most; Dask's workers.
RUNS, ROUNDS, WORKERS = 1000, 3, 2
#: Runs that a thread of the raw loop makes.
RAW_RUNS = 100
STUDY = f"""
id = "bench"
title = "Runs of {RUN_S:g} s"
scenario = "{SCENARIO}"
cases = ["{CASE}"]
[parameters]
duration = {RUN_S}
[axes."controller.K"]
low = 10.0
high = 50.0
count = {RUNS}
"""


def measure(bench: Bench) -> Iterator[Found]:
    """The rows."""
    rounds, all_cores, steps = min(bench.rounds, ROUNDS), cores(), round(RUN_S / STEP)
    study = bench.work / "bench.toml"
    study.write_text(STUDY)
    with ExitStack() as stack:
        pairs = [stack.enter_context(coupled_testbed(bench, steps=steps)) for _ in range(all_cores)]
        work = {
            "raw": lambda: raw(bench, pairs, steps),
            "all cores": lambda: swept(bench, study, workers=all_cores),
        }
        if find_spec("distributed") is None:
            yield NotRun(name="Dask", reason="the Python package distributed is not installed")
        else:
            from distributed import LocalCluster  # noqa: PLC0415 - it may not be there

            cluster = stack.enter_context(
                LocalCluster(n_workers=WORKERS, threads_per_worker=1, dashboard_address=None, silence_logs=50)
            )
            work["Dask"] = lambda: swept(bench, study, scheduler=cluster.scheduler_address)
            if all_cores != WORKERS:
                work["as many"] = lambda: swept(bench, study, workers=WORKERS)
        times = in_turns(work, rounds, warm_up=False)
    shares = times.ratios("raw", "all cores")
    yield Row(
        name=f"sweep on {all_cores} cores, runs an hour / raw C loop on {all_cores} threads",
        value=median(shares),
        spread=quarters(shares),
        limit=0.8,
        aim=0.9,
        least=True,
        told=f"{hourly(times.median('all cores'))} / {hourly(times.median('raw'))} runs of {RUN_S:g} s an hour",
    )
    if "Dask" in work:
        local = "as many" if "as many" in work else "all cores"
        yield Row(
            name=f"Dask on {WORKERS} local workers / local pool of {WORKERS}, {RUNS} runs",
            value=times.ratio("Dask", local),
            spread=times.spread("Dask", local),
            limit=1.2,
            aim=1.05,
            told=f"{RUNS * times.median('Dask'):.2f} s / {RUNS * times.median(local):.2f} s",
        )


def hourly(seconds: float) -> str:
    """Runs an hour."""
    return f"{3600.0 / seconds:,.0f}"


def machine_time() -> float:
    """Seconds that all cores together were ours or nobody's, over the number of cores.

    A difference of two is the time by the clock without what other programs took. Idle cores are ours: who waits pays.
    """
    here = psutil.Process()
    own = 0.0
    for process in (here, *here.children(recursive=True)):
        with suppress(psutil.NoSuchProcess):
            times = process.cpu_times()
            # One that has ended is found with the process that waited for it.
            own += sum(times[:2]) + getattr(times, "children_user", 0.0) + getattr(times, "children_system", 0.0)
    machine = psutil.cpu_times()
    return float(own + machine.idle + getattr(machine, "iowait", 0.0)) / (psutil.cpu_count() or 1)


def swept(bench: Bench, study: Path, *, workers: int | None = None, scheduler: str | None = None) -> float:
    """Seconds a run of a sweep, from the first rows that came back to the last."""
    seen: list[tuple[int, float]] = []

    def look(progress: sweep.Progress) -> None:
        if progress.done == progress.all or (progress.done > 0 and not seen):
            seen.append((progress.done, machine_time()))

    with tempfile.TemporaryDirectory(dir=bench.work) as out:
        done = sweep.sweep(study, out=Path(out), workers=workers, scheduler=scheduler, fmu_dir=bench.fmu_dir, tell=look)
    assert done.failed == 0, done.failed
    (first, began), (last, ended) = seen
    return (ended - began) / (last - first)


def raw(bench: Bench, pairs: list[tuple[Plan, Coupled]], steps: int) -> float:
    """Seconds a run of the raw C loop on a thread for each pair; setting up does not count."""
    library = c_loop.load(bench)
    for plan, coupled in pairs:
        coupled.start(plan)
        # One run after the other, without a reset between them: the FMUs must not end after the first one.
        for part in coupled._parts.values():
            part.instance.reset()
        _initialize(replace(plan, duration=RAW_RUNS * plan.duration), coupled._parts, coupled._wires)

    def runs(coupled: Coupled) -> None:
        for k in range(RAW_RUNS):
            c_loop.pair(library, coupled, steps, STEP, first=k * steps)

    with ThreadPoolExecutor(len(pairs)) as threads:
        began = machine_time()
        # A list, so that what has failed in a thread fails here.
        list(threads.map(runs, [coupled for _, coupled in pairs]))
    return (machine_time() - began) / (RAW_RUNS * len(pairs))
