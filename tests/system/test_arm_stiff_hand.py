"""Scenario arm_stiff_hand on the built FMUs."""

from dataclasses import replace

import numpy as np
import pytest

from exo import theory
from exo.experiment import Experiment

SCENARIO = "arm_stiff_hand"


def test_the_closed_form_changes_sign_between_the_cases_that_hold_and_those_that_grow() -> None:
    paper = theory.Loop(M=99.93, M_n=5.0, D_n=20.0, K=1000.0, K_P=20.0, alpha=1.0, T=0.001, substep=1e-4)
    heavy = replace(paper, M_n=20.0, D_n=80.0)
    assert theory.hand_growth_rate(loop=paper, k_h=381.0) < 0.0 < theory.hand_growth_rate(loop=paper, k_h=382.0)
    assert theory.hand_growth_rate(loop=heavy, k_h=1661.0) < 0.0 < theory.hand_growth_rate(loop=heavy, k_h=1663.0)


def test_the_sampled_closed_form_tends_to_the_roots_of_the_continuous_loop() -> None:
    # Λ Λ_n s⁴ and so on, from the three equations of `hand_growth_rate` in the limit T → 0.
    M, M_n, D_n, K, K_P, alpha, k = 99.93, 5.0, 20.0, 1000.0, 20.0, 1.0, 400.0
    pi, arm, nominal = [1.0, K_P], [M, 0.0, k], [M_n, D_n, 0.0]
    # (M s² + K c + k) q = K c q_n;  (M_n s² + D_n s + α c) q_n = (α c − k) q,  c = s + K_P
    left = np.polymul(np.polyadd(arm, np.multiply(K, pi)), np.polyadd(nominal, np.multiply(alpha, pi)))
    right = np.polymul(np.multiply(K, pi), np.polyadd(np.multiply(alpha, pi), [-k]))
    expected = np.roots(np.polysub(left, right)).real.max()
    errors = [
        abs(
            theory.hand_growth_rate(
                loop=theory.Loop(M=M, M_n=M_n, D_n=D_n, K=K, K_P=K_P, alpha=alpha, T=T, substep=T / 10.0), k_h=k
            )
            - expected
        )
        for T in (1e-3, 5e-4)
    ]
    assert errors[0] < 0.03
    assert errors[0] / errors[1] == pytest.approx(2.0, abs=0.1)


def test_the_hand_pulls_toward_where_it_took_hold(experiment: Experiment) -> None:
    run = experiment.recordings["paper_350"]
    assert run["operator.f_hand[1]"] == pytest.approx(-350.0 * (run["plant.p[1]"] - run["plant.p[1]"][0]), abs=1e-12)
