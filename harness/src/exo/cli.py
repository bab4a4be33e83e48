"""The command `exo`. Exit codes: 0 good, 1 a failed verdict (or difference, or problem), 2 a wrong command."""

import json
import re
from collections import Counter
from collections.abc import Callable, Iterable
from contextlib import ExitStack
from math import isfinite
from pathlib import Path
from typing import Annotated

import typer
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn

from exo import (
    __version__,
    c_library,
    experiment,
    folder,
    junit,
    kept,
    loop,
    presets,
    readings,
    report,
    results,
    scenario,
    screen,
    selection,
    sensitivity,
    sweep,
    tool,
    validate,
)
from exo import benchmark as bench
from exo import compare as comparison
from exo.errors import ExoError, FmuError, ScenarioError
from exo.expansion import schema as file_schema
from exo.experiment import Experiment
from exo.fmu import Archive, find_fmu_dir
from exo.kept import ALL, NONE
from exo.presets import Preset
from exo.references import replay
from exo.references import write as references
from exo.scenario import Scenario
from exo.screen import console, sentences
from exo.systems import closed, container, form, ssp
from exo.systems import system as systems
from exo.systems.system import RECIPES
from exo.tuning import asked, reading, show
from exo.tuning import guide as tuning

app = typer.Typer(no_args_is_help=True, add_completion=False, pretty_exceptions_enable=False, help=__doc__)

Out = Annotated[Path, typer.Option("--out", help="Folder for the results.")]
FmuDir = Annotated[
    Path | None, typer.Option("--fmu-dir", help="Folder of the archives; else $EXO_FMU_DIR or target/fmu.")
]
Signals = Annotated[
    str, typer.Option(metavar="all|none|SCENARIO,…", help="Whose signals are written, every tick as Parquet.")
]
EngineOption = Annotated[
    str, typer.Option("--engine", metavar="fmpy|native", help="What makes the steps: the numbers are equal.")
]
Csv = Annotated[bool, typer.Option("--csv", help="Write signals and the figures' data as CSV, too.")]
AsJson = Annotated[bool, typer.Option("--json", help="As JSON.")]
#: Findings of one rule that `exo validate` prints.
SHOWN = 5


def _version(wanted: bool) -> None:
    if wanted:
        typer.echo(f"exo {__version__}")
        raise typer.Exit


@app.callback()
def main(
    _wanted: Annotated[
        bool, typer.Option("--version", callback=_version, is_eager=True, help="Prints the version.")
    ] = False,
) -> None:
    screen.take_any_letter()


main.__doc__ = __doc__


@app.command("list")
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


@app.command("schema")
def print_schema() -> None:
    """Prints the JSON Schema of scenario files, for editors and other programs."""
    with sentences():
        typer.echo(json.dumps(file_schema.schema(), indent=2, ensure_ascii=False))


@app.command()
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
        scenarios = [
            selection.narrowed(one, cases=cases or (), duration=duration, step=step) for one in selection.load(names)
        ]
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
            out=out,
            fmu_dir=fmu_dir,
            tell=lambda done, folder: screen.print_run(
                done,
                folder=folder,
                shown=screen.ORDER if everything else ("fail", "info"),
                unwired=everything or own_file,
            ),
        )
    raise typer.Exit(0 if passed else 1)


@app.command()
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


@app.command("sweep")
def run_sweep(
    study: Annotated[
        str, typer.Argument(help=f"A study: {', '.join(sweep.built_in())}, or a .toml file that says what varies.")
    ],
    *,
    workers: Annotated[int | None, typer.Option(help="Processes; else one for each processor.")] = None,
    scheduler: Annotated[
        str | None, typer.Option(metavar="ADDRESS", help="A Dask cluster in their place, as tcp://10.0.0.1:8786.")
    ] = None,
    engine: Annotated[
        str | None, typer.Option("--engine", metavar="fmpy|native", help="Else native, where it is installed.")
    ] = None,
    fresh: Annotated[bool, typer.Option("--fresh", help="Forgets what an earlier sweep has left.")] = False,
    out: Annotated[Path, typer.Option("--out", help="Folder for the results.")] = Path("results/sweeps"),
    fmu_dir: FmuDir = None,
) -> None:
    """Runs a study's rows, on all processors or a cluster; goes on where an earlier sweep was stopped."""
    with sentences(), progress_bar() as progress:
        task = progress.add_task(Path(study).stem, total=None)
        done = sweep.sweep(
            study,
            out=out,
            workers=workers,
            scheduler=scheduler,
            engine=loop.named(engine) if engine is not None else None,
            fmu_dir=fmu_dir,
            fresh=fresh,
            tell=lambda far: progress.update(task, completed=far.done, total=far.all),
        )
        failed = f", {done.failed} of them failed: column failure says why" if done.failed else ""
        console.print(f"{done.folder / 'runs.parquet'}: {done.table.num_rows} runs{failed}", markup=False)
        for path in done.pictures:
            console.print(str(path), markup=False)


