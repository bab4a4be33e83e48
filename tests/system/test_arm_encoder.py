"""Scenario arm_encoder on the built FMUs."""

from typing import Any

import numpy as np
import pytest

from exo.experiment import Experiment

SCENARIO = "arm_encoder"


def test_the_encoders_read_multiples_of_their_counts(experiment: Experiment) -> None:
    counts = {"joint17": [2.0**17] * 3, "joint14": [2.0**14] * 3, "motor": [2000.0 * g for g in (354.0, 600.0, 354.0)]}
    for case, per_turn in counts.items():
        run = experiment.recordings[case]
        for i, n in enumerate(per_turn, start=1):
            read = run[f"plant.q[{i}]"] * n / (2.0 * np.pi)
            # A thirtieth of a count at a million counts a turn: the rounding of three products.
            assert read == pytest.approx(np.round(read), abs=1e-6)
            # And no coarser: somewhere the arm is slow enough to pass one count in a sample. The yaw rests: x lies in
            # the arm's own plane.
            changes = np.abs(np.diff(np.round(read)))
            assert set(changes[changes < 1.5]) == ({0.0} if i == 1 else {0.0, 1.0})
            assert np.abs(run[f"plant.q[{i}]"] - run[f"plant.q_joint[{i}]"]).max() <= 2.0 * np.pi / n
    ideal = experiment.recordings["ideal"]
    assert (ideal["plant.q[2]"] == ideal["plant.q_joint[2]"]).all()


def test_coarser_counts_make_a_noisier_velocity_and_more_torque(results: dict[str, Any]) -> None:
    for metric in ("dp_noise", "torque"):
        values = [results[f"{metric}/{case}"].value for case in ("ideal", "motor", "joint17", "joint14")]
        assert values == sorted(values)
        assert values[-1] > 1.2 * values[0]
