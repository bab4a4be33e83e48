"""Sweeps: the table, its folder, rows that fail."""

import errno
import json
import tempfile
from collections import Counter
from pathlib import Path
from typing import Any

import pyarrow.parquet as pq
import pytest

from exo import folder, sweep
from exo.errors import ExoError
from exo.runs import FAILURE
from exo.sweep import store

from sweeping import WALL


def test_a_grid_has_every_point_once_and_a_picture(
    study_file: Path, fmu_dir: Path, tmp_path: Path, monkeypatch: Any
) -> None:
    """Also where a machine that was switched off has left an empty part; and no file of an FMU stays behind."""
    parts, temporary = tmp_path / "out" / "small" / "parts", tmp_path / "temporary"
    parts.mkdir(parents=True)
    for name in ("00000000.parquet", ".00000001.parquet.half"):
        (parts / name).write_bytes(b"")
    temporary.mkdir()
    monkeypatch.setenv("TMPDIR", str(temporary))
    monkeypatch.setattr(tempfile, "tempdir", str(temporary))
    told: list[sweep.Progress] = []
    done = sweep.sweep(study_file, out=tmp_path / "out", workers=2, fmu_dir=fmu_dir, tell=told.append)
    assert done.failed == 0
    assert done.table[store.ROW].to_pylist() == list(range(6))
    points = zip(done.table["controller.K"].to_pylist(), done.table["controller.M_n"].to_pylist(), strict=True)
    assert Counter(points) == Counter((K, M) for K in (10.0, 20.0, 30.0) for M in (2.0, 8.0))
    assert [path.name for path in done.pictures] == ["map.png"]
    assert done.pictures[0].stat().st_size > 10_000
    assert [told[0].done, told[-1].done] == [0, 6]
    assert not list(parts.iterdir())
    assert not list(temporary.glob("exo-*"))


def test_a_sweep_that_is_done_is_not_run_again_and_pictures_may_change(
    study_file: Path, fmu_dir: Path, tmp_path: Path
) -> None:
    first = sweep.sweep(study_file, out=tmp_path / "out", workers=1, fmu_dir=fmu_dir)
    study_file.write_text(WALL.replace("limit = 0.4", "limit = 0.3"))
    again = sweep.sweep(study_file, out=tmp_path / "out", workers=1, fmu_dir=fmu_dir)
    assert again.table.equals(first.table)  # the seconds, too
    study_file.write_text(WALL.replace("30.0]", "31.0]"))
    with pytest.raises(ExoError, match="another study: study, rows differ; expected another --out, or --fresh"):
        sweep.sweep(study_file, out=tmp_path / "out", workers=1, fmu_dir=fmu_dir)
    study_file.write_text(WALL)
    (first.folder / store.TABLE).write_bytes(b"half a table")
    with pytest.raises(ExoError, match=r"runs\.parquet: cannot be read; expected another --out, or --fresh"):
        sweep.sweep(study_file, out=tmp_path / "out", workers=1, fmu_dir=fmu_dir)
    study_file.write_text(WALL.replace("30.0]", "31.0]"))
    fresh = sweep.sweep(study_file, out=tmp_path / "out", workers=1, fmu_dir=fmu_dir, fresh=True)
    assert fresh.table["controller.K"].to_pylist()[-1] == 31.0


def test_a_row_that_fails_is_a_row_with_its_reason(study_file: Path, fmu_dir: Path, tmp_path: Path) -> None:
    study_file.write_text(WALL.replace("[10.0, 20.0, 30.0]", "[10.0, -1.0]"))
    done = sweep.sweep(study_file, out=tmp_path / "out", workers=2, fmu_dir=fmu_dir)
    assert done.failed == 2
    errors = done.table[FAILURE].to_pylist()
    assert errors[:2] == [None, None]
    assert all("K = -1" in text and "expected a value from" in text for text in errors[2:])


def test_a_full_disk_is_named_and_what_is_finished_is_kept(
    study_file: Path, fmu_dir: Path, tmp_path: Path, monkeypatch: Any
) -> None:
    plain, written = folder.write_file, []

    def write_file(path: Path, data: bytes) -> None:
        written.append(path)
        if len(written) == 3:  # the study's file, a part, and this
            raise OSError(errno.ENOSPC, "No space left on device")
        plain(path, data)

    monkeypatch.setattr(folder, "write_file", write_file)
    with pytest.raises(ExoError, match=r"parquet: No space left on device; what was finished is kept"):
        sweep.sweep(study_file, out=tmp_path, workers=1, fmu_dir=fmu_dir)
    told: list[sweep.Progress] = []
    done = sweep.sweep(study_file, out=tmp_path, workers=1, fmu_dir=fmu_dir, tell=told.append)
    assert told[0].kept_before > 0
    assert done.table[store.ROW].to_pylist() == list(range(6))


def test_the_table_opens_in_parquet_with_what_was_asked_for_beside_it(
    study_file: Path, fmu_dir: Path, tmp_path: Path
) -> None:
    done = sweep.sweep(study_file, out=tmp_path, workers=1, fmu_dir=fmu_dir)
    table = pq.read_table(done.folder / store.TABLE)
    assert table.column_names == [
        "row",
        "controller.K",
        "controller.M_n",
        "release_delay",
        "tank",
        "failure",
        "seconds",
    ]
    told = json.loads((done.folder / store.STUDY).read_text())
    assert told["study"]["sampling"]["seed"] == 1
    assert set(told["fmus"]) == {"Testbed.fmu", "TestbedController.fmu"}