@app.command()
def compare(
    a: Path,
    b: Path,
    *,
    tolerance: Annotated[float, typer.Option(help="Largest difference, as a share of the larger magnitude.")] = 1e-12,
    as_json: AsJson = False,
) -> None:
    """Compares two result folders or two signal files; exit code 1 beyond the tolerance."""
    with sentences():
        if not tolerance >= 0.0:
            raise ExoError(f"--tolerance {tolerance:g}: expected a share of 0 or more")
        differences = comparison.compare(a, b)
        beyond = sorted((d for d in differences if not d.share <= tolerance), key=lambda d: -d.share)
        largest = max((d.share for d in differences), default=0.0)
        if as_json:
            answer = {
                "a": str(a),
                "b": str(b),
                "tolerance": tolerance,
                "compared": len(differences),
                "largest": largest if isfinite(largest) else None,
                "beyond": [d.as_json() for d in beyond],
            }
            typer.echo(json.dumps(answer, indent=2, ensure_ascii=False, allow_nan=False))
        else:
            screen.print_differences(beyond)
            console.print(
                f"{len(differences)} numbers and signals compared, {len(beyond)} differ by more than {tolerance:g}; "
                f"largest difference {largest:.3g}"
            )
    raise typer.Exit(1 if beyond else 0)


@app.command("ssp")
def write_ssp(
    out: Annotated[Path, typer.Option("--out", help="Folder for the archives.")] = Path("target/ssp"),
    fmu_dir: FmuDir = None,
    bound: Annotated[
        list[str] | None,
        typer.Option(
            "--set", help="Parameter set that the SSP archives bind, as wall-standard_10_0.5; may be repeated."
        ),
    ] = None,
    inline: Annotated[
        bool, typer.Option("--inline", help="Parameter values inside the descriptions, no files.")
    ] = False,
    fmi3_dir: Annotated[
        Path | None, typer.Option("--fmi3-dir", help="Folder of FMI 3.0 archives; else fmi3 in that of the others.")
    ] = None,
) -> None:
    """Writes the coupled systems: SSP 1.0; in ssp2 SSP 2.0, with a variant for each parameter set; containers."""
    with sentences(), ExitStack() as stack:
        folder = find_fmu_dir(fmu_dir)
        defaults = systems.defaults(bound or ())
        for name in RECIPES:
            system = systems.load(name, default=defaults.get(name))
            alone = closed.load(name, default=defaults.get(name))
            files = sorted({*system.components.values(), *alone.components.values()})
            archives = {file: stack.enter_context(Archive(folder / file)) for file in files}
            forms = form.forms(out, files, twins=fmi3_dir, default_twins=folder / "fmi3", inline=inline)
            written = [
                ssp.write(system=one, archives=archives, folder=place, form=how)
                for place, how in forms.items()
                for one in (system, alone)
            ]
            for path in (*written, container.write(system=system, archives=archives, folder=out)):
                console.print(f"{path}  {path.stat().st_size // 1000} kB", markup=False)


@app.command("validate")
def validate_fmus(
    fmus: Annotated[list[Path] | None, typer.Argument(metavar="FMU…")] = None,
    *,
    strict: Annotated[bool, typer.Option(help="Warnings, too, are exit code 1.")] = False,
    load: Annotated[
        bool | None,
        typer.Option(
            help="--load: ask the dynamic rules, too (states, reset, two instances, step sizes, …). --no-load: run no "
            "library. Without either, the library of this machine is run through one step.",
            show_default=False,
        ),
    ] = None,
    platforms: Annotated[
        list[str] | None, typer.Option("--platform", help="A folder that binaries/ must have; may be repeated.")
    ] = None,
    max_glibc: Annotated[str | None, typer.Option(help="Newest glibc that Linux libraries may need, as 2.17.")] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Findings and verdicts as JSON.")] = False,
    rules: Annotated[bool, typer.Option("--rules", help="Lists the rules instead.")] = False,
) -> None:
    """Validates FMI 2.0 and 3.0 FMUs for co-simulation, and SSP archives; exit code 1 on an error.

    Of FMI 3.0, scheduled execution as well. What runs of an FMU runs in processes of its own.
    """
    if rules:
        _print_rules()
        return
    with sentences():
        if not fmus:
            raise FmuError("no FMU is given: exo validate FMU…, or --rules")
        if max_glibc is not None and not re.fullmatch(r"[0-9]+(\.[0-9]+)+", max_glibc):
            raise FmuError(f"--max-glibc {max_glibc}: expected a version, as 2.17")
        how = {"run": load is not False, "dynamic": load is True}
        reports = [validate.check(f, **how, platforms=tuple(platforms or ()), max_glibc=max_glibc) for f in fmus]
    if as_json:
        typer.echo(json.dumps([report.as_json(strict=strict) for report in reports], indent=2, ensure_ascii=False))
    else:
        for report in reports:
            _print_report(report)
    raise typer.Exit(1 if any(report.failed(strict=strict) for report in reports) else 0)


