"""`exo export`: the signals of a run for other programs, each file read by a program that is not exo."""

import csv
import locale
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest
import scipy.io

import exo
from exo import export, recording
from exo.export import matlab, text

from commands import SHORT
from commands import exo as command


@pytest.fixture(scope="module")
def results(tmp_path_factory: pytest.TempPathFactory, fmu_dir: Path) -> Path:
    """A scenario's folder with two cases."""
    folder = tmp_path_factory.mktemp("results")
    path = folder / "short.toml"
    path.write_text(SHORT + '[[cases]]\nid = "weak"\n[cases.parameters]\n"controller.K" = 10.0\n', encoding="utf-8")
    assert command("run", path, "--out", folder, "--fmu-dir", fmu_dir).exit_code == 0
    return folder / "short"


@pytest.fixture(scope="module")
def run(results: Path) -> exo.Run:
    return exo.read_run(results, case="push")


def test_csv_has_names_then_units_then_every_bit(results: Path, run: exo.Run, tmp_path: Path) -> None:
    answer = command("export", results, "--out", tmp_path)
    assert answer.exit_code == 0, answer.output
    assert {path.name for path in tmp_path.iterdir()} == {"push.csv", "weak.csv"}
    with (tmp_path / "push.csv").open(encoding="utf-8", newline="") as file:
        names, units, *rows = csv.reader(file)
    assert names == ["time", *run.signals]
    assert dict(zip(names, units, strict=True)) == run.units
    assert len(rows) == len(run.time)
    columns = dict(zip(names, zip(*rows, strict=True), strict=True))
    assert np.array_equal(np.array(columns["plant.q"], dtype=float), run["plant.q"])
    assert np.array_equal(np.array(columns["time"], dtype=float), run.time)
    assert set(columns["controller.engaged"]) <= {"0", "1"}
    table = pd.read_csv(tmp_path / "push.csv", header=[0, 1])
    assert table["plant.tau_e", "N"].to_numpy().tobytes() == run["plant.tau_e"].tobytes()


@pytest.mark.parametrize(("decimal", "between"), [("comma", ";"), ("point", ",")])
def test_excel_gets_its_mark_its_separators_and_its_decimals(
    decimal: str, between: str, results: Path, run: exo.Run, tmp_path: Path
) -> None:
    arguments = ["--excel", "--decimal", decimal, "--case", "push", "--out", tmp_path]
    assert command("export", results, *arguments).exit_code == 0
    data = (tmp_path / "push.csv").read_bytes()
    # Without the mark Excel reads N·m as N·m only where the system's letters are UTF-8.
    assert data.startswith(b"\xef\xbb\xbftime" + between.encode())
    lines = data.decode("utf-8-sig").splitlines()
    assert csv.Sniffer().sniff("\n".join(lines[2:40]), delimiters=";,\t").delimiter == between
    assert {len(line.split(between)) for line in lines} == {1 + len(run.signals)}
    table = pd.read_csv(
        tmp_path / "push.csv",
        sep=between,
        decimal="," if decimal == "comma" else ".",
        header=[0, 1],
        encoding="utf-8-sig",
    )
    assert [name for name, _ in table.columns] == ["time", *run.signals]
    assert lines[1].split(between) == list(run.units.values())
    assert table["plant.q", "m"].to_numpy().tobytes() == run["plant.q"].tobytes()
    assert table["plant.energy.residual", "J"].to_numpy().tobytes() == run["plant.energy.residual"].tobytes()


def test_excel_without_a_decimal_takes_the_separators_of_the_system(monkeypatch: pytest.MonkeyPatch) -> None:
    before = locale.setlocale(locale.LC_NUMERIC)
    for point, expected in ((",", "comma"), (".", "point")):
        monkeypatch.setattr(locale, "localeconv", lambda point=point: {"decimal_point": point})
        assert text.separators(excel=True, decimal=None).decimal == expected
        assert text.separators(excel=False, decimal=None).decimal == "point"
    assert locale.setlocale(locale.LC_NUMERIC) == before


def test_a_table_that_excel_would_cut_is_refused(tmp_path: Path) -> None:
    rows = text.EXCEL_ROWS - 1
    table = recording.table(
        time=np.arange(rows, dtype=float), columns={"x": np.zeros(rows)}, units={}, parameters={}, choices={}
    )
    with pytest.raises(exo.ExoError, match="1048577 rows of 2 columns; Excel's sheets hold 1048576"):
        export.write(table, tmp_path / "long.csv", separators=text.Separators(excel=True))
    assert not list(tmp_path.iterdir())


