"""The page: every number, verdict and peak of the results is in it, and what has changed since; it asks for nothing."""

import json
import re
from pathlib import Path

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest

from exo import experiment, loop, report, results
from exo.experiment import Experiment
from exo.report import packed
from exo.report.thin import CLOSE, Window, farther, thin
from exo.scenario import Scenario, built_in, load
from exo.selection import narrowed

from commands import SHORT, exo
from pages import Page, said

SCENARIO = "gain_study"
#: What the whole `exo reproduce` may take, and how many scenarios it has to share that among.
LARGEST, SCENARIOS = 15e6, 45


@pytest.fixture(scope="module")
def overridden(fmu_dir: Path, tmp_path_factory: pytest.TempPathFactory) -> tuple[Experiment, Path]:
    """A run of the gain study with another K_P, and its folder."""
    out = tmp_path_factory.mktemp("overridden")
    done = experiment.run(
        scenario=load(SCENARIO), fmu_dir=fmu_dir, overrides={"controller.K_P": "11"}, engine=loop.fastest()
    )
    results.write(experiment=done, out=out)
    return done, out


@pytest.fixture(scope="module")
def walled(fmu_dir: Path, tmp_path_factory: pytest.TempPathFactory) -> tuple[Experiment, Path]:
    """The wall with the nominal of the paper, and its folder."""
    out = tmp_path_factory.mktemp("walled")
    scenario = narrowed(load("wall"), cases=["*_5_0.5"])
    done = experiment.run(scenario=scenario, fmu_dir=fmu_dir, engine=loop.fastest())
    results.write(experiment=done, out=out)
    return done, out


def test_the_page_holds_every_number_of_the_results_with_its_expectation_and_verdict(
    overridden: tuple[Experiment, Path],
) -> None:
    done, out = overridden
    path = report.write(out=out, scenarios=[SCENARIO])
    rows = Page(path).rows(SCENARIO)
    document = json.loads((out / SCENARIO / "metrics.json").read_text(encoding="utf-8"))
    assert set(rows) == set(document["metrics"]) == {result.id for result in done.results}
    for result in done.results:
        row, written = rows[result.id], document["metrics"][result.id]
        assert row["verdict"] == written["verdict"]
        assert float(row["measured"].split()[0]) == pytest.approx(written["value"], rel=1e-4)
        assert row["measured"].split()[1:] == ([written["unit"]] if written["unit"] != "1" else [])
        assert row["expected"] == result.expectation()
        assert result.title in row["what"]
        assert written["source"] in row["why"]
    assert "controller.K_P = 11.0" in Page(path).text


def test_the_paper_s_numbers_stand_beside_ours_with_their_difference(overridden: tuple[Experiment, Path]) -> None:
    done, out = overridden
    rows = Page(report.write(out=out, scenarios=[SCENARIO])).paper()
    printed = {result.id: result for result in done.results if result.paper}
    assert len(rows) == len(printed) > 0
    for row in rows:
        result = printed[row["what"].split()[-1]]
        assert result.paper is not None
        assert row["paper"].startswith(f"{result.paper.value:g} ±")
        share = float(row["difference"].removesuffix(" %"))
        assert share == pytest.approx(100.0 * (result.value / result.paper.value - 1.0), abs=0.006)


def test_the_page_asks_for_nothing(walled: tuple[Experiment, Path]) -> None:
    page = Page(report.write(out=walled[1], scenarios=["wall"]))
    for element in page.root.iter():
        for name in ("src", "srcset", "action", "data", "poster"):
            assert name not in element.attrib, element.tag
        if "href" in element.attrib:
            # The page itself, or, where scripts are off, pictures beside it.
            assert re.fullmatch(r"#[\w.-]+|wall/\w+\.png", element.get("href", "")), element.get("href")
    policy = page.root.xpath('//meta[@http-equiv="Content-Security-Policy"]/@content')[0]
    assert policy.startswith("default-src 'none';")
    assert not re.search(r"https?:", policy)
    assert "@import" not in page.text
    assert "url(" not in "".join(page.root.xpath("//style/text()"))


