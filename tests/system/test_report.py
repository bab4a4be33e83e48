"""The page: self-contained, with every number and figure of every scenario."""

from pathlib import Path

from exo import experiment, report, results
from exo.scenario import load

SCENARIO = "gain_study"


def test_the_page_holds_every_number_and_figure_and_loads_nothing(fmu_dir: Path, tmp_path: Path) -> None:
    done = experiment.run(scenario=load(SCENARIO), fmu_dir=fmu_dir, overrides={"controller.K_P": "11"})
    results.write(experiment=done, out=tmp_path)
    page = report.write(out=tmp_path, scenarios=[SCENARIO]).read_text(encoding="utf-8")
    for result in done.results:
        assert f"<code>{result.id}</code>" in page
        assert result.expectation().replace("<", "&lt;") in page
    assert page.count("data:image/png;base64,") == len(done.scenario.figures)
    assert "0.0207" in page
    assert "controller.K_P = 11.0" in page
    for outside in ("http://", "https://", "<script", "<link", "url("):
        assert outside not in page
