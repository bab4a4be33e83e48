"""Studies: what is refused, how samples are drawn, those that come along."""

import re
import shutil
from collections import Counter
from math import log10
from pathlib import Path

import numpy as np
import pytest

from exo import sweep
from exo.errors import ExoError
from exo.runs import FAILURE
from exo.sweep import study

from commands import exo
from sweeping import WALL, sampled


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("[10.0, 20.0, 30.0]", "[10.0, true]", "expected values of one kind, got the number 10.0, the Boolean True"),
        ("cases", 'parameters = { "controller.K" = 5.0 }\ncases', "parameters.controller.K: is an axis, too"),
        ("count = 2", "count = 1000000000", "3000000000 runs; expected at most 10000000"),
        ('scenario = "wall"', 'scenario = "wal"', "close matches: wall"),
        ('cases = ["passive_bounded_5_0.5"]', 'cases = ["none"]', "no such case"),
        ('"release_delay", "tank"', '"release_delai"', "close matches: release_delay"),
        ('axes."controller.K"', 'axes."controller.k"', "no variable k"),
        ("count = 2", "", "a grid needs values, or low, high and count"),
        ("low = 2.0", "low = -2.0", "expected a number above 0 on a log scale"),
        ("low = 2.0", "low = 9.0", "expected two numbers, the lower first"),
        ("low = 2.0", "mean = 2.0", "expected one of: values; low and high; mean and deviation"),
        ('x = "controller.K"', 'x = "controller.D"', "no column controller.D"),
        ('kind = "map"', 'kind = "pie"', "figures.map.kind: got 'pie'; expected"),
        ('color = "release_delay"', "", "a map needs color"),
        ("[10.0, 20.0, 30.0]", '["10"]', "controller.K holds texts; expected numbers to draw"),
        ('title = "Time', 'titel = "Time', "titel"),
        ("[axes", '[sampling]\nmethod = "sobol"\nsamples = 100\n[axes', "expected a power of 2, as 64 or 128"),
        ("[axes", '[sampling]\nmethod = "random"\n[axes', "method random: expected samples"),
        ("[axes", "[sampling]\nseed = -1\n[axes", "sampling.seed: got -1; expected"),
        (
            "20.0, 30.0]",
            "nan]",
            "axes.controller.K.values.1: got nan; expected a number that is finite, a text, or true",
        ),
        ("20.0, 30.0]", "1979-05-27]", "values[1]: got datetime.date(1979, 5, 27); expected a number"),
        ("20.0, 30.0]", "10.0]", "axes.controller.K: values: 10.0 stands twice; expected each point of a grid once"),
        ('axes."controller.K"', "axes.controller.K", 'expected the name in quotes, as [axes."controller.K"]'),
        ("30.0]", "30.0]\ncount = 3", "axes.controller.K: count 3: belongs to low and high; expected none"),
        ("low = 2.0\nhigh = 8.0", "mean = 2.0\ndeviation = 1.0", "belongs to low and high"),
        (
            "low = 2.0\nhigh = 8.0",
            "low = 1e-300\nhigh = 1e300",
            "is no number of 64 bits; expected ends that are nearer",
        ),
        ('low = 2.0\nhigh = 8.0\nscale = "log"', "low = -1e308\nhigh = 1e308", "expected ends that are nearer"),
        (
            "limit = 0.4",
            '[[figures]]\nid = "Map"\ntitle = "M"\nkind = "histogram"\nx = "tank"',
            "map and Map would be one",
        ),
        ("title = ", "titel = ", "titel: unknown key, with value 'Time to let go'"),
    ],
)
def test_a_wrong_study_is_refused_by_name(old: str, new: str, said: str, fmu_dir: Path, tmp_path: Path) -> None:
    file = tmp_path / "study.toml"
    assert old in WALL
    file.write_text(WALL.replace(old, new, 1))
    answer = exo("sweep", file, "--out", tmp_path / "out", "--fmu-dir", fmu_dir)
    assert answer.exit_code == 2
    assert said in " ".join(answer.stderr.split())
    assert "Traceback" not in answer.stderr