@app.command("references")
def replay_references(
    fmus: Annotated[list[Path], typer.Argument(metavar="FMU…", help="FMI 2.0 or 3.0, with co-simulation.")],
    *,
    as_json: AsJson = False,
) -> None:
    """Replays the experiments that FMUs carry (FMI-LS-REF); exit code 1 when an output differs by too much."""
    with sentences():
        for path in fmus:
            if not path.is_file():
                raise FmuError(f"{path}: no such FMU")
        answers = [(path, replay.replay(path)) for path in fmus]
    if as_json:
        told = [{"fmu": str(path)} | answer.as_json() for path, answer in answers]
        typer.echo(json.dumps(told, indent=2, ensure_ascii=False))
    else:
        for path, answer in answers:
            screen.print_replay(path, answer)
    raise typer.Exit(1 if any(answer.failed for _, answer in answers) else 0)


@app.command("record")
def record_references(
    folder: Annotated[Path, typer.Argument(help="Has a folder for each FMU.")] = Path("modelDescription/references"),
    *,
    bless: Annotated[
        bool, typer.Option("--bless", help="Rewrites what differs, so that it is a diff to read.")
    ] = False,
    fmu_dir: FmuDir = None,
) -> None:
    """Records the references of this project's FMUs; without --bless, exit code 1 where the folder has others."""
    with sentences(), ExitStack() as stack:
        built = find_fmu_dir(fmu_dir)
        archives = {path.name: stack.enter_context(Archive(path)) for path in sorted(built.glob("*.fmu"))}
        files = references.contents(archives)
        changed = references.write(files, folder) if bless else references.differences(files, folder)
    for name in changed:
        said = "written" if bless else "out of date: `cargo xtask references --bless`, then read the diff"
        console.print(f"{folder / name}: {said}", markup=False)
    console.print(f"{len(files)} files, {sum(map(len, files.values())) // 1000} kB", markup=False)
    raise typer.Exit(1 if changed and not bless else 0)


@app.command()
def benchmark(engine: EngineOption = "fmpy", fmu_dir: FmuDir = None) -> None:
    """Prints µs a macro step and the real-time factor; exit code 1 below 100 × real time."""
    with sentences():
        speed = bench.measure(fmu_dir=find_fmu_dir(fmu_dir), engine=loop.named(engine))
    console.print(speed.sentence())
    raise typer.Exit(0 if speed.factor >= bench.WANTED_FACTOR else 1)


@app.command("sensitivity")
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
        runner = sensitivity.Runner(study=data, fmu_dir=find_fmu_dir(fmu_dir))
        with progress_bar() as progress:
            task = progress.add_task("sensitivity", total=len(list(sensitivity.jobs(data))))
            effects = sensitivity.measure(runner, on_job=lambda job: progress.update(task, description=job, advance=1))
        path = out or study.with_suffix(".json")
        folder.write_file(path, sensitivity.text(effects).encode())
        console.print(f"written: {path}", markup=False)


@app.command("identify-tool")
def identify_tool(
    file: Annotated[
        Path, typer.Argument(metavar="READINGS", help="CSV: q[1..3], ft.force[1..3], ft.torque[1..3], a row a reading.")
    ],
    mount: Annotated[str, typer.Option(help="ft.mount of the sensor: roll,pitch,yaw in rad.")] = "0,0,0",
) -> None:
    """Prints mass and centre of gravity of what hangs on the force sensor, from readings at rest in several poses."""
    with sentences():
        angles = parse_angles(mount)
        q, force, torque = readings.read(file)
        found = tool.identify(R=tool.orientation(q=q, mount=angles), force=force, torque=torque)

    def numbers(values: Iterable[float]) -> str:
        return f"[{', '.join(f'{x:.5f}' for x in values)}]"

    console.print(
        f'"controller.ft.mass" = {found.mass:.5f}  # kg, standard error {found.mass_error:.2g}\n'
        f'"controller.ft.cog" = {numbers(found.cog)}  # m, standard errors {numbers(found.cog_error)}\n'
        f"# bias: {numbers(found.bias_force)} N, {numbers(found.bias_torque)} N·m; a tare finds it anew\n"
        f"# left of {len(q)} readings: {found.force_rest:.2g} N, {found.torque_rest:.2g} N·m root mean square",
        markup=False,
    )


