"""Where an archive lies and where the process works makes no difference: odd names, another folder, a read-only one."""

import json
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Mapping
from pathlib import Path

import pytest

from exo.fmu import Archive

from foreign.contents import contents
from foreign.record import record
from foreign.runs import RUNS, by_calls, product

#: Spaces, what looks like an escape but is none, other letters, braces.
ODD = "a folder %20 für {1-2} 資源"
STEPS = 100


CHILD = Path(__file__).parent / "foreign" / "frozen_child.py"


# One controller and one plant through every importer; tests/abi/tests/resources.rs has every FMU.
@pytest.mark.parametrize("name", ["TestbedController.fmu", "ExoskeletonArm.fmu"])
@pytest.mark.parametrize("importer", RUNS)
def test_an_importer_runs_an_archive_in_a_folder_of_any_name_from_another_folder(
    importer: str, name: str, archives: Mapping[str, Archive], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    run, clock = RUNS[importer]
    usual = archives[name]
    expected = by_calls(usual, record(usual, steps=STEPS), clock)

    odd, elsewhere = tmp_path / ODD, tmp_path / "elsewhere"
    temporary = odd / "unpacked"
    for folder in (temporary, elsewhere):
        folder.mkdir(parents=True)
    path = Path(shutil.copy(usual.path, odd))
    monkeypatch.chdir(elsewhere)
    monkeypatch.setenv("TMPDIR", str(temporary))
    monkeypatch.setattr(tempfile, "tempdir", str(temporary))
    before = contents(odd)
    with Archive(path) as archive:
        assert Path(archive.folder).is_relative_to(temporary)
        found = run(archive, record(archive, steps=STEPS), tmp_path)
    assert {name: values.tobytes() for name, values in found.items()} == {
        name: values.tobytes() for name, values in expected.items()
    }
    assert contents(odd) == before, "nothing is written beside the archive, and nothing unpacked is left"
    assert contents(elsewhere) == {}


def test_an_fmu_runs_from_a_folder_that_cannot_be_written(
    fmu: Path, archives: Mapping[str, Archive], tmp_path: Path
) -> None:
    folder, elsewhere = tmp_path / ODD, tmp_path / "elsewhere"
    folder.mkdir()
    elsewhere.mkdir()
    path = Path(shutil.copy(fmu, folder))
    child = subprocess.run(
        [sys.executable, CHILD, path, folder], cwd=elsewhere, capture_output=True, text=True, check=False, timeout=60
    )
    assert child.returncode == 0, child.stderr
    assert child.stderr == ""
    answer = json.loads(child.stdout)
    assert answer["frozen"], "the folder could be written, so nothing was tested"
    assert answer["changed"] == []
    assert contents(elsewhere) == {}
    usual = archives[fmu.name]
    expected = by_calls(usual, record(usual, steps=STEPS), product)
    assert answer["outputs"] == {name: values.tolist() for name, values in expected.items()}
