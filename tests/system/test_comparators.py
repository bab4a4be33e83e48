"""Scenario comparators on the built FMUs: the expected figures come from elsewhere."""

from typing import Any

import numpy as np
import pytest

from exo.experiment import Experiment
from exo.scenario import load
from oracles import comparators as oracle

SCENARIO = "comparators"
COMPARATORS = ("natural", "sliding_mode")


@pytest.mark.parametrize("law", COMPARATORS)
def test_the_expected_figures_are_those_of_the_second_implementation(law: str) -> None:
    expected = {metric.id: metric.expected for metric in load(SCENARIO).metrics}
    # The printed digits.
    assert expected["release_delay"][f"wall_{law}"].value == pytest.approx(oracle.wall_delay(law), abs=0.005)
    assert expected["model_error"][f"friction_{law}"].value == pytest.approx(oracle.friction_error(law), rel=1e-3)


def test_both_comparators_stick_where_the_bounded_law_lets_go(results: dict[str, Any]) -> None:
    assert results["release_delay/wall_passive_bounded"].value < 0.5
    for law in COMPARATORS:
        assert results[f"release_delay/wall_{law}"].value > 1.0


def test_only_the_natural_port_bears_the_hand(results: dict[str, Any]) -> None:
    assert results["hand_decay/hand_natural"].value < 0.0
    for law in ("standard", "passive", "passive_bounded", "sliding_mode"):
        assert results[f"hand_growth/hand_{law}"].value > 0.05


def test_no_energy_is_shown_for_a_comparator(experiment: Experiment) -> None:
    for law in COMPARATORS:
        run = experiment.recordings[f"wall_{law}"]
        for name in ("H", "G", "tank"):
            assert not np.any(run[f"controller.energy.{name}"])


def test_sliding_mode_stays_within_its_limit_and_does_not_chatter(experiment: Experiment) -> None:
    tau = experiment.recordings["return_sliding_mode"]["controller.tau_a"]
    assert np.max(np.abs(tau)) == 12.5
    # Pushed, held, braked, and the swing of the coupling: some changes of sign, not one in every sample.
    assert np.count_nonzero(np.diff(np.sign(tau[np.abs(tau) > 0.1]))) < 20
