"""Frequency responses: velocity over force at one sine, against closed forms and against the desired model."""

import math

import numpy as np
from numpy.typing import NDArray

from exo import forms, theory
from exo.metrics.basic import window
from exo.metrics.loops import comparator_of, desired_mass, loop_of
from exo.metrics.registry import metric
from exo.recording import Recording

RESPONSES = theory.RESPONSES | {"servo": forms.servo_response}


def fit_phasor(*, time: NDArray[np.float64], signal: NDArray[np.float64], omega: float) -> complex:
    """P with signal ≈ Im(P exp(iωt)) in the least-squares sense."""
    basis = np.column_stack([np.sin(omega * time), np.cos(omega * time)])
    (a, b), *_ = np.linalg.lstsq(basis, signal, rcond=None)
    return complex(a, b)


def measured_response(
    run: Recording, *, force: str, velocity: str, profile: str, after: float
) -> tuple[complex, float]:
    """Velocity over force at the ticks (m/(N·s)) and the angular frequency (rad/s) of the profile's one sine, fitted
    over t ≥ after."""
    (sine,) = run.profiles[profile]
    omega = 2.0 * math.pi * sine.frequency
    steady = window(run.time, after=after, before=None)
    phasors = [fit_phasor(time=run.time[steady], signal=run[name][steady], omega=omega) for name in (velocity, force)]
    return phasors[0] / phasors[1], omega


@metric
def response_error(
    run: Recording, *, controller: str, plant: str, theory_of: str, part: str, profile: str, after: float
) -> float:
    """Distance of the measured dq/τ_h from a closed form at the frequency of the profile's one sine.

    `theory_of`: `sampled`, `continuous` or `servo`. `part`: `relative` |H/H₀ − 1|, `magnitude` ||H/H₀| − 1|, `phase`
    |arg H/H₀| (rad). The steady state is fitted over t ≥ after, by when the slow mode, about exp(−t D_n/M_n), must have
    died out.
    """
    measured, omega = measured_response(
        run, force=f"{controller}.tau_h", velocity=f"{plant}.dq", profile=profile, after=after
    )
    loop = loop_of(run, controller=controller, plant=plant)
    quotient = measured / RESPONSES[theory_of](loop=loop, omega=omega)
    return {
        "relative": abs(quotient - 1.0),
        "magnitude": abs(abs(quotient) - 1.0),
        "phase": abs(math.atan2(quotient.imag, quotient.real)),
    }[part]


@metric
def comparator_response_error(run: Recording, *, controller: str, plant: str, profile: str, after: float) -> float:
    """|H/H₀ − 1| of the measured dq/τ_h and the exact sampled loop of a comparator, at the profile's one sine."""
    measured, omega = measured_response(
        run, force=f"{controller}.tau_h", velocity=f"{plant}.dq", profile=profile, after=after
    )
    loop = comparator_of(run, controller=controller, plant=plant)
    return abs(measured / forms.comparator_response(loop=loop, omega=omega) - 1.0)


@metric
def model_error(run: Recording, *, controller: str, plant: str, profile: str, after: float) -> float:
    """|H (M_d iω + D_n) − 1|: how far the fundamental of the robot's motion is from the desired model's, which is
    1/(M_d s + D_n), with the robot's mass as M_d under `natural`."""
    measured, omega = measured_response(
        run, force=f"{controller}.tau_h", velocity=f"{plant}.dq", profile=profile, after=after
    )
    mass = desired_mass(run, controller=controller)
    return abs(measured * (mass * 1j * omega + run.parameter(f"{controller}.D_n")) - 1.0)
