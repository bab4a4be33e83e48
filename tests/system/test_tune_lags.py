"""`exo tune` counts the phase of low passes, drive and friction: written down a second time, by Jury, on the FMUs."""

import math
from collections.abc import Mapping
from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import brentq

from exo import scenario as scenarios
from exo import theory
from exo.fmu import Archive
from exo.master import plan, simulate
from exo.metrics.growth import growth_rate
from exo.theory import Hand, Loop
from exo.tuning import nyquist, region
from exo.tuning.machine import Gains, Machine

WALL = Gains(M_n=1e9, D_n=1.0, K=1.0, K_P=1e-6)
LAGGED = Loop(
    M=6.0,
    M_n=2.0,
    D_n=3.0,
    K=300.0,
    K_P=10.0,
    alpha=1.0,
    T=0.002,
    substep=8e-5,
    b=-4.0,
    dq_cutoff=30.0,
    f_cutoff=20.0,
    drive_cutoff=60.0,
)


def test_the_matrix_with_all_lags_is_the_tick_written_down_a_second_time() -> None:
    loop, hand = LAGGED, Hand(k_h=40.0, b_h=3.0)
    matrix = theory.closed_loop(loop=loop, hand=hand)
    T, dt = loop.T, loop.T / 25
    q, dq, q_before, q_n, v_n, smooth, force, tau = 0.3, -0.2, 0.29, 0.35, 0.1, 0.4, -1.0, 2.0
    state = np.array([q, dq, q - q_before, q_n - q, v_n, smooth, force, tau])
    for _ in range(20):
        f_h = -40.0 * q - 3.0 * dq
        # Each low pass: x⁺ = x + (1 − exp(−2π f T)) (u − x), and the law uses x⁺.
        smooth += (1.0 - math.exp(-2.0 * math.pi * 30.0 * T)) * ((q - q_before) / T - smooth)
        force += (1.0 - math.exp(-2.0 * math.pi * 20.0 * T)) * (f_h - force)
        lead = 1.0 + 10.0 * T / 2.0
        v_m = (2.0 * 2.0 / T * v_n + force + lead * smooth - 10.0 * (q_n - q)) / (2.0 * 2.0 / T + 3.0 + lead)
        tau_a = 300.0 * (lead * (v_m - smooth) + 10.0 * (q_n - q))
        q_before, q_n, v_n = q, q_n + T * v_m, 2.0 * v_m - v_n
        for _ in range(25):
            tau = tau_a + (tau - tau_a) * math.exp(-2.0 * math.pi * 60.0 * dt)
            dq = (6.0 * dq + dt * (tau + f_h)) / (6.0 - 4.0 * dt)
            q += dt * dq
        state = matrix @ state
        assert state == pytest.approx([q, dq, q - q_before, q_n - q, v_n, smooth, force, tau], rel=1e-11, abs=1e-12)


def test_many_substeps_come_near_the_exact_lag_and_friction() -> None:
    coarse, fine, exact = (
        theory.growth_rate(loop=replace(LAGGED, substep=substep), hand=Hand(k_h=40.0)) for substep in (8e-5, 2e-5, 0.0)
    )
    assert coarse - exact == pytest.approx(4.0 * (fine - exact), rel=0.02)  # first order in the substep
    assert coarse != exact


@pytest.mark.parametrize("cutoff", [1.0, 30.0, 200.0])
def test_without_delay_a_low_pass_on_the_velocity_leaves_a_pure_damper_its_limit(cutoff: float) -> None:
    # (z − 1)(z − 1 + w) + β w (z + 1)/2 = 0, w the low pass' share: by Jury β = K T/M < 2, whatever w is.
    machine = Machine(T=0.002, M_min=6.0, M_max=6.0, dq_cutoff=cutoff)
    interval = region.gain_interval(machine=machine, gains=WALL, M=6.0)
    assert interval is not None
    assert interval.high * 0.002 / 6.0 == pytest.approx(2.0, rel=1e-4)


