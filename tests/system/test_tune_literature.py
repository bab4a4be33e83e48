"""`exo tune` against the literature's closed boundaries: a sampled wall, and an admittance under a velocity loop.

With a nominal that does not move (M_n → ∞) the law is a sampled wall: y = −dq + K_P (e − T dq/2) makes
B_w = K (1 + K_P T/2) and K_w = K K_P.
"""

from dataclasses import replace

import numpy as np
import pytest

from exo import theory
from exo.theory import Hand, Loop
from exo.tuning import region
from exo.tuning.machine import Gains, Machine, loop
from oracles import sampled_wall

M, T = 6.0, 0.002


@pytest.mark.parametrize("delay", [0, 1])
@pytest.mark.parametrize("K_P", [1.0, 10.0, 100.0, 300.0])
def test_the_largest_gain_is_where_the_sampled_wall_of_the_literature_ends(K_P: float, delay: int) -> None:
    machine = Machine(T=T, delay=delay, M_min=M, M_max=M)
    interval = region.gain_interval(machine=machine, gains=Gains(M_n=1e9, D_n=1.0, K=1.0, K_P=K_P), M=M)
    assert interval is not None
    share = 1.0 + K_P * T / 2.0
    beta = sampled_wall.largest_gain(ratio=K_P * T / share, delay=delay)
    # `region.edge` halves to 1e-6; a nominal of 1e9 kg moves by 1e-8 of the robot.
    assert interval.high == pytest.approx(beta * M / T / share, rel=3e-6)


def test_without_delay_the_boundary_is_a_rational_function() -> None:
    # Jury's criterion by hand: ζ < 2 β (2 − β)/(2 + β). Small gains: K_w T/2 < B_w.
    for theta in (0.01, 0.5, 1.5):
        zeta, beta = sampled_wall.boundary(theta, 0)
        assert zeta == pytest.approx(2.0 * beta * (2.0 - beta) / (2.0 + beta), rel=1e-12)
    for delay in (0, 1, 5):
        zeta, beta = sampled_wall.boundary(1e-4, delay)
        assert beta / zeta == pytest.approx(0.5 + delay, rel=1e-6)  # Hulin: K_w (T/2 + t_d) < B_w


@pytest.mark.parametrize("delay", [0, 1, 3])
def test_the_oracle_s_boundary_is_where_its_own_roots_leave_the_unit_circle(delay: int) -> None:
    for theta in (0.05, 0.2, 0.35):
        zeta, beta = sampled_wall.boundary(theta, delay)
        assert sampled_wall.growth(zeta=zeta, beta=beta, delay=delay) == pytest.approx(1.0, abs=1e-9)
        assert sampled_wall.growth(zeta=1.02 * zeta, beta=beta, delay=delay) > 1.0 + 1e-6
        assert sampled_wall.growth(zeta=0.98 * zeta, beta=beta, delay=delay) < 1.0


def test_the_law_s_matrix_has_the_wall_s_characteristic_roots() -> None:
    # The growth itself, not only where it is 0: on either side of the boundary.
    for K, K_P, delay in ((2000.0, 50.0, 0), (7000.0, 10.0, 0), (1500.0, 300.0, 1), (3000.0, 20.0, 1)):
        machine = Machine(T=T, delay=delay, M_min=M, M_max=M)
        at = loop(machine=machine, gains=Gains(M_n=1e9, D_n=1.0, K=K, K_P=K_P), M=M)
        matrix = theory.closed_loop(loop=at, delay=delay)
        # The one nearest to 1 is the velocity of the nominal, which nothing changes.
        eigenvalues = sorted(np.linalg.eigvals(matrix), key=lambda z: abs(z - 1.0))
        rest = max(abs(z) for z in eigenvalues[1:])
        wall = sampled_wall.growth(zeta=K * K_P * T**2 / M, beta=K * (1.0 + K_P * T / 2.0) * T / M, delay=delay)
        assert rest == pytest.approx(wall, abs=1e-6)


def test_colgate_and_schenkel_s_condition_is_half_a_sample_of_the_stiffness_and_the_damping_itself() -> None:
    for K_w, B_w in ((1000.0, 0.0), (1000.0, 3.0), (0.0, 5.0)):
        assert sampled_wall.passive_damping(K_w=K_w, B_w=B_w, T=T) == pytest.approx(K_w * T / 2.0 + B_w, rel=1e-5)


@pytest.mark.parametrize("k_h", [1.0, 30.0, 1000.0])
def test_without_friction_a_spring_at_the_handle_grows_on_any_nominal_lighter_than_the_robot(k_h: float) -> None:
    # Keemink et al. with b = 0: M_n (b + K) > M K is M_n > M, whatever K and k_h are.
    robot = Loop(M=10.0, M_n=2.0, D_n=0.0, K=30.0, K_P=1e-9, alpha=0.0, T=1e-5, substep=0.0)
    for M_n, grows in ((2.0, True), (9.0, True), (11.0, False), (20.0, False)):
        rate = theory.growth_rate(loop=replace(robot, M_n=M_n), hand=Hand(k_h=k_h))
        # K_P → 0 leaves a mode that neither grows nor decays, e at rest: rounding over T = 1e-5 s.
        assert (rate > 1e-4) == grows, (M_n, rate)