def test_the_largest_and_the_smallest_value_of_every_signal_are_in_the_page(walled: tuple[Experiment, Path]) -> None:
    done, out = walled
    seen = set()
    for facts, time, values in Page(report.write(out=out, scenarios=["wall"])).signals("wall"):
        run = done.recordings[facts["case"]]
        column = run[facts["column"]]
        assert values.max() == np.float32(column.max())
        assert values.min() == np.float32(column.min())
        # Each point is one of the run's.
        k = np.round(time / run.step).astype(int)
        assert time == pytest.approx(run.time[k], abs=1e-9)
        assert np.array_equal(values, column[k].astype(np.float32))
        assert len(values) < len(column) / 4
        seen.add((facts["case"], facts["column"]))
    assert seen == {(c.case, c.column) for f in done.scenario.figures for p in f.panels for c in p.curves}


def test_the_figures_keep_the_arrangement_of_the_scenario(walled: tuple[Experiment, Path]) -> None:
    done, out = walled
    head = Page(report.write(out=out, scenarios=["wall"])).head("wall")
    for drawn, figure in zip(head["figures"], done.scenario.figures, strict=True):
        assert (drawn["id"], drawn["title"], drawn["columns"]) == (figure.id, figure.title, figure.columns)
        for panel, asked in zip(drawn["panels"], figure.panels, strict=True):
            assert (panel["title"], panel["y"]) == (asked.title, asked.y_label)
            assert {curve["label"] for curve in panel["curves"]} == {curve.label for curve in asked.curves}
            shown = [head["series"][curve["s"]] for curve in panel["curves"]]
            assert {(one["case"], one["column"]) for one in shown} == {(c.case, c.column) for c in asked.curves}
            assert len({(curve["color"], *curve["dash"]) for curve in panel["curves"]}) == len(asked.curves)
    units = {one["column"]: one["unit"] for one in head["series"]}
    assert units == {"plant.q": "m", "controller.tau_a": "N"}


def test_the_first_sentence_is_made_of_the_measured_delays(walled: tuple[Experiment, Path]) -> None:
    done, out = walled
    delays = {result.id: result.value for result in done.results}
    page = Page(report.write(out=out, scenarios=["wall"]))
    headline = " ".join(page.root.xpath("//h1")[0].text_content().split())
    assert f"{delays['release_delay/passive_bounded_5_0.5']:.2g} s" in headline
    assert f"{delays['release_delay/standard_5_0.5']:.3g} s" in headline
    assert len(page.root.xpath('//*[local-name()="svg"]//*[local-name()="path"]')) >= 2


def test_a_page_without_the_wall_says_how_many_verdicts_fail(overridden: tuple[Experiment, Path]) -> None:
    page = Page(report.write(out=overridden[1], scenarios=[SCENARIO]))
    counts = {v: sum(result.verdict == v for result in overridden[0].results) for v in ("pass", "fail")}
    headline = " ".join(page.root.xpath("//h1")[0].text_content().split())
    assert f"{counts['fail'] or 'none'} of {sum(counts.values())} verdicts" in headline


def test_the_whole_reproduce_stays_below_15_megabytes(walled: tuple[Experiment, Path]) -> None:
    # Were every experiment as this one, which has more than most.
    text = Page(report.write(out=walled[1], scenarios=["wall"])).text
    packed_here = sum(len(one) for one in re.findall(r'id="(?:pack|scene)-wall">([^<]*)<', text))
    assert packed_here > 10_000
    assert len(text) + (SCENARIOS - 1) * packed_here < LARGEST


