"""How fast a swing grows or decays, against the eigenvalues of the sampled loop."""

import math

import numpy as np
import scipy
from numpy.typing import NDArray

from exo import forms, theory
from exo.metrics.basic import values, window
from exo.metrics.loops import COMPARATORS, arm_loop_of, comparator_of, gains_of, loop_of, machine_of
from exo.metrics.registry import metric
from exo.recording import Recording
from exo.tuning import region


@metric
def growth_rate(run: Recording, *, column: str, after: float, before: float) -> float:
    """σ (1/s) of a swing c + exp(σ t) A sin(ω t + φ) fitted to the window by least squares."""
    shown = window(run.time, after=after, before=before)
    time, signal = run.time[shown] - after, run[column][shown]
    centered = signal - np.mean(signal)
    scaled = centered / np.max(np.abs(centered))
    crossings = int(np.count_nonzero(np.diff(np.signbit(scaled))))
    omega = math.pi * max(crossings, 1) / (before - after)

    def left(x: NDArray[np.float64]) -> NDArray[np.float64]:
        swing = x[3] * np.sin(x[2] * time) + x[4] * np.cos(x[2] * time)
        return np.asarray(x[0] + np.exp(x[1] * time) * swing - scaled)

    return float(scipy.optimize.least_squares(left, [0.0, 0.0, omega, 0.5, 0.5]).x[1])


@metric
def hand_growth_error(
    run: Recording,
    *,
    controller: str,
    plant: str,
    operator: str,
    column: str,
    after: float,
    before: float,
    Lambda: float,
    damping: float = 0.0,
    axis: int = 1,
) -> float:
    """Distance of the measured σ (1/s) from the closed form for a hand of stiffness k_h on an arm without friction, of
    mass `Lambda` (kg) along `axis` (1 is x), with `damping` (N·s/m) on top of D_n."""
    loop = arm_loop_of(run, controller=controller, plant=plant, axis=axis, Lambda=Lambda, damping=damping)
    expected = theory.hand_growth_rate(loop=loop, k_h=run.parameter(f"{operator}.k_h"))
    return abs(growth_rate(run, column=column, after=after, before=before) - expected)


@metric
def testbed_hand_growth_error(
    run: Recording, *, controller: str, plant: str, operator: str, column: str, after: float, before: float
) -> float:
    """Distance of the measured σ (1/s) from the closed form, for a hand of stiffness k_h on the frictionless testbed:
    laws of the paper's kind and comparators."""
    k_h = run.parameter(f"{operator}.k_h")
    if run.choice(f"{controller}.law") in COMPARATORS:
        loop = comparator_of(run, controller=controller, plant=plant, k_h=k_h)
        expected = forms.comparator_growth_rate(loop=loop)
    else:
        expected = theory.hand_growth_rate(loop=loop_of(run, controller=controller, plant=plant), k_h=k_h)
    return abs(growth_rate(run, column=column, after=after, before=before) - expected)


@metric
def tick_growth(run: Recording, *, column: str, after: float, before: float) -> float:
    """σ = ln|λ|/T (1/s) of the larger of two modes: x_{k+2} = a x_{k+1} + b x_k over the window by least squares. It
    also sees what changes its sign from tick to tick, and what does not swing."""
    x = values(run, column, after, before)
    x = x / np.max(np.abs(x))
    (a, b), *_ = np.linalg.lstsq(np.column_stack([x[1:-1], x[:-2]]), x[2:], rcond=None)
    return float(np.log(np.max(np.abs(np.roots([1.0, -a, -b])))) / run.step)


@metric
def tick_growth_error(
    run: Recording, *, controller: str, plant: str, operator: str, column: str, after: float, before: float
) -> float:
    """Distance of `tick_growth` from the closed form's σ, as a share of it."""
    machine = machine_of(run, controller=controller, plant=plant, operator=operator)
    loop = loop_of(run, controller=controller, plant=plant)
    expected = theory.growth_rate(loop=loop, hand=machine.hand, delay=machine.delay)
    return abs(tick_growth(run, column=column, after=after, before=before) / expected - 1.0)


@metric
def boundary_share(run: Recording, *, controller: str, plant: str, operator: str) -> float:
    """The hand's stiffness over the predicted limit; K over its limit where there is no hand."""
    machine = machine_of(run, controller=controller, plant=plant, operator=operator)
    gains = gains_of(run, controller=controller)
    if machine.k_h:
        return machine.k_h / region.hand_limit(machine=machine, gains=gains, M=machine.M_min)
    interval = region.gain_interval(machine=machine, gains=gains, M=machine.M_min)
    return gains.K / interval.high if interval else math.nan
