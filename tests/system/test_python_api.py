"""`exo` from Python: what it loads, couples and runs, and what it says where that is not possible."""

import copy
import importlib
import os
import pickle
import pkgutil
import signal
import subprocess
import sys
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from io import StringIO
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest
import xarray as xr
from matplotlib import image

import exo
from exo import experiment, scenario, selection
from exo.fmu import Archive

WIRES = {"controller.q": "plant.q", "plant.tau_a": "controller.tau_a"}
STEP = 0.002
WALL = "passive_bounded_5_0.5"


@pytest.fixture(scope="module")
def testbed(fmu_dir: Path) -> exo.System:
    """Controller and plant of one axis."""
    fmus = {"controller": fmu_dir / "TestbedController.fmu", "plant": fmu_dir / "Testbed.fmu"}
    return exo.couple(fmus, wires=WIRES, step=STEP)


@pytest.fixture(scope="module")
def pushed(testbed: exo.System) -> exo.Run:
    """Two seconds of 3 N."""
    return exo.simulate(testbed, duration=2.0, inputs={"controller.tau_h": 3.0, "plant.tau_h": 3.0})


def test_importing_exo_loads_none_of_the_large_packages() -> None:
    large = ["numpy", "pandas", "xarray", "matplotlib", "fmpy", "pyarrow", "scipy", "pydantic"]
    code = f"import exo, sys; dir(exo); print([name for name in {large} if name in sys.modules])"
    assert subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout == "[]\n"


def test_every_public_name_is_there_whatever_has_been_imported_before() -> None:
    for module in pkgutil.walk_packages(exo.__path__, "exo."):
        if "probe.__main__" not in module.name:
            importlib.import_module(module.name)
    for name in exo.__all__:
        value = getattr(exo, name)
        assert isinstance(value, str) or callable(value), f"exo.{name} is hidden by a module of this name"
    assert set(exo.__all__) <= set(dir(exo))
    with pytest.raises(AttributeError, match="module exo has no lode"):
        _ = exo.lode


def test_a_variable_has_what_the_description_says_of_it(fmu_dir: Path) -> None:
    loaded = exo.load("Testbed.fmu", fmu_dir=fmu_dir)
    with Archive(fmu_dir / "Testbed.fmu") as archive:
        declared = archive.description.modelVariables
    assert list(loaded.variables) == [one.name for one in declared]
    mass = loaded["M"]
    assert (mass.causality, mass.variability, mass.type, mass.unit, mass.start) == (
        "parameter",
        "fixed",
        "Real",
        "kg",
        6.0,
    )
    assert loaded["drive.mode"].start == 1
    assert loaded["drive.mode"].choices == {"torque": 1, "position_servo": 2, "velocity_servo": 3}
    assert list(loaded.inputs) == ["tau_a", "tau_h", "tau_d", "q_d", "dq_d"]
    table = loaded.frame()
    assert table.loc["wall.k", "start"] == 1e5
    assert table.loc["q", "unit"] == "m"
    assert loaded.problems == ""


def test_an_fmu_shows_itself_as_a_table_in_text_and_in_a_notebook(fmu_dir: Path) -> None:
    loaded = exo.load(fmu_dir / "Testbed.fmu")
    lines = repr(loaded).splitlines()
    assert lines[0].startswith("Testbed.fmu ")
    assert lines[0].endswith("5 inputs, 17 outputs, 13 parameters")
    assert lines[1].split() == ["name", "causality", "type", "unit", "start", "description"]
    assert len(lines) == 2 + len(loaded.variables)
    shown = pd.read_html(StringIO(loaded._repr_html_()))[0]
    assert list(shown["name"]) == list(loaded.variables)
    long = repr(exo.load(fmu_dir / "ExoskeletonArm.fmu")).splitlines()
    assert len(long) == 63
    assert long[32].startswith("…")


