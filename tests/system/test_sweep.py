"""Sweeps: the table, its folder, rows that fail."""

import errno
import json
import re
import shutil
import tempfile
import zipfile
from collections import Counter
from pathlib import Path
from typing import Any

import pyarrow.parquet as pq
import pytest
from matplotlib.figure import Figure

from exo import sweep
from exo.commands.sweep import Line
from exo.errors import ExoError
from exo.runs import FAILURE
from exo.sweep import local, store

from commands import exo
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
    was = r"study\.axes\.controller\.K\.values is \[10\.0, 20\.0, 31\.0\], was \[10\.0, 20\.0, 30\.0\]"
    with pytest.raises(ExoError, match=rf"another study: {was}; expected another --out, or --fresh"):
        sweep.sweep(study_file, out=tmp_path / "out", workers=1, fmu_dir=fmu_dir)
    study_file.write_text(WALL)
    (first.folder / store.TABLE).write_bytes(b"half a table")
    with pytest.raises(ExoError, match=r"runs\.parquet: cannot be read; expected another --out, or --fresh"):
        sweep.sweep(study_file, out=tmp_path / "out", workers=1, fmu_dir=fmu_dir)
    study_file.write_text(WALL.replace("30.0]", "31.0]"))
    fresh = sweep.sweep(study_file, out=tmp_path / "out", workers=1, fmu_dir=fmu_dir, fresh=True)
    assert fresh.table["controller.K"].to_pylist()[-1] == 31.0


def test_words_of_a_study_may_change_and_an_fmu_may_not(study_file: Path, fmu_dir: Path, tmp_path: Path) -> None:
    """Between a kill and the command that goes on, too: its parts are looked at in the same way."""
    first = sweep.sweep(study_file, out=tmp_path / "out", workers=1, fmu_dir=fmu_dir)
    study_file.write_text(
        WALL.replace("values =", 'label = "K [N·s/m]"\nvalues =').replace('"Time to', '"How long to', 1)
    )
    assert sweep.sweep(study_file, out=tmp_path / "out", workers=1, fmu_dir=fmu_dir).table.equals(first.table)
    assert "How long to let go" in (first.folder / store.STUDY).read_text(encoding="utf-8")
    built_again = tmp_path / "fmus"
    built_again.mkdir()
    for name in ("Testbed.fmu", "TestbedController.fmu"):
        shutil.copy(fmu_dir / name, built_again)
    with zipfile.ZipFile(built_again / "Testbed.fmu", "a") as archive:
        archive.comment = b"built again"
    with pytest.raises(ExoError, match=r"another study: Testbed\.fmu is another one; expected another --out, or"):
        sweep.sweep(study_file, out=tmp_path / "out", workers=1, fmu_dir=built_again)


def test_a_worker_that_finds_another_fmu_than_the_first_one_mixes_no_rows(
    study_file: Path, fmu_dir: Path, tmp_path: Path
) -> None:
    """The archive is built again while the sweep runs; a worker that begins after that would open the new one."""
    built = tmp_path / "fmus"
    built.mkdir()
    for name in ("Testbed.fmu", "TestbedController.fmu"):
        shutil.copy(fmu_dir / name, built)

    def build_again(progress: sweep.Progress) -> None:
        assert progress.done == 0
        with zipfile.ZipFile(built / "Testbed.fmu", "a") as archive:
            archive.comment = b"built again"

    with pytest.raises(ExoError, match=r"Testbed\.fmu: has changed since the sweep began; expected the same FMU"):
        sweep.sweep(study_file, out=tmp_path / "out", workers=1, fmu_dir=built, tell=build_again)


def test_a_table_that_lacks_rows_is_refused_and_none_is_run_for_it(
    study_file: Path, fmu_dir: Path, tmp_path: Path
) -> None:
    done = sweep.sweep(study_file, out=tmp_path / "out", workers=1, fmu_dir=fmu_dir)
    pq.write_table(done.table.slice(0, 4), done.folder / store.TABLE)
    with pytest.raises(ExoError, match=r"runs\.parquet: has 4 rows, not rows 0 to 5 once each; expected another --out"):
        sweep.sweep(study_file, out=tmp_path / "out", workers=1, fmu_dir=fmu_dir)
    assert not list((done.folder / "parts").iterdir())


