"""Rigid-body terms, kinematics and forward dynamics of ExoskeletonArm.fmu against Pinocchio and MuJoCo.

The engines hold the specification's table themselves (`oracles/`); the FMU runs on its start values. So a wrong start
value, sign, frame or term shows.
"""

from collections.abc import Iterator, Mapping
from ctypes import c_double, c_int, c_void_p
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from exo.fmu import Archive, Instance
from oracles.engines import Arm, Link, MuJoCo, Pinocchio, State, Terms

COUNT = 250
#: Step of the forward dynamics. The plant takes M, C, g and J at the begin of a substep, so one substep without
#: friction gives the acceleration exactly, whatever its length: (dq⁺ − dq)/h.
H = 1e-3
ENGINES = {"pinocchio": Pinocchio, "mujoco": MuJoCo}
TERMS = ("M", "C_dq", "g", "p", "p_pad", "J")
#: Relative, in the largest element of the term: some fifty roundings of 1e-16 and what they lose to cancellation in
#: bent poses. Required by docs/specification.md section 6; measured: 9e-15.
ROUNDING = 1e-12
#: Forward dynamics, relative. The difference quotient over H costs eps · 3 rad/s / H = 7e-13 rad/s² of accelerations of
#: some rad/s². Required by docs/specification.md section 6; measured: 6e-13.
QUOTIENT = 1e-9


def states(*, count: int, seed: int) -> list[State]:
    """Random states between the specification's stops; every fourth without payload, every third with gravity askew."""
    random = np.random.default_rng(seed)
    low, high = np.array([-1.2, -2.0, 0.1]), np.array([1.2, 1.0, 2.6])
    return [
        State(
            q=random.uniform(low, high),
            dq=random.uniform(-3.0, 3.0, 3),
            payload=float(random.uniform(0.1, 40.0)) if k % 4 else 0.0,
            gravity=random.uniform(-12.0, 12.0, 3) if k % 3 == 0 else np.array([0.0, 0.0, -9.81]),
            tau_a=random.uniform(-100.0, 100.0, 3),
            f_h=random.uniform(-50.0, 50.0, 3),
            f_d=random.uniform(-50.0, 50.0, 3),
        )
        for k in range(count)
    ]


def vector(name: str, value: Any) -> dict[str, float]:
    return {f"{name}[{i + 1}]": float(x) for i, x in enumerate(value)}


def parameters(state: State) -> dict[str, bool | float]:
    """The FMU's parameters for a state: no friction, no lag, stops out of the way."""
    return {
        **vector("q_start", state.q),
        **vector("gravity", state.gravity),
        **vector("stop.min", [-10.0] * 3),
        **vector("stop.max", [10.0] * 3),
        **{name: 0.0 for kind in ("F_c", "F_s", "b") for name in vector(f"friction.{kind}", range(3))},
        "drive.cutoff": 0.0,
        "substep": H,
        "payload.m": state.payload,
        "payload.attached": state.payload > 0.0,
        "vacuum": True,
        **vector("tau_a", state.tau_a),
        **vector("f_h", state.f_h),
        **vector("f_d", state.f_d),
    }


def outputs(archive: Archive, start: Mapping[str, bool | float], *, h: float | None = None) -> dict[str, Any]:
    """All vectors of an instance after initialization, or after one step of `h`."""
    with Instance(archive, "arm") as instance:
        for name, value in start.items():
            instance.set_start(name, value)
        instance.setup_experiment(start_time=0.0, stop_time=1.0)
        instance.enter_initialization_mode()
        instance.exit_initialization_mode()
        if h is not None:
            step = instance.function("fmi2DoStep")
            assert step(c_void_p(instance.component), c_double(0.0), c_double(h), c_int(1)) == 0, (
                instance.last_message()
            )
        names = [f"{name}[{i + 1}]" for name, n in SIZES.items() for i in range(n)]
        values = instance.values(names)
        return {name: np.array([values[f"{name}[{i + 1}]"] for i in range(n)]) for name, n in SIZES.items()}


SIZES = {"rigid_body.M": 9, "rigid_body.C_dq": 3, "rigid_body.g": 3, "p": 3, "dp": 3, "p_pad": 3, "dq": 3}


def terms(archive: Archive, state: State, arm: Mapping[str, float] | None = None) -> Terms:
    """What the FMU says of a state. J column by column, from the handle's velocity at unit joint velocities."""
    base = {**parameters(state), **(arm or {})}
    moving = base | vector("dq_start", state.dq)
    start, after = outputs(archive, moving), outputs(archive, moving, h=H)
    columns = [outputs(archive, base | vector("dq_start", unit))["dp"] for unit in np.eye(3)]
    return Terms(
        M=start["rigid_body.M"].reshape(3, 3),
        C_dq=start["rigid_body.C_dq"],
        g=start["rigid_body.g"],
        p=start["p"],
        p_pad=start["p_pad"],
        J=np.column_stack(columns),
        ddq=(after["dq"] - state.dq) / H,
    )


