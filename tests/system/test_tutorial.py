"""docs/tutorial.md, done word by word in a folder outside of this repository, with a space and an umlaut in its path.

Not done: the blocks `console`, which clone, install from a network, or fetch compilers. In their place stand this
clone and the program that `cargo xtask test` has built of it. A configuration of cargo lies in the folder above, as a
stranger may have one: other flags, another target, panics that abort, a target folder elsewhere.
"""

import csv
import math
import re
import shutil
import subprocess
import zipfile
from collections.abc import Iterable
from ctypes import byref
from dataclasses import dataclass
from pathlib import Path

import fmpy
import pytest
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import (
    FMU2Slave,
    fmi2CallbackAllocateMemoryTYPE,
    fmi2CallbackFreeMemoryTYPE,
    fmi2CallbackFunctions,
    fmi2CallbackLoggerTYPE,
)
from fmpy.logging import addLoggerProxy

from cargo_fmu import ROOT, cargo_fmu, environment

from foreign.cosim import cosim

TUTORIAL = (ROOT / "docs" / "tutorial.md").read_text(encoding="utf-8")

#: The Modelica Association's simulator, if it is on this machine.
FMUSIM = shutil.which("fmusim")

#: Kind and text of each block, in order.
BLOCKS = re.findall(r"^```(\w+)\n(.*?)^```$", TUTORIAL, re.MULTILINE | re.DOTALL)

#: What a stranger's own configuration of cargo may say.
CONFIGURATION = """
[build]
target = "thumbv7em-none-eabihf"
rustflags = ["-Cpanic=abort"]
[profile.release]
panic = "abort"
debug = true
"""


@dataclass(frozen=True)
class Done:
    """The package at the end, and what was printed on the way."""

    package: Path
    target: Path
    printed: list[str]

    @property
    def fmu(self) -> Path:
        """The archive."""
        return self.target / "fmu" / "MyPlant.fmu"

    @property
    def twin(self) -> Path:
        """The same for FMI 3.0."""
        return self.target / "fmu" / "fmi3" / "MyPlant.fmu"


@pytest.fixture(scope="module")
def done(tmp_path_factory: pytest.TempPathFactory) -> Done:
    """Runs the tutorial from its first word to its last."""
    folder = tmp_path_factory.mktemp("eigene Modelle für FMI")
    target = tmp_path_factory.mktemp("target")
    (folder / ".cargo").mkdir()
    (folder / ".cargo" / "config.toml").write_text(CONFIGURATION, encoding="utf-8")
    where, printed = folder, []
    for kind, text in BLOCKS:
        if kind == "sh":
            # The folder in which one block ends is where the next one begins.
            after = folder / "where"
            script = f'set -euo pipefail\n{text}\npwd > "{after}"\n'
            run = subprocess.run(
                ["bash", "-c", script],
                cwd=where,
                env=environment(target),
                capture_output=True,
                encoding="utf-8",
                check=False,
            )
            assert run.returncode == 0, f"{text}{run.stdout}{run.stderr}"
            where = Path(after.read_text(encoding="utf-8").strip())
            printed.append(run.stdout)
        elif kind == "text":
            assert printed[-1] == text
        elif kind == "rust":
            assert (where / "src" / "lib.rs").read_text(encoding="utf-8") == text
        elif kind == "toml":
            manifest = where / "Cargo.toml"
            said = re.search(r"version `([\d.]+)` instead\s+of `([\d.]+)`", TUTORIAL)
            assert said is not None
            old = manifest.read_text(encoding="utf-8")
            new = old.replace(f'version = "{said[2]}"', f'version = "{said[1]}"', 1)
            manifest.write_text(f"{new}\n{text}", encoding="utf-8")
        else:
            assert kind == "console", kind
    return Done(where, target, printed)


def test_the_tutorial_runs_and_its_own_test_agrees_with_the_closed_form(done: Done) -> None:
    assert done.printed[0].splitlines()[-2:] == [str(done.fmu), str(done.fmu.parent / "fmi3" / done.fmu.name)]
    assert done.printed[1] == "as the closed form says\n"
    assert "No problems found" in done.printed[-1]