def test_what_is_no_number_is_an_empty_cell(tmp_path: Path) -> None:
    table = recording.table(
        time=np.array([0.0, 1.0]), columns={"x": np.array([np.nan, 1e-7])}, units={}, parameters={}, choices={}
    )
    path = export.write(table, tmp_path / "x.csv", separators=text.Separators(decimal="comma"))
    rows = path.read_text(encoding="utf-8").splitlines()
    assert rows[:3] == ["time;x", "s;", "0;"]
    assert float(rows[3].replace(",", ".").split(";")[1]) == 1e-7


def test_mdf4_has_units_and_the_time_in_seconds(results: Path, run: exo.Run, tmp_path: Path) -> None:
    asammdf = pytest.importorskip("asammdf", reason="optional: pip install asammdf")
    assert command("export", results, "--format", "mdf4", "--case", "push", "--out", tmp_path).exit_code == 0
    with asammdf.MDF(tmp_path / "push.mf4") as file:
        assert file.version == "4.10"
        assert set(file.channels_db) == {"time", *run.signals}
        for name in run.signals:
            channel = file.get(name)
            assert channel.unit == run.units[name], name
            assert np.array_equal(channel.samples, run[name]), name
            assert np.array_equal(channel.timestamps, run.time), name
        assert file.get("time").unit == "s"
        assert file.get("plant.q").samples.dtype == np.float64


def test_without_asammdf_one_sentence_says_what_to_install(results: Path, tmp_path: Path) -> None:
    code = "import sys; sys.modules['asammdf'] = None; from exo.cli import app; app()"
    arguments = ["export", results, "--format", "mdf4", "--out", tmp_path / "out"]
    answer = subprocess.run([sys.executable, "-c", code, *arguments], capture_output=True, text=True, check=False)
    assert answer.returncode == 2
    assert answer.stderr == ("exo: MDF4 needs the package asammdf, which is not installed: `pip install asammdf`\n")
    assert not (tmp_path / "out").exists()


def test_matlab_gets_structs_of_the_same_fields(results: Path, run: exo.Run, tmp_path: Path) -> None:
    assert command("export", results, "--format", "matlab", "--out", tmp_path).exit_code == 0
    found: dict[str, Any] = scipy.io.loadmat(tmp_path / "push.mat", simplify_cells=True)
    assert np.array_equal(found["time"], run.time)
    names = found["names"]
    assert sorted(names.values()) == sorted(run.signals)
    assert names["plant_energy_loss_wall"] == "plant.energy.loss_wall"
    for field, name in names.items():
        assert field.isidentifier()
        assert field.isascii()
        assert len(field) <= 63
        assert np.array_equal(found["signals"][field], run[name]), name
        assert (found["units"][field] if len(found["units"][field]) else "") == run.units[name]
    columns = scipy.io.loadmat(tmp_path / "push.mat")
    assert columns["time"].shape == (500, 1)
    assert (tmp_path / "push.mat").read_bytes().startswith(b"MATLAB 5.0 MAT-file")


NUMBERS = [0.0, -0.0, np.nan, np.inf, -np.inf, 5e-324, 2.2250738585072014e-308, 1.7976931348623157e308, 0.1, 1e22, 1e-7]


@pytest.mark.parametrize("rows", [1, len(NUMBERS)])
def test_every_format_gives_every_number_back_by_its_bits(rows: int, tmp_path: Path) -> None:
    """Those that a run rarely has, among them one row only, and a unit and a name that are not ASCII."""
    asammdf = pytest.importorskip("asammdf", reason="optional: pip install asammdf")
    numbers, time = np.array(NUMBERS[:rows]), np.arange(rows) * 0.002
    counts = np.array([-(2**31), 2**31 - 1, *range(rows)][:rows], dtype=np.int32)
    columns = {"größe.τ[1]": numbers, "plant.count": counts, "plant.on": counts % 2 == 1}
    units = {"größe.τ[1]": "N·m", "plant.count": "1"}
    table = recording.table(time=time, columns=columns, units=units, parameters={}, choices={})
    files = {ending: export.write(table, tmp_path / f"a{ending}") for ending in (".csv", ".mat", ".mf4", ".parquet")}

    with asammdf.MDF(files[".mf4"]) as file:
        found = {name: file.get(name) for name in columns}
    assert found["größe.τ[1]"].unit == "N·m"
    assert found["größe.τ[1]"].samples.tobytes() == numbers.tobytes()
    assert found["plant.count"].timestamps.tobytes() == time.tobytes()
    assert np.array_equal(found["plant.count"].samples, counts)
    assert np.array_equal(found["plant.on"].samples, columns["plant.on"])

    matlab_file = scipy.io.loadmat(files[".mat"])
    signals, names = matlab_file["signals"][0, 0], matlab_file["names"][0, 0]
    fields = {str(names[field][0]): signals[field] for field in names.dtype.names}
    assert set(fields) == set(columns)
    for name, values in columns.items():
        assert fields[name].shape == (rows, 1)
        assert np.array_equal(fields[name][:, 0], values, equal_nan=values.dtype == np.float64), name
    assert fields["größe.τ[1]"].tobytes() == numbers.tobytes()
    assert fields["plant.count"].dtype == np.int32

    frame = pd.read_parquet(files[".parquet"])
    assert frame["größe.τ[1]"].to_numpy().tobytes() == numbers.tobytes()
    assert frame.attrs["units"]["größe.τ[1]"] == "N·m"
    assert list(frame.dtypes[1:]) == [np.float64, np.int32, bool]

    with files[".csv"].open(encoding="utf-8", newline="") as file:
        header, second, *lines = csv.reader(file)
    assert (header, second) == (["time", *columns], ["s", "N·m", "1", ""])
    # A cell without a number is NaN.
    read = np.array([float(line[1]) if line[1] else np.nan for line in lines])
    assert read.tobytes() == numbers.tobytes()
    assert [line[2:] for line in lines] == [[str(count), str(count % 2)] for count in counts.tolist()]


