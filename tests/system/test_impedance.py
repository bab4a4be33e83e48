"""Scenario impedance on the built FMUs: what a hand gets."""

import math
from typing import Any

import pytest

from exo.experiment import Experiment
from exo.handfigures import impedance_table
from exo.metrics.impedance import impedance_of

SCENARIO = "impedance"
WHO = {"controller": "controller", "plant": "plant", "operator": "operator"}


def test_slowly_moved_the_robot_is_the_nominal_and_quickly_moved_it_is_itself(results: dict[str, Any]) -> None:
    # M_n = 2 kg, M = 6 kg; 5 % at 0.128 Hz for the finite K, 5 % at 16 Hz for the sample that the mass is ahead.
    for law in ("standard", "passive", "sliding_mode"):
        assert results[f"mass_slow/{law}"].value == pytest.approx(2.0, rel=0.05)
        assert results[f"mass_fast/{law}"].value == pytest.approx(6.0, rel=0.05)
    assert results["mass_slow/natural"].value == pytest.approx(6.0, rel=0.01)


def test_the_damping_that_a_slow_hand_feels_is_that_of_the_corrected_transfer_function(experiment: Experiment) -> None:
    # eq:admittance_proposed at s → 0: D_n/(1 + α/K), 4.84 N·s/m, and D_n itself without the reaction.
    for law, expected in (("passive", 5.0 / (1.0 + 1.0 / 30.0)), ("standard", 5.0)):
        found = impedance_of(experiment.recordings[law], **WHO, after=50.0)
        assert found.robot[0].real == pytest.approx(expected, rel=0.002)  # ω² of 0.2 rad/s
        assert found.omega[0] == pytest.approx(2.0 * math.pi * 0.032)


def test_a_hand_that_holds_on_does_not_change_what_the_robot_is_and_adds_itself(experiment: Experiment) -> None:
    alone, held = (impedance_of(experiment.recordings[case], **WHO, after=50.0) for case in ("passive", "hand"))
    assert held.robot == pytest.approx(alone.robot, rel=1e-9)  # rounding of a least-squares fit
    added = held.held - held.robot
    assert added == pytest.approx(
        5.0 + 20.0 / (1j * held.omega), rel=0.06
    )  # (ωT)²/12 at 412 rad/s, of a hand late by ½ T
    assert alone.held == pytest.approx(alone.robot, rel=1e-12)


def test_the_figure_s_numbers_have_every_case_and_sine(experiment: Experiment) -> None:
    table = impedance_table(experiment.recordings)
    assert {len(column) for column in table.values()} == {12}
    assert "hand, robot and hand: Im Z/ω [kg]" in table
    assert len(table) == 1 + 2 * 5 + 2
