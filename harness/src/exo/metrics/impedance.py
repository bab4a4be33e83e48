"""What a hand gets: impedance and apparent mass over frequency, and how stiff it may be."""

import math
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
import scipy
from numpy.typing import NDArray

from exo import forms, theory
from exo.metrics.basic import window
from exo.metrics.growth import tick_growth
from exo.metrics.loops import COMPARATORS, comparator_of, gains_of, loop_of, machine_of
from exo.metrics.registry import metric
from exo.recording import Recording
from exo.tuning import region

Complex = NDArray[np.complex128]
#: Stiffnesses of a hand between which a comparator's limit is looked for (N/m), and how many.
STIFFNESSES = np.geomspace(0.1, 1e6, 281)


@dataclass(frozen=True)
class Impedance:
    """At the angular frequencies ω (rad/s): force over velocity (N·s/m) at the handle, of the robot alone, and of robot
    and hand together, as a force feels them that pushes beside the hand."""

    omega: NDArray[np.float64]
    robot: Complex
    held: Complex


def impedance_of(run: Recording, *, controller: str, plant: str, operator: str, after: float) -> Impedance:
    """Fitted over t ≥ after to the sines of the operator's plan, which must be in a steady state by then."""
    steady = window(run.time, after=after, before=None)
    sines = [i for i in range(1, 17) if run.parameter(f"{operator}.segment[{i}].amplitude")]
    omega = 2.0 * math.pi * np.array([run.parameter(f"{operator}.segment[{i}].frequency") for i in sines])
    turns = np.outer(run.time[steady], omega)
    basis = np.concatenate([np.sin(turns), np.cos(turns)], axis=1)
    signals = [run[name][steady] for name in (f"{plant}.dq", f"{controller}.tau_h", f"{operator}.f_profile[1]")]
    fitted, *_ = np.linalg.lstsq(basis, np.stack(signals, axis=1), rcond=None)
    dq, tau_h, plan = (fitted[: len(omega)] + 1j * fitted[len(omega) :]).T
    return Impedance(omega=omega, robot=tau_h / dq, held=plan / dq)


def expected_robot(run: Recording, *, controller: str, plant: str, omega: NDArray[np.float64]) -> Complex:
    """The robot's impedance by the closed form of its sampled loop, as long as nothing saturates or sticks."""
    law = run.choice(f"{controller}.law")
    if law in COMPARATORS:
        comparator = comparator_of(run, controller=controller, plant=plant)
        return np.array([1.0 / forms.comparator_response(loop=comparator, omega=w) for w in omega])
    return np.array(
        [1.0 / theory.sampled(loop=small_signal(run, controller=controller, plant=plant), omega=w) for w in omega]
    )


def small_signal(run: Recording, *, controller: str, plant: str) -> theory.Loop:
    """The unlimited loop: `standard` has no reaction; the bounded laws are the paper's below their limits."""
    loop = loop_of(run, controller=controller, plant=plant)
    return replace(loop, alpha=0.0) if run.choice(f"{controller}.law") == "standard" else loop


def expected_hand(run: Recording, *, operator: str, omega: NDArray[np.float64], step: float) -> Complex:
    """Impedance b_h + k_h Q/dQ of the hand, as it acts on the robot from tick to tick."""
    k_h, b_h = (run.parameter(f"{operator}.{name}") for name in ("k_h", "b_h"))
    # q_{k+1} = q_k + T (dq_k + dq_{k+1})/2 but for the substeps: Q/dQ = (T/2) (z + 1)/(z − 1).
    z = np.exp(1j * omega * step)
    return np.asarray(b_h + k_h * 0.5 * step * (z + 1.0) / (z - 1.0))


@metric
def impedance_error(run: Recording, *, controller: str, plant: str, operator: str, after: float) -> float:
    """Largest distance of the robot's measured impedance from its closed form over all sines, as a share of it."""
    found = impedance_of(run, controller=controller, plant=plant, operator=operator, after=after)
    expected = expected_robot(run, controller=controller, plant=plant, omega=found.omega)
    return float(np.max(np.abs(found.robot / expected - 1.0)))


