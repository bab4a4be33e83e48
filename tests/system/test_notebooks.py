"""The notebooks of docs/notebooks: they run, and show what the repository has of them."""

import base64
import json
import re
from io import BytesIO
from pathlib import Path
from typing import Any

import nbformat
import numpy as np
import pytest
from matplotlib import image

from notebooks import NOTEBOOKS, executed, pictures, texts

from commands import exo


@pytest.fixture(scope="module")
def place(tmp_path_factory: pytest.TempPathFactory, fmu_dir: Path) -> Path:
    """Folders as in the repository, with the runs that the notebooks load."""
    root = tmp_path_factory.mktemp("clone")
    (root / "docs" / "notebooks").mkdir(parents=True)
    (root / "target").mkdir()
    (root / "target" / "fmu").symlink_to(fmu_dir, target_is_directory=True)
    arguments = ["--case", "*_5_0.5", "--engine", "native", "--fmu-dir", fmu_dir, "--out", root / "results"]
    assert exo("run", "wall", *arguments).exit_code == 0
    return root


@pytest.fixture(scope="module", params=NOTEBOOKS, ids=lambda path: path.stem)
def both(request: pytest.FixtureRequest, place: Path) -> tuple[Any, Any]:
    """A notebook as it is committed, and as it runs now."""
    now = executed(request.param, folder=place / "docs" / "notebooks")
    return nbformat.read(request.param, as_version=4), now


def test_the_notebook_shows_now_what_is_committed(both: tuple[Any, Any]) -> None:
    committed, now = both
    assert texts(committed) == texts(now), "python tests/system/notebooks.py"
    assert len(texts(now)) >= 4
    assert len(pictures(committed)) == len(pictures(now)) == 2
    for old, new in zip(pictures(committed), pictures(now), strict=True):
        seen = [image.imread(BytesIO(base64.b64decode(one))) for one in (old, new)]
        assert seen[0].shape == seen[1].shape
        # Another version of the fonts moves letters, not curves.
        assert np.abs(seen[0] - seen[1]).mean() < 0.01
        assert seen[0].std() > 0.05


def test_the_delays_in_the_notebook_are_those_of_the_scenario(both: tuple[Any, Any], place: Path) -> None:
    printed = dict(re.findall(r"^(\w+): ([\d.]+) s$", "\n".join(texts(both[1])), re.MULTILINE))
    metrics = json.loads((place / "results" / "wall" / "metrics.json").read_text(encoding="utf-8"))["metrics"]
    assert len(printed) == 2
    for law, delay in printed.items():
        assert float(delay) == pytest.approx(metrics[f"release_delay/{law}_5_0.5"]["value"], abs=5e-4)


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_a_committed_notebook_names_no_place_and_no_time(path: Path) -> None:
    text = path.read_text(encoding="utf-8")
    assert not re.search(r"(?<![\w.])/(home|root|tmp|usr|work|Users|opt)/", text)
    assert "iopub" not in text
    notebook = nbformat.reads(text, as_version=4)
    nbformat.validate(notebook)
    cells = [cell for cell in notebook.cells if cell.cell_type == "code"]
    assert [cell.execution_count for cell in cells] == [*range(1, len(cells) + 1)]
    outputs = [output for cell in cells for output in cell.outputs]
    assert not any(output.get("name") == "stderr" for output in outputs)
