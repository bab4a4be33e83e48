"""The sampled virtual wall of the literature, with its boundaries in closed form; shares nothing with `exo`.

A mass M under a sampled spring K_w and damper B_w, the force held over T and d samples late, the velocity a difference:

    M ddx = −K_w x(t_k − dT) − B_w (x(t_k − dT) − x(t_k − (d + 1)T))/T

Colgate and Schenkel (1997) give the damping that makes such a wall passive, Hulin, Preusche and Hirzinger (2006) where
a mass at it becomes unstable, with delay. With ζ = K_w T²/M and β = B_w T/M the characteristic equation is

    z^(d+1) (z − 1)² + ½ (z + 1) (ζ z + β (z − 1)) = 0

On the unit circle, z = exp(iθ), it is linear in ζ and β:

    ζ = 4 tan²(θ/2) cos((d + 1) θ),   β = 2 tan(θ/2) sin((d + 1) θ) − ζ/2
"""

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq


def boundary(theta: float, delay: int) -> tuple[float, float]:
    """(ζ, β) at which the wall swings with θ radians a sample for ever."""
    tangent = np.tan(theta / 2.0)
    stiffness = 4.0 * tangent**2 * np.cos((delay + 1) * theta)
    return float(stiffness), float(2.0 * tangent * np.sin((delay + 1) * theta) - stiffness / 2.0)


def largest_gain(*, ratio: float, delay: int) -> float:
    """The largest β on the boundary's first branch at which ζ = ratio · β."""

    def off(theta: float) -> float:
        stiffness, damping = boundary(theta, delay)
        return stiffness - ratio * damping

    # ζ/β falls from 1/(½ + d) to 0 along the branch, at whose end cos((d + 1) θ) is 0.
    end = np.pi / (2.0 * (delay + 1))
    theta = brentq(off, 1e-6, end, xtol=1e-15)
    return boundary(float(theta), delay)[1]


def passive_damping(*, K_w: float, B_w: float, T: float) -> float:
    """The robot's own damping b above which the wall is passive, by Colgate and Schenkel's condition as it stands:

    b > (T/2)/(1 − cos ωT) Re{(1 − exp(−iωT)) H(exp(iωT))},  H = K_w + B_w (1 − 1/z)/T,  over 0 < ω ≤ π/T.
    """
    z: NDArray[np.complex128] = np.exp(1j * np.linspace(1e-3, np.pi, 20_001))
    H = K_w + B_w * (1.0 - 1.0 / z) / T
    return float(np.max(0.5 * T / (1.0 - z.real) * ((1.0 - 1.0 / z) * H).real))


def growth(*, zeta: float, beta: float, delay: int) -> float:
    """Largest |z| of the characteristic equation."""
    left = np.polymul(np.eye(1, delay + 2)[0], [1.0, -2.0, 1.0])
    return float(np.max(np.abs(np.roots(np.polyadd(left, 0.5 * np.polymul([1.0, 1.0], [zeta + beta, -beta]))))))
