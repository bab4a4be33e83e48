"""`exo list`, `exo schema`, `exo run`, `exo reproduce`."""

import json
from collections.abc import Callable
from contextlib import ExitStack
from pathlib import Path
from typing import Annotated

import typer

from exo import c_library, experiment, folder, junit, kept, loop, presets, report, results, scenario, screen, selection
from exo import requirements as required
from exo.commands.options import AsJson, Csv, EngineOption, FmuDir, Out, Signals, parse_settings, progress_bar
from exo.errors import ScenarioError
from exo.expansion import schema as file_schema
from exo.experiment import Experiment
from exo.fmu import find_fmu_dir
from exo.kept import ALL, NONE
from exo.presets import Preset
from exo.requirements import Requirements
from exo.scenario import Scenario
from exo.screen import console, sentences


def list_scenarios(*, as_json: AsJson = False) -> None:
    """Lists the scenarios."""
    with sentences():
        scenarios = [scenario.load(name) for name in scenario.built_in()]
        if as_json:
            rows = [selection.described(data) for data in scenarios]
            typer.echo(json.dumps(rows, indent=2, ensure_ascii=False))
            return
        table = screen.table("scenario", "cases", "what")
        for data in scenarios:
            screen.add(table, data.id, str(len(data.cases)), data.title)
        screen.print_table(table)


def print_schema() -> None:
    """Prints the JSON Schema of scenario files, for editors and other programs."""
    with sentences():
        typer.echo(json.dumps(file_schema.schema(), indent=2, ensure_ascii=False))


def run(
    names: Annotated[
        list[str], typer.Argument(metavar="SCENARIO…", help="Scenario ids, patterns such as 'arm_*', or .toml files.")
    ],
    *,
    settings: Annotated[
        list[str] | None, typer.Option("--set", metavar="NAME=VALUE", help="Overrides a parameter in all cases.")
    ] = None,
    preset: Annotated[
        str | None, typer.Option("--preset", metavar="NAME", help="Gains of a preset in all cases; --set goes on top.")
    ] = None,
    cases: Annotated[
        list[str] | None, typer.Option("--case", metavar="CASE", help="Only cases of this id or pattern.")
    ] = None,
    duration: Annotated[float | None, typer.Option(help="Another length of all cases, s.")] = None,
    step: Annotated[float | None, typer.Option(help="Another macro step, s.")] = None,
    real_time: Annotated[
        bool, typer.Option("--real-time", help="By the clock; says how late steps began and which ones overran.")
    ] = False,
    c_precision: Annotated[
        str | None,
        typer.Option(
            "--c-library", metavar="f64|f32", help="Controllers: the C library of `cargo xtask law`, not their FMUs."
        ),
    ] = None,
    requirements: Annotated[
        Path | None, typer.Option(metavar="FILE", help="Also judges the requirements of this file.")
    ] = None,
    everything: Annotated[bool, typer.Option("--all", help="Prints the numbers that pass, too.")] = False,
    signals: Signals = ALL,
    csv: Csv = False,
    engine: EngineOption = "fmpy",
    out: Out = Path("results"),
    fmu_dir: FmuDir = None,
) -> None:
    """Runs scenarios; exit code 1 when a verdict fails.

    What --set, --duration or --step change makes the verdicts that rest on it information.
    """
    with sentences(), ExitStack() as stack:
        whole = selection.load(names)
        own = _required(requirements, whole)
        scenarios = [selection.narrowed(one, cases=cases or (), duration=duration, step=step) for one in whole]
        own_file = any(name.endswith(".toml") for name in names)
        given = {key: value for key, value in (("duration", duration), ("step", step)) if value is not None}
        if c_precision is not None:
            for one in scenarios:
                c_library.check(one, c_precision)
            fmu_dir = stack.enter_context(c_library.archives(find_fmu_dir(fmu_dir), c_precision))
        passed = _run_all(
            scenarios=scenarios,
            overrides=parse_settings(settings or []),
            preset=presets.load(preset) if preset is not None else None,
            given=given,
            signals=signals,
            csv=csv,
            engine=loop.named(engine),
            real_time=real_time,
            own=own,
            out=out,
            fmu_dir=fmu_dir,
            tell=lambda done, folder: screen.print_run(
                done,
                folder=folder,
                shown=screen.ORDER if everything else ("fail", "info"),
                unwired=everything or own_file,
            ),
        )
        screen.print_page(out)
    raise typer.Exit(0 if passed else 1)


def reproduce(
    signals: Signals = NONE,
    csv: Csv = False,
    engine: EngineOption = "fmpy",
    out: Out = Path("results"),
    fmu_dir: FmuDir = None,
) -> None:
    """Runs all scenarios and writes report.html."""
    with sentences():
        names = list(scenario.built_in())
        passed = _run_all(
            scenarios=selection.load(names),
            overrides={},
            given={},
            signals=signals,
            csv=csv,
            engine=loop.named(engine),
            out=out,
            fmu_dir=fmu_dir,
            tell=lambda done, folder: screen.print_run(done, folder=folder, shown=("fail",), unwired=False),
        )
        path = report.write(out=out, scenarios=names)
        console.print(f"report: {path}", markup=False)
    raise typer.Exit(0 if passed else 1)


def _required(file: Path | None, running: list[Scenario]) -> tuple[Requirements, ...]:
    """Those of the user's file, which must say something of what runs."""
    if file is None:
        return ()
    data = required.load(file)
    required.check(data, file, running=running)
    return (data,)


def preset_settings(preset: Preset | None, data: Scenario) -> dict[str, str]:
    """A preset as `--set` would say it for this scenario."""
    if preset is None:
        return {}
    try:
        values = preset.qualified({name: part.archive for name, part in data.components.items()})
    except ScenarioError as error:
        raise ScenarioError(f"{data.id}: {error}") from error
    return {name: repr(value) for name, value in values.items()}


def _run_all(
    *,
    scenarios: list[Scenario],
    overrides: dict[str, str],
    given: dict[str, float],
    preset: Preset | None = None,
    signals: str,
    csv: bool,
    engine: loop.Engine,
    real_time: bool = False,
    own: tuple[Requirements, ...] = (),
    out: Path,
    fmu_dir: Path | None,
    tell: Callable[[Experiment, Path], None],
) -> bool:
    """Runs and writes one scenario after the other; whether no verdict failed."""
    fmus = find_fmu_dir(fmu_dir)
    # All of them before the first one runs: a scenario without the preset's archive is refused.
    gains = [preset_settings(preset, data) for data in scenarios]
    written = kept.parse(signals=signals, csv=csv, scenarios=[data.id for data in scenarios])
    folder.prepare(out, [data.id for data in scenarios])
    passed = True
    with progress_bar() as progress:
        for data, values in zip(scenarios, gains, strict=True):
            task = progress.add_task(data.id, total=len(data.cases) + 1)
            done = experiment.run(
                scenario=data,
                fmu_dir=fmus,
                overrides=values | overrides,
                given=given,
                engine=engine,
                real_time=real_time,
                required=(required.built_in(), *own),
                on_case=lambda _case, task=task: progress.advance(task),  # type: ignore[misc]
            )
            place = results.write(experiment=done, out=out, kept=written)
            junit.combine(out)
            progress.remove_task(task)
            passed = passed and done.passed
            tell(done, place)
    return passed
