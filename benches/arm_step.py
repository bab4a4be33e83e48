"""A substep of ExoskeletonArm.fmu beside a step of MuJoCo, implicitfast.

Both arms start 1 mm above the table and get the same joint torques, changed every 10 ms: they are pressed on the table
and rubbed over it, forth and back, so that joints slide and hold and the pad stays in contact. Both step by 1e-4 s, a
hundred steps a call: the FMU through fmi2DoStep, sensors, energies and checks included; MuJoCo through mj_step with
`nstep`, so that Python costs it nothing. Of MuJoCo's settings the fastest one counts.
"""

from collections.abc import Iterator, Mapping
from ctypes import c_double, c_int, c_void_p
from dataclasses import dataclass, field
from pathlib import Path
from time import thread_time_ns

import mujoco
import numpy as np
from numpy.typing import NDArray

from benches.row import Bench, Found, Row, Sheet
from benches.turns import in_turns, pinned
from exo.fmu import Archive, Instance, References

Vector = NDArray[np.float64]
ARM_XML = Path(__file__).parents[1] / "tests" / "system" / "oracles" / "arm.xml"

STEP = 1e-4
CHUNK = 100
CHUNKS = 400
#: What a substep may cost, in steps of MuJoCo; and what it should.
LIMIT, AIM = 1 / 10, 1 / 15


def torques() -> Vector:
    """Joint torques of each chunk (N·m): a press on the table, and a rub, forth and back, that exceeds stiction."""
    phase = 2.0 * np.pi * np.arange(CHUNKS) * CHUNK * STEP
    rub = np.column_stack([30.0 * np.sin(phase), 25.0 * np.sin(1.3 * phase), -20.0 * np.sin(1.3 * phase)])
    return rub + np.array([0.0, -25.0, -15.0])


@dataclass(kw_only=True)
class Run:
    """Processor times of all chunks (ns); whether the pad was in contact, and which joints moved, at their ends."""

    ns: list[int] = field(default_factory=list)
    q: list[Vector] = field(default_factory=list)
    contact: list[bool] = field(default_factory=list)
    sliding: list[Vector] = field(default_factory=list)

    def look(self, q: Vector, dq: Vector, *, contact: bool) -> None:
        """Books the end of a chunk. 1e-4 rad/s is above MuJoCo's creep."""
        self.q.append(q.copy())
        self.sliding.append(np.abs(dq) > 1e-4)
        self.contact.append(contact)

    def shares(self) -> tuple[str, str]:
        """In how much of the time the pad was in contact, and each joint moved (%)."""
        moving = ", ".join(f"{100 * share:.0f}" for share in np.mean(self.sliding, axis=0))
        return f"{100 * np.mean(self.contact):.0f}", moving


def plant(archive: Archive) -> Run:
    """The FMU."""
    run = Run()
    with Instance(archive, "arm") as arm:
        arm.set_start("table.z", -0.3581)
        arm.set_start("substep", STEP)
        for i, F_c in enumerate((12.0, 14.0, 12.0)):  # no Stribeck peak, as in MuJoCo
            arm.set_start(f"friction.F_s[{i + 1}]", F_c)
        arm.setup_experiment(start_time=0.0, stop_time=CHUNKS * CHUNK * STEP)
        arm.enter_initialization_mode()
        arm.exit_initialization_mode()
        tau_a = References(archive, [f"tau_a[{i}]" for i in (1, 2, 3)], "Real")
        names = [f"{name}[{i}]" for name in ("q_joint", "dq") for i in (1, 2, 3)]
        moving, touching = References(archive, names, "Real"), References(archive, ["contact"], "Boolean")
        step, component, keep = arm.function("fmi2DoStep"), c_void_p(arm.component), c_int(1)
        values, contact = np.zeros(6), np.zeros(1, dtype=np.int32)
        for k, tau in enumerate(torques()):
            arm.write(tau_a, np.ascontiguousarray(tau))
            t, h = c_double(k * CHUNK * STEP), c_double(CHUNK * STEP)
            began = thread_time_ns()
            status = step(component, t, h, keep)
            run.ns.append(thread_time_ns() - began)
            assert status == 0, arm.last_message()
            arm.read(moving, values)
            arm.read(touching, contact)
            run.look(values[:3], values[3:], contact=bool(contact[0]))
    return run


#: MuJoCo's settings by name: what differs from the file.
SETTINGS: dict[str, dict[str, float | int]] = {
    "arm.xml": {},
    "default tolerance 1e-8": {"tolerance": 1e-8},
    "pyramidal cone": {"cone": int(mujoco.mjtCone.mjCONE_PYRAMIDAL)},
}
EXACT = {"tolerance": 0.0, "iterations": 1000}


def foreign(changes: Mapping[str, float | int]) -> Run:
    """MuJoCo, with the file's options but for `changes`."""
    model = mujoco.MjModel.from_xml_path(str(ARM_XML))
    for option, value in changes.items():
        setattr(model.opt, option, value)
    assert model.opt.timestep == STEP
    assert model.opt.integrator == mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, 0)
    run = Run()
    for tau in torques():
        data.qfrc_applied[:] = tau
        began = thread_time_ns()
        mujoco.mj_step(model, data, nstep=CHUNK)
        run.ns.append(thread_time_ns() - began)
        run.look(data.qpos, data.qvel, contact=data.ncon > 0)
    return run


def distance(a: Run, b: Run) -> float:
    """Largest difference of joint angles at the ends of the chunks (rad)."""
    return float(np.abs(np.array(a.q) - np.array(b.q)).max())


def measure(bench: Bench) -> Iterator[Found]:
    """The row, and what the runs did."""
    last: dict[str, Run] = {}

    def kept(name: str, run: Run) -> float:
        last[name] = run
        return 1e-9 * sum(run.ns)

    with Archive(bench.fmu_dir / "ExoskeletonArm.fmu") as archive, pinned():
        theirs = {
            name: lambda name=name, changes=changes: kept(name, foreign(changes))  # type: ignore[misc]
            for name, changes in SETTINGS.items()
        }
        times = in_turns({"ours": lambda: kept("ours", plant(archive)), **theirs}, bench.rounds)
    fastest = min(theirs, key=times.median)
    steps = CHUNK * CHUNKS
    lines = [("ExoskeletonArm.fmu", f"{1e9 * times.median('ours') / steps:,.0f}", *last["ours"].shares(), "", "")]
    for name, changes in SETTINGS.items():
        run, exact = last[name], foreign({**changes, **EXACT})
        distances = (f"{distance(run, exact):.0e}", f"{distance(run, last['ours']):.0e}")
        lines.append((f"MuJoCo, {name}", f"{1e9 * times.median(name) / steps:,.0f}", *run.shares(), *distances))
    yield Row(
        name="ExoskeletonArm substep / MuJoCo implicitfast step",
        value=times.ratio("ours", fastest),
        spread=times.spread("ours", fastest),
        limit=LIMIT,
        aim=AIM,
        told=f"{1e9 * times.median('ours') / steps:,.0f} ns / {1e9 * times.median(fastest) / steps:,.0f} ns; {fastest}",
    )
    yield Sheet(
        title="The arm beside MuJoCo",
        about=f"Steps of {STEP:g} s, pressed and rubbed on the table, MuJoCo {mujoco.__version__}. Its friction and "
        "contact are soft, the plant's are not; so the arms end apart.",
        header=(
            "what",
            "ns a step",
            "pad in contact, % of the time",
            "joints sliding, % of the time",
            "largest distance from tolerance 0, rad",
            "from the FMU, rad",
        ),
        lines=lines,
    )
