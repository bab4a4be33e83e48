"""The paper's theorems 1 and 2 as numbers: closed forms for one axis of mass M with viscous friction b."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class Pair:
    """Robot and nominal of one axis: M (kg), b (N·s/m) of the robot, M_n (kg), D_n, K, alpha (N·s/m), K_P (1/s)."""

    M: float
    b: float
    M_n: float
    D_n: float
    K: float
    K_P: float
    alpha: float = 1.0


def l2_bound(pair: Pair) -> float:
    """A γ with ‖v‖ ≤ γ ‖τ_h‖, v = (dq, dq_n), as the proof of thm:passivity gives it (m/(N·s)).

    With S = ½ M dq² + (K/α) ½ M_n dq_n² + ½ K K_P e², from eq:real_dyn, eq:obs_dyn and eq:dob_input,

        dS = τ_h cᵀv − vᵀ D v,   c = (1, K/α),   D = [[b + K, −K], [−K, K D_n/α + K]]

    From rest ∫ vᵀDv ≤ ∫ τ_h cᵀv, and by Schwarz |D^½ v| ≤ |D^−½ c| |τ_h|: γ = √(cᵀD⁻¹c / λ_min(D)).
    """
    K, alpha = pair.K, pair.alpha
    D = np.array([[pair.b + K, -K], [-K, K * pair.D_n / alpha + K]])
    c = np.array([1.0, K / alpha])
    return math.sqrt(float(c @ np.linalg.solve(D, c)) / float(np.linalg.eigvalsh(D)[0]))


def l2_response(pair: Pair, omega: float) -> Array:
    """(dQ, dQ_n)/T_H at s = iω (m/(N·s)), ω > 0; a 2-vector of complex numbers."""
    s = 1j * omega
    y = np.array([-1.0, 1.0]) * (1.0 + pair.K_P / s)  # y = (dq_n − dq)(s + K_P)/s
    loop = np.diag([pair.M * s + pair.b, pair.M_n * s + pair.D_n]) + np.outer([-pair.K, pair.alpha], y)
    return np.asarray(np.linalg.solve(loop, np.ones(2)))


def l2_gain(pair: Pair) -> float:
    """The smallest γ with ‖v‖ ≤ γ ‖τ_h‖: the largest |(dQ, dQ_n)/T_H| over all frequencies (m/(N·s)).

    At s = 0 nominal and robot go together, and the gain is √2 (1 + α/K)/(D_n + α b/K).
    """
    standing = math.sqrt(2.0) * (1.0 + pair.alpha / pair.K) / (pair.D_n + pair.alpha * pair.b / pair.K)
    return max(standing, *(float(np.linalg.norm(l2_response(pair, w))) for w in np.geomspace(1e-4, 1e4, 2000)))


def found_disturbance(*, M: float, K: float, K_P: float, time: Array) -> Array:
    """τ_a/τ_ed after a step of τ_ed at 0 that then stays (1), at `time` (s).

    M (dde + K_P de) + K (de + K_P e) = τ_ed + M K_P de, eq:dif_dyn with the term that its print lacks and that does not
    vanish beside K: τ_a/τ_ed = K (s + K_P)/(M s² + K s + K K_P). As K → ∞ it becomes 1/(1 + (M/K) s),
    eq:boundary_layer: 63 % after M/K. Before that the spring is felt: it rises earlier, and overshoots.
    """
    poles = np.roots([M, K, K * K_P]).astype(complex)
    if abs(poles[0] - poles[1]) < 1e-6 * abs(poles[0]):
        poles = poles * np.array([1.0 + 1e-6, 1.0 - 1e-6])
    # Residues of K (s + K_P)/(s M (s − p₁)(s − p₂)), the one at 0 being 1.
    a, b = (K * (p + K_P) / (M * p * (p - other)) for p, other in ((poles[0], poles[1]), (poles[1], poles[0])))
    return np.asarray((1.0 + a * np.exp(poles[0] * time) + b * np.exp(poles[1] * time)).real)
