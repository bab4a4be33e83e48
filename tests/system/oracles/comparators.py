"""A second implementation of the comparators and of the testbed, written from the equations alone.

It shares no code with the FMUs: the desired models are integrated by the trapezoidal rule, the sliding mode's inclusion
is solved by trying the three cases, the plant is semi-implicit Euler with stiction and a penalty wall.
"""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
T = 0.002
SUBSTEPS = 25


class Natural:
    """M dv_d = f_h − D dq; τ = −D dq + K((v_d − dq) + K_P (q_d − q))."""

    def __init__(self, *, M: float, D: float, K: float, K_P: float, limit: float) -> None:
        self.M, self.D, self.K, self.K_P, self.limit = M, D, K, K_P, limit
        self.q_d = self.v_d = self.before = 0.0

    def __call__(self, q: float, f_h: float) -> float:
        dq, self.before = (q - self.before) / T, q
        acceleration = (f_h - self.D * dq) / self.M
        middle = self.v_d + acceleration * T / 2
        error = self.q_d - q + (middle - dq) * T / 2
        tau = self.K * (middle - dq) + self.K * self.K_P * error - self.D * dq
        self.q_d += self.v_d * T + acceleration * T * T / 2
        self.v_d += acceleration * T
        return max(-self.limit, min(self.limit, tau))


class SlidingMode:
    """M_n dv_n = f_h − D v_n; τ = K(db + K_P b) ∈ limit·Sgn((q_n − q − b) + H(v_n − dq − db))."""

    def __init__(self, *, M_n: float, D: float, K: float, K_P: float, H: float, limit: float) -> None:
        self.M_n, self.D, self.K, self.K_P, self.H, self.limit = M_n, D, K, K_P, H, limit
        self.q_n = self.v_n = self.b = self.before = 0.0

    def __call__(self, q: float, f_h: float) -> float:
        dq, self.before = (q - self.before) / T, q
        v_next = (self.v_n * (2 * self.M_n - self.D * T) + 2 * T * f_h) / (2 * self.M_n + self.D * T)
        middle = (self.v_n + v_next) / 2
        e, de = self.q_n - q + (middle - dq) * T / 2, middle - dq

        def argument(b: float) -> float:
            return e - b + self.H * (de - (b - self.b) / T)

        for tau in (self.limit, -self.limit):
            b = (tau * T + self.K * self.b) / (self.K + self.K * self.K_P * T)
            if argument(b) * tau >= 0:
                break
        else:
            b = (e + self.H * (de + self.b / T)) / (1 + self.H / T)
            tau = self.K * ((b - self.b) / T + self.K_P * b)
        self.b = b
        self.q_n += middle * T
        self.v_n = v_next
        return tau


def simulate(
    *, controller: Callable[[float, float], float], force: Array, M: float, F_c: float, b: float, wall: float
) -> Array:
    """Position at each tick, for the human's force at each tick."""
    q = dq = 0.0
    dt = T / SUBSTEPS
    positions = np.empty(len(force))
    for k, f_h in enumerate(force):
        positions[k] = q
        applied = controller(q, f_h) + f_h
        for _ in range(SUBSTEPS):
            push = applied
            if q > wall:
                push -= max(0.0, 1e5 * (q - wall) + 300.0 * dq)
            free = dq + dt / M * (push - b * dq)
            stop = dt / M * F_c
            dq = 0.0 if abs(free) <= stop else free - stop if free > 0 else free + stop
            q += dt * dq
    return positions


def wall_force() -> Array:
    """The operator of the wall experiment."""
    t = T * np.arange(30000)
    press = 5.0 * np.clip((t - 10) / 0.5, 0, 1) - 10.0 * np.clip((t - 20) / 0.5, 0, 1)
    return np.where(t < 10, 4.17 * np.sin(2 * np.pi * 0.31 * t), 0.0) + press


def gain_study_force() -> Array:
    """The operator of the gain study."""
    t = T * np.arange(30000)
    return 4.43 * np.sin(2 * np.pi * 0.363 * t) * np.clip(t / 2, 0, 1)


def release_delay(q: Array) -> float:
    """Time from 20.25 s to the first q < 0.299 m."""
    t = T * np.arange(len(q))
    free = (t >= 20.25 - 1e-9) & (q < 0.3 - 1e-3)
    return float(t[np.argmax(free)] - 20.25)


def fundamental_error(*, q: Array, force: Array, mass: float, D: float) -> float:
    """|H (mass iω + D) − 1| at 0.363 Hz over the last 20 s, velocity from central differences."""
    t = T * np.arange(len(q))
    omega = 2 * np.pi * 0.363
    v = np.gradient(q, T)
    last = (t >= 40) & (t < 60 - 2 * T)
    basis = np.exp(-1j * omega * t[last])
    H = np.linalg.lstsq(np.column_stack([basis.real, basis.imag]), v[last], rcond=None)[0] @ [1, 1j]
    F = np.linalg.lstsq(np.column_stack([basis.real, basis.imag]), force[last], rcond=None)[0] @ [1, 1j]
    return float(abs(H / F * (mass * 1j * omega + D) - 1))


def friction_error(law: str) -> float:
    """Distance of the comparator's motion from its model under the friction of the gain study."""
    force = gain_study_force()
    q = simulate(controller=_controller(law), force=force, M=6.0, F_c=0.69, b=0.35, wall=1e9)
    return fundamental_error(q=q, force=force, mass=6.0 if law == "natural" else 5.0, D=0.5)


def wall_delay(law: str) -> float:
    """The comparator's release delay at the wall."""
    q = simulate(controller=_controller(law), force=wall_force(), M=6.0, F_c=0.64, b=0.19, wall=0.3)
    return release_delay(q)


def _controller(law: str) -> Callable[[float, float], float]:
    common = {"D": 0.5, "K": 30.0, "K_P": 10.0, "limit": 12.5}
    return Natural(M=6.0, **common) if law == "natural" else SlidingMode(M_n=5.0, H=0.7, **common)
