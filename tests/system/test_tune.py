"""The gain guide: its closed form, limits, margins and the command."""

import json
import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

from exo import theory
from exo.cli import app
from exo.errors import ExoError
from exo.theory import Hand, Loop
from exo.tuning import chart, nyquist, region
from exo.tuning.guide import at_mass, guide, recommended_gain, warning
from exo.tuning.machine import Gains, Machine, loop

TESTBED = Machine(T=0.002, M_min=6.0, M_max=6.0, substep=8e-5)
TESTBED_GAINS = Gains(M_n=5.0, D_n=0.5, K=30.0, K_P=10.0)
ARM = Machine(T=0.001, M_min=14.0, M_max=99.93, k_h=200.0, substep=1e-4)
ARM_GAINS = Gains(M_n=5.0, D_n=20.0, K=1000.0, K_P=20.0)


def test_the_matrix_is_the_tick_written_down_a_second_time() -> None:
    # sampled_tick has (q, dq, q_{k−1}, q_n, v_n) and takes the force from outside: here what the hand exerts at q, dq.
    testbed = loop(machine=TESTBED, gains=TESTBED_GAINS, M=6.0)
    hand = Hand(k_h=40.0, b_h=3.0)
    matrix = theory.closed_loop(loop=testbed, hand=hand)
    state = np.array([0.3, -0.2, 0.29, 0.35, 0.1])
    for _ in range(20):
        expected = theory.sampled_tick(loop=testbed, state=state, f_h=-40.0 * state[0] - 3.0 * state[1])
        q, dq, moved, e, v_n = matrix @ [state[0], state[1], state[0] - state[2], state[3] - state[0], state[4]]
        assert [q, dq, q - moved, q + e, v_n] == pytest.approx(expected, abs=1e-13)  # rounding of q − q_{k−1}
        state = expected


@pytest.mark.parametrize(("K_P", "delay", "share"), [(0.1, 0, 1.9998), (10.0, 0, 1.9418), (10.0, 1, 0.79844)])
def test_the_gain_ends_at_the_limit_of_the_exact_mass(K_P: float, delay: int, share: float) -> None:
    # The limit of the wholly sampled damper is K T/M = 2 without and about 0.83 with a sample of delay; K_P lowers it.
    # docs/specification.md section 1 has 1.88 to 1.95 and 0.78; fmu/admittance/tests/stability.rs finds them on the
    # law itself.
    machine = replace(TESTBED, delay=delay, substep=0.0)
    interval = region.gain_interval(machine=machine, gains=replace(TESTBED_GAINS, K_P=K_P), M=6.0)
    assert interval is not None
    assert interval.low == 0.0
    assert interval.high * machine.T / 6.0 == pytest.approx(share, rel=1e-4)  # figures printed


def test_a_hundred_substeps_come_near_the_exact_mass() -> None:
    # Backward Euler's n substeps add T²/(2 n M) of travel: 2.08 becomes 2 as 1/n.
    shares = []
    for substep in (8e-5, 2e-5, 0.0):
        machine = replace(TESTBED, substep=substep)
        interval = region.gain_interval(machine=machine, gains=TESTBED_GAINS, M=6.0)
        assert interval is not None
        shares.append(interval.high)
    assert shares[0] / shares[2] - 1.0 == pytest.approx(4.0 * (shares[1] / shares[2] - 1.0), rel=0.05)  # second order
    assert shares[0] > 1.03 * shares[2]


def test_the_hand_limit_of_the_arm_is_that_of_its_scenario() -> None:
    # docs/figures.md: 382 N/m for the paper's gains along x, 1662 N/m for four times the nominal.
    assert region.hand_limit(machine=ARM, gains=ARM_GAINS, M=99.93) == pytest.approx(381.6, abs=0.5)
    heavy = replace(ARM_GAINS, M_n=20.0, D_n=80.0)
    assert region.hand_limit(machine=ARM, gains=heavy, M=99.93) == pytest.approx(1662.0, abs=1.0)