@pytest.mark.parametrize("cutoff", [5.0, 30.0, 200.0])
def test_with_a_sample_of_delay_the_limit_is_jury_s(cutoff: float) -> None:
    # z (z − 1)(z − 1 + w) + β w (z + 1)/2: of z³ + a z² + b z + c the bound is c² − 1 = c a − b for c < 1.
    w = 1.0 - math.exp(-2.0 * math.pi * cutoff * 0.002)

    def margin(beta: float) -> float:
        a, b, c = w - 2.0, 1.0 - w + beta * w / 2.0, beta * w / 2.0
        return (1.0 - c**2) - (b - c * a)

    limit = brentq(margin, 1e-9, min(2.0 / w, 2.0))
    machine = Machine(T=0.002, delay=1, M_min=6.0, M_max=6.0, dq_cutoff=cutoff)
    interval = region.gain_interval(machine=machine, gains=WALL, M=6.0)
    assert interval is not None
    assert interval.high * 0.002 / 6.0 == pytest.approx(limit, rel=1e-4)
    assert limit < 0.82  # the low pass takes something: without it 0.83


def lagged_loop(random: np.random.Generator) -> tuple[Loop, Hand, int]:
    """A loop over some decades with some of the lags, its hand up to 150 samples late."""
    T, M = 10.0 ** random.uniform(-4.0, -2.0), 10.0 ** random.uniform(0.0, 2.0)
    dq_cutoff, f_cutoff, drive_cutoff = random.integers(0, 2, 3) * 10.0 ** random.uniform(-2.5, -0.3, 3) / T
    loop = Loop(
        M=M,
        M_n=M * 10.0 ** random.uniform(-2.0, 1.0),
        D_n=M * 10.0 ** random.uniform(-2.0, 1.5),
        K=M / T * 10.0 ** random.uniform(-4.0, 0.5),
        K_P=10.0 ** random.uniform(-0.5, 2.0),
        alpha=float(random.choice([0.0, 1.0])),
        T=T,
        substep=float(random.choice([0.0, T / 10.0])),
        b=float(random.choice([0.0, M]) * random.uniform(-3.0, 5.0)),
        dq_cutoff=float(dq_cutoff),
        f_cutoff=float(f_cutoff),
        drive_cutoff=float(drive_cutoff),
    )
    k_h = float(random.choice([0.0, 1.0]) * M * 10.0 ** random.uniform(-1.0, 4.0))
    hand = Hand(k_h=k_h, b_h=10.0 ** random.uniform(-1.0, 2.0), delay=float(random.uniform(1.0, 150.0)) * T)
    return loop, hand, int(random.integers(0, 2))


@pytest.mark.parametrize("seed", range(40))
def test_nyquist_counts_with_lags_what_the_matrix_has(seed: int) -> None:
    loop, hand, delay = lagged_loop(np.random.default_rng(seed))
    eigenvalues = np.abs(np.linalg.eigvals(theory.closed_loop(loop=loop, hand=hand, delay=delay)))
    late = nyquist.Late.of(loop=loop, hand=hand, delay=delay)
    for size in (1.0 + region.ON_THE_CIRCLE, 1.0001, 1.02, math.exp(-0.5 / late.m)):
        assert late.growing(size=size) == (eigenvalues > size).sum()
    assert late.growth() == pytest.approx(math.log(eigenvalues.max()), abs=1e-8)


def test_the_delay_margin_with_lags_is_where_later_forces_begin_to_grow() -> None:
    machine = Machine(
        T=0.001,
        M_min=20.0,
        M_max=20.0,
        k_h=300.0,
        b_h=25.0,
        dq_cutoff=60.0,
        f_cutoff=30.0,
        drive_cutoff=100.0,
    )
    gains = Gains(M_n=10.0, D_n=40.0, K=2000.0, K_P=20.0)
    margin = region.delay_margin(machine=machine, gains=gains, M=20.0) / machine.T
    without = replace(machine, dq_cutoff=0.0, f_cutoff=0.0, drive_cutoff=0.0)
    assert 1.0 < margin < region.delay_margin(machine=without, gains=gains, M=20.0) / machine.T - 3.0
    at = theory.Loop(
        M=20.0,
        M_n=10.0,
        D_n=40.0,
        K=2000.0,
        K_P=20.0,
        alpha=1.0,
        T=0.001,
        substep=0.0,
        dq_cutoff=60.0,
        f_cutoff=30.0,
        drive_cutoff=100.0,
    )
    last, first = (
        theory.growth_rate(loop=at, hand=machine.hand, delay=n) for n in (math.floor(margin), math.ceil(margin))
    )
    assert last < 0.0 < first