def test_a_coupled_run_has_the_numbers_of_the_scenario_bit_for_bit(fmu_dir: Path) -> None:
    """The wall from Python's own wires and forces against `exo run wall`."""
    loaded = scenario.load("wall")
    narrowed = selection.narrowed(loaded, cases=[WALL], duration=25.0)
    recorded = experiment.run(scenario=narrowed, fmu_dir=fmu_dir).recordings[WALL]
    plan = experiment.plan(scenario=narrowed, case=narrowed.cases[0])
    system = exo.couple(
        {name: fmu_dir / archive for name, archive in plan.components.items()},
        wires={target: source for target, source in plan.inputs.items() if not source.startswith("profile.")},
        step=plan.step,
        coupling=plan.coupling,
    )
    force = [segment.model_dump() for segment in plan.profiles["tau_h"]]
    fed = {target: force for target, source in plan.inputs.items() if source == "profile.tau_h"}
    assert len(fed) == 2
    for engine in ("fmpy", "native"):
        run = exo.simulate(system, duration=25.0, inputs=fed, parameters=plan.parameters, engine=engine)
        assert set(recorded.columns) - set(run.signals) <= {"controller.engage"}
        for name, column in run.signals.items():
            assert column.tobytes() == recorded[name].tobytes(), name
    assert run.units["plant.tau_e"] == "N"
    assert run.choices["controller.law"] == "passive_bounded"
    by_name = exo.simulate("wall", case=WALL, duration=25.0, fmu_dir=fmu_dir)
    assert by_name.name == WALL
    assert by_name["plant.q"].tobytes() == recorded["plant.q"].tobytes()
    assert by_name.units == {"time": "s", **recorded.units}


def test_a_force_may_be_a_number_a_function_an_array_or_segments(testbed: exo.System) -> None:
    """The same sine in four ways; a function of single numbers is one, too."""
    import math  # noqa: PLC0415

    time = np.arange(500) * STEP
    single = exo.simulate(testbed, duration=1.0, inputs={"plant.tau_h": np.array(2.0)})
    assert (single["plant.tau_h"] == 2.0).all()
    ways: list[Any] = [
        lambda t: 5.0 * np.sin(2.0 * np.pi * 0.5 * t + 0.25),
        lambda t: 5.0 * math.sin(2.0 * math.pi * 0.5 * t + 0.25),
        5.0 * np.sin(2.0 * np.pi * 0.5 * time + 0.25),
        [{"kind": "sine", "amplitude": 5.0, "frequency": 0.5, "phase": 0.25}],
    ]
    runs = [exo.simulate(testbed, duration=1.0, inputs={"plant.tau_h": way}) for way in ways]
    for run in runs[1:]:
        np.testing.assert_allclose(run["plant.tau_h"], runs[0]["plant.tau_h"], rtol=1e-12, atol=1e-15)
        np.testing.assert_allclose(run["plant.q"], runs[0]["plant.q"], rtol=1e-9, atol=1e-12)
    assert np.array_equal(runs[2]["plant.tau_h"], ways[2])
    held = exo.simulate(testbed, duration=1.0, inputs={"plant.tau_h": 2.0, "controller.engage": False})
    assert (held["plant.tau_h"] == 2.0).all()
    assert held["controller.engage"].dtype == bool
    assert not held["controller.engaged"].any()


def test_the_mass_accelerates_as_newton_says(fmu_dir: Path) -> None:
    """q = F t²/(2 M) without friction and wall, from one FMU alone; backward Euler's error is F/(2 M) · substep · t."""
    system = exo.couple({"plant": fmu_dir / "Testbed.fmu"}, step=STEP)
    free = {"plant.F_c": 0.0, "plant.b": 0.0, "plant.wall.q": 1e9, "plant.M": 4.0}
    run = exo.simulate(system, duration=2.0, inputs={"plant.tau_h": 6.0}, parameters=free)
    expected = 6.0 / (2.0 * 4.0) * run.time**2
    assert np.abs(run["plant.q"] - expected).max() <= 6.0 / (2.0 * 4.0) * 8e-5 * 2.0 + 1e-12