def _print_rules() -> None:
    table = screen.table("rule", "severity", "FMI", "holds when")
    for rule in validate.RULES.values():
        screen.add(table, rule.id, rule.severity, rule.only or "2.0, 3.0", rule.text)
    for rule in validate.ssp.RULES.values():
        screen.add(table, rule.id, rule.severity, "SSP", rule.text)
    screen.print_table(table)


def _print_report(report: validate.Report) -> None:
    """At most `SHOWN` findings of one rule: an exporter that breaks a rule often breaks it in every variable."""
    seen: Counter[str] = Counter()
    for finding in report.findings:
        seen[finding.rule] += 1
        if seen[finding.rule] <= SHOWN:
            console.print(f"{report.path}: {finding}", markup=False)
    for rule, times in seen.items():
        if times > SHOWN:
            console.print(f"{report.path}: {times - SHOWN} more of {rule}: see --json", markup=False)
    for sentence in report.skipped:
        console.print(f"{report.path}: not checked: {sentence}", markup=False)
    for sentence in report.replayed:
        console.print(f"{report.path}: {sentence}", markup=False)
    for verdict in report.verdicts:
        console.print(f"{report.path}: {verdict}", markup=False)
    if not report.findings:
        console.print(f"{report.path}: No problems found.", markup=False)


def parse_angles(text: str) -> list[float]:
    """Three angles between commas."""
    try:
        angles = [float(part) for part in text.split(",")]
    except ValueError:
        angles = []
    if len(angles) != 3 or not all(isfinite(angle) for angle in angles):
        raise ScenarioError(f"--mount {text}: expected roll,pitch,yaw in rad")
    return angles


