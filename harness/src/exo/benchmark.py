"""Cost of the loop: µs a macro step of the wall scenario's two FMUs, recording included, and the real-time factor; by
each engine, and their ratio."""

from dataclasses import dataclass
from pathlib import Path

from exo.fmu import Archive, find_fmu_dir
from exo.loop import ENGINES, Engine
from exo.master import plan, simulate
from exo.scenario import load

#: What the loop must reach at 500 Hz.
WANTED_FACTOR = 100.0
REPETITIONS = 5


@dataclass(frozen=True, kw_only=True)
class Speed:
    """The fastest of several runs. The factor that is judged counts processor time: what else the machine does in the
    meantime is no property of the loop."""

    engine: Engine
    steps: int
    simulated: float
    wall_time: float
    cpu_time: float

    @property
    def factor(self) -> float:
        """Simulated time over processor time."""
        return self.simulated / self.cpu_time

    def sentence(self) -> str:
        """The figures as one line."""
        return (
            f"engine {self.engine}: {1e6 * self.cpu_time / self.steps:.2f} µs a macro step (set, step, get of both "
            f"FMUs, recorded): {self.factor:.0f} × real time at 500 Hz by processor time, "
            f"{self.simulated / self.wall_time:.0f} × by the clock, over {self.steps} steps; "
            f"wanted: {WANTED_FACTOR:.0f} ×"
        )


def measure(*, fmu_dir: Path, engine: Engine = "fmpy") -> Speed:
    """Runs one wall case several times. ExoError, if the engine is not installed."""
    scenario = load("wall")
    case = next(case for case in scenario.cases if case.id == "passive_bounded_5_0.5")
    job = plan(scenario=scenario, case=case)
    with Archive(fmu_dir / "TestbedController.fmu") as controller, Archive(fmu_dir / "Testbed.fmu") as plant:
        archives = {archive.path.name: archive for archive in (controller, plant)}
        runs = [simulate(plan=job, archives=archives, engine=engine) for _ in range(REPETITIONS)]
    return Speed(
        engine=engine,
        steps=job.steps,
        simulated=job.duration,
        wall_time=min(run.wall_time for run in runs),
        cpu_time=min(run.cpu_time for run in runs),
    )


if __name__ == "__main__":
    speeds = [measure(fmu_dir=find_fmu_dir(), engine=engine) for engine in ENGINES]
    for speed in speeds:
        print(speed.sentence())
    python, native = speeds
    print(f"engine native takes {native.cpu_time / python.cpu_time:.3f} of what fmpy takes; wanted: at most .25")
