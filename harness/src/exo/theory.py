"""Closed forms that measured numbers are compared with.

Symbols are the paper's. The position q, the nominal q_n, e = q_n − q; f_h is the human force τ_h (N).
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
import scipy
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class Loop:
    """The unlimited loop of law 2 (`passive`) and a free mass without friction.

    M, M_n in kg; D_n, K, alpha in N·s/m; K_P in 1/s; T and substep in s. Of `opened` and what is built on it, also: b,
    friction of the robot that is proportional to its speed (N·s/m; negative where dry friction falls with speed), and
    the corner frequencies (Hz, 0: none) of the low passes on the sensed velocity, on the force that the law sees, and
    of the drive's torque.
    """

    M: float
    M_n: float
    D_n: float
    K: float
    K_P: float
    alpha: float
    T: float
    substep: float
    b: float = 0.0
    dq_cutoff: float = 0.0
    f_cutoff: float = 0.0
    drive_cutoff: float = 0.0


def continuous(*, loop: Loop, omega: float) -> complex:
    """dQ/T_H of the continuous loop at s = iω (m/(N·s))                                    eq:admittance_proposed

    (N s + (K + α)s + K K_P + α K_P) / (M N s² + α M s² + K N s + α M K_P s + K K_P N),  N = M_n s + D_n

    The print has (K + D_n)s in the numerator; it must be (K + 1)s, with α = 1. From
    M s dQ = K c (dQ_n − dQ) + T_H and N dQ_n = T_H − α c (dQ_n − dQ), c = (s + K_P)/s.
    """
    s = 1j * omega
    N = loop.M_n * s + loop.D_n
    M, K, K_P, alpha = loop.M, loop.K, loop.K_P, loop.alpha
    numerator = N * s + (K + alpha) * s + K * K_P + alpha * K_P
    denominator = M * N * s**2 + alpha * M * s**2 + K * N * s + alpha * M * K_P * s + K * K_P * N
    return complex(numerator / denominator)


def substeps(*, T: float, substep: float) -> int:
    """How many substeps of at most `substep` (s, above 0) the plants take in T (s); one at least."""
    return max(1, int(np.ceil(T / substep - 1e-6)))


def sampled_tick(*, loop: Loop, state: Array, f_h: float) -> Array:
    """The state (q, dq, q_{k−1}, q_n, v_n) one period later: implicit midpoint law, mass by backward Euler.

    With n substeps of dt = T/n, each v⁺ = v + dt u/M and q⁺ = q + dt v⁺, the mass ends at
    v + T u/M and q + T v + (n + 1)/(2n) T² u/M.
    """
    q, v, q_before, q_n, v_n = state
    T, K_P, alpha = loop.T, loop.K_P, loop.alpha
    dq, e = (q - q_before) / T, q_n - q
    c = alpha * (1.0 + K_P * T / 2.0)
    v_m = (2.0 * loop.M_n * v_n / T + f_h + alpha * (dq + K_P * T * dq / 2.0 - K_P * e)) / (
        2.0 * loop.M_n / T + loop.D_n + c
    )
    y = (v_m - dq) + K_P * (e + T * (v_m - dq) / 2.0)
    acceleration = (loop.K * y + f_h) / loop.M
    n = substeps(T=T, substep=loop.substep)
    return np.array(
        [
            q + T * v + (n + 1.0) / (2.0 * n) * T**2 * acceleration,
            v + T * acceleration,
            q,
            q_n + T * v_m,
            2.0 * v_m - v_n,
        ]
    )


def sampled(*, loop: Loop, omega: float) -> complex:
    """dQ/T_H of the sampled loop at the ticks, z = exp(iωT): C(zI − A)⁻¹B with A, B read off `sampled_tick`."""
    A = np.column_stack([sampled_tick(loop=loop, state=column, f_h=0.0) for column in np.eye(5)])
    B = sampled_tick(loop=loop, state=np.zeros(5), f_h=1.0)
    z = np.exp(1j * omega * loop.T)
    return complex(np.linalg.solve(z * np.eye(5) - A, B)[1])


RESPONSES: dict[str, Callable[..., complex]] = {"continuous": continuous, "sampled": sampled}


def error_at_a_wall(
    *, time: Array, f_h: Array, e: float, de: float, M_n: float, D_n: float, K_P: float, alpha: float
) -> Array:
    """e(t) of a nominal whose robot rests at a wall (q constant), from e, de at `time[0]`; f_h held between the ticks.

    M_n ë + (D_n + α) ė + α K_P e = f_h: the nominal sees D_n + α and the spring α K_P, and ends at f_h/(α K_P).
    """
    T = float(time[1] - time[0])
    dynamics = np.zeros((3, 3))
    dynamics[0, 1] = 1.0
    dynamics[1] = [-alpha * K_P / M_n, -(D_n + alpha) / M_n, 1.0 / M_n]
    step = scipy.linalg.expm(dynamics * T)
    curve = np.empty_like(time)
    x, v = e, de
    for k, force in enumerate(f_h):
        curve[k] = x
        x, v, _ = step @ (x, v, force)
    return curve


@dataclass(frozen=True, kw_only=True)
class Hand:
    """A hand that holds the robot like a spring and a damper: f_h = −k_h q(t − delay) − b_h dq(t − delay).

    k_h in N/m, b_h in N·s/m, delay in s. Sampled at the tick and held over it; between ticks of the past the motion is
    taken linear, as the operator's FMU takes it.
    """

    k_h: float = 0.0
    b_h: float = 0.0
    delay: float = 0.0


@dataclass(frozen=True, kw_only=True)
class Opened:
    """Law and robot over one tick: x⁺ = A x + B u + F f_h, τ_a = C x + G f_h.

    x = (q, dq, q_k − q_{k−1}, e, v_n), then as far as the loop has them the low-passed velocity, the low-passed force,
    and the drive's torque; u is the force asked of the robot: τ_a, or that of an earlier tick.
    """

    A: Array
    B: Array
    F: Array
    C: Array
    G: float


def weight(*, cutoff: float, T: float) -> float:
    """Share w of x⁺ = x + w (u − x), the sampled first-order low pass: 1 − exp(−2π f T), f in Hz; 1 for f = 0, none."""
    return float(-np.expm1(-2.0 * np.pi * cutoff * T)) if cutoff else 1.0


def robot(*, loop: Loop) -> tuple[Array, Array, Array]:
    """(q, dq, τ) over one tick: its map (3, 3), what the force asked of the drive adds (3), and a force on the mass
    (3).

        M ddq = τ + f − b dq,  dτ/dt = 2π f_d (u − τ); without a lag τ = u

    In n substeps as the plants take them, backward Euler with the torque at the end of each; a substep of 0 stands for
    the exact solution (n → ∞).
    """
    step = _robot(M=loop.M, b=loop.b, T=loop.T, substep=loop.substep, lag=2.0 * np.pi * loop.drive_cutoff)
    return step[:3, :3], step[:3, 3], step[:3, 4]


@lru_cache(maxsize=1024)  # a search for a gain asks for the same robot again and again
def _robot(*, M: float, b: float, T: float, substep: float, lag: float) -> Array:
    """The map of (q, dq, τ, u, f), for the `lag` in rad/s."""
    if substep > 0.0:
        n = substeps(T=T, substep=substep)
        dt = T / n
        keep = np.exp(-lag * dt) if lag else 0.0
        q, v, tau, u, f = np.eye(5)
        tau_end = keep * tau + (1.0 - keep) * u
        v_end = (M * v + dt * (tau_end + f)) / (M + dt * b)
        step: Array = np.linalg.matrix_power(np.array([q + dt * v_end, v_end, tau_end, u, f]), n)
    else:
        flow = np.zeros((5, 5))
        flow[0, 1] = T
        flow[1] = np.array([0.0, -b, 1.0, 0.0, 1.0]) * T / M if lag else np.array([0.0, -b, 0.0, 1.0, 1.0]) * T / M
        flow[2] = np.array([0.0, 0.0, -lag, lag, 0.0]) * T
        step = scipy.linalg.expm(flow)
        step[:, 0] = np.eye(5)[0]  # nothing depends on the place, not by rounding either
    step.setflags(write=False)
    return step


def opened(*, loop: Loop) -> Opened:
    """The implicit midpoint law of docs/specification.md section 1 and the `robot` without dry friction.

    Low passes as the law has them: on the difference of positions (`dq_cutoff`), and on the force of which only the law
    knows (`f_cutoff`); the robot feels the force itself.
    """
    T, K_P, alpha = loop.T, loop.K_P, loop.alpha
    seen, felt = weight(cutoff=loop.dq_cutoff, T=T), weight(cutoff=loop.f_cutoff, T=T)
    has = [seen < 1.0, felt < 1.0, loop.drive_cutoff > 0.0]
    unit = np.eye(5 + sum(has) + 2)  # the states, then u and f_h
    u, f_h = unit[-2:]
    q, v, moved, e, v_n = unit[:5]
    smooth, force, tau = (unit[4 + sum(has[: i + 1])] if has[i] else np.zeros(len(unit)) for i in range(3))

    c = 1.0 + K_P * T / 2.0
    dq = (1.0 - seen) * smooth + seen * moved / T
    f = (1.0 - felt) * force + felt * f_h
    inertia = 2.0 * loop.M_n / T
    v_m = (inertia * v_n + f + alpha * (c * dq - K_P * e)) / (inertia + loop.D_n + alpha * c)
    out = loop.K * (c * (v_m - dq) + K_P * e)

    own, asked, pushed = robot(loop=loop)
    q_end, v_end, tau_end = own @ np.array([q, v, tau]) + np.outer(asked, u) + np.outer(pushed, f_h)
    way = q_end - q
    rows = [q_end, v_end, way, e + T * v_m - way, 2.0 * v_m - v_n]
    rows += [row for row, there in zip((dq, f, tau_end), has, strict=True) if there]
    whole = np.array(rows)
    return Opened(A=whole[:, :-2], B=whole[:, -2], F=whole[:, -1], C=out[:-2], G=float(out[-1]))


def closed_loop(*, loop: Loop, hand: Hand = Hand(), delay: int = 0) -> Array:
    """The map of one tick with the hand on the robot and τ_a arriving `delay` ticks late.

    Its state is that of `opened`, then the forces under way, then those that the hand is still to exert. Without a
    spring in the hand nothing depends on q, and it is left out: its eigenvalue 1 says only that the mass may stand
    anywhere.
    """
    law, late = opened(loop=loop), hand.delay / loop.T
    whole = int(np.floor(late + 1e-9))
    share = max(late - whole, 0.0) if late - whole > 1e-9 else 0.0
    reflex = whole + (1 if share else 0)

    order = len(law.B)

    def tick(state: Array) -> Array:
        x, under_way, meant = np.split(state, [order, order + delay])
        felt = [-hand.k_h * x[0] - hand.b_h * x[1], *meant]
        f_h = (1.0 - share) * felt[whole] + share * felt[reflex]
        forces = [law.C @ x + law.G * f_h, *under_way]
        x_after = law.A @ x + law.B * forces[delay] + law.F * f_h
        return np.concatenate([x_after, forces[:delay], felt[:reflex]])

    matrix = np.column_stack([tick(unit) for unit in np.eye(order + delay + reflex)])
    return matrix if hand.k_h else matrix[1:, 1:]


def growth_rate(*, loop: Loop, hand: Hand = Hand(), delay: int = 0) -> float:
    """Growth σ (1/s) of the slowest mode, exp(σ t), of `closed_loop`: ln|λ|/T of its largest eigenvalue λ."""
    eigenvalues = np.linalg.eigvals(closed_loop(loop=loop, hand=hand, delay=delay))
    return float(np.log(np.max(np.abs(eigenvalues))) / loop.T)


def hand_growth_rate(*, loop: Loop, k_h: float) -> float:
    """Growth σ (1/s) of the slowest mode, exp(σ t), of the sampled loop with a hand of stiffness k_h (N/m), one axis.

        M ddq = K y − k_h q                           eq:real_dyn, no friction; y and k_h q held over T
        M_n ddq_n = −D_n dq_n − α y − k_h q           eq:obs_dyn
        y = de + K_P e                                eq:dob_input

    The hand is no passive load: it acts on the nominal as well, and (f_h ; dq) alone is no passive port when M_n < M.
    """
    return growth_rate(loop=loop, hand=Hand(k_h=k_h))