@pytest.mark.parametrize("M_n", [0.6, 3.0])
def test_the_hand_limit_tends_to_the_first_order_form_of_the_controllers_advice(M_n: float) -> None:
    # advice.rs: k_h² (M − M_n) = K D_n (k_h + M_n K_P²), first order in 1/K: the distance falls about as 1/K.
    M, D_n, K_P = 6.0, 0.5, 10.0
    distances = []
    for K in (1e3, 1e4):
        machine = Machine(T=1e-6, M_min=M, M_max=M)
        limit = region.hand_limit(machine=machine, gains=Gains(M_n=M_n, D_n=D_n, K=K, K_P=K_P), M=M)
        first_order = max(np.roots([M - M_n, -K * D_n, -K * D_n * M_n * K_P**2]).real)
        distances.append(abs(limit / first_order - 1.0))
    assert distances[0] < 0.07
    assert distances[1] < 0.2 * distances[0]


def test_a_reflex_delay_of_whole_samples_is_a_shift_register() -> None:
    testbed = loop(machine=TESTBED, gains=TESTBED_GAINS, M=6.0)
    late = theory.closed_loop(loop=testbed, hand=Hand(k_h=20.0, b_h=1.0, delay=3 * 0.002), delay=1)
    state = np.array([0.1, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0])
    law = theory.opened(loop=testbed)
    x, felt, force = state[:5], [0.0, 0.0, 0.0], 0.0
    for _ in range(30):
        state = late @ state
        f_h, felt = felt[-1], [-20.0 * x[0] - 1.0 * x[1], *felt[:-1]]
        force, arriving = law.C @ x + law.G * f_h, force
        x = law.A @ x + law.B * arriving + law.F * f_h
        assert state[:5] == pytest.approx(x, abs=1e-15)
    assert abs(x[0] - 0.1) > 1e-4  # the hand has pulled


def test_half_a_sample_of_reflex_delay_lies_between_its_neighbours() -> None:
    testbed = loop(machine=TESTBED, gains=TESTBED_GAINS, M=6.0)
    grown = [theory.growth_rate(loop=testbed, hand=Hand(k_h=60.0, delay=m * 0.002)) for m in (10.0, 10.5, 11.0)]
    assert grown[0] < grown[1] < grown[2]
    assert grown[1] == pytest.approx(0.5 * (grown[0] + grown[2]), abs=0.01 * (grown[2] - grown[0]))  # its curvature


@pytest.mark.parametrize(("machine", "gains", "M"), [(TESTBED, TESTBED_GAINS, 6.0), (ARM, ARM_GAINS, 99.93)])
def test_the_delay_margin_is_where_later_forces_begin_to_grow(machine: Machine, gains: Gains, M: float) -> None:
    # K as large as recommended, so that the margin is a few samples; further whole samples straddle it.
    gains = replace(gains, K=0.25 * M / machine.T)
    margin = region.delay_margin(machine=machine, gains=gains, M=M) / machine.T
    assert 2.0 < margin < 40.0
    at = loop(machine=machine, gains=gains, M=M)
    last, first = (
        theory.growth_rate(loop=at, hand=machine.hand, delay=n) for n in (math.floor(margin), math.ceil(margin))
    )
    assert last < 0.0 < first


def swing_of_error(K: float, T: float) -> float:
    machine, gains = Machine(T=T, M_min=6.0, M_max=6.0), Gains(M_n=5.0, D_n=5.0, K=K, K_P=10.0)
    return region.error_per_newton(machine=machine, gains=gains, M=6.0, frequency=0.5)


def test_the_error_halves_when_the_gain_doubles_until_sampling_is_what_remains() -> None:
    # thm:pm, at a T that does not matter: e (s + K_P) = (M s v − F)/K to first order in 1/K, v = F/(M_n s + D_n).
    assert swing_of_error(1000.0, 1e-5) / swing_of_error(2000.0, 1e-5) == pytest.approx(2.0, rel=0.01)
    # dq is the mean velocity of the sample before, T behind v_m: y = 0 leaves e (s + K_P) = −T s v whatever K is.
    s, T = 1j * math.pi, 0.002
    v = 1.0 / (5.0 * s + 5.0)
    for K in (1000.0, 2000.0, 1e6):
        expected = abs(((6.0 * s * v - 1.0) / K - T * s * v) / (s + 10.0))
        assert swing_of_error(K, T) == pytest.approx(expected, rel=0.02)  # first order in 1/K and T


