"""Scenario frequency_response on the built FMUs."""

from dataclasses import replace

from exo import theory
from exo.experiment import Experiment
from exo.metrics.loops import loop_of
from exo.metrics.response import measured_response

SCENARIO = "frequency_response"


def test_the_fit_tells_one_percent_more_damping(experiment: Experiment) -> None:
    run = experiment.recordings["0.032Hz"]
    measured, omega = measured_response(
        run, force="controller.tau_h", velocity="plant.dq", profile="tau_h", after=200.0
    )
    loop = loop_of(run, controller="controller", plant="plant")
    other = theory.sampled(loop=replace(loop, D_n=1.01 * loop.D_n), omega=omega)
    assert abs(measured / other - 1.0) > 1e-3


def test_the_printed_numerator_does_not_fit(experiment: Experiment) -> None:
    # eq:admittance_proposed as printed has (K + D_n)s where (K + 1)s belongs; α K_P hides the difference at low ω.
    run = experiment.recordings["1.6Hz"]
    measured, omega = measured_response(
        run, force="controller.tau_h", velocity="plant.dq", profile="tau_h", after=200.0
    )
    loop = loop_of(run, controller="controller", plant="plant")
    s = 1j * omega
    N = loop.M_n * s + loop.D_n
    corrected = N * s + (loop.K + loop.alpha) * s + (loop.K + loop.alpha) * loop.K_P
    printed = N * s + (loop.K + loop.D_n) * s + (loop.K + loop.alpha) * loop.K_P
    as_printed = theory.continuous(loop=loop, omega=omega) * printed / corrected
    assert abs(as_printed / theory.sampled(loop=loop, omega=omega) - 1.0) > abs(
        theory.continuous(loop=loop, omega=omega) / theory.sampled(loop=loop, omega=omega) - 1.0
    )
    assert abs(measured / as_printed - 1.0) > abs(measured / theory.continuous(loop=loop, omega=omega) - 1.0)
