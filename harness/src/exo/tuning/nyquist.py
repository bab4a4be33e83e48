"""Stability of the loop whose hand acts many samples late, by Nyquist's count instead of a matrix of all samples.

The characteristic polynomial of `theory.closed_loop` in w = z − 1, the hand acting m + 1 or, for the share `early`, m
samples late, is

    z^(m+1) D(w) + R(w),  R = (early z + 1 − early) N

and its size grows with m while D and N keep theirs. So how many roots lie outside of a circle is counted on the circle:
where |R| = |D| is a polynomial of the size of D, and between those places the phase turns as that of the larger one
does, which is a sum over its roots. The work does not depend on m.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.polynomial import polynomial
from numpy.typing import NDArray

from exo import theory
from exo.theory import Array, Hand, Loop

Complex = NDArray[np.complex128]
#: The count is a whole number but for rounding. A root on the circle counts half, and is taken as outside.
ROUNDING = 0.1
#: Newton's steps; where the nearest start to ln z = 0 lies, over 1/m; starts a decade of distance, and directions.
STEPS, NEAREST, A_DECADE, DIRECTIONS = 40, 1e-2, 16, 24
#: No root lies beyond: |ln|z||.
FARTHEST = 40.0
#: Where the search for the largest root begins, ln|z|.
ON_THE_WAY = 1e-9


def times(*factors: object) -> Array:
    """The product of polynomials, lowest power first."""
    product = np.ones(1)
    for factor in factors:
        product = np.convolve(product, np.atleast_1d(np.asarray(factor, dtype=np.float64)))
    return product


def plus(a: Array, b: Array) -> Array:
    """The sum of two polynomials."""
    total = np.zeros(max(len(a), len(b)))
    total[: len(a)] += a
    total[: len(b)] += b
    return total


@dataclass(frozen=True, kw_only=True)
class Parts:
    """The loop as polynomials in w = z − 1, lowest power first. Without low passes, lag and friction all coefficients
    are sums of what is not negative.

    S: the nominal. G_1: K_P and c of what is sensed, G_2: of the nominal. I_1: what the nominal resists with. seen,
    felt: what the low passes on velocity and force divide by; share: what the one on force multiplies with. Of the
    robot: poles, and w times that is what all of its answers divide by; q_u, v_u: place over T²/M and velocity over T/M
    for a force asked of the drive; q_f, v_f: for a force on the mass; minor: v_f q_u − v_u q_f over w times `poles`.
    """

    S: Array
    G_1: Array
    G_2: Array
    I_1: Array
    seen: Array
    felt: Array
    share: Array
    poles: Array
    q_u: Array
    v_u: Array
    q_f: Array
    v_f: Array
    minor: Array

    @classmethod
    def of(cls, *, loop: Loop) -> "Parts":
        """From the equations of `theory.opened`, each with z − 1 or (z + 1)/2 in place of its difference or mean."""
        T, c = loop.T, 1.0 + loop.K_P * loop.T / 2.0
        inertia, coupling = 2.0 * loop.M_n / T, loop.K_P * T
        seen, felt = (theory.weight(cutoff=f, T=T) for f in (loop.dq_cutoff, loop.f_cutoff))
        damping = loop.D_n + loop.alpha * c
        return cls(
            S=np.array(
                [2.0 * loop.alpha * coupling, 2.0 * damping + loop.alpha * coupling, inertia + damping],
            ),
            G_1=np.array([coupling * seen, c * seen + coupling]),
            G_2=np.array([coupling, c]),
            I_1=np.array([2.0 * loop.D_n, inertia + loop.D_n]),
            seen=np.array([seen, 1.0]),
            # Without a low pass force = force, and not z force = z force.
            felt=np.array([felt, 1.0]) if felt < 1.0 else np.ones(1),
            share=np.array([felt, felt]) if felt < 1.0 else np.ones(1),
            **_robot(loop),
        )

    def hand(self, *, hand: Hand, T: float) -> tuple[Array, Array]:
        """M times the hand's force for a force asked of the drive, and for one on the mass, both over w times
        `poles`."""
        return tuple(  # type: ignore[return-value]
            plus(hand.k_h * T**2 * q, hand.b_h * T * v) for q, v in ((self.q_u, self.v_u), (self.q_f, self.v_f))
        )


def _robot(loop: Loop) -> dict[str, Array]:
    """The robot's part of `Parts`: its map is triangular in (q, v, τ)."""
    T, M = loop.T, loop.M
    if not (loop.b or loop.drive_cutoff):
        n = theory.substeps(T=T, substep=loop.substep) if loop.substep > 0.0 else np.inf
        travel, faster = np.array([1.0, 0.5 * (1.0 + 1.0 / n)]), np.array([0.0, 1.0])
        return {"poles": faster, "q_u": travel, "v_u": faster, "q_f": travel, "v_f": faster, "minor": np.zeros(1)}
    scale = np.array([M / T**2, M / T, 1.0])
    own, asked, pushed = theory.robot(loop=loop)
    own, asked, pushed = own * scale[:, None] / scale, asked * scale, pushed * scale
    beta, kappa = np.array([1.0 - own[1, 1], 1.0]), np.array([1.0 - own[2, 2], 1.0])
    if not loop.drive_cutoff:  # the same force, whoever exerts it
        q, v = plus(own[0, 1] * pushed[1:2], pushed[0] * beta), np.array([0.0, pushed[1]])
        return {"poles": beta, "q_u": q, "v_u": v, "q_f": q, "v_f": v, "minor": np.zeros(1)}
    faster, further = (plus(own[i, 2] * asked[2:], asked[i] * kappa) for i in (1, 0))
    return {
        "poles": times(beta, kappa),
        "q_u": plus(own[0, 1] * faster, times(beta, further)),
        "v_u": times([0.0, 1.0], faster),
        "q_f": times(plus(own[0, 1] * pushed[1:2], pushed[0] * beta), kappa),
        "v_f": times([0.0, pushed[1]], kappa),
        "minor": plus(pushed[1] * further, -pushed[0] * faster),
    }


