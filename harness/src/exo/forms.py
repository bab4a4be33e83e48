"""Sampled loops, in closed form, of the testbed's other controllers: the comparators and the servo form.

One tick is a linear map as long as nothing saturates or sticks. Symbols as in `exo.theory`.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from exo.theory import Loop

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class Comparator:
    """`natural` or `sliding_mode` on a mass with viscous friction b (N·s/m) and a hand of stiffness k_h (N/m) and
    damping b_h (N·s/m).

    M_n is the desired mass: the robot's under `natural`. H (s) is the surface's time constant, `sliding_mode` only.
    """

    law: str
    M: float
    b: float
    M_n: float
    D_n: float
    K: float
    K_P: float
    H: float
    T: float
    substep: float
    k_h: float = 0.0
    b_h: float = 0.0


def comparator_tick(*, loop: Comparator, state: Array, f_h: float) -> Array:
    """The state (q, dq, q_{k−1}, q_n, v_n, b) one period later.

    natural:       M dv_d = f_h − D_n dq,   τ = K((v_d − dq) + K_P (q_d − q)) − D_n dq
    sliding_mode:  M_n dv_n = f_h − D_n v_n,   τ = K(db + K_P b),   H db + b = e + H de
    """
    q, dq, q_before, q_n, v_n, b = state
    T, K, K_P, D_n, M_n = loop.T, loop.K, loop.K_P, loop.D_n, loop.M_n
    force = f_h - loop.k_h * q - loop.b_h * dq
    sensed = (q - q_before) / T
    if loop.law == "natural":
        v_m = v_n + T / 2.0 * (force - D_n * sensed) / M_n
        w = v_m - sensed
        tau = K * (w + K_P * (q_n - q + T / 2.0 * w)) - D_n * sensed
        b = 0.0
    else:
        # M_n (v⁺ − v)/T = f_h − D_n (v + v⁺)/2
        v_after = ((M_n / T - D_n / 2.0) * v_n + force) / (M_n / T + D_n / 2.0)
        v_m = (v_n + v_after) / 2.0
        w = v_m - sensed
        # implicit Euler of H db + b = e + H de
        b_after = (q_n - q + T / 2.0 * w + loop.H * w + loop.H / T * b) / (1.0 + loop.H / T)
        tau = K * ((b_after - b) / T + K_P * b_after)
        b = b_after
    n = max(1, round(T / loop.substep))
    q_after, dt = q, T / n
    for _ in range(n):
        dq = (loop.M * dq + dt * (tau + force)) / (loop.M + dt * loop.b)
        q_after += dt * dq
    return np.array([q_after, dq, q, q_n + T * v_m, 2.0 * v_m - v_n, b])


def comparator_response(*, loop: Comparator, omega: float) -> complex:
    """dQ/T_H at the ticks, z = exp(iωT)."""
    A = np.column_stack([comparator_tick(loop=loop, state=column, f_h=0.0) for column in np.eye(6)])
    B = comparator_tick(loop=loop, state=np.zeros(6), f_h=1.0)
    return complex(np.linalg.solve(np.exp(1j * omega * loop.T) * np.eye(6) - A, B)[1])


def comparator_growth_rate(*, loop: Comparator) -> float:
    """Growth σ (1/s) of the slowest mode with the hand; the states that nothing moves back (q_{k−1}, b) decay."""
    A = np.column_stack([comparator_tick(loop=loop, state=column, f_h=0.0) for column in np.eye(6)])
    return float(np.log(np.max(np.abs(np.linalg.eigvals(A)))) / loop.T)


def servo_tick(*, loop: Loop, state: Array, f_h: float) -> Array:
    """The state (q, dq, q_n, v_n, τ_m) of the servo form one period later; no friction, no limit.

    M_n dv_n = f_h − D_n v_n − α τ_m/K with τ_m the drive's mean force of the sample before; the drive closes
    τ = K((v_m − dq) + K_P (q_n + T v_m/2 − q)) at the start of every substep.
    """
    q, dq, q_n, v_n, tau_m = state
    T, M_n = loop.T, loop.M_n
    v_after = ((M_n / T - loop.D_n / 2.0) * v_n + f_h - loop.alpha * tau_m / loop.K) / (M_n / T + loop.D_n / 2.0)
    v_m = (v_n + v_after) / 2.0
    n = math.ceil(T / loop.substep - 1e-6)
    mean = 0.0
    for _ in range(n):
        tau = loop.K * ((v_m - dq) + loop.K_P * (q_n + T * v_m / 2.0 - q))
        dq += T / n * (tau + f_h) / loop.M
        q += T / n * dq
        mean += tau / n
    return np.array([q, dq, q_n + T * v_m, v_after, mean])


def servo_response(*, loop: Loop, omega: float) -> complex:
    """dQ/T_H of the servo form at the ticks."""
    A = np.column_stack([servo_tick(loop=loop, state=column, f_h=0.0) for column in np.eye(5)])
    B = servo_tick(loop=loop, state=np.zeros(5), f_h=1.0)
    return complex(np.linalg.solve(np.exp(1j * omega * loop.T) * np.eye(5) - A, B)[1])
