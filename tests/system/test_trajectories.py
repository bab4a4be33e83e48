"""Every importer gives each FMU the same inputs, and gets the same outputs after every step, bit for bit."""

from collections.abc import Mapping
from pathlib import Path

import numpy as np
import pytest

from exo.fmu import Archive

from foreign.matrix import load
from foreign.record import Record, record
from foreign.runs import BOX, RUNS, Clock, by_calls, difference, in_container, nanoseconds, product

STEPS = 400
MATRIX = load()


def differences(found: Mapping[str, np.ndarray], expected: Mapping[str, np.ndarray]) -> dict[str, float]:
    """Largest difference of each output that is not the same in every bit."""
    assert sorted(found) == sorted(expected)
    return {
        name: float(np.max(np.abs(found[name] - values)))
        for name, values in expected.items()
        if found[name].tobytes() != values.tobytes()
    }


@pytest.fixture(scope="module")
def given(fmu: Path, archives: Mapping[str, Archive]) -> tuple[Archive, Record]:
    """An FMU and what every importer gives to it."""
    archive = archives[fmu.name]
    return archive, record(archive, steps=STEPS)


def test_the_inputs_all_move_and_most_outputs_do(given: tuple[Archive, Record]) -> None:
    archive, one = given
    assert list(one.inputs) == archive.names("input")
    assert [name for name, values in one.inputs.items() if np.ptp(values) == 0.0] == []
    found = by_calls(archive, one, product)
    still = [name for name, values in found.items() if np.ptp(values) == 0.0]
    # What is off at the start (joint space, faults, detector, clocks) rests: half of ArmController's outputs.
    assert len(still) < 0.6 * len(found), still
    assert [name for name in still if name.startswith(("tau_a", "p[", "p_n", "dp[", "e_nr", "f_a"))] == []


@pytest.mark.parametrize("importer", RUNS)
def test_an_importer_gets_the_outputs_that_direct_calls_get(
    importer: str, given: tuple[Archive, Record], tmp_path: Path
) -> None:
    archive, one = given
    assert MATRIX.ran(importer, archive.path.stem), "what is run stands in matrix.toml"
    run, clock = RUNS[importer]
    assert differences(run(archive, one, tmp_path), by_calls(archive, one, clock)) == {}


@pytest.mark.parametrize("clock", [difference, nanoseconds])
def test_the_importers_clocks_give_the_same_outputs_to_1e_12_where_nothing_is_touched(
    clock: Clock, given: tuple[Archive, Record]
) -> None:
    archive, one = given
    free = {key: value for key, value in one.settings.items() if not key.startswith(("table.", "payload."))}
    apart = Record(settings=free, step=one.step, time=one.time, inputs=one.inputs)
    found, expected = by_calls(archive, apart, clock), by_calls(archive, apart, product)
    beyond = {
        name: float(np.max(np.abs(found[name] - values)))
        for name, values in expected.items()
        if np.any(np.abs(found[name] - values) > 1e-12 * np.maximum(1.0, np.abs(values)))
    }
    assert beyond == {}


def test_an_input_that_comes_one_step_late_is_seen(archives: Mapping[str, Archive], tmp_path: Path) -> None:
    archive = archives["Testbed.fmu"]
    one = record(archive, steps=STEPS)
    late = {name: np.roll(values, 1) for name, values in one.inputs.items()}
    found = in_container(archive, Record(settings={}, step=one.step, time=one.time, inputs=late), tmp_path)
    assert len(differences(found, by_calls(archive, one, product))) > 10
    assert all(not name.startswith(f"{BOX}.") for name in found)
