"""Parameters arrive in every importer, from a file and from inside the description; a variant brings its own."""

import zipfile
from collections.abc import Callable, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from exo.fmu import Archive
from exo.recording import Recording
from exo.simulate import simulate
from exo.systems import closed, ssp
from exo.systems.form import Form
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


def system(case: str, **settings: float) -> System:
    """The closed testbed with one parameter set: that of the case, with other values."""
    given = {key.replace("__", "."): value for key, value in settings.items()}
    parameters = dict(closed.case_plans(NAME)[case].parameters) | {"controller.T": T} | given
    return replace(closed.load(NAME, default=case), step=T, parameter_sets={case: parameters})


def harness(data: System, archives: Mapping[str, Archive]) -> Recording:
    """The same case in the harness."""
    parameters = data.parameter_sets[data.default]
    plan = closed.case_plans(NAME)[data.default]
    return simulate(
        plan=replace(plan, coupling="exchange_at_once", step=T, duration=STEPS * T, parameters=parameters),
        archives=archives,
    )


def position(data: System, archives: Mapping[str, Archive]) -> list[float]:
    """plant.q after each step, in the harness. It is a continuous output: row k + 1 is what step k left."""
    return list(np.asarray(harness(data, archives).columns["plant.q"], dtype=float)[1:])


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("run", [through_fmpy, through_libcosim, through_ecos])
def test_a_parameter_that_is_bound_acts_in_the_run(
    run: Run, way: str, archives: Mapping[str, Archive], tmp_path: Path
) -> None:
    data = system(CASE, plant__M=9.25)
    path = ssp.write(system=data, archives=archives, folder=tmp_path, form=WAYS[way])
    found = run(path, data, STEPS, SEEN)["plant.q"][:-1]
    assert found == position(data, archives)[: STEPS - 1]
    other = position(system(CASE), archives)
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


def two_cases(archives: Mapping[str, Archive], folder: Path) -> tuple[System, Path]:
    """SSP 2.0 with two cases, and the folder that it is unpacked in."""
    other = "wall-standard_10_0.5"
    data = system(CASE)
    parameters = dict(closed.case_plans(NAME)[other].parameters) | {"controller.T": T}
    data = replace(data, parameter_sets=dict(data.parameter_sets) | {other: parameters})
    path = ssp.write(system=data, archives=archives, folder=folder, form=Form(version="2.0", variants=True))
    with zipfile.ZipFile(path) as files:
        files.extractall(folder / "unpacked")
    return data, path


def test_libcosim_runs_ssp_2_0_and_the_variant_that_it_is_given(
    archives: Mapping[str, Archive], tmp_path: Path
) -> None:
    data, path = two_cases(archives, tmp_path)
    other = next(name for name in data.parameter_sets if name != CASE)
    runs: dict[str, Any] = {
        CASE: through_libcosim(path, data, STEPS, SEEN),
        other: through_libcosim(tmp_path / "unpacked" / f"{other}.ssd", data, STEPS, SEEN),
    }
    for name, found in runs.items():
        assert found["plant.q"][:-1] == position(ssp.variant(data, name), archives)[: STEPS - 1], name
    assert runs[CASE] != runs[other]


def test_where_an_importer_knows_the_default_only_the_variant_takes_its_place(
    archives: Mapping[str, Archive], tmp_path: Path
) -> None:
    data, path = two_cases(archives, tmp_path)
    other = next(name for name in data.parameter_sets if name != CASE)
    chosen = tmp_path / "chosen.ssp"
    with zipfile.ZipFile(path) as files, zipfile.ZipFile(chosen, "w") as target:
        for name in files.namelist():
            if not name.endswith(".ssd"):
                target.writestr(name, files.read(name))
        target.writestr(ssp.DEFAULT, files.read(f"{other}.ssd"))
    found = through_libcosim(chosen, data, STEPS, SEEN)
    assert found["plant.q"][:-1] == position(ssp.variant(data, other), archives)[: STEPS - 1]


def test_ecos_and_fmpy_refuse_version_2_0_by_name(archives: Mapping[str, Archive], tmp_path: Path) -> None:
    data, path = two_cases(archives, tmp_path)
    with pytest.raises(AssertionError, match=r"Unsupported SSP version: '2\.0'"):
        through_ecos(path, data, 1, SEEN)
    with pytest.raises(Exception, match=r"'2\.0' is not accepted by the pattern"):
        through_fmpy(path, data, 1, SEEN)
