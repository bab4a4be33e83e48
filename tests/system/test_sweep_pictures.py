"""A study's pictures."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
import pytest

from exo import sweep
from exo.errors import ExoError
from exo.sweep import pictures, study
from exo.sweep.pictures import front

from sweeping import WALL, sampled


def test_a_front_has_what_no_other_point_beats() -> None:
    x, y = np.array([3.0, 1.0, 2.0, 2.0, 4.0, 1.0]), np.array([1.0, 5.0, 3.0, 2.0, 1.0, 6.0])
    assert [(x[i], y[i]) for i in front(x, y)] == [(1.0, 5.0), (2.0, 2.0), (3.0, 1.0)]


POINTS = {
    "a": [1.0, 2.0, 3.0, 4.0],
    "b": [1.0, 2.0, 3.0, 4.0],
    "z": [0.0, 0.4, 0.6, 0.9],
    "yes": [True, True, True, False],
}


@pytest.mark.parametrize(
    ("settings", "columns", "drawn"),
    [
        ({"limit": 0.5}, {}, 4),
        ({"limit": 0.5}, {"b": [1.0] * 4}, 4),
        ({"limit": 0.5}, {"a": [1.0] * 4, "b": [1.0] * 4}, 4),
        ({"log": ["x"]}, {"a": [-1.0, -1.0, 2.0, 2.0], "b": [1.0, 2.0, 1.0, 2.0]}, 2),
        ({"where": {"yes": 1.0}}, {}, 3),
    ],
    ids=["a slope", "a line", "one point", "no logarithm", "a Boolean"],
)
def test_points_that_are_no_map_are_drawn_as_what_they_are(
    settings: dict[str, Any], columns: dict[str, Any], drawn: int, tmp_path: Path, monkeypatch: Any
) -> None:
    data = {"id": "f", "title": "f", "kind": "map", "x": "a", "y": "b", "color": "z", **settings}
    seen = []
    plain = pictures._map

    def look(axes: Any, of: Any, figure: Any, numbers: Any) -> None:
        seen.append(len(numbers["z"]))
        plain(axes, of, figure, numbers)

    monkeypatch.setattr(pictures, "_map", look)
    figure = study.Figure.model_validate_json(json.dumps(data))
    path = pictures.draw(figure, sampled("random"), pa.table({**POINTS, **columns}), tmp_path)
    assert seen == [drawn]
    assert path.stat().st_size > 5_000


@pytest.mark.parametrize(
    ("said", "scales"),
    [({}, ("log", "linear")), ({"log": []}, ("linear", "linear")), ({"log": ["y"]}, ("linear", "log"))],
)
def test_an_axis_of_scale_log_is_drawn_as_one_unless_the_figure_says_otherwise(
    said: dict[str, Any], scales: tuple[str, str], tmp_path: Path, monkeypatch: Any
) -> None:
    data = {"id": "f", "title": "f", "kind": "scatter", "x": "a", "y": "b", **said}
    figure = study.Figure.model_validate_json(json.dumps(data))
    seen = []
    monkeypatch.setattr(pictures.pyplot, "close", lambda drawing: seen.append(drawing.axes[0]))
    pictures.draw(figure, sampled("random"), pa.table({"a": [1.0, 100.0], "b": [1.0, 2.0]}), tmp_path)
    assert [(axes.get_xscale(), axes.get_yscale()) for axes in seen] == [scales]


def test_a_figure_that_cannot_be_drawn_leaves_the_others_and_says_where_the_runs_are(
    study_file: Path, fmu_dir: Path, tmp_path: Path
) -> None:
    nothing = '[[figures]]\nid = "none"\ntitle = "None"\nkind = "histogram"\nx = "tank"\nwhere = { tank = -7.0 }\n'
    study_file.write_text(WALL.replace("[[figures]]", nothing + "[[figures]]"))
    with pytest.raises(ExoError, match=r"figure none: no row has tank; the runs are in .*runs\.parquet"):
        sweep.sweep(study_file, out=tmp_path, workers=1, fmu_dir=fmu_dir)
    assert (tmp_path / "small" / "map.png").exists()


def test_where_all_runs_failed_the_first_reason_is_told(study_file: Path, fmu_dir: Path, tmp_path: Path) -> None:
    study_file.write_text(WALL.replace("[10.0, 20.0, 30.0]", "[-1.0, -2.0]"))
    with pytest.raises(ExoError, match=r"no row has .*; 4 of 4 failed, the first: .*K = -1.*; the runs are in"):
        sweep.sweep(study_file, out=tmp_path, workers=1, fmu_dir=fmu_dir)


def test_the_median_of_many_points_goes_through_their_middle_whatever_lies_outside() -> None:
    x = np.random.default_rng(1).uniform(0.0, 10.0, 5_000)
    y = 2.0 * x + np.tile([-1.0, 0.0, 0.0, 0.0, 50.0], 1_000)
    at, middle = pictures._medians(x, y)
    assert len(at) == pictures.PARTS
    # Within a part x goes by 0.4; half of it, twice.
    assert abs(middle - 2.0 * at).max() < 0.4
