"""Numbers beside the paper's: judged where that is fair, with a reason where they are off."""

import re
from pathlib import Path

import pytest

from exo import report, results
from exo.experiment import Experiment
from exo.paper import published
from exo.scenario import Check
from exo.verdict import beside_the_paper, judge

from conftest import run_of

ROOT = Path(__file__).resolve().parents[2]


@pytest.mark.parametrize("key", sorted(published()))
def test_a_reason_cites_a_section_that_exists_or_says_what_is_published(key: str) -> None:
    number = published()[key]
    assert number.because
    assert not (number.within is not None and number.relative is not None)
    sections = re.findall(r"docs/specification\.md section (\d)", number.because)
    text = (ROOT / "docs" / "specification.md").read_text(encoding="utf-8")
    assert all(f"\n## {section} " in text for section in sections)
    assert sections or number.within == number.rounding  # nothing to explain beyond the print


@pytest.mark.parametrize(
    ("ratio", "over", "under"),
    [
        ("fig:1dof_perf/K=7.5 over K=15", "fig:1dof_perf/K=7.5", "fig:1dof_perf/K=15"),
        ("fig:1dof_perf/K=15 over K=30", "fig:1dof_perf/K=15", "fig:1dof_perf/K=30"),
        ("sec:task_space_control/K=250 over K=500", "sec:task_space_control/K=250", "sec:task_space_control/K=500"),
        ("sec:task_space_control/K=500 over K=1000", "sec:task_space_control/K=500", "sec:task_space_control/K=1000"),
    ],
)
def test_a_ratio_is_that_of_the_printed_numbers_with_the_rounding_of_both(ratio: str, over: str, under: str) -> None:
    upper, lower, stated = published()[over], published()[under], published()[ratio]
    value = upper.value / lower.value
    assert stated.value == pytest.approx(value, abs=1e-4)  # figures written down
    share = upper.rounding / upper.value + lower.rounding / lower.value
    assert stated.rounding == pytest.approx(share * value, rel=0.01)


def test_the_limit_and_the_fitted_errors_are_judged_and_what_is_not_published_is_explained(fmu_dir: Path) -> None:
    judged, explained = {}, {}
    for name in ("gain_study", "arm_performance", "paper_figures"):
        found = {result.id: result for result in run_of(name, fmu_dir).results}
        judged |= {f"{name}/{key}": result.verdict for key, result in found.items() if key.endswith("/paper")}
        for key, result in found.items():
            if result.paper and not result.paper.is_fair:
                explained[f"{name}/{key}"] = result.paper.explains(result.value)
                assert f"{key}/paper" not in found
    assert judged == dict.fromkeys(
        [
            *(f"gain_study/max_error/K{K}/paper" for K in ("7.5", "15", "30")),
            "gain_study/ratio_7.5_15/paper",
            "gain_study/ratio_15_30/paper",
            *(f"paper_figures/max_error/perf_K{K}/paper" for K in ("7.5", "15", "30")),
            "paper_figures/saturation/standard/paper",
        ],
        "pass",
    )
    assert "hand is not published" in explained["paper_figures/release_delay/standard"]  # +70 %
    assert "not the same arm" in explained["arm_performance/max_error/K250"]  # −5.5 %
    assert explained["arm_performance/max_error/K1000"] == ""  # 0.01124 is 0.011 to the print's digits


@pytest.mark.parametrize(("value", "verdict"), [(12.54, "pass"), (12.56, "fail"), (12.44, "fail")])
def test_a_number_beyond_the_print_s_rounding_fails_where_it_is_fair(value: float, verdict: str) -> None:
    limit = published()["fig:exp_1dof_standard/tau_max"]
    measured = judge(metric="m", title="t", value=value, unit="N", check=Check(), source="s", paper=limit)
    assert beside_the_paper(measured).verdict == verdict
    assert bool(limit.explains(value)) == (verdict == "fail")


SCENARIO = "paper_figures"


def test_the_page_says_why_beside_the_number(experiment: Experiment, tmp_path: Path) -> None:
    results.write(experiment=experiment, out=tmp_path)
    page = report.write(out=tmp_path, scenarios=[SCENARIO]).read_text(encoding="utf-8")
    row = next(line for line in page.splitlines() if "time stuck at the wall" in line)
    assert "+70.44 %" in row
    assert "not published" in row
    row = next(line for line in page.splitlines() if "torque limit of the testbed" in line)
    assert re.search(r'badge pass">pass</span> 12\.5 ± 0\.05', row)