def test_the_error_is_that_of_a_run_of_ticks() -> None:
    gains = Gains(M_n=5.0, D_n=5.0, K=100.0, K_P=10.0)
    at = loop(machine=TESTBED, gains=gains, M=6.0)
    state, errors = np.zeros(5), []
    for k in range(10000):
        state = theory.sampled_tick(loop=at, state=state, f_h=math.sin(math.pi * k * at.T))
        errors.append(state[3] - state[0])
    # The start has died out after 15 s (M_n/D_n = 1 s): 1e-5 of it is left.
    answer = region.error_per_newton(machine=TESTBED, gains=gains, M=6.0, frequency=0.5)
    assert max(errors[7500:]) == pytest.approx(answer, rel=1e-3)


def test_the_recommended_gain_keeps_the_advised_share_and_half_of_the_limit() -> None:
    assert recommended_gain(machine=TESTBED, gains=TESTBED_GAINS) == pytest.approx(0.25 * 6.0 / 0.002)
    # With K_P T = 1 the delayed loop ends below K T/M = 0.5, and half of that is what is left.
    fast = Gains(M_n=5.0, D_n=0.5, K=30.0, K_P=500.0)
    delayed = replace(TESTBED, delay=1)
    limit = region.gain_interval(machine=delayed, gains=fast, M=6.0)
    assert limit is not None
    assert limit.high * 0.002 / 6.0 < 0.5
    assert recommended_gain(machine=delayed, gains=fast) == pytest.approx(limit.high / 2.0)


def test_the_smallest_nominal_holds_twice_the_hand_and_a_lighter_one_does_not() -> None:
    answer = guide(machine=ARM, gains=ARM_GAINS, frequency=0.4)
    assert answer.stable
    assert answer.M_n_smallest is not None
    assert answer.D_n_smallest is not None
    for name, value in (("M_n", answer.M_n_smallest), ("D_n", answer.D_n_smallest)):
        limits = [
            region.hand_limit(machine=ARM, gains=replace(ARM_GAINS, **{name: factor * value}), M=ARM.M_max)
            for factor in (0.99, 1.01)
        ]
        assert limits[0] < 2.0 * ARM.k_h < limits[1]
    assert answer.k_h_limit == pytest.approx(381.6, abs=0.5)
    assert answer.lowering_margin > 1.0


def test_the_warning_is_that_of_the_controllers() -> None:
    codes = [
        warning(machine=TESTBED, gains=replace(TESTBED_GAINS, K=K, M_n=M_n))
        for M_n in (5.0, 0.1)
        for K in (30.0, 760.0)
    ]
    assert codes == [0, 1, 2, 3]


def test_an_unstable_loop_has_a_negative_time_constant_and_no_delay_margin() -> None:
    at = at_mass(machine=replace(ARM, k_h=500.0), gains=ARM_GAINS, M=99.93, frequency=0.4)
    assert not at.stable
    assert at.slowest < 0.0
    assert at.slowest == pytest.approx(-1.0 / at.growth)
    assert at.delay_margin is None


@pytest.mark.parametrize(
    ("changes", "text"),
    [
        ({"T": 0.0}, "T = 0: expected a finite value, at least 1e-06"),
        ({"M_min": 9e-7}, "M_min = 9e-07: expected a finite value, at least 1e-06"),
        ({"M_max": 1e300}, "M_max = 1e[+]300: expected at most 1e[+]12"),
        ({"M_min": math.nan}, "M_min = nan"),
        ({"k_h": -1.0}, "k_h = -1: expected a finite value, at least 0"),
        ({"M_max": 5.0}, "M_max = 5: expected at least M_min = 6"),
        ({"delay": 2}, "delay = 2: expected 0 or 1"),
        ({"hand_delay": 1.5}, "hand_delay = 1.5: expected at most 1 s"),
    ],
)
def test_a_machine_that_cannot_be_is_refused_by_name(changes: dict[str, float], text: str) -> None:
    with pytest.raises(ExoError, match=text):
        replace(TESTBED, **changes)


