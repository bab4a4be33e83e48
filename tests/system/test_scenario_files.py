"""Scenario files: what is wrong is named with file, key, value and expectation."""

import re
from pathlib import Path

import pytest

from exo import scenario
from exo.errors import ExoError, ScenarioError
from exo.experiment import run
from exo.paper import lookup, published

GOOD = """
id = "mini"
title = "A mini scenario"
about = "One case."
source = "here"
duration = 1.0
step = 0.002
[components.controller]
archive = "TestbedController.fmu"
[components.plant]
archive = "Testbed.fmu"
[inputs]
"controller.q" = "plant.q"
"plant.tau_h" = "profile.tau_h"
[[profiles.tau_h]]
kind = "constant"
amplitude = 1.0
[[cases]]
id = "only"
[[metrics]]
id = "m"
title = "largest q"
unit = "m"
function = "maximum"
arguments = { column = "plant.q" }
source = "here"
"""


def refused(text: str) -> str:
    with pytest.raises(ScenarioError) as error:
        scenario.parse(text=text, origin="mini.toml")
    return str(error.value)


def test_the_good_one_is_good() -> None:
    assert scenario.parse(text=GOOD, origin="mini.toml").cases[0].id == "only"


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("step = 0.002", "step = 0.002\nspeed = 3", r"mini\.toml: speed: unknown key, with value 3"),
        ("amplitude = 1.0", "amplitud = 1.0", r"tau_h\.0\.amplitud: unknown key, .* \(close matches: amplitude"),
        ("[inputs]", "[input]", r"input: unknown key, .* \(close matches: inputs"),
        ("[inputs]", "[parameter]\n[inputs]", r"parameter: unknown key, .* \(close matches: parameters"),
        ("arguments =", "argument =", r"metrics\.m\.argument: unknown key, .* \(close matches: arguments"),
        ('id = "only"', 'id = "only"\nlable = "l"', r"cases\.only\.lable: unknown key, .* \(close matches: label"),
        ("duration = 1.0", 'duration = "1"', r"mini\.toml: duration: got '1'; expected: .*number"),
        ("duration = 1.0", "duration = true", r"mini\.toml: duration: got True; expected: .*number"),
        ("duration = 1.0", "duration = -1.0", r"mini\.toml: duration: got -1\.0; expected: .*greater than 0"),
        ("duration = 1.0", "duration = nan", r"mini\.toml: duration: got nan; expected: .*finite"),
        ("duration = 1.0", "duration = 1.0005", r"duration 1\.0005 s is no multiple of the step 0\.002 s"),
        ("duration = 1.0", "", r"mini\.toml: duration: missing"),
        ('kind = "constant"', 'kind = "sinus"', r"profiles\.tau_h\.0\.kind: got 'sinus'; expected: .*'sine'"),
        ('kind = "constant"', 'kind = "sine"', r"a sine segment needs a frequency"),
        ("amplitude = 1.0", "amplitude = 1.0\nt_off = -1.0", r"t_off -1\.0 s must lie after t_on 0\.0 s"),
        ('"profile.tau_h"', '"profile.tau_g"', r"unknown profile tau_g .*tau_h"),
        ('"plant.q"\n', '"plnt.q"\n', r"unknown component plnt .*plant"),
        (
            'archive = "Testbed.fmu"',
            'archive = "../Testbed.fmu"',
            r"components\.plant\.archive: got '\.\./Testbed\.fmu'",
        ),
        ('id = "only"', 'id = "only"\n[[cases]]\nid = "only"', r"case id only stands twice"),
        ('source = "here"\n', 'source = "here"\n[broken\n', r"mini\.toml: not TOML: .*line"),
        (
            'id = "only"',
            'id = "only"\n[[figures]]\nid = "f"\ntitle = "f"\nkind = "arm_poses"',
            "such a figure needs poses",
        ),
        (
            'id = "only"',
            'id = "only"\n[[figures]]\nid = "f"\ntitle = "f"\nkind = "arm_poses"\n'
            'poses = { case = "other", plant = "plant", times = [0.0] }',
            r"figure f: unknown case other .*only",
        ),
        ('unit = "m"', 'unit = "m"\ncases = ["other"]', r"metric m: unknown case other .*only"),
        ('unit = "m"', 'unit = "m"\ncheck = { value = 1.0 }', r"value needs exactly one of within and relative"),
        ('unit = "m"', 'unit = "m"\ncheck = { at_most = 1.0, at_least = 0.0 }', r"one of value, at_most, at_least"),
    ],
)
def test_what_is_wrong_is_named(old: str, new: str, message: str) -> None:
    assert old in GOOD
    assert re.search(message, refused(GOOD.replace(old, new, 1)), re.DOTALL)


def test_every_problem_of_a_file_is_reported_at_once() -> None:
    text = refused(GOOD.replace("step = 0.002", 'step = "fast"\nspeed = 3'))
    assert "step: got 'fast'" in text
    assert "speed: unknown key" in text


@pytest.mark.parametrize("name", scenario.built_in())
def test_built_in_scenarios_are_valid_and_carry_their_file_s_name(name: str) -> None:
    assert scenario.load(name).id == name


#: Scenarios whose subject is the sensor's delay, not what `ft.*` say.
SENSOR_DELAY = {"coupling_delay"}
NO_PLANT = {"HumanOperator.fmu"}
#: What a human's force may come from, and what a sensor makes of it.
FORCE, READING = r"(profile\.\w+|\w+\.f_h\[\d\])", r"plant\.(tau_h_measured|f_h_measured\[\d\])"