@app.command()
def tune(
    *,
    T: Annotated[float | None, typer.Option("--T", help="Sample period, s.")] = None,
    M_min: Annotated[float | None, typer.Option("--M-min", help="Lightest effective mass, kg.")] = None,
    M_max: Annotated[float | None, typer.Option("--M-max", help="Heaviest effective mass, kg.")] = None,
    delay: Annotated[int | None, typer.Option("--delay", help="Samples by which the force comes late: 0 or 1.")] = None,
    k_h: Annotated[float | None, typer.Option("--k-h", help="Stiffness of the hand, N/m; else 0.")] = None,
    b_h: Annotated[float | None, typer.Option("--b-h", help="Damping of the hand, N·s/m; else 0.")] = None,
    hand_delay: Annotated[
        float | None, typer.Option("--hand-delay", help="Reflex delay of the hand, s; else 0.")
    ] = None,
    K: Annotated[float | None, typer.Option("--K", help="Control gain, N·s/m; else the recommended one.")] = None,
    K_P: Annotated[float | None, typer.Option("--K-P", help="Spring to damper of the coupling, 1/s; else 10.")] = None,
    M_n: Annotated[float | None, typer.Option("--M-n", help="Nominal mass, kg; else M-min.")] = None,
    D_n: Annotated[float | None, typer.Option("--D-n", help="Nominal damping, N·s/m; else M-n/(1 s).")] = None,
    alpha: Annotated[float | None, typer.Option("--alpha", help="Damper of the reaction, N·s/m; else 1.")] = None,
    substep: Annotated[
        float | None, typer.Option("--substep", help="Substep of a simulated mass, s; else 0, the exact mass.")
    ] = None,
    dq_cutoff: Annotated[
        float | None,
        typer.Option("--dq-cutoff", help="Low pass on the sensed velocity (dq_cutoff, dp_cutoff), Hz; 0: none."),
    ] = None,
    f_cutoff: Annotated[
        float | None, typer.Option("--f-cutoff", help="Low pass on the sensed force (ft.cutoff), Hz; 0: none.")
    ] = None,
    drive_cutoff: Annotated[
        float | None, typer.Option("--drive-cutoff", help="Lag of the drive's torque (drive.cutoff), Hz; 0: none.")
    ] = None,
    resolution: Annotated[
        float | None, typer.Option("--resolution", help="One count of the encoder along the axis, m; 0: ideal.")
    ] = None,
    F_c: Annotated[float | None, typer.Option("--F-c", help="Coulomb friction along the axis, N.")] = None,
    F_s: Annotated[float | None, typer.Option("--F-s", help="Stiction along the axis, N; else F-c.")] = None,
    v_s: Annotated[
        float | None, typer.Option("--v-s", help="Stribeck speed, in which stiction falls to Coulomb friction, m/s.")
    ] = None,
    b: Annotated[float | None, typer.Option("--b", help="Viscous friction along the axis, N·s/m; else 0.")] = None,
    speed: Annotated[
        float | None, typer.Option("--speed", help="Speed of a hand-led motion that is judged for stick-slip, m/s.")
    ] = None,
    frequency: Annotated[float, typer.Option("--frequency", help="Where the error is stated, Hz.")] = 0.4,
    name: Annotated[
        str | None,
        typer.Option("--scenario", metavar="SCENARIO", help="Scenario or .toml file from which all of this is read."),
    ] = None,
    case: Annotated[str | None, typer.Option("--case", help="Case of the scenario; else its first one.")] = None,
    axis: Annotated[str, typer.Option("--axis", help="Axis of the arm's handle: x, y or z.")] = "x",
    settings: Annotated[
        list[str] | None, typer.Option("--set", metavar="NAME=VALUE", help="Overrides a parameter of the scenario.")
    ] = None,
    out: Out = Path("results/tune"),
    fmu_dir: FmuDir = None,
) -> None:
    """Prints which gains keep the sampled loop stable, with margins; exit code 1 when the given ones do not.

    Says also what encoder and dry friction do. With --scenario everything that is not given is read from the FMUs'
    start values and the scenario's.
    """
    with sentences():
        machine_options = {"T": T, "M_min": M_min, "M_max": M_max, "delay": delay, "substep": substep}
        hand_options = {"k_h": k_h, "b_h": b_h, "hand_delay": hand_delay}
        lag_options = {"dq_cutoff": dq_cutoff, "f_cutoff": f_cutoff, "drive_cutoff": drive_cutoff}
        gain_options = {"K": K, "K_P": K_P, "M_n": M_n, "D_n": D_n, "alpha": alpha}
        options = machine_options | hand_options | lag_options | gain_options | {"resolution": resolution}
        found = None
        if name is not None:
            found = reading.read(
                scenario=scenario.load(name),
                case=case,
                axis=axis,
                texts=parse_settings(settings or []),
                fmu_dir=fmu_dir or find_fmu_dir(),
            )
        elif case is not None or settings:
            raise ScenarioError("--case and --set: expected a scenario to apply them to (--scenario)")
        machine, gains = asked.machine_and_gains(options=options, found=found)
        rubbing = asked.friction(options={"F_c": F_c, "F_s": F_s, "v_s": v_s, "b": b}, found=found)
        answer = tuning.guide(machine=machine, gains=gains, frequency=frequency, friction=rubbing, speed=speed)
        written = show.write(guide=answer, out=out)
    console.print(show.verdict(answer), markup=False)
    for sentence in show.warnings(answer):
        console.print(sentence, markup=False)
    console.print(show.by_mass(answer))
    console.print(show.LEGEND.format(frequency=frequency), markup=False)
    console.print(show.summary(answer))
    console.print(f"written: {', '.join(str(path) for path in written)}", markup=False)
    raise typer.Exit(0 if answer.stable else 1)


def parse_settings(settings: list[str]) -> dict[str, str]:
    """`name=value` texts as a dictionary."""
    parsed = {}
    for text in settings:
        name, equals, value = text.partition("=")
        if not equals or not name.strip() or not value.strip():
            raise ScenarioError(f"--set {text}: expected <component>.<parameter>=<value>")
        parsed[name.strip()] = value.strip()
    return parsed


def preset_settings(preset: Preset | None, data: Scenario) -> dict[str, str]:
    """A preset as `--set` would say it for this scenario."""
    if preset is None:
        return {}
    try:
        values = preset.qualified({name: part.archive for name, part in data.components.items()})
    except ScenarioError as error:
        raise ScenarioError(f"{data.id}: {error}") from error
    return {name: repr(value) for name, value in values.items()}


def progress_bar() -> Progress:
    """How far a long command is; nothing where no one watches."""
    columns = (TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), TimeElapsedColumn())
    return Progress(*columns, console=console, transient=True, disable=not console.is_terminal)


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
                on_case=lambda _case, task=task: progress.advance(task),  # type: ignore[misc]
            )
            place = results.write(experiment=done, out=out, kept=written)
            junit.combine(out)
            progress.remove_task(task)
            passed = passed and done.passed
            tell(done, place)
    return passed


if __name__ == "__main__":
    app()
