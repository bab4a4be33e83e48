"""Every verdict of every scenario is a test; what is special about a scenario has a file of its own."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from exo import scenario as scenarios

from conftest import run_of


def verdicts() -> Iterator[Any]:
    """Scenario and id of everything that is judged or reported, known before it runs."""
    for name in scenarios.built_in():
        data = scenarios.load(name)
        cases = tuple(case.id for case in data.cases)
        ids = [f"{metric.id}/{case}" for metric in data.metrics for case in metric.cases or cases]
        for one in ids + [ratio.id for ratio in data.ratios]:
            yield pytest.param(name, one, id=f"{name}-{one}")  # `conftest.group` reads the name


@pytest.mark.parametrize(("name", "metric"), list(verdicts()))
def test_verdict_does_not_fail(name: str, metric: str, fmu_dir: Path) -> None:
    results = {result.id: result for result in run_of(name, fmu_dir).results}
    result = results[metric]
    assert result.verdict != "fail", f"{result.value:.6g} {result.unit}, expected {result.expectation()}"