#: A mass (kg) at a damper (N·s/m) and a spring (N/m), and the force (N) on it.
VALUES = {"m": 1.5, "d": 0.9, "k": 30.0, "force": 2.0}
#: The communication step (s) and how many.
STEP, STEPS = 0.01, 400


def assert_closed_form(times: Iterable[float], places: Iterable[float]) -> None:
    """A step of the force from rest: x (m) at each time (s)."""
    m, d, k, force = VALUES.values()
    decay = d / (2 * m)
    omega = math.sqrt(k / m - decay**2)
    number = 0
    for t, x in zip(times, places, strict=True):
        wave = math.cos(omega * t) + decay / omega * math.sin(omega * t)
        # The method's error in substeps of 1 ms is far below.
        assert x == pytest.approx(force / k * (1 - math.exp(-decay * t) * wave), abs=1e-10), t
        number += 1
    assert number >= STEPS


def test_a_step_of_the_force_moves_the_mass_as_the_closed_form_says(done: Done) -> None:
    for fmu in (done.fmu, done.twin):
        run = fmpy.simulate_fmu(str(fmu), stop_time=STEPS * STEP, output_interval=STEP, start_values=VALUES)
        assert_closed_form(run["time"], run["x"])


def test_libcosim_moves_it_as_the_closed_form_says(done: Done) -> None:
    start = {f"plant.{name}": value for name, value in VALUES.items()}
    found = cosim(
        {
            "step_ns": round(STEP * 1e9),
            "steps": STEPS,
            "instances": {"plant": str(done.fmu)},
            "start": start,
            "connections": {},
            "inputs": {"plant.force": [VALUES["force"]] * STEPS},
            "outputs": ["plant.x"],
        }
    )
    assert_closed_form([STEP * (k + 1) for k in range(STEPS)], found["plant.x"])


@pytest.mark.skipif(FMUSIM is None, reason="fmusim (github.com/modelica/fmusim) is not on PATH")
def test_fmusim_moves_it_as_the_closed_form_says(done: Done, tmp_path: Path) -> None:
    for fmu in (done.fmu, done.twin):
        table = tmp_path / "out.csv"
        starts = [part for name, value in VALUES.items() for part in ("--start-value", f"{name}={value}")]
        times = ["--stop-time", str(STEPS * STEP), "--set-stop-time", "--output-interval", str(STEP)]
        command = [str(FMUSIM), "simulate", *times, *starts, "--output-variable", "x", "--output-file", str(table)]
        run = subprocess.run([*command, str(fmu)], capture_output=True, encoding="utf-8", check=False)
        assert run.returncode == 0, run.stdout + run.stderr
        rows = list(csv.DictReader(table.read_text(encoding="utf-8").splitlines()))
        assert_closed_form([float(row["time"]) for row in rows], [float(row["x"]) for row in rows])


def test_the_fmu_says_whose_it_is_and_nothing_of_this_project(done: Done) -> None:
    description = fmpy.read_model_description(str(done.fmu))
    assert (description.version, description.author, description.copyright, description.license) == (
        "1.2.0",
        "Jane Doe",
        "Copyright 2026 Jane Doe",
        None,
    )
    run = fmpy.instantiate_fmu(fmpy.extract(str(done.fmu)), description)
    references = {variable.name: variable.valueReference for variable in description.modelVariables}
    assert run.getString([references["version"], references["git_hash"]]) == [b"1.2.0", b"unknown"]
    run.freeInstance()
    with zipfile.ZipFile(done.fmu) as archive:
        names = archive.namelist()
        overview = archive.read("documentation/licenses/license.txt").decode()
    assert overview.startswith("MyPlant 1.2.0\nCopyright 2026 Jane Doe\n\nThe package names no licence.\n")
    # This SDK is linked in, under its own licence.
    for sdk in ("fmu-export-", "fmu-declaration-"):
        assert any(name.startswith(f"documentation/licenses/{sdk}") for name in names), sdk
        assert re.search(rf"^{sdk}\S+ +MIT OR Apache-2.0$", overview, re.MULTILINE)