def test_verdicts_that_have_changed_since_the_last_run_are_told(tmp_path: Path, fmu_dir: Path) -> None:
    path, out = tmp_path / "short.toml", tmp_path / "out"
    path.write_text(SHORT, encoding="utf-8")
    arguments = ("--fmu-dir", fmu_dir, "--out", out)
    exo("run", path, *arguments)
    assert not (out / "short" / "earlier.json").exists()
    assert exo("report", "--out", out).exit_code == 0
    assert Page(out / "report.html").rows("short")["moved/push"]["change"] == ""
    assert "There is no earlier run" in (out / "report.html").read_text(encoding="utf-8")

    exo("run", path, *arguments)
    exo("report", "--out", out)
    assert Page(out / "report.html").rows("short")["moved/push"]["change"] == ""

    path.write_text(SHORT.replace("at_least = 0.1", "at_least = 100.0"), encoding="utf-8")
    exo("run", path, *arguments)
    exo("report", "--out", out)
    row = Page(out / "report.html").rows("short")["moved/push"]
    assert (row["verdict"], row["change"]) == ("fail", "verdict")
    assert "was pass" in row["measured"]

    path.write_text(SHORT.replace('id = "moved"', 'id = "went"').replace("amplitude = 3.0", "amplitude = 4.0"), "utf-8")
    exo("run", path, *arguments)
    exo("report", "--out", out)
    rows = Page(out / "report.html").rows("short")
    assert {name: row["change"] for name, row in rows.items()} == {"went/push": "new", "moved/push": "gone"}


def test_verdicts_are_compared_with_another_folder_where_one_is_given(tmp_path: Path, fmu_dir: Path) -> None:
    path = tmp_path / "short.toml"
    path.write_text(SHORT, encoding="utf-8")
    exo("run", path, "--fmu-dir", fmu_dir, "--out", tmp_path / "old")
    path.write_text(SHORT.replace("amplitude = 3.0", "amplitude = 4.0"), encoding="utf-8")
    exo("run", path, "--fmu-dir", fmu_dir, "--out", tmp_path / "new")
    assert exo("report", "--out", tmp_path / "new", "--against", tmp_path / "old").exit_code == 0
    row = Page(tmp_path / "new" / "report.html").rows("short")["moved/push"]
    assert (row["verdict"], row["change"]) == ("pass", "value")
    old = json.loads((tmp_path / "old" / "short" / "metrics.json").read_text(encoding="utf-8"))
    assert f"was pass, {old['metrics']['moved/push']['value']:.5g} m" in row["measured"]


def test_what_is_wrong_with_results_is_a_sentence(tmp_path: Path, fmu_dir: Path) -> None:
    path, out = tmp_path / "short.toml", tmp_path / "out"
    path.write_text(SHORT, encoding="utf-8")

    def refused(*arguments: object) -> str:
        answer = exo("report", *arguments)
        assert answer.exit_code == 2
        return answer.stderr.replace("\n", " ")

    assert "no such folder" in refused("--out", out)
    out.mkdir()
    assert "no results in it" in refused("--out", out)
    exo("run", path, "--fmu-dir", fmu_dir, "--out", out)
    assert "no results of scenario shirt (close matches: short)" in refused("shirt", "--out", out)
    assert "no such folder" in refused("--out", out, "--against", tmp_path / "nowhere")
    for name, damage, message in (
        ("figures/q.parquet", "x", "cannot be read"),
        ("figures/q.parquet", None, "missing"),
        ("manifest.json", "{}", "holds no scenario of this version"),
        ("metrics.json", "{", "not a file of exo's results"),
        ("metrics.json", '{"schema": "other"}', "expected schema"),
        ("earlier.json", "{}", "not the verdicts of an earlier run"),
    ):
        file = out / "short" / name
        before = file.read_bytes() if file.exists() else None
        file.unlink(missing_ok=True)
        if damage is not None:
            file.write_text(damage, encoding="utf-8")
        answer = refused("--out", out)
        assert message in answer
        assert str(file) in answer
        file.unlink(missing_ok=True)
        if before is not None:
            file.write_bytes(before)
    assert exo("report", "--out", out).exit_code == 0
    # As the harness has left it before its columns said what they are.
    file = out / "short" / "figures" / "q.parquet"
    table = pq.read_table(file)
    pq.write_table(table.cast(pa.schema([pa.field(one.name, one.type) for one in table.schema])), file)
    assert "does not say of which case and column it is" in refused("--out", out)


