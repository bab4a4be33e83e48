"""Steps that are not the sample period: cases with their own step, their pictures, and what `exo run` says of them."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from exo import experiment as experiments
from exo import plots
from exo.errors import ScenarioError
from exo.master import plan
from exo.scenario import load
from exo.selection import narrowed

SCENARIO = "communication_step"


def test_each_case_runs_with_its_own_step(experiment: Any) -> None:
    steps = {case: recording.step for case, recording in experiment.recordings.items()}
    assert steps["T"] == 0.002
    assert steps["0.6_T"] == pytest.approx(0.0012, rel=1e-12)
    assert len(experiment.recordings["2_T"].time) == 15_000


def test_another_step_on_the_command_line_is_that_of_every_case() -> None:
    other = narrowed(load(SCENARIO), step=0.01)
    assert {plan(scenario=other, case=case).step for case in other.cases} == {0.01}


def test_a_picture_of_several_steps_leaves_out_what_a_case_has_not(experiment: Any) -> None:
    figure = next(figure for figure in experiment.scenario.figures if figure.id == "error")
    table = plots.data(figure=figure, recordings=experiment.recordings)
    time = table["time [s]"].to_numpy()
    assert np.all(np.diff(time) > 1e-6)
    for label, case in (("T/2", "T_2"), ("2 T", "2_T"), ("0.6 T", "0.6_T")):
        column = table[f"{label} [m]"].to_numpy()
        recording = experiment.recordings[case]
        assert np.array_equal(column[~np.isnan(column)], recording["controller.e_nr"])
        assert time[~np.isnan(column)] == pytest.approx(recording.time, abs=1e-9)


def test_a_picture_of_cases_of_several_lengths_is_refused(experiment: Any, fmu_dir: Path) -> None:
    scenario = load(SCENARIO)
    cases = tuple(
        case.model_copy(update={"duration": 30.0 if case.id == "T_2" else 60.0})
        for case in scenario.cases
        if case.id in {"T", "T_2"}
    )
    short = scenario.model_copy(update={"cases": cases, "metrics": (), "ratios": (), "figures": ()})
    done = experiments.run(scenario=short, fmu_dir=fmu_dir)
    figure = experiment.scenario.figures[0]
    curves = tuple(curve for curve in figure.panels[0].curves if curve.case in {"T", "T_2"})
    only = figure.model_copy(update={"panels": (figure.panels[0].model_copy(update={"curves": curves}),)})
    with pytest.raises(ScenarioError, match="one duration"):
        plots.data(figure=only, recordings=done.recordings)


def test_steps_that_do_not_divide_the_period_are_named_once_each(experiment: Any) -> None:
    assert [note.split(":")[0] for note in experiment.notes] == [
        f"the step {step:g} s does not divide controller.T = 0.002 s" for step in (0.0012, 0.003, 0.004)
    ]
    assert all("sample_period" in note for note in experiment.notes)


def test_steps_that_divide_it_are_not(fmu_dir: Path) -> None:
    scenario = narrowed(load("gain_study"), cases=["K30"], step=0.0005)
    assert experiments.run(scenario=scenario, fmu_dir=fmu_dir).notes == ()
