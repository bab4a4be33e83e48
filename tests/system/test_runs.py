"""Many runs of a scenario: each equals a run of its own, whatever ran before it."""

import math
from contextlib import ExitStack
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pyarrow as pa
import pytest

import exo
from exo import experiment, loop, master, metrics, scenario, selection
from exo.coupled import Coupled
from exo.errors import ExoError, FmuError
from exo.fmu import Archive, Instance
from exo.loop import Part
from exo.runs import FAILURE, Batch

WALL = "passive_bounded_5_0.5"


def alone(name: str, case: str, fmu_dir: Path, **settings: str) -> dict[str, float]:
    """What `exo run` finds with these settings."""
    loaded = selection.narrowed(scenario.load(name), cases=[case])
    texts = {key.replace("__", "."): value for key, value in settings.items()}
    done = experiment.run(scenario=loaded, fmu_dir=fmu_dir, overrides=texts)
    return {result.id.split("/")[0]: result.value for result in done.results}


def equal(a: float, b: float) -> bool:
    return a == b or (math.isnan(a) and math.isnan(b))


@pytest.mark.parametrize("engine", loop.ENGINES)
def test_each_row_is_what_a_run_of_its_own_gives(engine: loop.Engine, fmu_dir: Path) -> None:
    gains = [30.0, 5.0, 10.0, 30.0]
    found = exo.batch("wall", {"controller.K": gains}, cases=[WALL], engine=engine, fmu_dir=fmu_dir)
    assert found[FAILURE].null_count == len(gains)
    for i, K in enumerate(gains):
        wanted = alone("wall", WALL, fmu_dir, controller__K=str(K))
        for name in found.column_names:
            if name in wanted:
                assert equal(found[name][i].as_py(), wanted[name]), (K, name)
    assert found["spring_force"][0] == found["spring_force"][3]
    assert len(set(found["release_delay"].to_pylist())) == 3


def test_all_cases_and_ratios_of_the_arm_in_one_row(fmu_dir: Path) -> None:
    found = exo.batch("gain_study", {"controller.D_n": [0.5]}, fmu_dir=fmu_dir)
    done = experiment.run(scenario=scenario.load("gain_study"), fmu_dir=fmu_dir, overrides={"controller.D_n": "0.5"})
    wanted = {result.id: result.value for result in done.results if not result.id.endswith("beside the paper")}
    compared = [name for name in found.column_names if name in wanted]
    assert len(compared) >= 6
    for name in compared:
        assert equal(found[name][0].as_py(), wanted[name]), name


def test_a_row_that_fails_is_a_row_with_its_reason_and_the_next_one_is_unharmed(fmu_dir: Path) -> None:
    found = exo.batch("wall", {"controller.K": [30.0, -1.0, 30.0]}, cases=[WALL], fmu_dir=fmu_dir).to_pydict()
    assert "K = -1 N.s/m, expected a value from" in found[FAILURE][1]
    assert math.isnan(found["release_delay"][1])
    assert found["release_delay"][0] == found["release_delay"][2] > 0.0


def test_a_row_that_ends_in_the_middle_names_scenario_case_component_and_time(fmu_dir: Path) -> None:
    for branch_at, t in ((None, 0), (19.0, 19)):
        found = exo.batch("wall", {"plant.tau_d": [1e300]}, cases=[WALL], branch_at=branch_at, fmu_dir=fmu_dir)
        said = found[FAILURE][0].as_py()
        assert said.startswith(f"wall: case {WALL}: plant: fmi2DoStep returned fmi2Error")
        assert said.endswith(f"(step at t = {t} s)")
    with pytest.raises(FmuError, match=f"wall: case {WALL}: plant: fmi2DoStep returned"):
        exo.simulate("wall", case=WALL, parameters={"plant.tau_d": 1e300}, fmu_dir=fmu_dir)


def test_rows_set_forces_and_times_too(fmu_dir: Path) -> None:
    rows = {"profile.tau_h.1.amplitude": [0.0, 5.0], "duration": [2.0, 4.0]}
    with Batch("wall", cases=[WALL], fmu_dir=fmu_dir) as runs:
        runs.check([dict.fromkeys(rows, 1.0)])
        looked = [runs.run(dict(zip(rows, values, strict=True))) for values in zip(*rows.values(), strict=True)]
    assert all(one.error is None for one in looked)
    refused = exo.batch("wall", {"duration": [2.001]}, cases=[WALL], fmu_dir=fmu_dir)[FAILURE][0].as_py()
    assert "no multiple of the step" in refused


