"""`exo benchmark`, `exo sensitivity`."""

from pathlib import Path
from typing import Annotated

import typer

from exo import benchmark as bench
from exo import folder, loop, sensitivity
from exo.commands.options import EngineOption, FmuDir, progress_bar
from exo.fmu import find_fmu_dir
from exo.screen import console, sentences


def benchmark(engine: EngineOption = "fmpy", fmu_dir: FmuDir = None) -> None:
    """Prints µs a macro step and the real-time factor; exit code 1 below 100 × real time."""
    with sentences():
        speed = bench.measure(fmu_dir=find_fmu_dir(fmu_dir), engine=loop.named(engine))
    console.print(speed.sentence())
    raise typer.Exit(0 if speed.factor >= bench.WANTED_FACTOR else 1)


def measure_sensitivity(
    study: Annotated[Path, typer.Argument(help="What is changed, and which figures are looked at.")] = Path(
        "docs/assumptions.toml"
    ),
    out: Annotated[Path | None, typer.Option("--out", help="JSON file; else beside the study.")] = None,
    fmu_dir: FmuDir = None,
) -> None:
    """Changes every parameter of the plants, one at a time, and writes what the key figures become."""
    with sentences():
        data = sensitivity.load(study)
        path = out or study.with_suffix(".json")
        folder.prepare_file(path)
        runner = sensitivity.Runner(study=data, fmu_dir=find_fmu_dir(fmu_dir))
        with progress_bar() as progress:
            task = progress.add_task("sensitivity", total=len(list(sensitivity.jobs(data))))
            effects = sensitivity.measure(runner, on_job=lambda job: progress.update(task, description=job, advance=1))
        folder.write_file(path, sensitivity.text(effects).encode())
        console.print(f"written: {path}", markup=False)