def test_names_of_matlab_are_valid_and_no_two_alike() -> None:
    long = "controller." + "x" * 80
    given = ["plant.p[1]", "plant.p_1", "plant.p[1,2]", "end", "2nd", "der(x)", "θ", long, long + "y"]
    found = matlab.names(given)
    assert found["plant.p[1]"] == "plant_p_1"
    assert found["plant.p_1"] == "plant_p_1_2"
    assert found["end"] == "end_2"
    assert found["2nd"] == "x2nd"
    assert found["der(x)"] == "der_x"
    assert len(set(found.values())) == len(given)
    assert all(one.isidentifier() and one.isascii() and len(one) <= 63 for one in found.values())


def test_signals_rows_and_single_files_are_chosen(results: Path, run: exo.Run, tmp_path: Path) -> None:
    chosen = ["--signal", "plant.q", "--signal", "plant.energy.*", "--every", 10]
    assert command("export", results / "signals" / "push.parquet", *chosen, "--out", tmp_path).exit_code == 0
    table = pd.read_csv(tmp_path / "push.csv", header=[0, 1])
    assert table.shape == (50, 2 + len(run.names("plant.energy.*")))
    assert np.array_equal(table["plant.q", "m"], run["plant.q"][::10])


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["--format", "xlsx"], "--format xlsx: expected one of csv, mdf4, matlab"),
        (["--format", "mdf4", "--excel"], "--format mdf4: has no --excel and no --decimal"),
        (["--decimal", "dot"], "--decimal dot: expected point or comma"),
        (["--every", 0], "--every 0: expected 1 or more"),
        (["--case", "pull"], "--case pull: no such case of"),
        (["--signal", "plant.qq"], "no signal plant.qq (close matches: plant.q"),
    ],
)
def test_what_cannot_be_exported_is_a_sentence(
    arguments: list[object], said: str, results: Path, tmp_path: Path
) -> None:
    answer = command("export", results, *arguments, "--out", tmp_path / "out")
    assert answer.exit_code == 2
    assert said in answer.stderr
    assert not (tmp_path / "out").exists()


def test_a_folder_without_signals_says_what_is_missing(results: Path, tmp_path: Path) -> None:
    for place, said in (
        (tmp_path / "none", "no such folder; expected a scenario's results, as results/wall"),
        (results.parent, "expected the folder of one scenario's results (short)"),
        (results / "figures", "has no signals"),
    ):
        answer = command("export", place, "--out", tmp_path / "out")
        assert (answer.exit_code, said in answer.stderr) == (2, True), answer.stderr


def test_an_export_into_a_folder_that_has_one_is_refused_whole_or_replaces_it(results: Path, tmp_path: Path) -> None:
    (tmp_path / "weak.csv").write_text("mine", encoding="utf-8")
    refused = command("export", results, "--out", tmp_path)
    assert refused.exit_code == 2
    assert "weak.csv: is there already; expected another --out, or --overwrite" in refused.stderr
    assert [path.name for path in tmp_path.iterdir()] == ["weak.csv"]
    assert command("export", results, "--out", tmp_path, "--overwrite").exit_code == 0
    assert (tmp_path / "weak.csv").read_text(encoding="utf-8").startswith("time,")


def test_a_file_that_cannot_be_written_whole_leaves_what_was_there(
    run: exo.Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = run.save(tmp_path / "push.csv", "plant.q")
    before = path.read_bytes()

    def full(_: object, file: Path, *__: object) -> None:
        file.write_bytes(b"half")
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(text, "write", full)
    with pytest.raises(exo.ExoError, match=r"push\.csv: cannot be written: No space left on device"):
        run.save(tmp_path / "push.csv")
    assert path.read_bytes() == before
    assert [one.name for one in tmp_path.iterdir()] == ["push.csv"]
