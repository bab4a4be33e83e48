"""The importers' pages: their Python runs as printed, and the wiring and its checks are what the FMUs do."""

import re
import shutil
import subprocess
import sys
import textwrap
from pathlib import Path

import numpy as np
import pytest

import exo
from exo.fmu import Archive, find_fmu_dir

from commands import exo as command
from documents.names import ROOT
from foreign.ecos import tbb

PAGES = ROOT / "docs/importers"
TOML = re.compile(r"^    ```toml\n(.*?)^    ```", re.MULTILINE | re.DOTALL)
BLOCK = re.compile(r"^```python\n(.*?)^```", re.MULTILINE | re.DOTALL)
WIRING = (PAGES / "wiring.md").read_text(encoding="utf-8")
WORD = re.compile(r"`(\w+)\.([\w\[\].]+)`")


@pytest.fixture(scope="module")
def systems(fmu_dir: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder that `exo ssp` writes: a fresh clone's CI has none."""
    folder = tmp_path_factory.mktemp("ssp")
    done = command("ssp", "--fmu-dir", fmu_dir, "--out", folder)
    assert done.exit_code == 0, done.output
    return folder


@pytest.fixture
def place(fmu_dir: Path, systems: Path, tmp_path: Path) -> Path:
    """A folder in which `target` is as the pages say."""
    (tmp_path / "target").mkdir()
    (tmp_path / "target/fmu").symlink_to(fmu_dir)
    (tmp_path / "target/ssp").symlink_to(systems)
    return tmp_path


@pytest.mark.parametrize(
    ("page", "said"), [("fmpy", ""), ("ecos", r"0\.\d+"), ("libcosim", r"\[0\.\d+\]"), ("../tour", r"0\.300")]
)
def test_the_python_of_a_page_runs(place: Path, page: str, said: str) -> None:
    blocks = BLOCK.findall((PAGES / f"{page}.md").read_text(encoding="utf-8"))
    assert blocks
    text = "\n".join(blocks)
    if page == "ecos":
        text = f"import ctypes\nctypes.CDLL({tbb()!r}, mode=ctypes.RTLD_GLOBAL)\n{text}"
    done = subprocess.run(
        [sys.executable, "-c", f"import matplotlib\nmatplotlib.use('agg')\n{text}"],
        cwd=place, capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    assert re.search(said, done.stdout), done.stdout
    assert page != "fmpy" or (place / "testbed.png").stat().st_size > 10_000


def test_every_line_of_the_wiring_joins_an_output_with_an_input() -> None:
    rows = [line.split("|")[1:3] for line in WIRING.splitlines() if line.startswith("| ") and "`" in line]
    seen = 0
    for source, target in rows:
        for cell, causality in ((source, "output"), (target, "input")):
            for model, name in WORD.findall(cell):
                with Archive(find_fmu_dir(None) / f"{model}.fmu") as archive:
                    assert archive.variable(name.replace("1..3", "1")).causality == causality, f"{model}.{name}"
                    seen += 1
    assert seen > 15


MISTAKES = {
    "nothing": {},
    "`tau_a` is not wired": {"plant.tau_a": None},
    "`tau_a` has the wrong sign": {"plant.tau_a": "-controller.tau_a"},
    "the controller's `q` is not wired": {"controller.q": None},
    "the controller's `tau_h` is not wired": {"controller.tau_h": None},
    "the plant's `tau_h` is not wired": {"plant.tau_h": None},
}


@pytest.mark.parametrize("mistake", MISTAKES)
def test_a_wrong_wire_gives_the_numbers_of_the_table(mistake: str) -> None:
    found = re.search(rf"^\| (\S+) m \| (\S+) m \| {re.escape(mistake)}", WIRING, re.MULTILINE)
    assert found, mistake
    printed = [float(number.replace("−", "-")) for number in found.groups()]
    folder = find_fmu_dir(None)
    changed = MISTAKES[mistake]
    wires = {"controller.q": "plant.q", "plant.tau_a": "controller.tau_a"} | changed
    forces = [name for name in ("controller.tau_h", "plant.tau_h") if name not in changed]
    system = exo.couple(
        {"controller": folder / "TestbedController.fmu", "plant": folder / "Testbed.fmu"},
        wires={target: source for target, source in wires.items() if source and target not in forces},
        step=0.002,
    )
    run = exo.simulate(system, duration=12.0, inputs=dict.fromkeys(forces, lambda t: np.where(t < 6.0, 1.0, -1.0)))
    q = np.ravel(run.frame()["plant.q"])
    assert [q[2999], q[-1]] == pytest.approx(printed, rel=5e-3, abs=5e-4)


def test_the_scenario_for_a_law_of_ones_own_runs_with_any_archive_that_has_the_ports(tmp_path: Path) -> None:
    text = textwrap.dedent(TOML.findall((ROOT / "docs/own-law.md").read_text(encoding="utf-8"))[0])
    (tmp_path / "my_wall.toml").write_text(text, encoding="utf-8")
    fmus = tmp_path / "my-folder"
    fmus.mkdir()
    for source, target in (("TestbedController", "MyLaw"), ("Testbed", "Testbed")):
        shutil.copy(find_fmu_dir(None) / f"{source}.fmu", fmus / f"{target}.fmu")
    done = command("run", tmp_path / "my_wall.toml", "--fmu-dir", fmus, "--out", tmp_path / "out")
    assert done.exit_code == 0, done.output
    assert "release_delay/mine" in done.output
    assert (tmp_path / "out/my_wall/position.png").is_file()
