"""What docs/python.md and docs/results.md tell a reader to type, typed."""

import inspect
import re
import shlex
import subprocess
import sys
from contextlib import redirect_stdout
from io import StringIO
from pathlib import Path
from typing import Any

import pytest

import exo

from commands import exo as command

DOCS = Path(__file__).resolve().parents[2] / "docs"
PAGE = (DOCS / "python.md").read_text(encoding="utf-8")


def test_the_examples_run_one_after_the_other_and_say_what_the_page_says(
    tmp_path: Path, fmu_dir: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("EXO_FMU_DIR", str(fmu_dir))
    known: dict[str, Any] = {}
    printed = StringIO()
    blocks = re.findall(r"```python\n(.*?)```", PAGE, re.DOTALL)
    assert len(blocks) >= 6
    for number, block in enumerate(blocks):
        with redirect_stdout(printed):
            exec(compile(block, f"docs/python.md, example {number + 1}", "exec"), known)
    assert "N/m 100000.0" in printed.getvalue()
    assert "TestbedController.fmu: law: no item pasive (close matches: passive" in printed.getvalue()
    assert list(known["stiff"].index) == ["wall.k"]
    assert known["run"].choices["controller.law"] == "standard"
    assert (tmp_path / "push.png").stat().st_size > 10_000
    assert known["again"]["plant.q"].tobytes() == known["run"]["plant.q"].tobytes()
    assert [case.id for case in known["scenario"].cases] == ["light", "heavy"]


def test_the_page_has_every_public_name_and_no_other() -> None:
    told = set(re.findall(r"`exo\.(\w+)`", PAGE))
    assert told >= set(exo.__all__)
    assert told - set(exo.__all__) <= {"ExoError", "__all__"}


@pytest.mark.parametrize("name", [name for name in exo.__all__ if name != "__version__"])
def test_every_public_name_is_documented_and_typed(name: str) -> None:
    thing = getattr(exo, name)
    assert len(inspect.getdoc(thing) or "") > 30
    functions = [thing] if inspect.isfunction(thing) else []
    if inspect.isclass(thing) and thing.__module__.startswith("exo.api."):
        functions = [one for key, one in vars(thing).items() if inspect.isfunction(one) and not key.startswith("_")]
    for function in functions:
        assert inspect.getdoc(function), function.__qualname__
        signature = inspect.signature(function)
        assert signature.return_annotation is not inspect.Signature.empty, function.__qualname__
        untyped = [one.name for one in signature.parameters.values() if one.annotation is one.empty]
        assert set(untyped) <= {"self", "cls"}, function.__qualname__


SCRIPT = """
from pathlib import Path
import numpy as np
from numpy.typing import NDArray
import exo

def waves(t: NDArray[np.float64]) -> NDArray[np.float64]:
    return 5.0 * np.sin(2.5 * t)

def push(t: float) -> float:
    return 1.0 if t > 1.0 else 0.0

def main() -> None:
    plant: exo.Fmu = exo.load("Testbed.fmu")
    mass: exo.Variable = plant["M"]
    fmus = {"plant": "Testbed.fmu"}
    system: exo.System = exo.couple(fmus, step=0.002)
    exo.couple({"one": plant, "other": Path("Testbed.fmu")}, wires={"one.tau_h": "other.tau_e"}, step=0.002)
    gains = {"plant.M": 6.0}
    run: exo.Run = exo.simulate(
        system,
        duration=1.0,
        inputs={"plant.tau_h": push, "plant.tau_d": waves, "plant.tau_a": [1.0] * 500, "plant.q_d": np.float32(1.0)},
        parameters=gains,
    )
    exo.simulate(
        system,
        duration=1.0,
        inputs={"plant.tau_h": np.ones(500)},
        parameters={"plant.M": np.float64(6.0), "plant.drive.mode": "torque", "plant.x[1..3]": np.ones(3)},
    )
    exo.simulate(system, duration=1.0, inputs={"plant.tau_h": [{"kind": "constant", "amplitude": 1.0}]})
    scenario: exo.Scenario = exo.read_scenario("wall")
    print(exo.simulate(scenario, case="standard_5_0.5").units["plant.q"], mass.start, mass.unit)
    q: NDArray[np.float64] = run["plant.q"]
    print(q.max(), run.frame("plant.q")["plant.q"], run.dataset()["plant.q"].attrs["units"], [name for name in run])
    run.plot("plant.q").savefig("x.png")
    path: Path = run.save("x.parquet")
    print(exo.read_run(path).name, exo.batch("wall", {"controller.K": [1.0]})["release_delay"])
    try:
        exo.load("x")
    except exo.ExoError as error:
        print(error)
"""


def test_the_script_of_somebody_who_checks_types_strictly_passes(tmp_path: Path) -> None:
    """And what is wrong in it is found: a step that is a text, a force that is no function of the time."""
    (tmp_path / "script.py").write_text(SCRIPT, encoding="utf-8")
    wrong = SCRIPT.replace("fmus, step=0.002", 'fmus, step="fast"').replace(
        '"plant.tau_h": push', '"plant.tau_h": main'
    )
    (tmp_path / "wrong.py").write_text(wrong, encoding="utf-8")
    cache = f"--cache-dir={Path(exo.__file__).parents[2] / '.mypy_cache'}"
    command = [sys.executable, "-m", "mypy", "--strict", cache, "script.py", "wrong.py"]
    answer = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
    lines = answer.stdout.splitlines()
    assert [line for line in lines if line.startswith("script.py")] == [], answer.stdout
    assert sum("error:" in line for line in lines) == 2, answer.stdout + answer.stderr


def test_the_exports_of_the_results_page_are_commands_that_run(
    tmp_path: Path, fmu_dir: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    pattern = "passive_*_5_0.5"
    arguments = ["--case", pattern, "--duration", 1, "--fmu-dir", fmu_dir]
    assert command("run", "wall", *arguments).exit_code == 0
    (tmp_path / "push.parquet").write_bytes(
        (tmp_path / "results/wall/signals/passive_applied_5_0.5.parquet").read_bytes()
    )
    page = (DOCS / "results.md").read_text(encoding="utf-8")
    lines = [line.strip() for line in page.splitlines() if line.startswith("    exo export")]
    assert len(lines) == 5
    for line in lines:
        typed = shlex.split(re.split(r"\s{3,}", line)[0])
        answer = command(*typed[1:], *(["--overwrite"] if "--excel" in typed else []))
        assert answer.exit_code == 0, (line, answer.output, answer.stderr)
    endings = {path.suffix for path in (tmp_path / "export" / "wall").iterdir()}
    assert endings == {".csv", ".mf4", ".mat"}
    assert (tmp_path / "here" / "push.csv").is_file()
