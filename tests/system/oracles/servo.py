"""A second implementation of the servo form on the frictional testbed, written from the equations alone.

The law in its own words: the nominal's velocity by the trapezoidal rule under the last sample's mean force, the drive
told the mean of the nominal's motion over the sample. The drive's own loop is 25 cycles a sample, as the testbed's is.
"""

from oracles.comparators import SUBSTEPS, Array, T


def gain_study_error(*, force: Array, K: float) -> float:
    """max |q_n − q| over 40–60 s at M = 6, M_n = 5, D_n = 0.5, K_P = 10, F_c = 0.69, b = 0.35, drive limit 12.5 N."""
    M, M_n, D_n, K_P, F_c, b, limit = 6.0, 5.0, 0.5, 10.0, 0.69, 0.35, 12.5
    q = dq = q_n = v_n = felt = worst = 0.0
    dt = T / SUBSTEPS
    for k, f_h in enumerate(force):
        if k * T >= 40.0:
            worst = max(worst, abs(q_n - q))
        v_next = (v_n * (2 * M_n - D_n * T) + 2 * T * (f_h - felt / K)) / (2 * M_n + D_n * T)
        q_next = q_n + T * (v_n + v_next) / 2
        told_v, told_q = (q_next - q_n) / T, (q_next + q_n) / 2
        impulse = 0.0
        for _ in range(SUBSTEPS):
            tau = max(-limit, min(limit, K * (told_v - dq) + K * K_P * (told_q - q)))
            impulse += tau * dt
            # Stiction and Coulomb friction, then viscous friction, implicitly.
            push = (M * dq + dt * (tau + f_h)) / (M + dt * b)
            stop = dt * F_c / (M + dt * b)
            dq = 0.0 if abs(push) <= stop else push - stop if push > 0 else push + stop
            q += dt * dq
        felt = impulse / T
        q_n, v_n = q_next, v_next
    return worst