@pytest.mark.parametrize("engine", loop.ENGINES)
def test_rows_that_branch_off_equal_runs_whose_gain_changes_then(engine: loop.Engine, fmu_dir: Path) -> None:
    """Against the whole: the branch with the trunk's own gain is the plain run; no row depends on those before it."""
    gains = [30.0, 5.0, 10.0, 30.0]
    run: Any = {"cases": [WALL], "engine": engine, "fmu_dir": fmu_dir}
    own = exo.batch("wall", {"controller.K": [30.0]}, **run).to_pydict()
    found = exo.batch("wall", {"controller.K": gains}, branch_at=19.0, **run).to_pydict()
    backwards = exo.batch("wall", {"controller.K": gains[::-1]}, branch_at=19.0, **run).to_pydict()
    for name in [one for one in found if one != FAILURE]:
        assert equal(found[name][0], own[name][0]), name
        assert all(equal(a, b) for a, b in zip(found[name], backwards[name][::-1], strict=True)), name
    assert len(set(found["release_delay"])) == 3
    for i in (1, 2):
        assert equal(found["release_delay"][i], changed(gains[i], at=19.0, engine=engine, fmu_dir=fmu_dir)), gains[i]


def changed(K: float, *, at: float, engine: loop.Engine, fmu_dir: Path) -> float:
    """The time to let go of one whole run, without a saved state, whose gain is set under way."""
    loaded = selection.narrowed(scenario.load("wall"), cases=[WALL])
    of = master.plan(scenario=loaded, case=loaded.cases[0])
    metric = next(one for one in loaded.metrics if one.id == "release_delay")
    with ExitStack() as stack:
        archives = {name: stack.enter_context(Archive(fmu_dir / name)) for name in of.components.values()}
        coupled = stack.enter_context(Coupled(of, archives))
        coupled.start(of)
        coupled.advance(until=round(at / of.step), engine=engine)
        coupled.set("controller.K", K)
        coupled.advance(engine=engine)
        return metrics.evaluate(
            recording=coupled.recording(), function=metric.function, arguments=metric.arguments, owner="changed"
        )


@pytest.mark.parametrize(
    ("parameters", "branch_at", "said"),
    [
        ({"controler.K": [1.0]}, None, "close matches: controller"),
        ({"controller.k": [1.0]}, None, "no variable k"),
        ({"controller.tau_a": [1.0]}, None, "only parameters and inputs can be set, this is output"),
        ({"controller.q": [1.0]}, None, "is wired to plant.q"),
        ({"profile.tau_h.9.amplitude": [1.0]}, None, "expected 1 to"),
        ({"profile.tau_h.1.kind": [1.0]}, None, "a term has no number kind"),
        ({"profile.tau_h": [1.0]}, None, "expected profile.<name>"),
        ({"controller.K": [1.0, 2.0], "plant.M": [1.0]}, None, "expected columns of one length"),
        ({"plant.M": [1.0]}, 5.0, "plant.M: is fixed; after 5 s only tunable"),
        ({"duration": [1.0]}, 5.0, "cannot set it"),
        (
            {"controller.K": [1.0, None]},
            None,
            "controller.K: expected a number of 64 bits, a text, or true or false",
        ),
        ({"controller.K": [[1.0, 2.0]]}, None, "expected a number of 64 bits"),
        ({"controller.K": [2**70]}, None, "expected a number of 64 bits"),
        ({"controller.K": 1.0}, None, "expected a name and a list of values, got 1.0"),
        ({"controller.law": "passive"}, None, "expected a name and a list of values, got passive"),
        ({"controller.law": ["passive", 3]}, None, "expected values of one kind, got the text passive, the number 3"),
        (pa.table([[1.0], [2.0]], names=["controller.K"] * 2), None, "expected each column once"),
        (
            {"controller.K": [1.0]},
            19.0005,
            "branch_at = 19.0005 s: expected a multiple of the step 0.002 s, as 19 or 19.002 s",
        ),
        ({"controller.K": [1.0]}, math.nan, "branch_at = nan s: expected a time within the run"),
        ({"controller.K": [1.0]}, "19", "branch_at = '19': expected a time in s"),
        ({"controller.K": [1.0]}, True, "branch_at = True: expected a time in s"),
        (None, None, "got None of type NoneType; expected columns by name"),
        (np.ones((2, 2)), None, "of type ndarray; expected columns by name"),
        (pd.DataFrame([[1.0, 2.0]], columns=["controller.K"] * 2), None, "expected each column once"),
        (pd.DataFrame({"controller.K": pd.array([1, None], dtype="Int64")}), None, "true or false, got <NA>"),
        ([{"controller.K": 1.0}, {"plant.M": 1.0}], None, "row 1 has no controller.K, row 0 has; expected each to"),
        ([{"controller.K": 1.0}, {"controller.K": 1.0, "plant.M": 1.0}], None, "row 0 has no plant.M, row 1 has"),
    ],
)
def test_what_no_row_can_set_is_refused_before_anything_runs(
    parameters: Any, branch_at: float | None, said: str, fmu_dir: Path
) -> None:
    with pytest.raises(ExoError) as caught:
        exo.batch("wall", parameters, cases=[WALL], branch_at=branch_at, fmu_dir=fmu_dir)
    assert said in str(caught.value)


def test_two_keys_of_one_element_are_refused(fmu_dir: Path) -> None:
    with pytest.raises(ExoError, match=r"Lambda_n\[2\]: sets .*, and so does controller.Lambda_n\[1\.\.3\]"):
        exo.batch("arm_contact", {"controller.Lambda_n[1..3]": [1.0], "controller.Lambda_n[2]": [5.0]}, fmu_dir=fmu_dir)