@metric
def held_impedance_error(run: Recording, *, controller: str, plant: str, operator: str, after: float) -> float:
    """The same of robot and hand together, against the sum of the closed form and the hand's b_h + k_h/s."""
    found = impedance_of(run, controller=controller, plant=plant, operator=operator, after=after)
    expected = expected_robot(run, controller=controller, plant=plant, omega=found.omega)
    expected = expected + expected_hand(run, operator=operator, omega=found.omega, step=run.step)
    return float(np.max(np.abs(found.held / expected - 1.0)))


@metric
def apparent_mass(
    run: Recording, *, controller: str, plant: str, operator: str, after: float, frequency: float
) -> float:
    """Im Z/ω (kg) of the robot at the sine next to `frequency` (Hz)."""
    found = impedance_of(run, controller=controller, plant=plant, operator=operator, after=after)
    i = int(np.argmin(np.abs(found.omega - 2.0 * math.pi * frequency)))
    return float(found.robot[i].imag / found.omega[i])


@metric
def least_resistance(run: Recording, *, controller: str, plant: str, operator: str, after: float) -> float:
    """Least Re Z (N·s/m) of the robot over all sines: below 0 it gives energy to a hand that moves it."""
    found = impedance_of(run, controller=controller, plant=plant, operator=operator, after=after)
    return float(np.min(found.robot.real))


@metric
def least_conductance(run: Recording, *, controller: str, plant: str, operator: str, after: float) -> float:
    """Least Re (1/Z), times |Z| (1): the admittance is positive real where it is not below 0."""
    found = impedance_of(run, controller=controller, plant=plant, operator=operator, after=after)
    return float(np.min((1.0 / found.robot).real * np.abs(found.robot)))


def hand_limit_of(run: Recording, *, controller: str, plant: str, operator: str) -> float:
    """The stiffness (N/m) up to which a hand of the run's b_h is stable on this law, by the closed form; inf: any."""
    b_h = run.parameter(f"{operator}.b_h")
    if run.choice(f"{controller}.law") not in COMPARATORS:
        machine = machine_of(run, controller=controller, plant=plant, operator=operator)
        alpha = small_signal(run, controller=controller, plant=plant).alpha
        return region.hand_limit(
            machine=machine, gains=replace(gains_of(run, controller=controller), alpha=alpha), M=machine.M_min
        )
    comparator = comparator_of(run, controller=controller, plant=plant)

    def growth(k_h: float) -> float:
        return forms.comparator_growth_rate(loop=replace(comparator, k_h=k_h, b_h=b_h))

    for soft, stiff in pairwise(STIFFNESSES):
        if growth(stiff) > 0.0:
            return 0.0 if growth(soft) > 0.0 else float(scipy.optimize.brentq(growth, soft, stiff, rtol=1e-9))
    return math.inf


@metric
def hand_limit(run: Recording, *, controller: str, plant: str, operator: str) -> float:
    """`hand_limit_of`: the stiffest hand (N/m) of the operator's b_h that is stable."""
    return hand_limit_of(run, controller=controller, plant=plant, operator=operator)


@metric
def hand_limit_share(run: Recording, *, controller: str, plant: str, operator: str) -> float:
    """The hand's stiffness over `hand_limit_of`."""
    limit = hand_limit_of(run, controller=controller, plant=plant, operator=operator)
    return run.parameter(f"{operator}.k_h") / limit if limit else math.inf


@metric
def grows(run: Recording, *, column: str) -> float:
    """1 where the slowest mode grows over the last third of the run, 0 where it decays (`tick_growth`)."""
    end = float(run.time[-1])
    return float(tick_growth(run, column=column, after=2.0 * end / 3.0, before=end) > 0.0)