@pytest.mark.parametrize(
    "lags",
    [
        {"controller.dp_cutoff": 5.0},
        {"controller.ft.cutoff": 5.0},
        {"plant.drive.cutoff": 20.0},
        {"controller.dp_cutoff": 20.0, "controller.ft.cutoff": 20.0, "plant.drive.cutoff": 20.0},
    ],
)
def test_the_fmus_swing_grows_as_the_loop_with_its_lags_does(
    lags: dict[str, float], archives: Mapping[str, Archive]
) -> None:
    # The paper's gains on the arm without friction and gravity, in a hand of 1000 N/m: the swing grows over 1 to 3 s.
    data = scenarios.load("arm_presets")
    (case,) = [one for one in data.cases if one.id == "paper_ideal"]
    # A push so small that the swing stays within a millimetre: the arm's axes are coupled by its motion, too.
    whole = plan(scenario=data, case=case, overrides={**lags, "operator.segment[1].amplitude": 1e-6})
    run = simulate(plan=replace(whole, duration=3.0), archives=archives)
    found = growth_rate(run, column="plant.p[1]", after=1.0, before=3.0)
    paper = Loop(M=99.93, M_n=5.0, D_n=20.0, K=1000.0, K_P=20.0, alpha=1.0, T=0.001, substep=1e-4)
    cutoffs = {
        "dq_cutoff": "controller.dp_cutoff",
        "f_cutoff": "controller.ft.cutoff",
        "drive_cutoff": "plant.drive.cutoff",
    }
    lagged = replace(paper, **{name: lags.get(key, 0.0) for name, key in cutoffs.items()})
    expected = theory.growth_rate(loop=lagged, hand=Hand(k_h=1000.0))
    assert found == pytest.approx(expected, abs=1e-3)  # the axes are coupled by 1.4 kg of 100 kg, which is left out
    assert abs(expected - theory.growth_rate(loop=paper, hand=Hand(k_h=1000.0))) > 0.1


@pytest.mark.parametrize(
    ("lag", "of_the_loop"),
    [
        ({"dq_cutoff": 5.0}, {"dq_cutoff": 5.0}),
        ({"f_cutoff": 5.0}, {"f_cutoff": 5.0}),
        ({"drive_cutoff": 5.0}, {"drive_cutoff": 5.0}),
        ({"slope": -200.0}, {"b": -200.0}),
    ],
)
@pytest.mark.parametrize("hand_delay", [0.0, 0.05])
def test_each_lag_of_the_machine_is_in_the_loop_that_is_judged(
    lag: dict[str, float], of_the_loop: dict[str, float], hand_delay: float
) -> None:
    # 50 ms are 50 samples: there Nyquist's count judges, and here the matrix.
    machine = Machine(T=0.001, M_min=20.0, M_max=20.0, k_h=300.0, b_h=25.0, hand_delay=hand_delay, **lag)
    gains = Gains(M_n=10.0, D_n=40.0, K=2000.0, K_P=20.0)
    plain = Loop(M=20.0, M_n=10.0, D_n=40.0, K=2000.0, K_P=20.0, alpha=1.0, T=0.001, substep=0.0)
    expected = theory.growth_rate(loop=replace(plain, **of_the_loop), hand=machine.hand)
    assert region.growth(machine=machine, gains=gains, M=20.0) == pytest.approx(expected, abs=1e-5)
    assert abs(expected - theory.growth_rate(loop=plain, hand=machine.hand)) > 1e-3
