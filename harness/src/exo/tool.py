"""Mass and centre of gravity of what hangs on the force sensor, and the sensor's bias, from readings in several poses.

Nobody touches the handle and the arm rests in each pose. With R from the sensor's frame to the base frame and γ = Rᵀ g,

    force  = m γ + b_f
    torque = (m c) × γ + b_n

which is linear in m, b_f and in m c, b_n: two least squares. The mass shows when gravity turns in the sensor's frame at
all; the centre of gravity needs it to turn about a second axis, or to sweep an arc.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from exo.errors import ExoError

Array = NDArray[np.float64]
GRAVITY = (0.0, 0.0, -9.81)
#: Least spread (standard deviation) of gravity's unit vector along the second direction in which it turns, as the
#: sensor sees it: an arc of some 100°. Below it noise counts more than tenfold.
LEAST_SPREAD = 0.1
#: No tool's centre of gravity is farther from its sensor (m); torques in N·mm put it a thousand times too far.
FARTHEST_COG = 1.0
#: A mass that is not this many standard errors from 0 is not known.
SIGNIFICANT = 3.0


@dataclass(frozen=True, kw_only=True)
class Tool:
    """What was found, SI, sensor frame; `*_error`: standard errors, `*_rest`: root mean square of what is left."""

    mass: float
    mass_error: float
    cog: Array
    cog_error: Array
    bias_force: Array
    bias_torque: Array
    force_rest: float
    torque_rest: float


def identify(*, R: Array, force: Array, torque: Array, gravity: Sequence[float] = GRAVITY) -> Tool:
    """From n readings: orientations (n, 3, 3), forces (n, 3) in N, torques about the sensor's origin (n, 3) in N·m."""
    n = len(R)
    gamma = np.einsum("kji,j->ki", R, np.asarray(gravity, dtype=float))
    _must_turn(gamma)
    each = np.tile(np.eye(3), (n, 1))
    x, P, force_rest = _least_squares(np.column_stack([gamma.reshape(-1), each]), force.reshape(-1))
    mass, mass_error, bias_force = float(x[0]), float(np.sqrt(P[0, 0])), x[1:]
    _must_weigh(mass, mass_error)
    x, P, torque_rest = _least_squares(np.column_stack([_crossed_with(gamma), each]), torque.reshape(-1))
    cog = x[:3] / mass
    cog_error = np.sqrt(np.diag(P)[:3] + (cog * mass_error) ** 2) / mass
    _must_be_near(cog, cog_error)
    return Tool(
        mass=mass,
        mass_error=mass_error,
        cog=cog,
        cog_error=cog_error,
        bias_force=bias_force,
        bias_torque=x[3:],
        force_rest=force_rest,
        torque_rest=torque_rest,
    )


def _must_turn(gamma: Array) -> None:
    length = np.linalg.norm(gamma, axis=1, keepdims=True)
    if not (length > 0.0).all():
        raise ExoError("without gravity a tool has no weight: expected a gravity vector that is not zero")
    directions = gamma / length
    spread = np.linalg.svd(directions - directions.mean(axis=0), compute_uv=False) / np.sqrt(len(gamma))
    if spread[1] >= LEAST_SPREAD:
        return
    found = f"spread {spread[0]:.3f}, {spread[1]:.3f} along two directions, expected {LEAST_SPREAD} or more"
    if spread[0] < LEAST_SPREAD:
        raise ExoError(
            f"gravity hardly turns in the sensor's frame ({found}): yaw, q[1], does not turn it; take readings in "
            "poses that pitch or roll the sensor by 100° and more"
        )
    raise ExoError(
        f"the poses turn gravity about one axis only and not far enough ({found}): pitch on, to an arc of 100° and "
        "more, or roll the sensor as well"
    )


def _must_weigh(mass: float, error: float) -> None:
    if abs(mass) <= SIGNIFICANT * error:
        raise ExoError(
            f"the mass comes out as {mass:.4g} kg with a standard error of {error:.2g} kg: the forces do not follow "
            "the poses, or the tool weighs nothing; expected readings at rest with nobody at the handle"
        )
    if mass < 0.0:
        raise ExoError(
            f"the mass comes out as {mass:.4g} kg: the forces are negated; expected ft.force as it acts on the "
            "sensor's tool, pointing down at rest (or --mount is upside down)"
        )


def _must_be_near(cog: Array, error: Array) -> None:
    distance = float(np.linalg.norm(cog))
    if distance - SIGNIFICANT * float(np.linalg.norm(error)) > FARTHEST_COG:
        raise ExoError(
            f"the centre of gravity comes out {distance:.3g} m from the sensor, expected less than {FARTHEST_COG:g} m: "
            "the torques are not in N·m (N·mm are a thousand times as many), or the forces not in N"
        )


def _crossed_with(gamma: Array) -> Array:
    """The matrices A with A v = v × γ, one below the other."""
    x, y, z = gamma.T
    zero = np.zeros_like(x)
    return np.stack([zero, z, -y, -z, zero, x, y, -x, zero], axis=1).reshape(-1, 3)


def _least_squares(A: Array, b: Array) -> tuple[Array, Array, float]:
    """Solution, its covariance from the residual, and the residual's root mean square."""
    x = np.asarray(np.linalg.lstsq(A, b, rcond=None)[0], dtype=np.float64)
    rest = b - A @ x
    freedom = max(len(b) - A.shape[1], 1)
    covariance: Array = np.linalg.inv(A.T @ A) * float(rest @ rest) / freedom
    return x, covariance, float(np.sqrt(np.mean(rest**2)))


def orientation(*, q: Array, mount: Sequence[float] = (0.0, 0.0, 0.0)) -> Array:
    """R from the sensor's frame to the base frame at joint angles `q` (n, 3): yaw, link 3's pitch q₂ + q₃ about −y, and
    the mounting's roll, pitch, yaw about link 3's fixed axes (rad), as ArmController's ft.mount says."""
    pitch = -(q[:, 1] + q[:, 2])
    roll, tilt, turn = (np.array([angle]) for angle in mount)
    return np.asarray(_turn(2, q[:, 0]) @ _turn(1, pitch) @ (_turn(2, turn) @ _turn(1, tilt) @ _turn(0, roll)))


def _turn(axis: int, angle: Array) -> Array:
    """Rotations about a coordinate axis."""
    R = np.zeros((len(angle), 3, 3))
    i, j = (axis + 1) % 3, (axis + 2) % 3
    R[:, axis, axis] = 1.0
    R[:, i, i] = R[:, j, j] = np.cos(angle)
    R[:, j, i] = np.sin(angle)
    R[:, i, j] = -np.sin(angle)
    return R
