"""Broken FMUs in a run: each is one sentence that names the archive, the process lives on, nothing stays behind."""

import os
import shutil
import signal
import subprocess
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path

import pytest

from exo import experiment, extraction, scenario
from exo.errors import FmuError
from exo.fmu import Archive

from broken.mutants import ARCHIVE, MACHINE_CODE, RUN, TEXT, VARIABLES, Mutant, edit, put, variable
from broken.parts import INDEX, XML, Parts, plain

ONE = """
title = "One FMU"
about = "A tenth of a second."
source = "here"
duration = 0.1
step = 0.01
[components.one]
archive = "broken.fmu"
[inputs]
[cases.only]
"""
#: What importers need not see: the run goes on.
HARMLESS = {
    "archive-extension: called .zip",
    "archive-ascii: an umlaut",
    "archive-backslash: a Windows path",
    "archive-windows: a device",
    "archive-windows: a star",
    "archive-windows: a stream",
    "archive-windows: a dot at the end",
    "archive-windows: a blank at the end of a folder",
    "xml-declaration: no encoding in it",
    "xml-declaration: none",
    "xml-declaration: XML 1.1",
    "xml-mark: a byte order mark",
    "xml-encoding: Latin-1",
    "xml-encoding: UTF-16",
    "fmpy: an output is missing in Outputs",
    "binary-platform: an unknown platform",
    "binary-wanted: no darwin64",
    "binary-format: an ELF file for Windows",
    "binary-extra: one more symbol",
    "binary-paths: a path of the builder",
    "binary-glibc: newer than 2.1",
    "binary-needs: libgcc_s",
    "load-version: FMI 2.1",
    "load-guid: takes any guid",
    "load-start: a Real",
    "load-start: a Boolean",
    "load-bounds: an output above max",
    "load-streams: talks",
}


def cut(share: float) -> Callable[[Parts], None]:
    """Only the first part of the library."""

    def change(parts: Parts) -> None:
        whole = parts.entries[parts.library]
        parts.entries[parts.library] = whole[: int(len(whole) * share)]

    return change


def only_windows(parts: Parts) -> None:
    """The library in the folder of another platform."""
    parts.entries["binaries/win64/TestbedController.dll"] = parts.entries.pop(parts.library)


OWN = [
    *(Mutant("cut", f"{share:g} of the library", cut(share)) for share in (0.0, 0.1, 0.5, 0.7, 0.9, 0.97)),
    Mutant("no-linux64", "only win64", only_windows),
    Mutant("integer", "an output of default variability", edit(variable("tick"), remove=("variability",))),
    Mutant("evil", "a library outside", edit("CoSimulation", modelIdentifier="../../evil")),
    Mutant("empty", "an empty description", put(XML, b"")),
]
MUTANTS = [*ARCHIVE, *TEXT, *MACHINE_CODE, *RUN, *OWN, *(m for m in VARIABLES if m.rule == "variable-variability")]


@pytest.fixture
def place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """An empty folder for temporary files."""
    folder = tmp_path / "temporary"
    folder.mkdir()
    monkeypatch.setattr(tempfile, "tempdir", str(folder))
    return folder


@pytest.mark.parametrize("mutant", MUTANTS, ids=lambda mutant: mutant.id)
def test_a_broken_fmu_is_one_sentence_that_names_it(mutant: Mutant, fmu_dir: Path, tmp_path: Path, place: Path) -> None:
    parts = plain(tmp_path, *mutant.macros) if mutant.base == "Plain" else Parts.of(fmu_dir / f"{mutant.base}.fmu")
    mutant.change(parts)
    parts.write(tmp_path).rename(tmp_path / "broken.fmu")
    if mutant.id in HARMLESS:
        done = experiment.run(scenario=scenario.parse(text=ONE, origin="one.toml"), fmu_dir=tmp_path)
        assert len(done.recordings["only"].time) == 10
    else:
        with pytest.raises(FmuError) as error:
            experiment.run(scenario=scenario.parse(text=ONE, origin="one.toml"), fmu_dir=tmp_path)
        text = str(error.value)
        assert "broken.fmu" in text or text.startswith("one: case only: one: fmi2")
        assert "\n" not in text
        assert str(place) not in text
    assert list(place.iterdir()) == []