def test_a_system_shows_its_wires_its_free_inputs_and_a_step_that_does_not_fit(
    testbed: exo.System, fmu_dir: Path
) -> None:
    lines = repr(testbed).splitlines()
    assert lines[0] == "controller (TestbedController.fmu) → plant (Testbed.fmu), every 0.002 s, zero_delay"
    assert "  controller.q = plant.q" in lines
    assert "  plant.tau_h: at its start value" in lines
    assert testbed.notes == ()
    fmus = {"controller": fmu_dir / "TestbedController.fmu", "plant": fmu_dir / "Testbed.fmu"}
    odd = exo.couple(fmus, wires=WIRES, step=0.0013)
    (note,) = odd.notes
    assert note.startswith("the step 0.0013 s does not divide controller.T = 0.002 s")
    assert repr(odd).splitlines()[-1] == f"  note: {note}"
    assert note in odd._repr_html_()
    assert pd.read_html(StringIO(odd._repr_html_()))[0].shape == (11, 2)


def test_arrays_are_wired_set_and_fed_at_once(fmu_dir: Path) -> None:
    fmus = {"controller": fmu_dir / "ArmController.fmu", "plant": fmu_dir / "ExoskeletonArm.fmu"}
    wires = {"controller.q[1..3]": "plant.q[1..3]", "plant.tau_a[1..3]": "controller.tau_a[1..3]"}
    system = exo.couple(fmus, wires=wires, step=0.001)
    assert system.wires["plant.tau_a[2]"] == "controller.tau_a[2]"
    force = np.zeros((300, 3))
    force[:, 1] = 10.0
    inputs = {"controller.f_h[1..3]": force, "plant.f_h[1..3]": force}
    run = exo.simulate(system, duration=0.3, inputs=inputs, parameters={"controller.K": [400.0, 500.0, 600.0]})
    assert [run.parameters[f"controller.K[{i}]"] for i in (1, 2, 3)] == [400.0, 500.0, 600.0]
    assert (run["plant.f_h[2]"] == 10.0).all()
    assert not run["plant.f_h[1]"].any()
    found = run.dataset("plant.p[1..3]", "controller.p_n[1..3]", "plant.q[1]", "plant.f_h[*]")
    assert found["plant.p"].dims == ("time", "element_3")
    assert found["plant.p"].attrs["units"] == "m"
    assert list(found.element_3) == [1, 2, 3]
    assert found["plant.q[1]"].dims == ("time",)
    for i in (1, 2, 3):
        assert np.array_equal(found["plant.p"].sel(element_3=i), run[f"plant.p[{i}]"])
    error = found["controller.p_n"] - found["plant.p"]
    assert error.shape == (300, 3)
    assert np.abs(error).max() > 0.0


def test_tables_have_signals_and_units(pushed: exo.Run) -> None:
    table = pushed.frame("plant.q", "plant.tau_e", "controller.saturated")
    assert table.index.name == "time"
    assert np.array_equal(table.index, np.arange(1000) * STEP)
    assert table.attrs["units"] == {"time": "s", "plant.q": "m", "plant.tau_e": "N", "controller.saturated": ""}
    assert list(table.dtypes) == [np.float64, np.float64, bool]
    assert np.array_equal(table["plant.q"], pushed["plant.q"])
    levels = pushed.frame("plant.q", unit_level=True)
    assert list(levels.columns) == [("plant.q", "m")]
    assert levels.columns.names == ["signal", "unit"]
    data = pushed.dataset()
    assert isinstance(data, xr.Dataset)
    assert {name: one.attrs["units"] for name, one in data.items()} == {
        name: pushed.units[name] for name in pushed.signals
    }
    assert data.time.attrs["units"] == "s"
    assert data.attrs["controller.K"] == pushed.parameters["controller.K"]
    assert float(data["plant.q"].sel(time=1.0, method="nearest")) == pushed["plant.q"][500]