def test_the_command_writes_numbers_and_map_and_fails_on_unstable_gains(tmp_path: Path) -> None:
    testbed = ["tune", "--T", "0.002", "--M-min", "6", "--M-max", "6", "--k-h", "20", "--M-n", "1", "--D-n", "2"]
    good = CliRunner().invoke(app, [*testbed, "--K", "60", "--substep", "8e-5", "--out", str(tmp_path)])
    assert good.exit_code == 0, good.output
    assert "recommended K" in good.output
    assert good.output.startswith(
        "stable: nothing grows at M = 6 kg. K = 60 N·s/m may rise by a factor of 101 and fall by"
    )
    numbers = json.loads((tmp_path / "tune.json").read_text(encoding="utf-8"))
    assert numbers["stable"] is True
    assert numbers["masses"][0]["KT_over_M_limit"] == pytest.approx(2.0243, abs=1e-4)
    assert numbers["gain_warning"] == 0
    assert (tmp_path / "tune.png").read_bytes().startswith(b"\x89PNG")
    bad = CliRunner().invoke(app, [*testbed, "--K", "20", "--out", str(tmp_path)])
    assert bad.exit_code == 1
    interval = json.loads((tmp_path / "tune.json").read_text(encoding="utf-8"))["stable_gains"]
    held = Loop(M=6.0, M_n=1.0, D_n=2.0, K=0.0, K_P=10.0, alpha=1.0, T=0.002, substep=0.0)
    below, above = (
        theory.growth_rate(loop=replace(held, K=factor * interval["low"]), hand=Hand(k_h=20.0))
        for factor in (0.999, 1.001)
    )
    assert above < 0.0 < below
    assert bad.output.startswith("unstable: something grows by")
    assert "K = 20 N·s/m; stable from 20.2 to 5830 N·s/m at every mass" in bad.output.split("\n")[0]
    assert json.loads((tmp_path / "tune.json").read_text(encoding="utf-8"))["stable"] is False
    refused = CliRunner().invoke(app, [*testbed, "--K", "-1", "--out", str(tmp_path)])
    assert refused.exit_code == 2
    assert "K = -1: expected a finite value, at least 1e-06" in refused.stderr
    refused = CliRunner().invoke(app, [*testbed, "--frequency", "300", "--out", str(tmp_path)])
    assert refused.exit_code == 2
    assert "frequency = 300: expected at most 250" in refused.stderr


def test_the_closed_form_without_a_spring_leaves_the_place_out() -> None:
    free = Loop(M=6.0, M_n=5.0, D_n=0.5, K=30.0, K_P=10.0, alpha=1.0, T=0.002, substep=8e-5)
    assert theory.closed_loop(loop=free).shape == (4, 4)
    # The nominal coasts with D_n/(M_n + (the 6 kg behind it)/K): slower than D_n/M_n alone would have it.
    assert -0.1 < theory.growth_rate(loop=free) < -0.05


def any_loop(random: np.random.Generator) -> tuple[Loop, Hand, int]:
    """A loop over some decades of everything, its hand up to 150 samples late, in whole samples or between them."""
    T, M = 10.0 ** random.uniform(-4.0, -2.0), 10.0 ** random.uniform(0.0, 2.0)
    at = Loop(
        M=M,
        M_n=M * 10.0 ** random.uniform(-2.0, 1.0),
        D_n=M * 10.0 ** random.uniform(-2.0, 1.5),
        K=M / T * 10.0 ** random.uniform(-4.0, 0.5),
        K_P=10.0 ** random.uniform(-0.5, 2.0),
        alpha=float(random.choice([0.0, 1.0, 10.0])),
        T=T,
        substep=float(random.choice([0.0, T / 10.0])),
    )
    k_h, b_h = random.choice([0.0, 1.0], 2) * [M * 10.0 ** random.uniform(-1.0, 4.0), 10.0 ** random.uniform(-1.0, 2.0)]
    late = float(random.choice([np.floor(random.uniform(1.0, 150.0)), random.uniform(1.0, 150.0)]))
    return at, Hand(k_h=float(k_h or not b_h), b_h=float(b_h), delay=late * T), int(random.integers(0, 2))


