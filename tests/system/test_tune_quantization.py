"""`exo tune` on encoders: what a count is worth, and whether dry friction swallows it."""

from collections.abc import Mapping
from dataclasses import fields, replace

import numpy as np
import pytest

from exo import scenario as scenarios
from exo.fmu import Archive, find_fmu_dir
from exo.master import plan, simulate
from exo.tuning import quantization, reading
from exo.tuning.machine import Gains, Machine

DELTA = 1e-5
MACHINE = Machine(T=0.001, M_min=14.0, M_max=100.0, resolution=DELTA)
GAINS = Gains(M_n=5.0, D_n=20.0, K=1000.0, K_P=20.0)


def judged(machine: Machine, gains: Gains, F_c: float) -> quantization.Quantization:
    found = quantization.quantization(machine=machine, gains=gains, F_c=F_c)
    assert found is not None
    return found


def law(*, machine: Machine, gains: Gains, reading: np.ndarray) -> np.ndarray:
    """τ_a for readings of a robot that stands: the law written down a second time (docs/specification.md section 1)."""
    T, K_P, alpha = machine.T, gains.K_P, gains.alpha
    keep = np.exp(-2.0 * np.pi * machine.dq_cutoff * T) if machine.dq_cutoff else 0.0
    q_n = v_n = dq = before = 0.0
    tau = []
    for q in reading:
        dq = keep * dq + (1.0 - keep) * (q - before) / T
        before, e = q, q_n - q
        # M_n (v⁺ − v)/T = −D_n v_m − α y, y = (v_m − dq) + K_P (e + T (v_m − dq)/2), v_m = (v + v⁺)/2
        lead = 1.0 + K_P * T / 2.0
        v_m = (2.0 * gains.M_n / T * v_n + alpha * (lead * dq - K_P * e)) / (
            2.0 * gains.M_n / T + gains.D_n + alpha * lead
        )
        tau.append(gains.K * (lead * (v_m - dq) + K_P * e))
        q_n, v_n = q_n + T * v_m, 2.0 * v_m - v_n
    return np.array(tau)


def test_without_the_reaction_the_force_of_the_readings_is_a_closed_form() -> None:
    # α = 0: the nominal rests. g_0 = −K (c/T + K_P), g_1 = K c/T, c = 1 + K_P T/2: the sum of both times δ/2.
    found = judged(MACHINE, replace(GAINS, alpha=0.0), 10.0)
    assert found.force == pytest.approx(1000.0 * DELTA * (1.0 / 0.001 + 20.0), rel=1e-9)
    # One count is one step: c/T + K_P at its own tick, K_P from the next one on.
    assert found.step == pytest.approx(1000.0 * DELTA * (1.01 / 0.001 + 20.0), rel=1e-9)
    assert found.velocity == pytest.approx(DELTA / 0.001)
    assert found.share == pytest.approx(found.force / 10.0)


def test_for_a_bare_spring_the_rule_is_that_of_abbott_and_okamura() -> None:
    # K_w ≤ 2 F_c/δ. A velocity that is all but filtered away leaves the spring K_w = K K_P.
    gains, F_c = replace(GAINS, alpha=0.0), 1.7
    slow = replace(MACHINE, dq_cutoff=1e-3)
    found = judged(slow, gains, F_c)
    assert found.K_needed is not None
    assert found.K_needed * gains.K_P == pytest.approx(2.0 * F_c / DELTA, rel=1e-3)  # 2 · 2π · 1e-3 Hz/K_P is left


@pytest.mark.parametrize("dq_cutoff", [0.0, 30.0])
@pytest.mark.parametrize("alpha", [0.0, 1.0, 30.0])
def test_the_worst_readings_make_the_force_and_no_others_make_more(alpha: float, dq_cutoff: float) -> None:
    machine, gains = replace(MACHINE, dq_cutoff=dq_cutoff), replace(GAINS, alpha=alpha)
    found = judged(machine, gains, 10.0)
    response = quantization.force_response(machine=machine, gains=gains)
    worst = 0.5 * DELTA * np.sign(response[::-1])
    assert law(machine=machine, gains=gains, reading=worst)[-1] == pytest.approx(found.force, rel=1e-6)
    random = np.random.default_rng(1).uniform(-0.5 * DELTA, 0.5 * DELTA, 3000)
    assert np.abs(law(machine=machine, gains=gains, reading=random)).max() < found.force
    one_count = np.full(3000, DELTA)
    assert np.abs(law(machine=machine, gains=gains, reading=one_count)).max() == pytest.approx(found.step, rel=1e-6)


def test_each_remedy_alone_is_just_enough() -> None:
    found = judged(MACHINE, GAINS, 4.0)
    assert not found.is_swallowed
    assert found.resolution_needed is not None
    assert found.K_needed is not None
    assert found.cutoff_needed is not None
    for machine, gains in (
        (replace(MACHINE, resolution=found.resolution_needed), GAINS),
        (MACHINE, replace(GAINS, K=found.K_needed)),
    ):
        assert judged(machine, gains, 4.0).share == pytest.approx(1.0, rel=1e-6)
    assert judged(replace(MACHINE, dq_cutoff=found.cutoff_needed), GAINS, 4.0).is_swallowed
    assert not judged(replace(MACHINE, dq_cutoff=1.01 * found.cutoff_needed), GAINS, 4.0).is_swallowed
    # K K_P δ/2 = 0.1 N stays whatever filters the velocity.
    assert judged(MACHINE, GAINS, 0.09).cutoff_needed is None
    assert quantization.quantization(machine=replace(MACHINE, resolution=0.0), gains=GAINS, F_c=4.0) is None


@pytest.mark.parametrize(
    ("bits", "K", "friction", "moves"),
    [
        (17, 3000.0, True, False),
        (16, 1000.0, True, False),
        (15, 1000.0, True, False),
        (14, 3000.0, True, True),
        (13, 1000.0, True, True),
        (17, 3000.0, False, True),
        (15, 1000.0, False, True),
    ],
)
def test_the_arm_rests_where_friction_swallows_the_counts(
    bits: int, K: float, friction: bool, moves: bool, archives: Mapping[str, Archive]
) -> None:
    # The rule is sufficient: at a share of 2 the arm may rest, too. 4.6 and 3.0 keep it moving, as no friction does.
    data = scenarios.load("arm_presets")
    settings: dict[str, float | str] = {f"controller.K[{i}]": K for i in (1, 2, 3)}
    settings |= {"plant.encoder.kind": "joint", "plant.encoder.bits": bits, "controller.encoder.samples": 0}
    settings |= {"operator.k_h": 100.0}
    if not friction:
        settings |= {f"plant.friction.{name}[{i}]": 0.0 for name in ("F_c", "F_s", "b") for i in (1, 2, 3)}
    found = reading.read(
        scenario=data,
        case="stiff_grip_grip",
        axis="x",
        texts={name: str(value) for name, value in settings.items()},
        fmu_dir=find_fmu_dir(),
    )
    machine, gains = (
        kind(**{field.name: found.values[field.name] for field in fields(kind) if field.name in found.values})
        for kind in (Machine, Gains)
    )
    share = judged(machine, gains, found.friction.F_c).share
    assert (share <= 1.0) == (not moves)
    (case,) = [one for one in data.cases if one.id == "stiff_grip_grip"]
    whole = plan(scenario=data, case=case, overrides=settings)
    run = simulate(plan=replace(whole, duration=8.0), archives=archives)
    speed = float(np.abs(run["plant.dp[1]"][run.time > 6.0]).max())  # 5.5 s after the push
    assert (speed > 0.0) == moves, share
