"""The nominal arm of ArmController in joint space, M_n(q), against Pinocchio and MuJoCo."""

from collections.abc import Iterator, Mapping
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from exo.fmu import Archive, Instance
from oracles.engines import Arm, Link, MuJoCo, Pinocchio, State

#: Relative, in the largest element of M_n: some fifty roundings. Required of rigid-body terms by
#: docs/specification.md section 6.
ROUNDING = 1e-12
LINK = ("m", "x", "z", "I_xx", "I_yy", "I_zz", "I_xz")


@pytest.fixture(scope="module")
def archive(fmu_dir: Path) -> Iterator[Archive]:
    with Archive(fmu_dir / "ArmController.fmu") as archive:
        yield archive


def parameters(arm: Arm, q: NDArray[np.float64]) -> dict[str, float | int]:
    """The FMU's parameters for an arm at a pose."""
    numbers: dict[str, float | int] = {"space": 2, "kinematics.A1": arm.A1, "kinematics.L1": arm.L1}
    for i in range(3):
        numbers |= {f"nominal.{key}[{i + 1}]": getattr(arm.links[i], key) for key in LINK}
        numbers |= {f"nominal.rotor[{i + 1}]": float(arm.armature()[i]), f"q[{i + 1}]": float(q[i])}
    return numbers


def mass_matrix(archive: Archive, start: Mapping[str, float | int]) -> NDArray[np.float64]:
    """M_n as the FMU shows it after initialization."""
    with Instance(archive, "nominal") as instance:
        for name, value in start.items():
            instance.set_start(name, value)
        instance.setup_experiment(start_time=0.0, stop_time=1.0)
        instance.enter_initialization_mode()
        instance.exit_initialization_mode()
        names = [f"M_n[{i + 1}]" for i in range(9)]
        values = instance.values(names)
        return np.array([values[name] for name in names]).reshape(3, 3)


def at(q: NDArray[np.float64]) -> State:
    """A state of rest that carries nothing."""
    zeros = np.zeros(3)
    return State(q=q, dq=zeros, payload=0.0, gravity=zeros, tau_a=zeros, f_h=zeros, f_d=zeros)


def poses(count: int, *, seed: int) -> NDArray[np.float64]:
    return np.random.default_rng(seed).uniform(-3.2, 3.2, (count, 3))


@pytest.mark.parametrize("engine", [Pinocchio, MuJoCo])
def test_the_specification_s_arm_as_a_nominal_one(archive: Archive, engine: type[Pinocchio] | type[MuJoCo]) -> None:
    oracle = engine()
    for q in poses(60, seed=3):
        found, expected = mass_matrix(archive, parameters(Arm(), q)), oracle(at(q)).M
        links = np.abs(expected - np.diag(Arm().armature())).max()
        assert np.abs(found - expected).max() < ROUNDING * links


def light_arm(random: np.random.Generator) -> Arm:
    """Some arm without symmetries, its rotors as the joints feel them."""

    def link() -> Link:
        I_xx, I_zz = random.uniform(0.001, 0.05, 2).tolist()
        # Any body: |I_xx − I_zz| ≤ I_yy ≤ I_xx + I_zz, I_xz² ≤ I_xx I_zz.
        I_yy = float(random.uniform(abs(I_xx - I_zz), I_xx + I_zz))
        I_xz = float(random.uniform(-0.5, 0.5) * np.sqrt(I_xx * I_zz))
        m, x, z = random.uniform((0.1, -0.1, -0.1), (5.0, 0.4, 0.1)).tolist()
        return Link(m=m, x=x, z=z, I_xx=I_xx, I_yy=I_yy, I_zz=I_zz, I_xz=I_xz)

    A1, L1 = random.uniform((0.0, 0.1), (0.2, 0.5)).tolist()
    rotor = random.uniform(0.01, 1.0, 3).tolist()
    links = (link(), link(), link())
    return Arm(A1=A1, L1=L1, links=links, rotor=(rotor[0], rotor[1], rotor[2]), gear=(1.0, 1.0, 1.0))


def test_any_nominal_arm_agrees_with_pinocchio(archive: Archive) -> None:
    random = np.random.default_rng(5)
    for q in poses(60, seed=7):
        arm = light_arm(random)
        found, expected = mass_matrix(archive, parameters(arm, q)), Pinocchio(arm)(at(q)).M
        assert np.abs(found - expected).max() < ROUNDING * np.abs(expected).max()


def test_the_comparison_sees_a_wrong_number(archive: Archive) -> None:
    q = poses(1, seed=9)[0]
    right, expected = parameters(Arm(), q), Pinocchio()(at(q)).M
    for key in ("x", "z", "I_xx", "I_yy", "I_xz"):
        wrong = right | {f"nominal.{key}[3]": right[f"nominal.{key}[3]"] * 1.001}
        assert np.abs(mass_matrix(archive, wrong) - expected).max() > 1e3 * ROUNDING * np.abs(expected).max(), key
