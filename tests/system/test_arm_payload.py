"""Scenario arm_payload on the built FMUs."""

from typing import Any

import numpy as np
import pytest

from exo import poses
from exo.experiment import Experiment

SCENARIO = "arm_payload"


def test_the_payload_hangs_from_the_grip_to_the_release(experiment: Experiment) -> None:
    run = experiment.recordings["passive_bounded_17.5kg"]
    held, vacuum = run["plant.attached"], run["plant.vacuum"]
    assert vacuum.dtype == bool
    assert (vacuum == ((run.time >= 2.0) & (run.time < 30.0))).all()
    # The pad is on the table when the vacuum comes on, so it grips in that very step.
    assert (held == vacuum).all()


def test_only_the_laws_that_feel_the_whole_or_the_bounded_y_lift(results: dict[str, Any]) -> None:
    for m in ("17.5kg", "25kg"):
        for law in ("passive", "passive_bounded"):
            assert results[f"lift/{law}_{m}"].value > 0.4
        for law in ("standard", "passive_applied"):
            assert results[f"lift/{law}_{m}"].value < 0.005


def test_the_tension_while_hanging_still_is_the_weight(experiment: Experiment) -> None:
    # Drifting down 10 mm/s in friction's steps: no mean acceleration over 1 s beyond 0.01 m/s².
    for m in (17.5, 25.0):
        run = experiment.recordings[f"passive_bounded_{m:g}kg"]
        still = (run.time >= 23.8) & (run.time < 24.8)
        assert np.mean(run["plant.tension"][still]) == pytest.approx(m * 9.81, rel=1e-3)


def test_the_poses_are_the_handle_s_and_the_pad_s(experiment: Experiment) -> None:
    figure = next(figure for figure in experiment.scenario.figures if figure.kind == "arm_poses")
    run = experiment.recordings[figure.poses.case]
    table = poses.table(poses=figure.poses, run=run)
    assert table["time [s]"] == pytest.approx(figure.poses.times)
    assert table["held"] == [0.0, 1.0, 1.0, 1.0]
    ticks = [round(1000 * t) for t in figure.poses.times]
    for name, column in (("handle", "p"), ("pad", "p_pad")):
        x, y, z = (run[f"plant.{column}[{i}]"][ticks] for i in (1, 2, 3))
        assert table[f"{name} r [m]"] == pytest.approx(np.hypot(x, y), abs=1e-14)
        assert table[f"{name} z [m]"] == pytest.approx(z, abs=1e-14)
