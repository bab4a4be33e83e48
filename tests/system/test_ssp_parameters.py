"""Parameters arrive in every importer, from a file and from inside the description; a variant brings its own."""

import zipfile
from collections.abc import Callable, Mapping
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pytest

from exo.fmu import Archive
from exo.master import simulate
from exo.systems import closed, ssp
from exo.systems.form import SSP_2, Form
from exo.systems.system import System

from foreign.ssp_runs import through_ecos, through_fmpy, through_fmpy_alone, through_libcosim

#: Exact in seconds and in libcosim's nanoseconds.
T = 2.0**-9
STEPS = 512
NAME, CASE = "TestbedSystem", "gain_study-K7.5"
#: An output that every sample changes, and its type.
SEEN = {"plant.q": "Real"}
WAYS = {"file": Form(), "inline": Form(inline=True)}
Run = Callable[..., dict[str, list[float]]]


def system(case: str, *others: str, name: str = NAME, **settings: float) -> System:
    """The closed system with the parameter sets of these cases, with other values; the first is the default."""
    given = {key.replace("__", "."): value for key, value in settings.items()} | {"controller.T": T}
    plans = closed.case_plans(name)
    sets = {one: dict(plans[one].parameters) | given for one in (case, *others)}
    return replace(closed.load(name, default=case), step=T, parameter_sets=sets)


def in_the_harness(data: System, output: str, archives: Mapping[str, Archive]) -> list[float]:
    """A continuous output of the default case after each step: row k + 1 of the harness is what step k left."""
    plan = closed.case_plans(data.name.removesuffix(closed.CLOSED))[data.default]
    parameters = data.parameter_sets[data.default]
    run = simulate(
        plan=replace(plan, coupling="exchange_at_once", step=T, duration=STEPS * T, parameters=parameters),
        archives=archives,
    )
    return list(np.asarray(run.columns[output], dtype=float)[1:])


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("run", [through_fmpy, through_libcosim, through_ecos])
def test_a_parameter_that_is_bound_acts_in_the_run(
    run: Run, way: str, archives: Mapping[str, Archive], tmp_path: Path
) -> None:
    data = system(CASE, plant__M=9.25)
    path = ssp.write(system=data, archives=archives, folder=tmp_path, form=WAYS[way])
    found = run(path, data, STEPS, SEEN)["plant.q"][:-1]
    assert found == in_the_harness(data, "plant.q", archives)[: STEPS - 1]
    other = in_the_harness(system(CASE), "plant.q", archives)
    assert abs(found[-1] - other[STEPS - 2]) > 1e-4, "another mass moves otherwise"


@pytest.mark.parametrize("way", WAYS)
def test_fmpy_applies_no_binding_by_itself(way: str, archives: Mapping[str, Archive], tmp_path: Path) -> None:
    data = system(CASE, plant__M=9.25)
    path = ssp.write(system=data, archives=archives, folder=tmp_path, form=WAYS[way])
    # Not even the operator pulls: its segments are parameters.
    assert set(through_fmpy_alone(path, data, STEPS, SEEN)["plant.q"]) == {0.0}


def test_inline_values_are_those_of_the_files_and_no_file_is_left(
    archives: Mapping[str, Archive], tmp_path: Path
) -> None:
    data = closed.load(NAME)
    path = ssp.write(system=data, archives=archives, folder=tmp_path, form=WAYS["inline"])
    with zipfile.ZipFile(path) as files:
        assert [name for name in files.namelist() if name.endswith(".ssv")] == []
        inside = files.read(ssp.DEFAULT)
    for component in data.components:
        text = ssp.parameter_set(system=data, archives=archives, name=data.default, component=component)
        for line in text.decode().splitlines():
            assert "<ssv:Real " not in line or line.strip() in inside.decode(), line


class Pair(NamedTuple):
    """Two cases of a system, and an output that differs between them."""

    system: str
    default: str
    other: str
    output: str


TESTBED = Pair(NAME, CASE, "wall-standard_10_0.5", "plant.q")
ARM = Pair("ExoskeletonSystem", "arm_performance-K500", "arm_payload-passive_bounded_17.5kg", "plant.p[1]")


def written(pair: Pair, archives: Mapping[str, Archive], folder: Path) -> tuple[System, Path]:
    """SSP 2.0 with both cases, also unpacked beside it."""
    data = system(pair.default, pair.other, name=pair.system)
    path = ssp.write(system=data, archives=archives, folder=folder, form=SSP_2)
    with zipfile.ZipFile(path) as files:
        files.extractall(folder / "unpacked")
    return data, path


@pytest.mark.parametrize("pair", [TESTBED, ARM], ids=lambda pair: pair.system)
def test_libcosim_runs_ssp_2_0_and_the_variant_that_it_is_given(
    pair: Pair, archives: Mapping[str, Archive], tmp_path: Path
) -> None:
    data, path = written(pair, archives, tmp_path)
    places = {pair.default: path, pair.other: tmp_path / "unpacked" / f"{pair.other}.ssd"}
    runs = {case: through_libcosim(place, data, STEPS, {pair.output: "Real"}) for case, place in places.items()}
    for case, found in runs.items():
        expected = in_the_harness(ssp.variant(data, case), pair.output, archives)
        assert found[pair.output][:-1] == expected[: STEPS - 1], case
    assert runs[pair.default] != runs[pair.other]


def test_where_an_importer_knows_the_default_only_the_variant_takes_its_place(
    archives: Mapping[str, Archive], tmp_path: Path
) -> None:
    data, path = written(TESTBED, archives, tmp_path)
    chosen = tmp_path / "chosen.ssp"
    with zipfile.ZipFile(path) as files, zipfile.ZipFile(chosen, "w") as target:
        for name in files.namelist():
            if not name.endswith(".ssd"):
                target.writestr(name, files.read(name))
        target.writestr(ssp.DEFAULT, files.read(f"{TESTBED.other}.ssd"))
    found = through_libcosim(chosen, data, STEPS, SEEN)
    assert found["plant.q"][:-1] == in_the_harness(ssp.variant(data, TESTBED.other), "plant.q", archives)[: STEPS - 1]


def test_ecos_and_fmpy_refuse_version_2_0_by_name(archives: Mapping[str, Archive], tmp_path: Path) -> None:
    data, path = written(TESTBED, archives, tmp_path)
    with pytest.raises(AssertionError, match=r"Unsupported SSP version: '2\.0'"):
        through_ecos(path, data, 1, SEEN)
    with pytest.raises(Exception, match=r"'2\.0' is not accepted by the pattern"):
        through_fmpy(path, data, 1, SEEN)
