"""The table of importers says what is so: versions, files, FMUs, and the documents that show it."""

import re
import tomllib
from importlib import metadata
from pathlib import Path

import pytest

from exo.systems.closed import CLOSED
from exo.systems.system import RECIPES

from conftest import NAMES
from foreign.matrix import DOCUMENTS, NAMES_SCHEDULED, ROOT, STATES, filled, load
from foreign.runs import RUNS

MATRIX = load()


def test_the_versions_are_those_that_run() -> None:
    lock = tomllib.loads((ROOT / "Cargo.lock").read_text())
    crates = {package["name"]: package["version"] for package in lock["package"]}
    for one in MATRIX.importer:
        if "python" in one:
            assert one["version"] == metadata.version(one["python"]), one["name"]
        elif "crate" in one:
            assert one["version"] == crates[one["crate"]], one["name"]
        else:
            assert "version" not in one, one["name"]


def test_every_fmu_and_every_system_has_a_row_and_every_importer_runs_every_fmu() -> None:
    kinds = ("{}.fmu (container)", "{}.ssp", f"{{}}{CLOSED}.ssp", "{}.ssp (SSP 2.0)", f"{{}}{CLOSED}.ssp (SSP 2.0)")
    systems = [kind.format(name) for kind in kinds for name in RECIPES]
    fmi3 = [f"fmi3/{name}.fmu" for name in NAMES] + [f"fmi3/scheduled/{name}.fmu" for name in NAMES_SCHEDULED]
    assert sorted(one["name"] for one in MATRIX.subject) == sorted([f"{name}.fmu" for name in NAMES] + fmi3 + systems)
    known = [one["name"] for one in MATRIX.importer]
    assert set(RUNS) < set(known)
    assert all(set(one["ran"]) <= set(known) for one in MATRIX.subject)
    # What each of these runs is checked where it runs (test_trajectories); here, that none is left out.
    assert [(importer, name) for importer in RUNS for name in NAMES if not MATRIX.ran(importer, name)] == []


def test_the_tests_that_it_names_are_there() -> None:
    assert [path for one in MATRIX.importer for path in one["tests"] if not (ROOT / path).exists()] == []


def test_the_states_of_platforms_are_known_and_the_first_one_is_run() -> None:
    assert MATRIX.platform[0]["name"] == "linux64"
    assert MATRIX.platform[0]["state"] == "run"
    assert all(one["state"] in STATES for one in MATRIX.platform)


def test_the_platforms_are_those_that_are_distributed() -> None:
    table = (ROOT / "modelDescription/cargo-fmu/src/platform.rs").read_text(encoding="utf-8")
    runners = re.findall(r'folder: "([^"]+)",.*?runner: Runner::(\w+),', table, flags=re.DOTALL)
    assert len(runners) >= 5
    expected = {folder: "built" if runner == "Nothing" else "run" for folder, runner in runners}
    assert {one["name"]: one["state"] for one in MATRIX.platform} == expected


@pytest.mark.parametrize("document", DOCUMENTS)
def test_a_document_shows_the_tables_as_they_are(document: str) -> None:
    text = Path(ROOT / document).read_text(encoding="utf-8")
    assert filled(document, text) == text, "cd tests/system && python -m foreign.matrix"


def test_another_table_is_another_text() -> None:
    text = (ROOT / "docs/importers.md").read_text(encoding="utf-8")
    assert filled("docs/importers.md", text.replace("| run |", "| – |", 1)) == text
    assert text.replace("| run |", "| – |", 1) != text
