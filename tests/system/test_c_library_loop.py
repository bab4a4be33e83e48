"""The C library in the place of the controllers' FMUs, `exo run --c-library`: the same loop, pace, metrics and bits."""

import json
import zipfile
from collections.abc import Iterator
from contextlib import ExitStack
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from lxml import etree

from exo import c_library, master, selection
from exo.errors import ExoError, FmuError
from exo.fmu import Archive, Instance
from exo.recording import Recording
from exo.scenario import load

from commands import SHORT, exo

#: What presses, lifts, saturates, faults, is tuned on the way, commands drives, couples late: cases by pattern.
CASES = {
    "wall": "*_5_0.5",
    "live_tuning": "*",
    "limits": "*",
    "position_servo": "wall_*",
    "coupling_delay": "wall_*",
    "arm_supervision": "*",
    "arm_contact": "passive_*",
    "arm_servo": "table_*1",
}
#: By step, at most; cases of the testbed run to their end.
STEPS = {0.001: 2000, 0.002: 30_000}
#: What the library does not have, and the harness' own inputs of it: docs/real-time.md, "Not in the library".
WITHOUT = {"tick", "sample_period", "gain_warning", "M_min", "M_n[1]", "M_n[2]", "M_n[3]"}


@pytest.fixture(scope="module", params=c_library.PRECISIONS)
def folders(request: pytest.FixtureRequest, fmu_dir: Path) -> Iterator[tuple[str, Path]]:
    with c_library.archives(fmu_dir, request.param) as folder:
        yield request.param, folder


@pytest.fixture(scope="module")
def double(fmu_dir: Path) -> Iterator[dict[str, Archive]]:
    with c_library.archives(fmu_dir, "f64") as folder, ExitStack() as stack:
        yield {path.name: stack.enter_context(Archive(path)) for path in sorted(folder.glob("*.fmu"))}


def beside(name: str, case: str, archives: Any, library: Any, **changes: Any) -> tuple[Recording, Recording]:
    """A case with the FMU and with the library, by the same engine."""
    scenario = load(name)
    plan = master.plan(scenario=scenario, case=next(one for one in scenario.cases if one.id == case))
    plan = replace(plan, **{"duration": min(plan.duration, STEPS[plan.step] * plan.step), **changes})
    fmu, c = (master.simulate(plan=plan, archives=of, engine="native") for of in (archives, library))
    return fmu, c


@pytest.mark.parametrize(
    ("name", "case"),
    [(name, case.id) for name in CASES for case in selection.narrowed(load(name), cases=[CASES[name]]).cases],
)
def test_the_library_in_the_loop_is_the_fmu_bit_for_bit(
    name: str, case: str, archives: dict[str, Archive], double: dict[str, Archive]
) -> None:
    fmu, c = beside(name, case, archives, double)
    lacking = {key.split(".", 1)[1] for key in set(fmu.columns) - set(c.columns)}
    assert lacking <= WITHOUT | {key for key in lacking if key.startswith(("ft.bias", "stiff_hand.k_h"))}, lacking
    assert any(key.startswith("controller.") for key in c.columns)
    for key, column in c.columns.items():
        assert column.tobytes() == fmu.columns[key].tobytes(), key
    moved = [key for key, column in c.columns.items() if column.tobytes() != column[:1].tobytes() * len(column)]
    assert any(key.startswith("plant.") for key in moved), "nothing moves"


def test_single_precision_is_another_one_and_close(folders: tuple[str, Path], archives: dict[str, Archive]) -> None:
    precision, folder = folders
    with ExitStack() as stack:
        library = {path.name: stack.enter_context(Archive(path)) for path in sorted(folder.glob("*.fmu"))}
        fmu, c = beside("arm_contact", "passive_bounded", archives, library, duration=8.0)
    apart = max(float(np.abs(fmu[f"plant.q[{i}]"] - c[f"plant.q[{i}]"]).max()) for i in (1, 2, 3))
    # Of a float's positions, 3e-8 m, what 3 s of motion in a closed loop make of it.
    assert apart == 0.0 if precision == "f64" else 0.0 < apart < 1e-4
    assert float(np.ptp(fmu["plant.q[2]"])) > 1e-3


