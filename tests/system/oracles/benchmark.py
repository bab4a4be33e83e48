"""A substep of ExoskeletonArm.fmu against a step of MuJoCo, implicitfast, in one run on one core.

`python tests/system/oracles/benchmark.py`, also the last stage of `cargo xtask bench`. Both arms start 1 mm above the
table and get the same joint torques, changed every 10 ms: they are pressed on the table and rubbed over it, forth and
back, so that joints slide and hold and the pad stays in contact. Both step by 1e-4 s, a hundred steps a call: the FMU
through fmi2DoStep, sensors, energies and checks included; MuJoCo through mj_step. The smallest of several times counts.
"""

from collections.abc import Mapping
from ctypes import c_double, c_int, c_void_p
from dataclasses import dataclass, field
from pathlib import Path
from time import perf_counter_ns

import mujoco
import numpy as np
from numpy.typing import NDArray

from exo.fmu import Archive, Instance, References, find_fmu_dir

Vector = NDArray[np.float64]
ARM_XML = Path(__file__).with_name("arm.xml")

STEP = 1e-4
CHUNK = 100
CHUNKS = 400
REPETITIONS = 5
#: What a substep may cost, in steps of MuJoCo; and what it should.
REQUIRED, WANTED = 1 / 5, 1 / 10


def torques() -> Vector:
    """Joint torques of each chunk (N·m): a press on the table, and a rub, forth and back, that exceeds stiction."""
    phase = 2.0 * np.pi * np.arange(CHUNKS) * CHUNK * STEP
    rub = np.column_stack([30.0 * np.sin(phase), 25.0 * np.sin(1.3 * phase), -20.0 * np.sin(1.3 * phase)])
    return rub + np.array([0.0, -25.0, -15.0])


@dataclass(kw_only=True)
class Run:
    """Times of all chunks (ns), and how often the pad was in contact, and how often joints moved, at their ends."""

    ns: list[int] = field(default_factory=list)
    q: list[Vector] = field(default_factory=list)
    contact: list[bool] = field(default_factory=list)
    sliding: list[Vector] = field(default_factory=list)

    def look(self, q: Vector, dq: Vector, *, contact: bool) -> None:
        """Books the end of a chunk. 1e-4 rad/s is above MuJoCo's creep."""
        self.q.append(q.copy())
        self.sliding.append(np.abs(dq) > 1e-4)
        self.contact.append(contact)

    def share(self) -> str:
        """What was active."""
        moving = ", ".join(f"{100 * share:.0f}" for share in np.mean(self.sliding, axis=0))
        return f"contact in {100 * np.mean(self.contact):.0f} %, joints sliding in {moving} % of the chunks"

    def per_step(self) -> float:
        """Mean time of a step (ns)."""
        return sum(self.ns) / (CHUNK * len(self.ns))


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
            began = perf_counter_ns()
            status = step(component, t, h, keep)
            run.ns.append(perf_counter_ns() - began)
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
        began = perf_counter_ns()
        mujoco.mj_step(model, data, nstep=CHUNK)
        run.ns.append(perf_counter_ns() - began)
        run.look(data.qpos, data.qvel, contact=data.ncon > 0)
    return run


def distance(a: Run, b: Run) -> float:
    """Largest difference of joint angles at the ends of the chunks (rad)."""
    return float(np.abs(np.array(a.q) - np.array(b.q)).max())


def main() -> None:
    """Measures and prints. MuJoCo's fastest setting is the one that counts."""
    ours: list[Run] = []
    theirs: dict[str, list[Run]] = {name: [] for name in SETTINGS}
    with Archive(find_fmu_dir() / "ExoskeletonArm.fmu") as archive:
        for _ in range(REPETITIONS):  # in turns: what else the machine does meets all
            ours.append(plant(archive))
            for name, changes in SETTINGS.items():
                theirs[name].append(foreign(changes))
    substep = min(run.per_step() for run in ours)
    step = {name: min(run.per_step() for run in runs) for name, runs in theirs.items()}
    print(f"ExoskeletonArm.fmu through fmi2DoStep: {substep:.0f} ns a substep of {STEP:g} s; {ours[0].share()}")
    for name, changes in SETTINGS.items():
        run, exact = theirs[name][0], foreign({**changes, **EXACT})
        print(
            f"MuJoCo {mujoco.__version__} implicitfast, {name}: {step[name] / 1e3:.2f} µs a step of {STEP:g} s, "
            f"ratio 1/{step[name] / substep:.1f}; {run.share()}; {distance(run, exact):.0e} rad from tolerance 0, "
            f"{distance(run, ours[0]):.0e} rad from the plant, whose friction and contact are not soft"
        )
    ratio = substep / min(step.values())
    print(
        f"a substep costs 1/{1 / ratio:.1f} of MuJoCo's fastest step; "
        f"required: 1/{1 / REQUIRED:.0f}, wanted: 1/{1 / WANTED:.0f}"
    )
    if ratio > REQUIRED:
        raise SystemExit("the plant's substep costs more than required")


if __name__ == "__main__":
    main()
