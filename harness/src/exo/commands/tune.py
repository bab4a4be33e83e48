"""`exo tune`."""

from pathlib import Path
from typing import Annotated

import typer

from exo import scenario
from exo.commands.options import FmuDir, Out, parse_settings
from exo.errors import ScenarioError
from exo.fmu import find_fmu_dir
from exo.screen import console, sentences
from exo.tuning import asked, reading, show
from exo.tuning import guide as tuning


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