def error(found: Terms, expected: Terms, name: str, arm: Arm) -> float:
    """Largest error in units of the term's largest element. The rotors, which dwarf the links in M and are a constant,
    do not count in its size."""
    a, b = getattr(found, name), getattr(expected, name)
    size = b - np.diag(arm.armature()) if name == "M" else b
    return float(np.abs(a - b).max() / np.abs(size).max())


@pytest.fixture(scope="module")
def archive(fmu_dir: Path) -> Iterator[Archive]:
    with Archive(fmu_dir / "ExoskeletonArm.fmu") as archive:
        yield archive


@pytest.fixture(scope="module")
def found(archive: Archive) -> list[tuple[State, Terms]]:
    """The FMU's answers, on its start values."""
    return [(state, terms(archive, state)) for state in states(count=COUNT, seed=7)]


def worst(found: list[tuple[State, Terms]], engine: Any, name: str) -> float:
    return max(error(mine, engine(state), name, Arm()) for state, mine in found)


@pytest.mark.parametrize("name", TERMS)
@pytest.mark.parametrize("engine", ENGINES)
def test_term_agrees_with_another_engine(found: list[tuple[State, Terms]], engine: str, name: str) -> None:
    assert worst(found, ENGINES[engine](), name) < ROUNDING


@pytest.mark.parametrize("engine", ENGINES)
def test_forward_dynamics_agree_with_another_engine(found: list[tuple[State, Terms]], engine: str) -> None:
    assert worst(found, ENGINES[engine](), "ddq") < QUOTIENT


def with_links(**changes: float) -> Arm:
    """The specification's arm with elements of links 2 and 3 multiplied."""
    one, *others = Arm().links
    changed = [replace(link, **{key: getattr(link, key) * by for key, by in changes.items()}) for link in others]
    return Arm(links=(one, changed[0], changed[1]))


@pytest.mark.parametrize(
    ("arm", "name"),
    [
        (with_links(I_xz=-1.0), "M"),  # I_xz read as a product of inertia, minus the tensor's element
        (with_links(I_yy=1.001), "M"),
        (with_links(z=-1.0), "g"),
        (Arm(pad=(0.36, 0.12)), "g"),
        (Arm(rotor=(2e-5, 2e-5, 1.9e-5)), "ddq"),
    ],
    ids=["I_xz", "I_yy", "z", "pad", "rotor"],
)
def test_the_comparison_sees_a_wrong_arm(found: list[tuple[State, Terms]], arm: Arm, name: str) -> None:
    assert worst(found, Pinocchio(arm), name) > 1e-6


def random_arm(random: np.random.Generator) -> tuple[Arm, dict[str, float]]:
    """An arm with every number of the rigid body changed, and the FMU's parameters for it."""

    def near(value: float) -> float:
        return float(value * random.uniform(0.7, 1.4))

    def link(like: Link) -> Link:
        I_xx, I_zz = near(like.I_xx), near(like.I_zz)
        # Any body: |I_xx − I_zz| ≤ I_yy ≤ I_xx + I_zz, I_xz² ≤ I_xx I_zz.
        I_yy = float(random.uniform(abs(I_xx - I_zz), I_xx + I_zz))
        I_xz = float(random.uniform(-0.5, 0.5) * np.sqrt(I_xx * I_zz))
        z = float(random.uniform(-0.1, 0.1))
        return Link(m=near(like.m), x=near(like.x), z=z, I_xx=I_xx, I_yy=I_yy, I_zz=I_zz, I_xz=I_xz)

    usual = Arm()
    one, two, three = (link(like) for like in usual.links)
    x, z = random.uniform((0.2, -0.1), (0.5, 0.1)).tolist()
    pad_x, pad_z = random.uniform((0.2, -0.2), (0.5, 0.1)).tolist()
    gear = [near(ratio) for ratio in usual.gear]
    rotor = [near(inertia) for inertia in usual.rotor]
    arm = Arm(
        A1=near(usual.A1),
        L1=near(usual.L1),
        handle=(x, z),
        pad=(pad_x, pad_z),
        links=(one, two, three),
        rotor=(rotor[0], rotor[1], rotor[2]),
        gear=(gear[0], gear[1], gear[2]),
    )
    numbers = {"A1": arm.A1, "L1": arm.L1, "handle.x": x, "handle.z": z, "pad.x": pad_x, "pad.z": pad_z}
    numbers |= vector("gear", gear) | vector("rotor.I", rotor)
    for key in ("m", "x", "z", "I_xx", "I_yy", "I_zz", "I_xz"):
        numbers |= vector(f"link.{key}", [getattr(link, key) for link in arm.links])
    return arm, numbers


def test_any_arm_agrees_with_pinocchio(archive: Archive) -> None:
    random = np.random.default_rng(11)
    for state in states(count=50, seed=13):
        arm, numbers = random_arm(random)
        mine, theirs = terms(archive, state, numbers), Pinocchio(arm)(state)
        for name in TERMS:
            assert error(mine, theirs, name, arm) < ROUNDING, (name, state, arm)
        assert error(mine, theirs, "ddq", arm) < QUOTIENT, (state, arm)