def least_damping(s: np.ndarray) -> float | None:
    swinging = s[np.abs(s.imag) > 1e-6 * np.abs(s)]
    return float(np.min(-swinging.real / np.abs(swinging))) if len(swinging) else None


@pytest.mark.parametrize("seed", range(100))
def test_nyquist_counts_and_finds_what_the_eigenvalues_of_the_matrix_are(seed: int) -> None:
    at, hand, delay = any_loop(np.random.default_rng(seed))
    eigenvalues = np.linalg.eigvals(theory.closed_loop(loop=at, hand=hand, delay=delay)).astype(complex)
    late = nyquist.Late.of(loop=at, hand=hand, delay=delay)
    # At the rule's circle, and where some of the roots are inside and some outside.
    for size in (1.0 + region.ON_THE_CIRCLE, 1.0001, 1.02, math.exp(-0.5 / late.m), math.exp(-2.0 / late.m)):
        assert late.growing(size=size) == (np.abs(eigenvalues) > size).sum()
    # The eigenvalues of a matrix of 150 are known to some 1e-9.
    assert late.growth() == pytest.approx(math.log(np.max(np.abs(eigenvalues))), abs=1e-8)
    mine, theirs = least_damping(late.roots()), least_damping(np.log(eigenvalues[np.abs(eigenvalues) > 1e-12]))
    assert mine == (None if theirs is None else pytest.approx(theirs, abs=1e-6))


def test_a_hand_a_second_late_is_judged_without_a_matrix_of_its_samples(monkeypatch: pytest.MonkeyPatch) -> None:
    # 0.8 s are 200, 400, 800 samples: the limit tends to that of the continuous loop, to first order in T. And 80000.
    sizes: list[int] = []
    matrix = theory.closed_loop

    def seen(**arguments: object) -> np.ndarray:
        sizes.append(len(answer := matrix(**arguments)))  # type: ignore[arg-type]
        return answer

    monkeypatch.setattr(theory, "closed_loop", seen)
    gains = replace(ARM_GAINS, D_n=60.0, K=500.0)
    limits = []
    for T in (4e-3, 2e-3, 1e-3, 1e-5):
        machine = Machine(T=T, M_min=20.0, M_max=20.0, k_h=10.0, b_h=5.0, hand_delay=0.8)
        limits.append(region.hand_limit(machine=machine, gains=gains, M=20.0))
        at = at_mass(machine=machine, gains=gains, M=20.0, frequency=0.4)
        assert at.stable == (limits[-1] > 10.0)
    assert 1.0 < limits[2] < 1e3
    assert limits[0] - limits[1] == pytest.approx(2.0 * (limits[1] - limits[2]), rel=0.05)
    assert limits[3] == pytest.approx(limits[2], rel=0.01)
    assert max(sizes, default=0) <= 6


def test_the_map_s_boundary_runs_where_it_is() -> None:
    x, y = np.geomspace(0.01, 100.0, 24), np.geomspace(0.1, 1000.0, 24)
    field = chart.distance(stable=lambda a, b: a * b < 7.0, x=x, y=y)
    step = math.log(x[1] / x[0])
    far = np.log(7.0 / np.outer(y, x)) / step  # along a row or a column, in steps of the map
    assert (np.sign(field) == np.sign(far)).all()
    near = np.abs(far) < 1.0
    assert near.sum() > 40
    assert np.abs(field - far)[near].max() <= 0.5**chart.HALVES


def test_a_single_mass_has_lines_to_look_at(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    drawn = []
    monkeypatch.setattr(chart.Canvas, "savefig", lambda canvas, *_, **__: drawn.append(canvas))
    answer = guide(machine=replace(TESTBED, k_h=20.0), gains=replace(TESTBED_GAINS, M_n=1.0), frequency=0.4)
    chart.draw(guide=answer, path=tmp_path / "tune.png")
    lines = [line for line in drawn[0].axes[0].lines if "est K" in str(line.get_label())]
    assert len(lines) == 3  # largest without and with a hand, smallest with it
    assert all(np.ptp(line.get_xdata()) > 0.0 and np.isfinite(line.get_ydata()).all() for line in lines)
