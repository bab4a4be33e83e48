"""The arm at its handle as the harness computes it, against the plant FMU's own; and the paper's footnote 2."""

import itertools
from collections.abc import Mapping
from pathlib import Path

import numpy as np
import pytest

from exo import derived
from exo.errors import ScenarioError
from exo.fmu import Archive, Instance
from exo.handle import Handle, handle_of

from conftest import recording


def started(fmu_dir: Path, settings: Mapping[str, float]) -> tuple[dict[str, float], np.ndarray]:
    """Parameters of an initialized arm, and its own mass matrix."""
    with Archive(fmu_dir / "ExoskeletonArm.fmu") as archive, Instance(archive, "arm") as arm:
        for name, value in settings.items():
            arm.set_start(name, value)
        arm.setup_experiment(start_time=0.0, stop_time=1.0)
        arm.enter_initialization_mode()
        arm.exit_initialization_mode()
        M = np.array(list(arm.values([f"rigid_body.M[{i}]" for i in range(1, 10)]).values())).reshape(3, 3)
        parameters = {f"plant.{name}": float(value) for name, value in arm.values(archive.names("parameter")).items()}
    return parameters, M


def at(parameters: Mapping[str, float], q: np.ndarray, *, attached: bool) -> Handle:
    """The handle at each of the poses q (n, 3)."""
    columns = {f"plant__q_joint[{i + 1}]": q[:, i] for i in range(3)}
    time = np.arange(len(q)) * 1e-3
    return handle_of(
        recording(time=time, parameters=parameters, plant__attached=np.full(len(q), attached), **columns), plant="plant"
    )


@pytest.mark.parametrize("q", [(0.0, -1.48096, 1.70138), (0.5, -0.9, 1.2), (-1.1, 0.4, 2.0)])
def test_the_harness_mass_matrix_is_the_plant_s_own_with_a_payload_and_a_handle_off_the_axis(
    q: tuple[float, float, float], fmu_dir: Path
) -> None:
    settings = {"payload.m": 10.0, "payload.attached": True, "handle.z": 0.03}
    parameters, M = started(fmu_dir, settings | {f"q_start[{i}]": angle for i, angle in enumerate(q, start=1)})
    assert at(parameters, np.array([q]), attached=True).M[0] == pytest.approx(M, abs=1e-13)  # rounding of 10 kg·m²


def test_the_inertia_is_almost_constant_in_the_joints_only_while_no_payload_hangs(fmu_dir: Path) -> None:
    # Footnote 2 of the paper, over the range of joints 2 and 3, 0.2 rad from the stretched elbow.
    poses = np.array(list(itertools.product([0.0], np.linspace(-2.0, 1.0, 31), np.linspace(0.3, 2.6, 24))))
    parameters, _ = started(fmu_dir, {})

    def changes(payload: float) -> tuple[list[float], float]:
        handle = at(parameters | {"plant.payload.m": payload}, poses, attached=payload > 0.0)
        of_joints = [float(np.ptp(handle.M[:, i, i]) / handle.M[:, i, i].min() + 1.0) for i in range(3)]
        across = handle.Lambda[:, 2, 2]
        return of_joints, float(across.max() / across.min())

    alone, loaded = changes(0.0), changes(17.5)
    assert alone[0] == pytest.approx([1.42, 1.07, 1.0], abs=0.01)  # the digits of docs/paper.md
    assert loaded[0] == pytest.approx([5.4, 1.8, 1.0], abs=0.05)
    assert alone[1] > 100.0


def test_a_stretched_elbow_has_no_effective_disturbance_and_says_so(fmu_dir: Path) -> None:
    parameters, _ = started(fmu_dir, {})
    gains = {f"controller.{name}[{i}]": 5.0 for name in ("Lambda_n", "D_n") for i in (1, 2, 3)}
    names = ("q_joint", "dp", "f_h", "tau_a", "tau_applied")
    columns = {f"plant__{name}[{i}]": np.zeros(3) for name in names for i in (1, 2, 3)}
    run = recording(time=np.arange(3.0), parameters=parameters | gains, plant__attached=np.zeros(3), **columns)
    with pytest.raises(ScenarioError, match=r"derived signal f_ed: .*expected an arm whose elbow is bent"):
        derived.added(run, ["f_ed"])
