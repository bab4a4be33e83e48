"""`exo compare`: what is the same is the same, whatever the numbers are; what differs is named in full."""

import json
import math
import os
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest

from exo import recording
from exo.compare import compare

from commands import SHORT, exo

NAN, INF = math.nan, math.inf
LONG_NAME = "controller.a_name_that_is_longer_than_a_terminal_is_wide.and_goes_on_and_on_until_it_does_not_fit[1]"


def table(path: Path, values: list[float], name: str = LONG_NAME, unit: str = "N") -> Path:
    fields = [pa.field("time", pa.float64()), pa.field(name, pa.float64(), metadata={"unit": unit})]
    columns = [pa.array(np.arange(float(len(values)))), pa.array(np.array(values))]
    recording.write(pa.table(columns, schema=pa.schema(fields)), path, csv=True)
    return path.with_suffix(".parquet")


@pytest.mark.parametrize("values", [[1.0, NAN, 2.0], [NAN, NAN, NAN], [INF, -INF, 1.0], [0.0, 0.0, 0.0]])
def test_a_signal_is_no_different_from_itself(values: list[float], tmp_path: Path) -> None:
    a, b = table(tmp_path / "a", values), table(tmp_path / "b", values)
    assert exo("compare", a, b, "--tolerance", 0).exit_code == 0
    assert exo("compare", a, b.with_suffix(".csv"), "--tolerance", 0).exit_code == 0


@pytest.mark.parametrize(
    ("one", "other", "share"),
    [
        ([1.0, NAN, 2.0], [1.0, NAN, 3.0], 1.0 / 3.0),
        ([1.0, NAN, 2.0], [1.0, 1.0, 2.0], INF),
        ([1.0, INF, 2.0], [1.0, -INF, 2.0], INF),
        ([1.0, 2.0], [1.0, 2.0, 3.0], INF),
    ],
)
def test_what_differs_beside_nan_is_found(one: list[float], other: list[float], share: float, tmp_path: Path) -> None:
    a, b = table(tmp_path / "a", one), table(tmp_path / "b", other)
    assert next(d for d in compare(a, b) if d.name == LONG_NAME).share == pytest.approx(share)
    assert exo("compare", a, b, "--tolerance", 100).exit_code == (0 if math.isfinite(share) else 1)


def test_names_are_whole_in_a_pipe_and_numbers_have_units(tmp_path: Path) -> None:
    a, b = table(tmp_path / "a", [1.0]), table(tmp_path / "b", [2.0])
    answer = exo("compare", a, b)
    (row,) = [line for line in answer.stdout.splitlines() if LONG_NAME in line]
    assert row.split() == ["signal", LONG_NAME, "1", "2", "N", "0.5"]


def test_the_answer_as_json_has_every_difference(tmp_path: Path) -> None:
    a, b = table(tmp_path / "a", [1.0, NAN]), table(tmp_path / "b", [2.0, 1.0])
    answer = exo("compare", a, b, "--json")
    assert answer.exit_code == 1
    found = json.loads(answer.stdout)
    assert found["compared"] == 2
    (row,) = found["beyond"]
    assert row == {
        "kind": "signal", "name": LONG_NAME, "unit": "N", "a": 1.0, "b": 2.0, "share": None, "why": "not finite in one",
    }  # fmt: skip


def test_metrics_have_units_and_undefined_ones_are_equal(tmp_path: Path, fmu_dir: Path) -> None:
    short = tmp_path / "short.toml"
    short.write_text(SHORT, encoding="utf-8")
    for name, gain in (("a", 30), ("b", 20)):
        exo("run", short, "--fmu-dir", fmu_dir, "--out", tmp_path / name, "--set", f"controller.K={gain}")
    found = json.loads(exo("compare", tmp_path / "a", tmp_path / "b", "--json").stdout)["beyond"]
    assert next(row for row in found if row["kind"] == "metric")["unit"] == "m"
    assert next(row for row in found if row["name"].endswith(": controller.tau_a"))["unit"] == "N"
    shutil.copytree(tmp_path / "a" / "short", tmp_path / "a" / ".short.x.new")
    assert "missing" not in exo("compare", tmp_path / "a", tmp_path / "b").stdout
    for name in ("a", "b"):
        path = tmp_path / name / "short" / "metrics.json"
        document = json.loads(path.read_text(encoding="utf-8"))
        document["metrics"]["moved/push"]["value"] = None
        path.write_text(json.dumps(document), encoding="utf-8")
    answer = exo("compare", tmp_path / "a", tmp_path / "b")
    assert "moved/push" not in answer.stdout