def test_the_page_on_sweeps_runs_word_by_word(
    fmu_dir: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Its batch, its study, and the number of runs that it says of each study that comes along."""
    page = (Path(__file__).parents[2] / "docs" / "sweeps.md").read_text(encoding="utf-8")
    batch, study = (re.search(rf"```{kind}\n(.*?)```", page, flags=re.DOTALL)[1] for kind in ("python", "toml"))
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("EXO_FMU_DIR", str(fmu_dir))
    exec(batch, {})
    assert "0.33" in capsys.readouterr().out
    Path("study.toml").write_text(study, encoding="utf-8")
    answer = exo("sweep", "study.toml", "--workers", 1)
    assert answer.exit_code == 0, answer.output
    assert answer.stdout == "results/sweeps/gain_and_mass/runs.parquet: 20 runs\nresults/sweeps/gain_and_mass/map.png\n"
    told = dict(re.findall(r"^\| `(\w+)` \| ([\d ]+) \|", page, flags=re.MULTILINE))
    assert {name: int(runs.replace(" ", "")) for name, runs in told.items()} == {
        name: sweep.load(name)[0].size for name in sweep.built_in()
    }


@pytest.mark.parametrize("method", ["random", "latin_hypercube", "sobol"])
def test_samples_are_spread_as_they_say_and_come_from_the_seed(method: str) -> None:
    rows = sampled(method).rows()
    assert rows == sampled(method).rows()
    assert rows != sampled(method, seed=2).rows()
    a, b, c = (sorted(float(row[key]) for row in rows) for key in "abc")
    loose = 0.2 if method == "random" else 0.03
    assert 1.0 <= a[0] <= a[-1] <= 100.0
    assert abs(a[128] / 10.0 - 1.0) < 5 * loose  # the median of the logarithm
    assert abs(sum(b) / 256 - 5.0) < 2.0 * loose
    assert abs(Counter(c)[2.0] / 256 - 1 / 3) < loose
    # Of each of 16 slices of the range a Latin hypercube and a Sobol sequence have their share.
    slices = Counter(int(8 * log10(x)) for x in a)
    if method != "random":
        assert set(slices.values()) == {16}


@pytest.mark.parametrize("name", sweep.built_in())
def test_each_study_that_comes_along_runs_and_draws(name: str, fmu_dir: Path, tmp_path: Path) -> None:
    """A few of its runs: what it measures is there, and what it draws."""
    text = sweep.built_in()[name].read_text()
    small = re.sub(
        r"^samples = \d+$", "samples = 8", re.sub(r"^count = \d+$", "count = 3", text, flags=re.M), flags=re.M
    )
    shutil.copytree(sweep.built_in()[name].parent / "scenarios", tmp_path / "scenarios")
    (tmp_path / "study.toml").write_text(small)
    done = sweep.sweep(tmp_path / "study.toml", out=tmp_path / "out", workers=2, fmu_dir=fmu_dir)
    assert done.failed == 0, done.table[FAILURE].to_pylist()
    assert len(done.pictures) == len(sweep.load(name)[0].figures) > 0


def test_the_stability_map_is_where_exo_tune_puts_it(fmu_dir: Path, tmp_path: Path) -> None:
    """What grows is beyond the predicted limit, what decays is below, for three masses from 5 to 60 N·s/m."""
    text = sweep.built_in()["stability_map"].read_text()
    small = text.replace("count = 56", "count = 4").replace("count = 60", "count = 14")
    assert small.count("count = ") == 2
    (tmp_path / "study.toml").write_text(small)
    done = sweep.sweep(tmp_path / "study.toml", out=tmp_path / "out", workers=2, fmu_dir=fmu_dir)
    grows = np.array(done.table["grows"].to_pylist()) > 0.5
    share = np.array(done.table["limit_share"].to_pylist())
    assert 20 < grows.sum() < len(grows) - 20
    assert (grows == (share > 1.0)).all(), share[grows != (share > 1.0)]


def test_a_study_from_an_editor_of_windows_is_read_and_one_nested_without_end_is_refused(
    study_file: Path, tmp_path: Path
) -> None:
    study_file.write_bytes(b"\xef\xbb\xbf" + study_file.read_bytes())
    assert study.load(study_file)[0].id == "small"
    endless = tmp_path / "endless.toml"
    endless.write_text(f"id = {'[' * 5000}{']' * 5000}\n")
    with pytest.raises(ExoError, match=r"endless\.toml: .*recursion.*; expected TOML"):
        study.load(endless)