def test_a_run_is_a_mapping_of_names_to_arrays_that_nobody_can_change(pushed: exo.Run) -> None:
    """Tests and notebooks share runs: one that subtracts in place would change what the others see."""
    assert list(pushed) == list(pushed.signals) == pushed.names()
    assert len(pushed) == len(pushed.signals)
    for values in (pushed["plant.q"], pushed.time):
        with pytest.raises(ValueError, match="read-only"):
            values[0] = 1.0
    data = pushed.dataset("plant.q")
    data["plant.q"] += 1.0
    table = pushed.frame("plant.q")
    table["plant.q"] += 1.0
    assert pushed["plant.q"][0] == 0.0
    assert pushed == pushed  # noqa: PLR0124
    assert pushed != copy.copy(pushed), "two runs are no truth values of arrays"
    for wrong in (0, ["plant.q"]):
        with pytest.raises(exo.ExoError, match="no signal"):
            _ = pushed[wrong]  # type: ignore[index]
        with pytest.raises(exo.ExoError, match="expected names or patterns, one argument each"):
            pushed.frame(wrong)  # type: ignore[arg-type]


def test_what_goes_to_another_process_comes_back_as_it_was(testbed: exo.System, pushed: exo.Run) -> None:
    for there in (pickle.loads(pickle.dumps(pushed)), copy.deepcopy(pushed)):
        assert {name: there[name].tobytes() for name in there} == {name: pushed[name].tobytes() for name in pushed}
        assert (there.units, there.parameters, there.choices) == (pushed.units, pushed.parameters, pushed.choices)
        with pytest.raises(ValueError, match="read-only"):
            there["plant.q"][0] = 1.0
        with pytest.raises(TypeError, match="does not support item assignment"):
            there.signals["plant.q"] = there["plant.q"]
    system = pickle.loads(pickle.dumps(testbed))
    assert (system.wires, system.fmus["plant"]["M"]) == (testbed.wires, testbed.fmus["plant"]["M"])
    inputs = {"controller.tau_h": 3.0, "plant.tau_h": 3.0}
    assert np.array_equal(exo.simulate(system, duration=2.0, inputs=inputs)["plant.q"], pushed["plant.q"])


@pytest.mark.parametrize("engine", ["fmpy", "native"])
def test_threads_simulate_one_system_at_the_same_time(engine: Any, testbed: exo.System) -> None:
    def end(force: float) -> float:
        inputs = {"controller.tau_h": force, "plant.tau_h": force}
        return float(exo.simulate(testbed, duration=0.5, inputs=inputs, engine=engine)["plant.q"][-1])

    forces = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0]
    with ThreadPoolExecutor(3) as pool:
        together = list(pool.map(end, forces))
    assert together == [end(force) for force in forces]
    assert len(set(together)) == len(forces)


@pytest.mark.skipif(sys.platform == "win32", reason="Windows sends no SIGINT to a process of its own")
@pytest.mark.parametrize("engine", ["fmpy", "native"])
def test_ctrl_c_ends_a_long_run_at_once_and_the_next_one_runs(
    engine: Any, testbed: exo.System, request: pytest.FixtureRequest
) -> None:
    # A job in the background has SIGINT ignored.
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    request.addfinalizer(lambda: signal.signal(signal.SIGINT, before))
    exo.simulate(testbed, duration=0.1, engine=engine)
    sent: list[float] = []
    timer = threading.Timer(0.2, lambda: (sent.append(time.monotonic()), os.kill(os.getpid(), signal.SIGINT)))
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        exo.simulate(testbed, duration=4000.0, engine=engine)
    assert time.monotonic() - sent[0] < 1.0
    assert len(exo.simulate(testbed, duration=0.1, engine=engine).time) == 50