@pytest.mark.parametrize("name", ["short", "wall"])
def test_a_scenario_of_one_s_own_has_a_page(name: str, tmp_path: Path, fmu_dir: Path) -> None:
    path, out = tmp_path / "own.toml", tmp_path / "out"
    text = SHORT.replace("A second of pushing", "A <b>second</b> & `K`").replace('id = "short"', f'id = "{name}"')
    path.write_text(text.replace('id = "q"', 'id = "release"'), encoding="utf-8")
    exo("run", path, "--fmu-dir", fmu_dir, "--out", out)
    assert exo("report", "--out", out).exit_code == 0
    page = Page(out / "report.html")
    assert "A <b>second</b> & `K`" in page.root.xpath(f'//details[@id="{name}"]/summary')[0].text_content()
    assert [facts["column"] for facts, _, _ in page.signals(name)] == ["plant.q"]


def test_the_margins_of_requirements_have_a_filter_and_their_formula(tmp_path: Path, fmu_dir: Path) -> None:
    path, out = tmp_path / "short.toml", tmp_path / "out"
    path.write_text(
        SHORT.replace('"moved"', '"requirement.goes.far"').replace(
            "at_least = 0.1", 'at_least = 0.0, because = "eventually(q >= 0.1)"'
        ),
        encoding="utf-8",
    )
    exo("run", path, "--fmu-dir", fmu_dir, "--out", out)
    exo("report", "--out", out)
    page = Page(out / "report.html")
    assert page.root.xpath('//button[@data-filter="requirement"]/i/text()') == ["1"]
    assert len(page.root.xpath("//tr[@data-r]")) == 1
    assert "Formula: eventually(q >= 0.1)" in page.rows("short")["requirement.goes.far/push"]["why"]


def test_a_thinned_signal_keeps_its_peaks_and_its_line() -> None:
    time = np.arange(60_000) * 1e-3
    values = np.sin(time) + 0.3 * np.sin(7.0 * time)
    values[31_415] = 9.0
    kept = thin(time, values)
    assert len(kept) <= 2000
    assert values[kept].max() == 9.0
    assert values[kept].min() == values.min()
    assert kept[0] == 0
    assert kept[-1] == len(time) - 1
    drawn = np.interp(time, time[kept], values[kept])
    assert np.abs(drawn - values).max() <= CLOSE * np.ptp(values)


@pytest.mark.parametrize("lively", ["a_sine_of_660_periods", "noise"])
def test_a_run_that_is_too_lively_ranges_over_what_it_ranges_over_at_every_time(lively: str) -> None:
    # Ten minutes at 1 kHz.
    time = np.arange(600_000) * 1e-3
    values = np.sin(7.0 * time) if lively != "noise" else np.random.default_rng(1).uniform(-1.0, 1.0, len(time))
    kept = thin(time, values)
    assert len(kept) <= 4100
    drawn = np.interp(time, time[kept], values[kept]).reshape(-1, 2000)
    seconds = values.reshape(-1, 2000)
    # In each two seconds, of a range of 2.
    assert np.abs(drawn.max(axis=1) - seconds.max(axis=1)).max() < 0.15
    assert np.abs(drawn.min(axis=1) - seconds.min(axis=1)).max() < 0.15
    assert farther(time, values, kept) == pytest.approx(np.abs(drawn.ravel() - values).max())


def test_a_line_that_is_close_enough_is_not_called_off() -> None:
    time = np.arange(60_000) * 1e-3
    values = np.sin(time)
    assert farther(time, values, thin(time, values)) == 0.0


def test_a_window_into_a_signal_is_as_fine_as_the_whole() -> None:
    time = np.arange(60_000) * 1e-3
    # Small and lively for a second, and far away after that.
    values = np.where(time < 1.0, 1e-3 * np.sin(50.0 * time), 1e3 * (time - 1.0))
    inside = time <= 0.999

    def off(kept: np.ndarray) -> float:
        return float(np.abs(np.interp(time, time[kept], values[kept]) - values)[inside].max())

    assert off(thin(time, values, [Window(0.0, 0.999, -1e-3, 1e-3)])) <= 2e-3 * CLOSE
    assert off(thin(time, values)) > 2e-3 * CLOSE