def test_a_library_that_is_cut_is_named_with_the_signal(fmu_dir: Path, tmp_path: Path) -> None:
    parts = Parts.of(fmu_dir / "TestbedController.fmu")
    cut(0.5)(parts)
    parts.write(tmp_path)
    with pytest.raises(
        FmuError, match=r"broken\.fmu: tried in a process of its own, its library ended by SIG(BUS|SEGV)"
    ):
        experiment.run(scenario=scenario.parse(text=ONE, origin="one.toml"), fmu_dir=tmp_path)


CHILD = """
import sys, tempfile, time
from pathlib import Path
from exo.fmu import Archive
tempfile.tempdir = sys.argv[2]
with Archive(Path(sys.argv[1])) as archive:
    print(archive.folder, flush=True)
    time.sleep(60)
"""


@pytest.fixture
def child(place: Path, fmu_dir: Path) -> subprocess.Popen[str]:
    """A process that has an archive open."""
    process = subprocess.Popen(
        [sys.executable, "-c", CHILD, fmu_dir / "Testbed.fmu", place], stdout=subprocess.PIPE, text=True
    )
    assert process.stdout is not None
    assert Path(process.stdout.readline().strip()).is_dir()
    yield process
    process.kill()
    process.wait()
    process.stdout.close()


def test_the_next_run_removes_what_a_killed_process_has_left_and_nothing_of_a_living_one(
    child: subprocess.Popen[str], place: Path, fmu_dir: Path
) -> None:
    (left,) = place.iterdir()
    with Archive(fmu_dir / "Testbed.fmu"):
        assert left.is_dir()
    child.kill()
    child.wait()
    assert left.is_dir()
    with Archive(fmu_dir / "Testbed.fmu") as archive:
        assert not left.exists()
        assert Path(archive.folder).is_dir()
    assert list(place.iterdir()) == []


def test_a_run_that_is_told_to_end_leaves_nothing(place: Path, fmu_dir: Path, tmp_path: Path) -> None:
    command = [sys.executable, "-m", "exo", "run", "wall", "--fmu-dir", fmu_dir, "--out", tmp_path / "out"]
    process = subprocess.Popen(command, env=os.environ | {"TMPDIR": str(place)}, stderr=subprocess.PIPE, text=True)
    while process.poll() is None and not list(place.glob(f"{extraction.PREFIX}*")):
        pass
    process.send_signal(signal.SIGTERM)
    _, said = process.communicate(timeout=60)
    assert process.returncode == 143
    assert "Traceback" not in said
    assert list(place.iterdir()) == []
    assert [path.name for path in (tmp_path / "out").iterdir()] == []


def test_a_full_temporary_folder_is_a_sentence(fmu_dir: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    gone = tmp_path / "gone"
    gone.mkdir()
    monkeypatch.setattr(tempfile, "tempdir", str(gone))
    shutil.rmtree(gone)
    archive = Archive(fmu_dir / "Testbed.fmu")
    with pytest.raises(FmuError, match=r"Testbed\.fmu: cannot be extracted to .*gone"), archive:
        pass


def test_the_documentation_of_an_archive_does_not_matter(fmu_dir: Path, tmp_path: Path, place: Path) -> None:
    parts = Parts.of(fmu_dir / "TestbedController.fmu")
    parts.entries.pop(INDEX)
    parts.write(tmp_path)
    assert experiment.run(scenario=scenario.parse(text=ONE, origin="one.toml"), fmu_dir=tmp_path).passed
    assert list(place.iterdir()) == []


@pytest.mark.parametrize("strict", [True, False])
def test_a_description_without_a_version_is_told_so(strict: bool, fmu_dir: Path, tmp_path: Path) -> None:
    parts = Parts.of(fmu_dir / "Testbed.fmu")
    parts.edit(".", remove=("fmiVersion",))
    with pytest.raises(
        FmuError, match=r'broken\.fmu: modelDescription\.xml: no fmiVersion; expected fmiVersion="2\.0"$'
    ):
        Archive(parts.write(tmp_path), strict=strict)