@pytest.mark.skipif(sys.platform == "win32", reason="Windows keeps a folder that is somebody's working folder")
def test_a_working_folder_that_is_gone_is_told(
    testbed: exo.System, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.delenv("EXO_FMU_DIR", raising=False)
    (tmp_path / "gone").mkdir()
    monkeypatch.chdir(tmp_path / "gone")
    (tmp_path / "gone").rmdir()
    for call in (lambda: exo.load("Testbed.fmu"), lambda: exo.simulate(testbed, duration=0.1)):
        with pytest.raises(exo.ExoError, match="the working folder is not there any more; expected one that exists"):
            call()


def test_signals_are_chosen_by_name_and_pattern(pushed: exo.Run) -> None:
    assert set(pushed.names("plant.energy.*")) == {name for name in pushed.signals if name.startswith("plant.energy.")}
    assert pushed.names("plant.d?", "plant.dq", "plant.q") == ["plant.dq", "plant.q"]
    with pytest.raises(exo.ExoError, match=r"no signal plant\.qq \(close matches: plant\.q"):
        pushed.frame("plant.qq")
    with pytest.raises(exo.ExoError, match=r"no signal plnt\.\*"):
        pushed.frame("plnt.*")


def test_a_picture_has_a_panel_for_each_unit(pushed: exo.Run, tmp_path: Path) -> None:
    figure = pushed.plot("plant.q", "controller.q_n", "plant.dq", title="Push")
    assert [axes.get_ylabel() for axes in figure.axes] == ["[m]", "[m/s]"]
    assert [line.get_label() for line in figure.axes[0].get_lines()] == ["plant.q", "controller.q_n"]
    line = figure.axes[0].get_lines()[0]
    assert np.array_equal(line.get_ydata(), pushed["plant.q"])
    (tmp_path / "push.png").write_bytes(figure._repr_png_())  # type: ignore[attr-defined]
    assert image.imread(tmp_path / "push.png").std() > 0.05
    with pytest.raises(exo.ExoError, match="plot of 44 signals; expected names or patterns of 1 to 12"):
        pushed.plot()


def test_a_saved_run_is_read_as_it_was(pushed: exo.Run, tmp_path: Path) -> None:
    path = pushed.save(tmp_path / "new" / "push.parquet")
    found = exo.read_run(path)
    assert found.name == "push"
    assert list(found.signals) == list(pushed.signals)
    for name, column in pushed.signals.items():
        assert found[name].tobytes() == column.tobytes()
    assert found.time.tobytes() == pushed.time.tobytes()
    assert (found.units, found.parameters, found.choices) == (pushed.units, pushed.parameters, pushed.choices)
    # Without exo, too.
    assert pd.read_parquet(path).attrs["units"]["plant.tau_e"] == "N"
    assert [one.name for one in path.parent.iterdir()] == ["push.parquet"]
    with pytest.raises(exo.ExoError, match=r"push\.xls: expected one of the endings \.parquet, \.csv, \.mf4, \.mat"):
        pushed.save(tmp_path / "push.xls")
    (tmp_path / "file").touch()
    with pytest.raises(exo.ExoError, match="cannot be written"):
        pushed.save(tmp_path / "file" / "push.csv")


@pytest.mark.parametrize(
    ("table", "said"),
    [
        ({"time": [0.0, 1.0], "s": ["a", "b"]}, "column s has 'a'; expected numbers, or true and false"),
        ({"time": ["a", "b"], "s": [1.0, 2.0]}, "column time has 'a'; expected numbers"),
        ({"time": [0.0, 1.0], "s": [True, None]}, "column s has None; expected numbers"),
        ({"time": [0.0, 0.0], "s": [1.0, 2.0]}, "expected a column time that increases"),
        ({"time": [0.0, float("nan")], "s": [1.0, 2.0]}, "expected a column time that increases"),
        ({"t": [0.0, 1.0]}, "expected signals of a run: a column time of two rows or more"),
    ],
)
def test_a_table_that_is_no_run_is_told_by_its_column(table: dict[str, Any], said: str, tmp_path: Path) -> None:
    pd.DataFrame(table).to_parquet(tmp_path / "table.parquet")
    with pytest.raises(exo.ExoError, match=said):
        exo.read_run(tmp_path / "table.parquet")


def test_a_run_is_read_from_the_folder_that_exo_run_leaves(fmu_dir: Path, tmp_path: Path) -> None:
    from commands import exo as command  # noqa: PLC0415

    arguments = ["--case", "passive*_5_0.5", "--duration", 1, "--fmu-dir", fmu_dir, "--out", tmp_path]
    assert command("run", "wall", *arguments).exit_code in (0, 1)
    run = exo.read_run(tmp_path / "wall", case=WALL)
    assert run.parameters["controller.M_n"] == 5.0
    assert run.choices["controller.law"] == "passive_bounded"
    assert run.units["plant.q"] == "m"
    assert len(run.time) == 500
    with pytest.raises(exo.ExoError, match="case None: expected one of its 3 cases"):
        exo.read_run(tmp_path / "wall")
    with pytest.raises(exo.ExoError, match=r"close matches: passive_bounded_5_0\.5"):
        exo.read_run(tmp_path / "wall", case="passive_bounded_5")
    with pytest.raises(exo.ExoError, match=r"expected the folder of one scenario's results \(wall\)"):
        exo.read_run(tmp_path)
    for case in (None, WALL):
        with pytest.raises(exo.ExoError, match="wal: no such file or folder; expected a Parquet file"):
            exo.read_run(tmp_path / "wal", case=case)


def test_scenarios_from_python_are_those_of_the_file(fmu_dir: Path) -> None:
    import tomllib  # noqa: PLC0415

    from commands import SHORT  # noqa: PLC0415

    tables = tomllib.loads(SHORT)
    tables["components"]["plant"]["parameters"]["wall.q"] = np.float64(1e9)
    tables["cases"] = ({"id": "push"},)
    assert exo.read_scenario(tables) == scenario.parse(text=SHORT, origin="short.toml")
    run = exo.simulate(tables, fmu_dir=fmu_dir)
    assert run.name == "push"
    short = {"base": "testbed", "title": "t", "about": "a", "source": "s", "duration": 1.0, "cases": {"a": {}}}
    short |= {"profiles": {"tau_h": [{"kind": "constant", "amplitude": 3.0}]}}
    assert exo.read_scenario(short).components.keys() == {"controller", "plant"}
    with pytest.raises(exo.ScenarioError, match=r"scenario\.cases\.a\.label: got <object"):
        exo.read_scenario(short | {"cases": {"a": {"label": object()}}})
    with pytest.raises(exo.ScenarioError, match=r"scenario: key 3: expected a text"):
        exo.read_scenario(short | {3: 4})
    with pytest.raises(exo.ScenarioError, match="scenario: duration: got 'long'"):
        exo.read_scenario(short | {"duration": "long"})


@pytest.mark.parametrize(
    ("changed", "said"),
    [
        ({"fmus": {}}, "couple: got {}; expected FMUs by name"),
        ({"fmus": {"plant": "Testbett.fmu"}}, r"Testbett\.fmu: no such file; expected an FMU"),
        ({"fmus": {"profile": "Testbed.fmu"}}, "component 'profile': expected letters, digits and _"),
        ({"wires": {"controller.q": "plnt.q"}}, r"wires: plnt\.q: no component plnt \(close matches: plant\)"),
        ({"wires": {"q": "plant.q"}}, r"wires: 'q' = 'plant\.q': expected component\.input = component\.output"),
        ({"wires": {"controller.qq": "plant.q"}}, r"TestbedController\.fmu: no variable qq \(close matches: q"),
        ({"wires": {"controller.q": "plant.M"}}, "M: expected a Real output, this is parameter of type Real"),
        ({"wires": {"controller.engage": "plant.q"}}, "q: expected a Boolean output, this is output of type Real"),
        ({"wires": {"controller.tau_a": "plant.q"}}, "tau_a: only inputs and tunables can be wired"),
        ({"wires": {"controller.q[1..3]": "plant.q[1..2]"}}, "has 3 elements and plant.q.* has 2"),
        ({"step": 0.0}, r"step = 0\.0: expected a time above 0 s"),
        ({"step": "fast"}, "step = 'fast': expected a time above 0 s"),
        ({"step": float("nan")}, "step = nan: expected a time above 0 s"),
        ({"coupling": "late"}, "coupling 'late': expected one of zero_delay, one_sample_delay, exchange_at_once"),
        ({"delayed": ["plant.tau"]}, r"delayed: plant\.tau: no wired input \(close matches: plant\.tau_a"),
        ({"record": ["plant.version"]}, "record: plant.version: expected a variable that is a number"),
        ({"record": 3}, r"record: got 3; expected names as component\.variable"),
        ({"wires": [("controller.q", "plant.q")]}, "wires: got a value of type list; expected {"),
        ({"wires": {"controller.q": "plant.tau_e"}}, r"controller\.q is in m, plant\.tau_e in N; expected one unit"),
        ({"wires": {"controller.q": "-plant.dq"}}, r"controller\.q is in m, -plant\.dq in m/s; expected one unit"),
        ({"delayed": ["plant.tau_a"]}, "coupling 'zero_delay' with .*: delayed inputs belong to one_sample_delay"),
        ({"coupling": "one_sample_delay"}, "without delayed inputs it is zero_delay; expected both or none"),
    ],
)
def test_what_cannot_be_coupled_is_named_in_one_sentence(changed: dict[str, Any], said: str, fmu_dir: Path) -> None:
    plain = {"fmus": {"controller": "TestbedController.fmu", "plant": "Testbed.fmu"}, "wires": WIRES, "step": STEP}
    given = plain | changed
    fmus = {name: fmu_dir / file for name, file in given.pop("fmus").items()}
    with pytest.raises(exo.ExoError, match=said) as caught:
        exo.couple(fmus, **given)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("changed", "said"),
    [
        ({"duration": None}, "duration: got none; expected the length of the run in s"),
        ({"duration": -1.0}, r"duration = -1\.0: expected a time above 0 s"),
        ({"duration": 0.0031}, "no multiple of the step"),
        ({"duration": 1e9}, "expected at most 1e"),
        ({"case": "a"}, "case = 'a': a coupled system has no cases"),
        ({"engine": "rust"}, "engine 'rust': expected one of fmpy, native"),
        ({"inputs": {"tau_h": 1.0}}, "inputs: 'tau_h': expected component.input"),
        ({"inputs": {"plnt.tau_h": 1.0}}, r"inputs: plnt\.tau_h: expected component\.input, got component 'plnt'"),
        ({"inputs": {"plant.tau": 1.0}}, r"no variable tau \(close matches"),
        ({"inputs": {"plant.M": lambda t: t}}, "M: only inputs and tunables can be wired, this is a fixed parameter"),
        ({"inputs": {"plant.tau_h": [1.0, 2.0]}}, r"got an array of shape \(2,\); expected \(50,\), a value each step"),
        ({"inputs": {"plant.tau_h": lambda t: t[:, :2]}}, "its function raised IndexError"),
        ({"inputs": {"plant.tau_h": {"a": 1}}}, "got an array of shape|expected a number, a function of the time"),
        ({"inputs": {"plant.tau_h": [{"kind": "sine"}]}}, "term 1: a sine segment needs a frequency above 0 Hz"),
        ({"inputs": {"plant.tau_h": [{"kind": "sinus"}]}}, r"term 1\.kind: Input should be 'sine'"),
        ({"parameters": {"plant.wal.q": 1.0}}, r"no variable wal\.q \(close matches: wall\.q"),
        ({"parameters": {"M": 1.0}}, r"parameters: M: expected component\.parameter, got component 'M'"),
        ({"parameters": {"plant.M": None}}, r"parameters\.plant\.M: got None; expected a number"),
        ({"parameters": {"controller.law": "pasive"}}, r"law: no item pasive \(close matches: passive"),
        ({"parameters": {"controller.q": 1.0}}, r"controller\.q = 1\.0 has no effect, because it is wired to plant\.q"),
        ({"parameters": {"plant.M": -1.0}}, "plant: fmi2.*M = -1 kg, expected"),
        ({"parameters": {"controller.k": 1.0}}, r"no variable k \(close matches: K\)"),
        ({"parameters": {"plant.M": float("nan")}}, "M: expected a finite Real of at most .*, got nan"),
        ({"parameters": {"controller.law": 10**30}}, "expected a finite Integer of at most 2.14748e.09, got 10*…"),
        ({"parameters": [("plant.M", 1.0)]}, "parameters: got a value of type list; expected {"),
        ({"inputs": [("plant.tau_h", 1.0)]}, "inputs: got a value of type list; expected {"),
        ({"inputs": {"plant.tau_h": None}}, "tau_h: got None of type NoneType; expected numbers"),
        ({"inputs": {"plant.tau_h": lambda _: None}}, "tau_h: got None of type NoneType; expected numbers"),
        ({"inputs": {"plant.tau_h": np.full(50, 1j)}}, r"got .*1j.* of type complex128; expected numbers"),
        ({"inputs": {"plant.tau_h": lambda t: t + 1j}}, "of type complex128; expected numbers"),
        ({"inputs": {"plant.tau_h": ["1.0"] * 50}}, "got .*'1.0'.* of type str_; expected numbers"),
        ({"inputs": {"plant.tau_h": [None] * 50}}, "got None of type NoneType; expected numbers"),
        ({"inputs": {"plant.tau_h": 10**400}}, "tau_h: a number of 401 digits; expected a double"),
    ],
)
def test_what_cannot_be_run_is_named_in_one_sentence(changed: dict[str, Any], said: str, testbed: exo.System) -> None:
    with pytest.raises(exo.ExoError, match=said) as caught:
        exo.simulate(testbed, **{"duration": 0.1} | changed)
    assert "\n" not in str(caught.value)


