"""Identification of the tool on the force sensor: against a synthetic one, and what it refuses."""

from pathlib import Path

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from typer.testing import CliRunner

from exo import tool
from exo.cli import app
from exo.errors import ExoError
from exo.readings import COLUMNS, read

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
    with pytest.raises(ExoError, match=r"gravity hardly turns .* yaw, q\[1\], does not turn it"):
        tool.identify(R=R, force=force, torque=torque)


@pytest.mark.parametrize(("arc", "refused"), [(0.8, True), (2.8, False)])
def test_a_short_arc_about_one_axis_is_named_and_a_long_one_does(arc: float, refused: bool) -> None:
    q = np.column_stack([np.zeros(9), np.linspace(-0.5 * arc, 0.5 * arc, 9), np.zeros(9)])
    R = tool.orientation(q=q)
    force, torque = readings(R, seed=9, noise=0.0)
    if refused:
        with pytest.raises(ExoError, match="the poses turn gravity about one axis only and not far enough"):
            tool.identify(R=R, force=force, torque=torque)
    else:
        assert tool.identify(R=R, force=force, torque=torque).cog == pytest.approx(COG, abs=1e-12)


@pytest.mark.parametrize(
    ("force_factor", "torque_factor", "sentence"),
    [
        (-1.0, -1.0, "the mass comes out as -0.*: the forces are negated"),
        (-1.0, 1.0, "the mass comes out as -0.*: the forces are negated"),
        (1.0, 1e3, "the centre of gravity comes out .* m from the sensor.*: the torques are not in N·m"),
        (0.0, 1.0, "the forces do not follow the poses"),
    ],
)
def test_a_wrong_sign_or_unit_is_named(force_factor: float, torque_factor: float, sentence: str) -> None:
    R = Rotation.random(8, random_state=7).as_matrix()
    force, torque = readings(R, seed=7)
    with pytest.raises(ExoError, match=sentence) as refused:
        tool.identify(R=R, force=force_factor * force, torque=torque_factor * torque)
    assert "\n" not in str(refused.value)


def write(path: Path, *, columns: list[str]) -> Path:
    q = arm_poses()
    force, torque = readings(tool.orientation(q=q, mount=(0.0, 0.5, 0.0)), seed=8, noise=0.0)
    table = np.column_stack([q, force, torque])
    lines = [",".join(columns), *(",".join(repr(float(x)) for x in row) for row in table)]
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return path


@pytest.mark.parametrize("prefix", ["", "controller."])
def test_the_command_prints_the_parameters(tmp_path: Path, prefix: str) -> None:
    path = write(tmp_path / "poses.csv", columns=[prefix + name for name in COLUMNS])
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


def spreadsheet(path: Path, *, between: str, point: str, encoding: str, end: str = "\n") -> Path:
    plain = write(path, columns=[*COLUMNS]).read_text(encoding="utf-8")
    text = plain.replace(",", "\0").replace(".", point).replace("\0", between)
    header, _, rest = text.partition("\n")
    header = header.replace(f"ft{point}", "ft.")
    path.write_bytes(f"{header}\n{rest}".replace("\n", end).encode(encoding))
    return path


@pytest.mark.parametrize(
    ("between", "point", "encoding", "end"),
    [
        (",", ".", "utf-8-sig", "\n"),
        (";", ".", "utf-8", "\n"),
        (";", ",", "utf-8-sig", "\r\n"),
        ("\t", ",", "utf-8", "\r\n"),
    ],
)
def test_what_a_spreadsheet_writes_is_read(tmp_path: Path, between: str, point: str, encoding: str, end: str) -> None:
    path = spreadsheet(tmp_path / "poses.csv", between=between, point=point, encoding=encoding, end=end)
    done = CliRunner().invoke(app, ["identify-tool", str(path), "--mount", "0,0.5,0"])
    assert done.exit_code == 0, done.output
    assert '"controller.ft.mass" = 0.82000' in done.output
    assert '"controller.ft.cog" = [0.01100, -0.02400, 0.06300]' in done.output


@pytest.mark.parametrize(
    ("between", "point", "encoding", "sentence"),
    [
        (",", ",", "utf-8", "reading 1: 18 fields, expected 9 .* decimal commas between commas"),
        (",", ".", "utf-16", "expected text in UTF-8"),
    ],
)
def test_a_table_that_cannot_be_told_is_named(
    tmp_path: Path, between: str, point: str, encoding: str, sentence: str
) -> None:
    path = spreadsheet(tmp_path / "poses.csv", between=between, point=point, encoding=encoding)
    with pytest.raises(ExoError, match=sentence):
        read(path)


@pytest.mark.parametrize(
    ("cell", "sentence"),
    [
        ("", r"reading 2, ft.force\[1\]: expected a finite number, got ''"),
        ("nan", r"reading 2, ft.force\[1\]: expected a finite number, got 'nan'"),
        ("1.2.3", r"reading 2, ft.force\[1\]: expected a finite number, got '1.2.3'"),
        ("1,2", "reading 2: 10 fields, expected 9"),
    ],
)
def test_a_reading_that_is_no_number_is_named(tmp_path: Path, cell: str, sentence: str) -> None:
    path = write(tmp_path / "poses.csv", columns=[*COLUMNS])
    lines = path.read_text(encoding="utf-8").splitlines()
    fields = lines[2].split(",")
    path.write_text("\n".join([*lines[:2], ",".join([*fields[:3], cell, *fields[4:]]), *lines[3:]]), encoding="utf-8")
    with pytest.raises(ExoError, match=sentence):
        read(path)


def test_angles_in_degrees_are_named(tmp_path: Path) -> None:
    path = write(tmp_path / "poses.csv", columns=[*COLUMNS])
    header, *rows = path.read_text(encoding="utf-8").splitlines()
    turned = [[float(x) for x in row.split(",")] for row in rows]
    degrees = [[*np.degrees(row[:3]), *row[3:]] for row in turned]
    path.write_text("\n".join([header, *(",".join(map(str, row)) for row in degrees)]), encoding="utf-8")
    with pytest.raises(ExoError, match=r"q reaches .*, expected rad, at most 6.283: degrees\?"):
        read(path)