@dataclass(frozen=True, kw_only=True)
class Late:
    """z^m D(w) + R(w), w = z − 1: the characteristic polynomial; R is shorter than or as long as D."""

    m: int
    D: Array
    R: Array

    @classmethod
    def of(cls, *, loop: Loop, hand: Hand, delay: int) -> "Late":
        """The loop of `theory.closed_loop`."""
        parts, z = Parts.of(loop=loop), [1.0, 1.0]
        under_way = times(*[z] * delay)
        asked, pushed = parts.hand(hand=hand, T=loop.T)
        nominal = times(under_way, parts.S, parts.seen)
        D = plus(
            times(loop.M, nominal, parts.poles),
            times(loop.K * loop.T, parts.I_1, parts.G_1, parts.q_u),
        )
        D = times(D, parts.felt)
        lag = times(loop.K * hand.b_h * loop.T**2 / loop.M, [0.0, 1.0], parts.I_1, parts.G_1, parts.minor)
        N = plus(
            times(parts.felt, plus(times(nominal, pushed), lag)),
            times(loop.K, parts.share, asked, parts.seen, [2.0, 1.0], parts.G_2),
        )
        if hand.k_h:
            D = times([0.0, 1.0], D)
        else:
            N = N[1:]  # nothing depends on q: a root w = 0 of both is left out, as in `closed_loop`
        m, share = samples(delay=hand.delay, T=loop.T)
        if share:
            m, N = m + 1, times([1.0, 1.0 - share], N)
        return cls(m=m, D=D, R=np.pad(N, (0, len(D) - len(N))))

    def growing(self, *, size: float) -> int:
        """How many roots have |z| > `size`.

        On the circle z = size (1 + i x)/(1 − i x), x from 0 to ∞ being its upper half, D and R become polynomials D̃
        and R̃ of degree n in u = i x over (1 − u)^n, and the roots outside number n/2 − Δarg(D̃ + z⁻ᵐ R̃)/π.
        """
        D, R = (on_the_circle(p, size=size) for p in (self.D, self.R * size**-self.m))
        places = np.array([0.0, *crossings(D, R), np.inf])
        turned_D, turned_R = (turned(p, places) for p in (D, R))
        turned_R = turned_R - 2.0 * self.m * np.arctan(places)
        middle = between(places)
        larger = np.abs(polynomial.polyval(1j * middle, D)) >= np.abs(polynomial.polyval(1j * middle, R))
        # arg(D̃ + z⁻ᵐ R̃) = arg of the larger + arg(1 + smaller/larger), which stays within a quarter turn.
        rest = turned_R - turned_D
        ahead = np.angle(1.0 + np.exp(1j * rest))
        ahead[[0, -1]] = 0.0  # real there
        turn = np.where(larger, np.diff(turned_D) + np.diff(ahead), np.diff(turned_R) - np.diff(ahead)).sum()
        return math.ceil((len(D) - 1) / 2.0 - float(turn) / math.pi - ROUNDING)

    def growth(self) -> float:
        """ln|z| of the largest root, by halves."""
        # A hand that is felt at all leaves a root near |R/D|^(1/m): below exp(−300/m) there is no largest one.
        low, high = -300.0 / self.m, ON_THE_WAY
        while self.growing(size=math.exp(high)):
            low, high = high, 2.0 * high
        while high - low > 1e-12 + 1e-9 * abs(high):
            middle = 0.5 * (low + high)
            low, high = (middle, high) if self.growing(size=math.exp(middle)) else (low, middle)
        return 0.5 * (low + high)

    def roots(self) -> Complex:
        """ln z of the roots with an angle from 0 to π, in no order and some of them more than once.

        Newton's steps from where roots are: one in each 2π/m of the circle, about where z^m = −R/D, and from all over
        the upper half plane of ln z for those that the loop has besides.
        """
        angle = np.linspace(0.0, math.pi, 2 * self.m + 1)  # the phase of −R/D is not known beforehand: two in each
        chain: Complex = np.asarray(1j * angle, dtype=np.complex128)
        for _ in range(3):
            chain = self._next_in_chain(chain, angle)
        chain = np.append(chain, chain[-1].real + 1j * math.pi)  # a swing from tick to tick
        size = np.geomspace(NEAREST / self.m, math.pi, int(A_DECADE * math.log10(math.pi * self.m / NEAREST)))
        direction = np.exp(1j * math.pi * (np.arange(DIRECTIONS) + 0.5) / DIRECTIONS)
        everywhere = np.outer(size, direction).ravel()
        return self._newton(np.concatenate([chain, everywhere]))

    def _next_in_chain(self, s: Complex, angle: Array) -> Complex:
        """s with m s = ln(−R/D) on the branch nearest to `angle`."""
        w = np.expm1(s)
        with np.errstate(divide="ignore", invalid="ignore"):
            new = np.log(polynomial.polyval(w, self.R) / polynomial.polyval(w, self.D)) / self.m + 1j * angle
        return np.asarray(np.where(np.isfinite(new), new, s), dtype=np.complex128)

    def _newton(self, s: Complex) -> Complex:
        """Where Newton's steps for f(s) = D + exp(−m s) R, or exp(m s) D + R where that is less, come to rest."""
        d_D, d_R = polynomial.polyder(self.D), polynomial.polyder(self.R)
        step: Complex = np.full(s.shape, np.inf, dtype=np.complex128)
        with np.errstate(all="ignore"):
            for _ in range(STEPS):
                z, w = np.exp(s), np.expm1(s)
                D, R = polynomial.polyval(w, self.D), polynomial.polyval(w, self.R)
                slope_D, slope_R = z * polynomial.polyval(w, d_D), z * polynomial.polyval(w, d_R)
                inside = s.real < 0.0
                late = np.exp(np.where(inside, self.m * s, -self.m * s))
                value = np.where(inside, late * D + R, D + late * R)
                slope = np.where(
                    inside, late * (slope_D + self.m * D) + slope_R, slope_D + late * (slope_R - self.m * R)
                )
                step = np.asarray(value / slope, dtype=np.complex128)
                s = s - step
        s = s[(np.abs(step) <= 1e-9 * np.abs(s)) & (np.abs(s.real) < FARTHEST)]
        # One of each pair; the angle is that of a logarithm's principal value.
        s = np.log(np.exp(s))
        return np.asarray(s.real + 1j * np.abs(s.imag), dtype=np.complex128)