def test_a_scenario_with_many_cases_asks_for_one(fmu_dir: Path) -> None:
    with pytest.raises(
        exo.ScenarioError, match=r"wall: case None: expected the id of one of its 16 cases \(standard_0\.1"
    ):
        exo.simulate("wall", fmu_dir=fmu_dir)
    with pytest.raises(exo.ScenarioError, match=r"close matches: passive_bounded_5_0\.5"):
        exo.simulate("wall", case="passive_bounded_5_.5", fmu_dir=fmu_dir)
    with pytest.raises(exo.ScenarioError, match=r"Testbed\.fmu: got an FMU by itself; expected exo\.couple"):
        exo.simulate(exo.load(fmu_dir / "Testbed.fmu"), duration=1.0)  # type: ignore[arg-type]
    with pytest.raises(exo.FmuError, match="load: got a value of type int; expected the path of an FMU"):
        exo.couple({"plant": 3}, step=0.1)  # type: ignore[dict-item]
    with pytest.raises(
        exo.ScenarioError, match=r"got a value of type int; expected an id, a path to a \.toml file, or a dictionary"
    ):
        exo.simulate(3)  # type: ignore[arg-type]
    with pytest.raises(exo.FmuError, match=r"expected an FMI 2\.0 co-simulation FMU, got FMI 3\.0"):
        exo.load(fmu_dir / "fmi3" / "Testbed.fmu")