def test_the_library_offers_the_standard_s_functions_alone_and_tells_of_no_folder(done: Done) -> None:
    with zipfile.ZipFile(done.fmu) as archive:
        (library,) = [name for name in archive.namelist() if name.startswith("binaries/")]
        code = archive.read(library)
    assert b"fmi2DoStep\0" in code
    assert b"fmu_interface" not in code
    for folder in (str(done.package), str(done.target), str(ROOT), str(Path.home()), ".cargo/registry"):
        assert folder.encode() not in code, folder


def test_a_path_of_the_machine_in_the_model_is_named_and_no_archive_written(done: Done) -> None:
    source = done.package / "src" / "lib.rs"
    kept = source.read_text(encoding="utf-8")
    out = done.target / "refused"
    words = 'Err(Refusal(format!("{} {step:?}", env!("CARGO_MANIFEST_DIR"))))'
    try:
        source.write_text(
            re.sub(r"(fn step\(.*\{\n)", rf"\1        if step.h > 1e6 {{ return {words}; }}\n", kept), "utf-8"
        )
        run = cargo_fmu("build", "--out", str(out), cwd=done.package, target=done.target)
    finally:
        source.write_text(kept, encoding="utf-8")
    assert run.returncode == 1
    assert re.search(rf"error: \S*libmy_plant\.\w+ carries the path {re.escape(str(done.package))}", run.stderr), (
        run.stderr
    )
    assert not out.exists()


@pytest.mark.parametrize(
    ("right", "wrong", "said"),
    [
        ('from = ["x_0"]', 'from = ["x_1"]', "x: initially_from x_1: expected an output"),
        ("start = 1.0", 'start = panic!("no mass")', "panic in the start values: no mass at src/lib.rs:"),
    ],
)
def test_a_declaration_that_breaks_a_rule_is_named_by_its_row(done: Done, right: str, wrong: str, said: str) -> None:
    source = done.package / "src" / "lib.rs"
    kept = source.read_text(encoding="utf-8")
    try:
        source.write_text(kept.replace(right, wrong), encoding="utf-8")
        run = cargo_fmu("describe", cwd=done.package, target=done.target)
    finally:
        source.write_text(kept, encoding="utf-8")
    assert run.returncode == 1
    assert f"error: library my_plant of my-plant: {said}" in run.stderr
    assert "backtrace" not in run.stderr


def test_a_step_that_would_seem_to_hang_is_refused_by_name_and_the_instance_goes_on(done: Done) -> None:
    description = fmpy.read_model_description(str(done.fmu))
    said: list[str] = []
    logged = fmi2CallbackLoggerTYPE(lambda _, __, ___, ____, text: said.append(text.decode()))
    callbacks = fmi2CallbackFunctions(logger=logged)
    callbacks.allocateMemory = fmi2CallbackAllocateMemoryTYPE(fmpy.calloc)
    callbacks.freeMemory = fmi2CallbackFreeMemoryTYPE(fmpy.free)
    addLoggerProxy(byref(callbacks))
    run = FMU2Slave(
        guid=description.guid,
        unzipDirectory=fmpy.extract(str(done.fmu)),
        modelIdentifier=description.coSimulation.modelIdentifier,
    )
    run.instantiate(callbacks=callbacks, loggingOn=True)
    run.setupExperiment()
    run.enterInitializationMode()
    run.exitInitializationMode()
    for step in (1e5 * 1.001, 1e300):
        with pytest.raises(FMICallException):
            run.doStep(0.0, step)
    run.doStep(0.0, STEP)
    run.freeInstance()
    assert [text for text in said if "fmi2DoStep" in text] == [
        f"fmi2DoStep: communicationStepSize = {step} s, expected at most 100000.0 s (1e8 times the substep)"
        for step in ("100099.99999999999", "1e300")
    ]