def samples(*, delay: float, T: float) -> tuple[int, float]:
    """A delay (s) as whole samples and the share of one more."""
    late = delay / T
    whole = math.floor(late + 1e-9)
    return whole, late - whole if late - whole > 1e-9 else 0.0


def on_the_circle(p: Array, *, size: float) -> Array:
    """(1 − u)^n p(w), w = z − 1, z = `size` (1 + u)/(1 − u), n the degree of `p`: in u, lowest power first."""
    n = len(p) - 1
    rising, falling = np.array([size - 1.0, size + 1.0]), np.array([1.0, -1.0])
    total = np.zeros(n + 1)
    for k, coefficient in enumerate(p):
        total += coefficient * times(*[rising] * k, *[falling] * (n - k))
    return total


def crossings(D: Array, R: Array) -> Array:
    """The x > 0, rising, at which |D(i x)| = |R(i x)|."""
    difference = np.trim_zeros(squared(D) - squared(R), "b")
    y = polynomial.polyroots(difference) if len(difference) > 1 else np.zeros(0)
    real = y[(y.real > 0.0) & (np.abs(y.imag) <= 1e-6 * np.abs(y))].real
    return np.sqrt(np.sort(real))


def squared(p: Array) -> Array:
    """|p(i x)|² as a polynomial in x²."""
    mirrored = p * (-1.0) ** np.arange(len(p))
    in_u_squared = times(p, mirrored)[0::2]
    return in_u_squared * (-1.0) ** np.arange(len(p))  # u² = −x²


def turned(p: Array, x: Array) -> Array:
    """arg p(i x) without a jump in x, up to a multiple of 2π: the angles under which its roots see i x, summed."""
    roots = polynomial.polyroots(np.trim_zeros(p, "b")) if p.any() else np.zeros(0)
    right = roots.real > 0.0
    angle = np.arctan2(x[:, None] - roots.imag, np.abs(roots.real))
    total: Array = np.where(right, math.pi - angle, angle).sum(axis=1)
    lead = np.trim_zeros(p, "b")[-1:]
    return total + (math.pi if lead.size and lead[0] < 0.0 else 0.0)


def between(places: Array) -> Array:
    """A value between each two neighbours of 0, …, ∞."""
    inner = places[1:-1]
    if not len(inner):
        return np.ones(1)
    return np.concatenate([[0.5 * inner[0]], np.sqrt(inner[1:] * inner[:-1]), [2.0 * inner[-1]]])