@pytest.mark.parametrize("precision", c_library.PRECISIONS)
@pytest.mark.parametrize("engine", ["fmpy", "native"])
def test_the_pace_drives_the_library_and_tells_its_deadlines(precision: str, engine: str, tmp_path: Path) -> None:
    case = ("--case", "passive_bounded_5_0.5", "--duration", "0.2")
    how = ("--real-time", "--c-library", precision, "--engine", engine)
    answer = exo("run", "wall", *case, *how, "--out", tmp_path)
    assert answer.exit_code == 0, answer.stderr
    assert "100 steps of 2 ms by the clock" in " ".join(answer.stdout.split())
    told = json.loads((tmp_path / "wall" / "metrics.json").read_text())["run"]
    deadlines = told["cases"]["passive_bounded_5_0.5"]["deadlines"]
    assert deadlines["steps"] == 100
    assert 0.0 < deadlines["busy_median"] <= deadlines["busy_max"]
    assert told["fmus"]["TestbedController.fmu"]["generation_tool"] == f"exo, C library {precision}"
    assert "C library" not in told["fmus"]["Testbed.fmu"]["generation_tool"]


def test_the_description_names_what_the_library_has_and_points_at_it(folders: tuple[str, Path]) -> None:
    _, folder = folders
    for name, law in c_library.LAWS.items():
        with zipfile.ZipFile(folder / name) as archive:
            root = etree.fromstring(archive.read("modelDescription.xml"))
        assert root.get("guid") == f"exo-law {law}"
        variables = root.find("ModelVariables")
        references = [int(one.get("valueReference")) for one in variables]
        assert len(set(references)) == len(references)
        outputs = [i for i, one in enumerate(variables, start=1) if one.get("causality") == "output"]
        assert [int(one.get("index")) for one in root.find("ModelStructure/Outputs")] == outputs
        # The start values that an instance has are those that the description tells.
        with Archive(folder / name) as library, Instance(library, "started") as instance:
            told = {key: v for key, v in library.variables.items() if v.causality in ("input", "parameter") and v.start}
            for key, value in instance.values(list(told)).items():
                start = told[key].start
                expected = start == "true" if told[key].type == "Boolean" else float(start)
                assert value == pytest.approx(expected, rel=1e-6), key


def test_what_the_library_refuses_is_named(double: dict[str, Archive], archives: dict[str, Archive]) -> None:
    with pytest.raises(FmuError, match=r"exo_axis_init: M_n = -1: expected"):
        run_short(double, {"controller.M_n": -1.0})
    with pytest.raises(FmuError, match=r"exo_axis_init: law = 5: expected"):
        run_short(double, {"controller.law": 5})
    with pytest.raises(FmuError, match=r"fmi2DoStep: step 0\.004 s: expected T = 0\.002 s"):
        run_short(double, {}, step=0.004)
    assert run_short(archives, {}, step=0.004) is not None


def test_a_wrong_option_is_one_sentence(tmp_path: Path) -> None:
    def said(*arguments: object) -> str:
        answer = exo("run", *arguments, "--out", tmp_path / "out")
        assert answer.exit_code == 2, answer.stdout
        return " ".join(answer.stderr.split())

    assert "--c-library f16: expected one of f64, f32" in said("wall", "--c-library", "f16")
    assert not list(tmp_path.glob("out/*"))
    copied = tmp_path / "there" / "fmu"
    copied.mkdir(parents=True)
    assert "run `cargo xtask law` first" in said("wall", "--c-library", "f64", "--fmu-dir", copied)
    plants = tmp_path / "plant.toml"
    text = SHORT.replace('[components.controller]\narchive = "TestbedController.fmu"\n', "")
    kept = [line for line in text.splitlines() if not line.startswith(('"controller.', '"plant.tau_a"'))]
    plants.write_text("\n".join(kept))
    assert "short has Testbed.fmu; expected ArmController.fmu or TestbedController.fmu among them" in said(
        plants, "--c-library", "f64"
    )


def test_no_such_precision_is_an_error_from_python_too(fmu_dir: Path) -> None:
    with pytest.raises(ExoError, match="expected one of f64, f32"), c_library.archives(fmu_dir, "double"):
        pass


def run_short(archives: dict[str, Archive], parameters: dict[str, float], *, step: float = 0.002) -> Recording:
    scenario = load("wall")
    case = next(one for one in scenario.cases if one.id == "passive_bounded_5_0.5")
    plan = master.plan(scenario=scenario, case=case)
    plan = replace(plan, parameters={**plan.parameters, **parameters}, duration=10 * step, step=step)
    return master.simulate(plan=plan, archives=archives)