def test_an_engine_that_is_not_there_is_refused(fmu_dir: Path) -> None:
    wrong: Any = "fast"
    with pytest.raises(ExoError, match="fast: expected one of fmpy, native"):
        exo.batch("wall", {"controller.K": [1.0]}, cases=[WALL], engine=wrong, fmu_dir=fmu_dir)


def test_a_failed_branch_is_told_by_its_own_reason_whatever_the_clearing_up_says(
    fmu_dir: Path, monkeypatch: Any
) -> None:
    def refused(*_: object) -> None:
        raise FmuError("fmi2FreeFMUstate returned fmi2Error")

    monkeypatch.setattr(Instance, "free_state", refused)
    found = exo.batch("wall", {"controller.K": [-1.0, 30.0]}, cases=[WALL], branch_at=19.0, fmu_dir=fmu_dir)
    errors = found[FAILURE].to_pylist()
    assert "K = -1" in errors[0]
    assert errors[1] is None


def test_a_row_that_memory_does_not_hold_is_a_row_with_its_reason(fmu_dir: Path, monkeypatch: Any) -> None:
    plain = Part.resize

    def resize(part: Part, steps: int) -> None:
        if steps > 10**7:
            raise MemoryError
        plain(part, steps)

    monkeypatch.setattr(Part, "resize", resize)
    found = exo.batch("wall", {"duration": [60.0, 1e5, 60.0]}, cases=[WALL], fmu_dir=fmu_dir).to_pydict()
    assert found[FAILURE] == [None, "out of memory; expected a shorter duration or a longer step", None]
    assert found["tank"][0] == found["tank"][2]


def test_a_number_of_a_profile_that_is_none_is_named(fmu_dir: Path) -> None:
    for value, said in ((math.nan, "Input should be a finite number"), ("x", "Input should be a valid number")):
        found = exo.batch("wall", {"profile.tau_h.1.amplitude": [value]}, cases=[WALL], fmu_dir=fmu_dir)
        assert found[FAILURE][0].as_py().startswith(f"profile.tau_h.1.amplitude = {value}: {said}")


def test_a_branch_beyond_the_run_is_named(fmu_dir: Path) -> None:
    with pytest.raises(ExoError, match=r"branch_at = 1000 s: expected a time within the run"):
        exo.batch("wall", {"controller.K": [1.0]}, cases=[WALL], branch_at=1000.0, fmu_dir=fmu_dir)


K, LAW = [10.0, 20.0], [3, 4]
TABLES: dict[str, Any] = {
    "Arrow": pa.table({"controller.K": np.array(K), "controller.law": np.array(LAW)}),
    "a batch of Arrow": pa.record_batch({"controller.K": pa.array(K), "controller.law": pa.array(LAW)}),
    "columns of Arrow": {"controller.K": pa.chunked_array([K[:1], K[1:]]), "controller.law": pa.array(LAW)},
    "columns of NumPy": {"controller.K": np.array(K), "controller.law": np.array(LAW, dtype=np.uint8)},
    "pandas": pd.DataFrame({"controller.K": K, "controller.law": LAW}, index=[7, 3]),
    "rows": [{"controller.K": one, "controller.law": law} for one, law in zip(K, LAW, strict=True)],
    "what can be read once": {"controller.K": iter(K), "controller.law": iter(LAW)},
}


@pytest.fixture(scope="module")
def plain(fmu_dir: Path) -> pa.Table:
    """What lists give."""
    return exo.batch("wall", {"controller.K": K, "controller.law": LAW}, cases=[WALL], fmu_dir=fmu_dir)


@pytest.mark.parametrize("kind", TABLES)
def test_a_table_of_any_kind_goes_in(kind: str, plain: pa.Table, fmu_dir: Path) -> None:
    assert plain[FAILURE].null_count == 2
    assert plain["release_delay"][0] != plain["release_delay"][1]
    found = exo.batch("wall", TABLES[kind], cases=WALL, metrics="release_delay", fmu_dir=str(fmu_dir))
    assert found.column_names == ["controller.K", "controller.law", "release_delay", FAILURE]
    assert found.equals(plain.select(found.column_names))


@pytest.mark.parametrize("rows", [{}, {"controller.K": []}, [], pd.DataFrame()])
def test_no_row_is_no_run_and_no_error(rows: Any, fmu_dir: Path) -> None:
    found = exo.batch("wall", rows, cases=[WALL], metrics=["tank"], fmu_dir=fmu_dir)
    assert (found.num_rows, found.column_names[-2:]) == (0, ["tank", FAILURE])


def test_a_scenario_from_tables_runs_in_a_batch(fmu_dir: Path) -> None:
    tables = {
        "base": "testbed_wall",
        "title": "A light mass",
        "about": "As the wall.",
        "source": "here",
        "duration": 2.0,
        "cases": {"light": {"controller.M_n": 0.5}},
        "metrics": {"energy_residual": {}},
    }
    found = exo.batch(tables, {"controller.K": [20.0]}, fmu_dir=fmu_dir)
    assert found[FAILURE].null_count == 1
    assert found["energy_residual"][0].as_py() < 1e-9