def test_what_is_packed_comes_out_as_it_was() -> None:
    ticks = np.array([0, 1, 70_000], dtype="<u4")
    values = np.array([1.5, -2.25e-30, 3.0e38], dtype="<f4")
    head, body = packed.unpack(packed.pack({"a": "τ"}, [packed.numbers(ticks), packed.numbers(values)]))
    assert head == {"a": "τ"}
    assert np.array_equal(packed.numbers_of(body[:12], "<u4"), ticks)
    assert np.array_equal(packed.numbers_of(body[12:], "<f4"), values)


def test_a_signal_that_is_nowhere_finite_leaves_a_gap_and_no_traceback(tmp_path: Path, fmu_dir: Path) -> None:
    path, out = tmp_path / "short.toml", tmp_path / "out"
    path.write_text(SHORT, encoding="utf-8")
    exo("run", path, "--fmu-dir", fmu_dir, "--out", out)
    file = out / "short" / "figures" / "q.parquet"
    table = pq.read_table(file)
    broken = np.full(table.num_rows, np.nan)
    pq.write_table(table.set_column(1, table.schema.field(1), [broken]), file)
    assert exo("report", "--out", out).exit_code == 0
    head = Page(out / "report.html").head("short")
    assert head["series"] == []
    assert head["figures"][0]["panels"][0]["curves"] == []


def test_a_gap_within_a_signal_is_one_point_that_is_no_number(tmp_path: Path, fmu_dir: Path) -> None:
    path, out = tmp_path / "short.toml", tmp_path / "out"
    path.write_text(SHORT, encoding="utf-8")
    exo("run", path, "--fmu-dir", fmu_dir, "--out", out)
    file = out / "short" / "figures" / "q.parquet"
    table = pq.read_table(file)
    values = table.column(1).to_numpy().copy()
    values[:3], values[200:300], values[350] = np.nan, np.nan, np.inf
    pq.write_table(table.set_column(1, table.schema.field(1), [values]), file)
    assert exo("report", "--out", out).exit_code == 0
    ((_, time, shown),) = Page(out / "report.html").signals("short")
    assert time[np.isnan(shown)] == pytest.approx([200 * 0.002, 350 * 0.002])
    assert set(np.round(time / 0.002).astype(int)) >= {3, 199, 300, 349, 351, 499}
    k = np.round(time[~np.isnan(shown)] / 0.002).astype(int)
    assert np.array_equal(shown[~np.isnan(shown)], values[k].astype(np.float32))


def test_the_first_screen_names_what_fails_and_counts_what_is_there(tmp_path: Path, fmu_dir: Path) -> None:
    path, out = tmp_path / "short.toml", tmp_path / "out"
    path.write_text(SHORT.replace("at_least = 0.1", "at_least = 100.0"), encoding="utf-8")
    exo("run", path, "--fmu-dir", fmu_dir, "--out", out)
    exo("report", "--out", out)
    page = Page(out / "report.html")
    failed = [said(one) for one in page.root.xpath('//ul[@class="failed"]/li')]
    assert len(failed) == 1
    assert failed[0].startswith("short how far it moved moved/push: ")
    assert failed[0].endswith("m, expected ≥ 100")
    assert "1 experiment, 1 run, 1 s simulated." in said(page.root.xpath('//section[contains(@class, "first")]')[0])
    assert "coupled by fmpy." in said(page.root.xpath("//footer")[0])


@pytest.mark.parametrize("name", built_in())
def test_a_scenario_comes_back_from_its_manifest_as_it_ran(name: str) -> None:
    scenario = load(name)
    dumped = json.dumps(scenario.model_dump(mode="json", exclude_defaults=True))
    assert Scenario.model_validate_json(dumped) == scenario
