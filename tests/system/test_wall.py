"""Scenario wall on the built FMUs."""

from typing import Any

from exo import metrics
from exo.experiment import Experiment
from exo.metrics.wall import wall_curve_error

SCENARIO = "wall"


def test_the_standard_law_sticks_ten_times_as_long_as_any_feedback_of_y(results: dict[str, Any]) -> None:
    for nominal in ("0.1_0.5", "5_0.5", "5_5", "10_0.5"):
        stuck = results[f"release_delay/standard_{nominal}"].value
        for law in ("passive", "passive_bounded"):
            assert results[f"release_delay/{law}_{nominal}"].value < 0.1 * stuck


def test_the_curve_at_the_wall_needs_the_reaction_of_alpha(experiment: Experiment) -> None:
    # Without the reaction on the nominal e grows without bound: the closed form must not fit law standard.
    arguments = next(m.arguments for m in experiment.scenario.metrics if m.id == "analytic_curve")
    arguments = metrics.complete("wall_curve_error", arguments)
    assert wall_curve_error(experiment.recordings["standard_10_0.5"], **arguments) > 1.0


def test_saturation_is_reported_at_the_limit_only(experiment: Experiment) -> None:
    run = experiment.recordings["standard_5_0.5"]
    saturated = run["controller.saturated"]
    assert saturated.any()
    assert not saturated.all()
    assert (abs(run["controller.tau_a"][saturated]) == 12.5).all()


def test_ticks_count_from_zero_without_a_gap(experiment: Experiment) -> None:
    run = experiment.recordings["passive_bounded_5_0.5"]
    assert (run["controller.tick"] == range(len(run.time))).all()
