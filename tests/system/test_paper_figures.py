"""Scenario paper_figures on the built FMUs."""

from pathlib import Path

import pytest

from exo import results as results_on_disk
from exo.experiment import Experiment
from exo.kept import Kept
from exo.recording import read

SCENARIO = "paper_figures"


@pytest.mark.parametrize("label", ["fig:1dof_perf", "fig:exp_1dof_standard", "fig:1dof_passivity"])
def test_the_paper_s_figure_is_drawn_and_stored_with_its_labels(
    label: str, experiment: Experiment, tmp_path: Path
) -> None:
    figure = next(figure for figure in experiment.scenario.figures if figure.label == label)
    folder = results_on_disk.write(experiment=experiment, out=tmp_path, kept=Kept(csv=True))
    assert (folder / f"{figure.id}.png").read_bytes().startswith(b"\x89PNG")
    columns = read(folder / "figures" / f"{figure.id}.csv")
    assert "time [s]" in columns
    curves = [curve for panel in figure.panels for curve in panel.curves]
    assert len(columns) == 1 + len(curves)
    assert all(name.endswith(("[m]", "[N]")) for name in columns if name != "time [s]")
    parquet = read(folder / "figures" / f"{figure.id}.parquet")
    assert list(parquet) == list(columns)
    assert all((parquet[name] == columns[name]).all() for name in columns)