def test_a_terminal_that_lacks_letters_gets_their_numbers(tmp_path: Path) -> None:
    table(tmp_path / "a", [1.0], name="one")
    table(tmp_path / "b", [1.0], name="other")
    command = [sys.executable, "-m", "exo", "compare", tmp_path / "a.csv", tmp_path / "b.csv"]
    environment = os.environ | {"PYTHONIOENCODING": "latin-1", "PYTHONUTF8": "0"}
    answer = subprocess.run(command, capture_output=True, env=environment, check=False)
    assert (answer.returncode, answer.stderr) == (1, b"")
    assert b"missing  one    \\u2013" in answer.stdout


@pytest.mark.parametrize("data", [b"", b"{", b"{}", b'{"metrics": {"a": 1}}', b"\xff"])
def test_a_broken_file_is_named(data: bytes, tmp_path: Path) -> None:
    for name in ("a", "b"):
        (tmp_path / name).mkdir()
        (tmp_path / name / "metrics.json").write_bytes(data)
    answer = exo("compare", tmp_path / "a", tmp_path / "b")
    assert (answer.exit_code, "error of exo itself" in answer.stderr) == (2, False)
    assert "metrics.json" in answer.stderr
    (tmp_path / "a.parquet").write_bytes(data)
    answer = exo("compare", tmp_path / "a.parquet", tmp_path / "a.parquet")
    assert (answer.exit_code, "error of exo itself" in answer.stderr) == (2, False)
    assert "a.parquet" in answer.stderr


@pytest.mark.parametrize(
    ("data", "said"),
    [
        ("time,Stöße\n0,1\n1,2\n".encode("latin-1"), "is no UTF-8; expected"),
        (b"time,q\n0,1\n1,\xe4\n", "is no UTF-8; expected"),
        (b"time,q,q\n0,1,2\n1,2,3\n", "column q is there twice; expected each name once"),
        (b"time,q\ns,m\n0,far\n", "q: expected numbers"),
        (b"time,q\n0," + b"1" * 200_000 + b'\n"', "cannot be read"),
    ],
)
def test_a_table_of_another_program_that_cannot_be_compared_is_named(data: bytes, said: str, tmp_path: Path) -> None:
    path = tmp_path / "a.csv"
    path.write_bytes(data)
    answer = exo("compare", path, path)
    assert (answer.exit_code, "error of exo itself" in answer.stderr) == (2, False), answer.stderr
    assert answer.stderr.startswith(f"exo: {path}: ")
    assert said in answer.stderr


def test_a_unit_that_is_no_utf_8_is_shown_as_far_as_it_goes(tmp_path: Path) -> None:
    path = tmp_path / "a.parquet"
    pq.write_table(
        pa.table([[1.0]], schema=pa.schema([pa.field("q", pa.float64(), metadata={"unit": b"\xb0C"})])), path
    )
    assert exo("compare", path, path).exit_code == 0
    assert recording.units_of(path) == {"q": "\ufffdC"}


@pytest.mark.parametrize("options", [(), ("--excel", "--decimal", "point"), ("--excel", "--decimal", "comma")])
def test_an_exported_table_is_no_different_from_its_run_and_has_its_units(
    options: tuple[str, ...], tmp_path: Path
) -> None:
    values = [0.1, NAN, -2.5e-30]
    run = table(tmp_path / "a", values)
    assert exo("export", run, "--out", tmp_path / "out", *options).exit_code == 0
    exported = tmp_path / "out" / "a.csv"
    assert exported.read_text(encoding="utf-8-sig").splitlines()[1][:2] in ("s,", "s;")
    answer = exo("compare", run, exported, "--tolerance", 0)
    assert answer.exit_code == 0, answer.output
    other = table(tmp_path / "b", [0.1, NAN, 1.0])
    assert exo("export", other, "--out", tmp_path / "out", *options).exit_code == 0
    (row,) = [d for d in compare(exported, tmp_path / "out" / "b.csv") if d.name == LONG_NAME]
    assert (row.a, row.b, row.unit) == (0.1, 1.0, "N")
    assert row.share == pytest.approx(1.0)


@pytest.mark.parametrize("tolerance", ["nan", "-1", "inf"])
def test_a_tolerance_that_is_none_is_refused(tolerance: str, tmp_path: Path) -> None:
    path = table(tmp_path / "a", [1.0])
    answer = exo("compare", path, path, "--tolerance", tolerance)
    assert answer.exit_code == 2
    assert "--tolerance" in answer.stderr
