"""The same loop in native Rust (dlopen, no Python) gives what the harness gives through fmpy.

`cargo xtask test` builds the program; by hand: `cargo build --package abi --bin native_loop`.
"""

import os
import subprocess
from pathlib import Path

import numpy as np
import pytest

from exo import master
from exo.fmu import Archive
from exo.profile import evaluate
from exo.scenario import load

ROOT = Path(__file__).parents[2]
COLUMNS = ("plant.q", "controller.q_n", "controller.e_nr", "controller.tau_a", "controller.energy.G")


@pytest.fixture(scope="module")
def native_loop() -> Path:
    program = Path(os.environ.get("EXO_NATIVE_LOOP", ROOT / "target" / "debug" / "native_loop"))
    assert program.is_file(), f"{program} is missing: run `cargo build --package abi --bin native_loop` first"
    return program


@pytest.mark.parametrize(
    ("scenario", "case"),
    [("wall", "passive_bounded_5_0.5"), ("wall", "passive_10_0.5"), ("adversary", "passive"), ("gain_study", "K30")],
)
def test_native_and_fmpy_loop_agree(scenario: str, case: str, native_loop: Path, fmu_dir: Path, tmp_path: Path) -> None:
    loaded = load(scenario)
    plan = master.plan(scenario=loaded, case=next(c for c in loaded.cases if c.id == case))
    time = np.arange(plan.steps) * plan.step
    forces = {name: evaluate(segments=segments, time=time) for name, segments in plan.profiles.items()}
    forces.setdefault("tau_d", np.zeros(plan.steps))
    rows = zip(time.tolist(), forces["tau_h"].tolist(), forces["tau_d"].tolist(), strict=True)
    (tmp_path / "in.csv").write_text("t,tau_h,tau_d\n" + "".join(f"{t!r},{h!r},{d!r}\n" for t, h, d in rows))

    with Archive(fmu_dir / "TestbedController.fmu") as controller, Archive(fmu_dir / "Testbed.fmu") as plant:
        run = master.simulate(plan=plan, archives={a.path.name: a for a in (controller, plant)})
        settings = []
        for name, value in plan.parameters.items():
            component, variable = name.split(".", 1)
            archive = controller if component == "controller" else plant
            number = archive.start_value(variable, value)[1]
            settings += ["--set", f"{'controller' if archive is controller else 'testbed'}.{variable}={number!r}"]

    arguments = ["--fmu-dir", fmu_dir, "--input", tmp_path / "in.csv", "--output", tmp_path / "out.csv", *settings]
    answer = subprocess.run([native_loop, *arguments], capture_output=True, text=True, check=False)
    assert answer.returncode == 0, answer.stderr
    native = np.loadtxt(tmp_path / "out.csv", delimiter=",", skiprows=1)
    for column, name in enumerate(COLUMNS, start=1):
        # The same libraries, the same inputs bit for bit: what differs is only who calls.
        assert abs(native[:, column] - run[name]).max() <= 1e-12, name
