"""Scenario arm_stiction on the built FMUs."""

import pytest

from exo.experiment import Experiment

SCENARIO = "arm_stiction"


def test_friction_carries_the_whole_torque_that_the_drive_delivers(experiment: Experiment) -> None:
    for case in ("up90", "down90"):
        run = experiment.recordings[case]
        for i in (1, 2, 3):
            # The solver converges to 1e-13 N·m·s of impulse over 1e-4 s.
            assert run[f"plant.tau_f[{i}]"] == pytest.approx(-run[f"plant.tau_applied[{i}]"], abs=1e-9)
            assert abs(run[f"plant.tau_applied[{i}]"][-1]) == pytest.approx(
                0.9 * run.parameter(f"plant.friction.F_s[{i}]")
            )
