"""Identification of the tool on the force sensor: against a synthetic one, and what it refuses."""

from pathlib import Path

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from typer.testing import CliRunner

from exo import tool
from exo.cli import app
from exo.errors import ExoError

MASS, COG = 0.82, np.array([0.011, -0.024, 0.063])
BIAS_FORCE, BIAS_TORQUE = np.array([3.1, -1.7, 5.2]), np.array([0.12, -0.31, 0.07])
SIGMA_FORCE, SIGMA_TORQUE = 0.1, 0.005
GRAVITY = np.array([0.0, 0.0, -9.81])


def readings(R: np.ndarray, *, seed: int, noise: float = 1.0) -> tuple[np.ndarray, np.ndarray]:
    """What the sensor shows: the weight at its place in the base frame, read in the sensor's."""
    random = np.random.default_rng(seed)
    weight = MASS * GRAVITY
    force = np.array([r.T @ weight for r in R])
    torque = np.array([r.T @ np.cross(r @ COG, weight) for r in R])
    force += BIAS_FORCE + noise * SIGMA_FORCE * random.standard_normal(force.shape)
    torque += BIAS_TORQUE + noise * SIGMA_TORQUE * random.standard_normal(torque.shape)
    return force, torque


def test_without_noise_the_tool_is_found_exactly() -> None:
    R = Rotation.random(8, random_state=1).as_matrix()
    force, torque = readings(R, seed=1, noise=0.0)
    found = tool.identify(R=R, force=force, torque=torque)
    # Rounding of a well conditioned least squares.
    assert abs(found.mass - MASS) < 1e-13
    for a, b in ((found.cog, COG), (found.bias_force, BIAS_FORCE), (found.bias_torque, BIAS_TORQUE)):
        assert np.abs(a - b).max() < 1e-13
    assert found.force_rest < 1e-13
    assert found.torque_rest < 1e-13


def test_with_noise_the_errors_are_as_large_as_it_says() -> None:
    R = np.repeat(Rotation.random(12, random_state=2).as_matrix(), 50, axis=0)
    shares = []
    for seed in range(200):
        force, torque = readings(R, seed=seed)
        found = tool.identify(R=R, force=force, torque=torque)
        shares.append([(found.mass - MASS) / found.mass_error, *((found.cog - COG) / found.cog_error)])
        assert found.force_rest == pytest.approx(SIGMA_FORCE, rel=0.1)  # 1800 samples: 2 %, times five
        assert found.torque_rest == pytest.approx(SIGMA_TORQUE, rel=0.1)
    # 200 runs know a standard deviation to 5 %, times four; their mean to 0.07.
    assert np.std(shares, axis=0) == pytest.approx(np.ones(4), rel=0.2)
    assert np.abs(np.mean(shares, axis=0)).max() < 0.3


def arm_poses() -> np.ndarray:
    """Yaw and pitch as the arm without a wrist can: link 3 from steeply down to steeply up."""
    pitch = np.linspace(-1.4, 1.4, 9)
    q_2 = np.linspace(-1.5, 0.4, 9)
    return np.column_stack([0.3 * np.cos(np.arange(9)), q_2, pitch - q_2])


def test_the_arm_without_a_wrist_finds_it_by_pitching() -> None:
    mount = (0.4, -0.7, 1.9)
    R = tool.orientation(q=arm_poses(), mount=mount)
    force, torque = readings(R, seed=4, noise=0.0)
    found = tool.identify(R=R, force=force, torque=torque)
    assert abs(found.mass - MASS) < 1e-12
    assert np.abs(found.cog - COG).max() < 1e-12


def test_the_orientation_is_that_of_another_package() -> None:
    q = np.random.default_rng(5).uniform(-2.0, 2.0, (20, 3))
    mount = (0.3, -1.1, 2.0)
    theirs = (
        Rotation.from_rotvec(np.outer(q[:, 0], [0.0, 0.0, 1.0]))
        * Rotation.from_rotvec(np.outer(q[:, 1] + q[:, 2], [0.0, -1.0, 0.0]))
        * Rotation.from_euler("xyz", mount)  # small letters: fixed axes
    ).as_matrix()
    assert np.abs(tool.orientation(q=q, mount=mount) - theirs).max() < 1e-15 * 8  # rounding


def test_poses_in_which_gravity_does_not_turn_are_refused() -> None:
    q = np.column_stack([np.linspace(-1.0, 1.0, 9), np.full(9, -1.0), np.full(9, 1.2)])  # yaw alone
    R = tool.orientation(q=q)
    force, torque = readings(R, seed=6)
    with pytest.raises(ExoError, match="gravity hardly turns"):
        tool.identify(R=R, force=force, torque=torque)


def test_forces_of_the_wrong_sign_are_refused() -> None:
    R = Rotation.random(8, random_state=7).as_matrix()
    force, torque = readings(R, seed=7)
    with pytest.raises(ExoError, match="the mass comes out as -0"):
        tool.identify(R=R, force=-force, torque=-torque)


def write(path: Path, *, columns: list[str]) -> Path:
    q = arm_poses()
    force, torque = readings(tool.orientation(q=q, mount=(0.0, 0.5, 0.0)), seed=8, noise=0.0)
    table = np.column_stack([q, force, torque])
    lines = [",".join(columns), *(",".join(repr(float(x)) for x in row) for row in table)]
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return path


@pytest.mark.parametrize("prefix", ["", "controller."])
def test_the_command_prints_the_parameters(tmp_path: Path, prefix: str) -> None:
    path = write(tmp_path / "poses.csv", columns=[prefix + name for name in tool.COLUMNS])
    done = CliRunner().invoke(app, ["identify-tool", str(path), "--mount", "0,0.5,0"])
    assert done.exit_code == 0, done.output
    assert '"controller.ft.mass" = 0.82000' in done.output
    assert '"controller.ft.cog" = [0.01100, -0.02400, 0.06300]' in done.output


def test_the_command_names_what_is_missing(tmp_path: Path) -> None:
    path = write(tmp_path / "poses.csv", columns=["q[1]", "q[2]", "q[3]", *("abcdef")])
    done = CliRunner().invoke(app, ["identify-tool", str(path)])
    assert done.exit_code == 2
    assert "missing: ft.force[1]" in done.output
    done = CliRunner().invoke(app, ["identify-tool", str(path), "--mount", "1,2"])
    assert done.exit_code == 2
    assert "expected roll,pitch,yaw" in done.output