def test_a_sweep_of_which_every_row_fails_is_no_success(study_file: Path, fmu_dir: Path, tmp_path: Path) -> None:
    for values, failed, code in (("[-1.0, -2.0]", 4, 1), ("[-1.0, 20.0]", 2, 0)):
        study_file.write_text(WALL[: WALL.index("[[figures]]")].replace("[10.0, 20.0, 30.0]", values))
        answer = exo("sweep", study_file, "--out", tmp_path / str(code), "--fmu-dir", fmu_dir, "--workers", 1)
        assert answer.exit_code == code, answer.output
        said = " ".join(answer.stdout.split())
        assert (
            f"4 runs, {failed} of them failed, see column failure; the first: wall: case passive_bounded_5_0.5: "
            in said
        )
        assert "K = -1 N.s/m, expected a value from" in said


@pytest.mark.parametrize("workers", [-1, 0, 100_000])
def test_as_many_workers_as_no_machine_bears_are_refused(
    workers: int, study_file: Path, tmp_path: Path, fmu_dir: Path
) -> None:
    answer = exo("sweep", study_file, "--workers", workers, "--out", tmp_path, "--fmu-dir", fmu_dir)
    assert answer.exit_code == 2
    assert f"--workers {workers}: expected 1 to {local.MOST}" in answer.output
    assert not list(tmp_path.glob("small"))


def test_workers_and_a_cluster_are_not_asked_for_together(study_file: Path, tmp_path: Path, fmu_dir: Path) -> None:
    with pytest.raises(ExoError, match=r"--workers 2, --scheduler tcp://a:1: expected one of them"):
        sweep.sweep(study_file, out=tmp_path, workers=2, scheduler="tcp://a:1", fmu_dir=fmu_dir)


def test_a_log_gets_a_line_now_and_then_with_an_estimate() -> None:
    """400 of 1000 rows are from before; the first worker needs 20 s to begin, then ten rows a second run."""
    line = Line("study")
    said = [line.of(sweep.Progress(400, 1000, 400, 0), 100.0)]
    said += [line.of(sweep.Progress(400 + 10 * i, 1000, 400, i), 120.0 + i) for i in range(1, 61)]
    assert [text for text in said if text] == [
        "study: 500 of 1000 runs, 10 of them failed; about 50 s left",
        "study: 800 of 1000 runs, 40 of them failed; about 20 s left",
    ]


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
    plain, written = Path.replace, []

    def replace(self: Path, target: Path) -> Path:
        written.append(target)
        if len(written) == 3:  # the study's file, a part, and this
            raise OSError(errno.ENOSPC, "No space left on device", str(self))
        return plain(self, target)

    monkeypatch.setattr(Path, "replace", replace)
    with pytest.raises(ExoError) as error:
        sweep.sweep(study_file, out=tmp_path, workers=1, fmu_dir=fmu_dir)
    said = "cannot be written: No space left on device; what was finished is kept, and the same command goes on"
    assert str(error.value) == f"{written[-1]}: {said}"
    told: list[sweep.Progress] = []
    done = sweep.sweep(study_file, out=tmp_path, workers=1, fmu_dir=fmu_dir, tell=told.append)
    assert told[0].kept_before > 0
    assert done.table[store.ROW].to_pylist() == list(range(6))


@pytest.mark.parametrize("what", ["study.json", "map.png"])
def test_a_disk_that_is_full_at_first_or_at_last_is_named_with_the_file(
    what: str, study_file: Path, fmu_dir: Path, tmp_path: Path, monkeypatch: Any
) -> None:
    full, plain = OSError(errno.ENOSPC, "No space left on device"), Path.replace

    def replace(self: Path, target: Path) -> Path:
        if target.name == what:
            raise full
        return plain(self, target)

    def savefig(*_: Any, **__: Any) -> None:
        raise full

    monkeypatch.setattr(Path, "replace", replace)
    monkeypatch.setattr(Figure, "savefig", savefig)
    with pytest.raises(ExoError, match=rf"{re.escape(what)}: .*No space left on device"):
        sweep.sweep(study_file, out=tmp_path, workers=1, fmu_dir=fmu_dir)


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
