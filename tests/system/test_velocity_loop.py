"""Scenario velocity_loop on the built FMUs: the passive limit of the literature."""

import numpy as np
import pytest

from exo.experiment import Experiment
from exo.metrics.impedance import impedance_of

SCENARIO = "velocity_loop"
WHO = {"controller": "controller", "plant": "plant", "operator": "operator"}


def test_the_velocity_loop_s_admittance_is_the_one_of_keemink_and_others(experiment: Experiment) -> None:
    for side, K in (("below", 1.125), ("above", 1.375)):
        found = impedance_of(experiment.recordings[f"tones_{side}"], **WHO, after=50.0)
        s = 1j * found.omega
        expected = (2.0 * s + K) / (2.0 * s * (10.0 * s + 5.0 + K))
        # Sampling: ωT/2 = 0.6 % at 1 Hz.
        assert 1.0 / found.robot == pytest.approx(expected, rel=0.01)
        assert (np.sign(expected.real) == (1.0 if side == "below" else -1.0)).all()