@pytest.mark.parametrize("name", scenario.built_in())
def test_the_controller_gets_the_force_itself_unless_the_sensor_is_the_subject(name: str) -> None:
    """docs/specification.md section 3, Which force the controller gets."""
    one = scenario.load(name)
    sensor = any(key.startswith("plant.ft.") for case in one.cases for key in case.parameters)
    controllers = {part for part, component in one.components.items() if "Controller" in component.archive}
    plants = {part for part, component in one.components.items() if component.archive not in NO_PLANT} - controllers
    read = set()
    for case in one.cases:
        inputs = {**one.inputs, **case.inputs}
        for target, source in inputs.items():
            part, _, variable = target.partition(".")
            if part not in controllers or not re.fullmatch(r"tau_h|f_h\[\d\]", variable):
                continue
            assert re.fullmatch(f"{FORCE}|{READING}", source), f"{case.id}: {target} = {source}"
            if re.fullmatch(READING, source):
                read.add(case.id)
            elif plants:  # the one that the plant gets
                assert source in {inputs.get(f"plant{side}.{variable}") for side in ("", ".left", ".right")}, case.id
    if sensor:
        assert read == {case.id for case in one.cases}
    elif name not in SENSOR_DELAY:
        assert not read


def test_an_unknown_scenario_names_close_matches(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    with pytest.raises(ScenarioError, match=r"unknown scenario wal .*wall"):
        scenario.load("wal")
    monkeypatch.chdir(tmp_path)
    (tmp_path / "mine").write_text(GOOD, encoding="utf-8")
    for name in ("mine", "my.yaml", "my.json", "MY.TOML"):
        with pytest.raises(ScenarioError, match=rf"{name}: expected the path of a TOML file, which ends in \.toml, or"):
            scenario.load(name)


def test_a_metric_that_nobody_knows_says_which_are_known() -> None:
    text = 'base = "testbed_wall"\ntitle = "t"\nabout = "a"\nsource = "s"\nduration = 1.0\n[cases.a]\n'
    text += "[metrics.release_dely]\n"
    with pytest.raises(ScenarioError, match=r"metrics\.release_dely: no known metric of this id .*release_delay"):
        scenario.parse(text=text, origin="mini.toml")


def test_a_file_with_the_mark_of_windows_editors_is_read(tmp_path: Path) -> None:
    (tmp_path / "mini.toml").write_text(GOOD, encoding="utf-8-sig")
    assert (tmp_path / "mini.toml").read_bytes().startswith(b"\xef\xbb\xbf")
    assert scenario.load(str(tmp_path / "mini.toml")) == scenario.parse(text=GOOD, origin="mini.toml")


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ('unit = "m"', 'unit = "mm"', r"mini: metric m: case only: unit: got mm, and plant\.q is in m; expected m"),
        ('unit = "m"', 'unit = "N"', "unit: got N"),
        ("arguments = {", "arguments = { aftr = 1.0,", "unexpected keyword argument 'aftr'; it takes column, after"),
        ('id = "only"', 'id = "only"\nparameters = { "plant.m" = 1.0 }', r"mini: case only: .* no variable m .*M"),
        (
            '"controller.q" = "plant.q"',
            '"controller.q" = "plant.dq"',
            r"q is in m, plant\.dq in m/s; expected one unit",
        ),
    ],
)
def test_what_the_fmus_show_to_be_wrong_is_named_with_scenario_and_case(
    old: str, new: str, said: str, fmu_dir: Path
) -> None:
    assert old in GOOD
    wrong = scenario.parse(text=GOOD.replace(old, new, 1), origin="mini.toml")
    with pytest.raises(ExoError, match=said):
        run(scenario=wrong, fmu_dir=fmu_dir)


def test_a_share_of_a_column_has_no_unit_of_it(fmu_dir: Path) -> None:
    """`time_above` is in s, whatever the column is in."""
    text = GOOD.replace('"maximum"', '"time_above"').replace('unit = "m"', 'unit = "s"')
    text = text.replace('{ column = "plant.q" }', '{ column = "plant.q", level = 0.0 }')
    assert run(scenario=scenario.parse(text=text, origin="mini.toml"), fmu_dir=fmu_dir).passed


def test_a_wrong_function_is_refused_before_anything_runs(tmp_path: object) -> None:
    wrong = scenario.parse(text=GOOD.replace('"maximum"', '"maximal"'), origin="mini.toml")
    with pytest.raises(ScenarioError, match=r"mini: metric m: unknown function maximal"):
        run(scenario=wrong, fmu_dir=tmp_path)  # type: ignore[arg-type]


def test_a_scenario_is_frozen() -> None:
    good = scenario.parse(text=GOOD, origin="mini.toml")
    with pytest.raises(ValueError, match="frozen"):
        good.duration = 2.0  # type: ignore[misc]


def test_the_published_errors_are_those_of_the_paper() -> None:
    assert [lookup(f"fig:1dof_perf/K={K}").value for K in ("7.5", "15", "30")] == [0.0207, 0.0103, 0.00549]
    assert all(number.rounding > 0.0 and ":" in number.label for number in published().values())
    arm = [lookup(f"sec:task_space_control/K={K}").value for K in ("250", "500", "1000")]
    assert arm == [0.046, 0.022, 0.011]
    with pytest.raises(ScenarioError, match=r"no fig:1dof_perf/K=3 .*K=30"):
        lookup("fig:1dof_perf/K=3")
