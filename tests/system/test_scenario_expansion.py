"""Bases, axes, known metrics, shared panels and wiring by name: what a short file means, and what is wrong in one."""

import re
from collections.abc import Mapping
from pathlib import Path

import pytest
from typer.testing import CliRunner

from exo import scenario
from exo.cli import app
from exo.errors import ScenarioError
from exo.expansion import wiring
from exo.experiment import run
from exo.fmu import Archive
from exo.naming import elements

MANUAL = Path(__file__).resolve().parents[2] / "docs" / "scenarios.md"
MINI = """
base = "testbed"
title = "t"
about = "a"
source = "s"
duration = 1.0
[axes]
K = [7.5, 15.0]
[axes.form]
servo = { text = "a drive", "controller.form" = "position_servo", coupling = "exchange_at_once" }
torque = { text = "a force" }
[profiles]
tau_h = "sway"
[cases."{form}_K{K}"]
label = "{form.text}, {K}"
"controller.K" = "{K}"
[metrics.m]
title = "largest q"
unit = "m"
function = "maximum"
arguments = { column = "plant.q" }
cases = ["{form}_K7.5"]
source = "s"
expected = { "torque_K{K}" = { at_most = [1.0, 2.0] } }
[metrics.release_delay]
cases = ["torque_K15"]
[figures.f]
title = "f"
x_range = [0.0, 1.0]
case = "{form}_K{K}"
column = "plant.q"
panels = [
    { title = "{form}", y_label = "q", label = "{K}" },
    { y_label = "dq", case = "servo_K15", column = "plant.dq" },
]
"""


def parsed(text: str, folder: Path | None = None) -> scenario.Scenario:
    return scenario.parse(text=text, origin="mini.toml", folder=folder)


def example() -> str:
    found = re.search(r"```toml\n(.*?)```", MANUAL.read_text(encoding="utf-8"), re.DOTALL)
    assert found
    return found[1]


def test_the_manual_s_example_runs_from_outside_and_passes(tmp_path: Path, fmu_dir: Path) -> None:
    file = tmp_path / "my_wall.toml"
    file.write_text(example(), encoding="utf-8")
    answer = CliRunner().invoke(app, ["run", str(file), "--out", str(tmp_path / "out"), "--fmu-dir", str(fmu_dir)])
    assert answer.exit_code == 0, answer.output
    assert "pass my_wall: 6 pass, 0 fail" in answer.output
    assert (tmp_path / "out" / "my_wall" / "release.png").is_file()


def test_every_key_of_a_scenario_stands_in_the_manual() -> None:
    manual = MANUAL.read_text(encoding="utf-8")
    keys = {"base", "wiring", "axes", "known", "over", "like", "parameters", *scenario.Scenario.model_fields}
    models = (scenario.Case, scenario.Metric, scenario.Check, scenario.Ratio, scenario.Segment)
    keys |= {key for model in models for key in model.model_fields}
    assert {key for key in keys if not re.search(rf"\b{key}\b", manual)} == set()


def test_a_short_file_is_the_plain_one() -> None:
    data = parsed(MINI)
    assert data.id == "mini"
    assert [case.id for case in data.cases] == ["servo_K7.5", "servo_K15", "torque_K7.5", "torque_K15"]
    servo = data.cases[1]
    assert servo.label == "a drive, 15"
    assert servo.parameters == {"controller.form": "position_servo", "controller.K": 15.0}
    assert servo.coupling == "exchange_at_once"
    assert data.cases[2].coupling is None
    assert data.metrics[0].cases == ("servo_K7.5", "torque_K7.5")
    assert data.metrics[0].expected["torque_K15"].at_most == 2.0
    assert data.metrics[1].function == "release_delay"
    panels = data.figures[0].panels
    assert [panel.title for panel in panels] == ["servo", "torque", ""]
    assert [(curve.case, curve.label) for curve in panels[1].curves] == [("torque_K7.5", "7.5"), ("torque_K15", "15")]
    assert [(curve.case, curve.column) for curve in panels[2].curves] == [("servo_K15", "plant.dq")]
    assert all(panel.x_range == (0.0, 1.0) for panel in panels)


def test_ids_as_tables_and_as_arrays_say_the_same() -> None:
    arrays = MINI.replace("[metrics.m]", '[[metrics]]\nid = "m"').replace(
        "[metrics.release_delay]", '[[metrics]]\nid = "release_delay"'
    )
    arrays = arrays.replace('[cases."{form}_K{K}"]', '[[cases]]\nid = "{form}_K{K}"')
    assert arrays.count("[[") == 3
    assert parsed(arrays) == parsed(MINI)


def test_a_scenario_replaces_what_its_base_says(tmp_path: Path) -> None:
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "base.toml").write_text(
        'base = "../mini.toml"\n[parameters]\n"plant.M" = 7.0\n"plant.b" = 0.1\n'
    )
    (tmp_path / "mini.toml").write_text(MINI + '[parameters]\n"plant.M" = 1.0\n"controller.D_n" = 2.0\n')
    data = parsed(
        'base = "mine/base.toml"\ntitle = "other"\n[parameters]\n"plant.M" = 8.0\n[cases.only]\n'
        '[metrics.tank]\nsource = "s"\n[figures.f]\ntitle = "f"\n',
        tmp_path,
    )
    assert data.title == "other"
    assert data.about == "a"
    assert data.components["plant"].parameters == {"b": 0.1, "M": 8.0}
    assert data.components["controller"].parameters == {"D_n": 2.0}
    assert list(data.components) == ["controller", "plant"]
    assert [case.id for case in data.cases] == ["only"]
    assert [metric.function for metric in data.metrics] == ["lowest_change"]


def test_a_scenario_can_be_a_base_and_keeps_its_id_to_itself() -> None:
    wall = scenario.load("wall")
    assert parsed('base = "wall"\n') == wall.model_copy(update={"id": "mini"})


def test_what_stands_in_a_metric_or_a_curve_replaces_what_it_starts_from() -> None:
    text = MINI.replace("[figures.f]", '[metrics.n]\nlike = "release_delay"\narguments = { margin = 0.5 }\n[figures.f]')
    text = text.replace('column = "plant.dq" }', 'curves = [{ column = "plant.dq", color = "red" }] }')
    data = parsed(text)
    assert data.metrics[2].arguments == data.metrics[1].arguments | {"margin": 0.5}
    (curve,) = data.figures[0].panels[2].curves
    assert (curve.case, curve.column, curve.color) == ("servo_K15", "plant.dq", "red")


def test_an_array_is_wired_as_a_whole() -> None:
    text = 'base = "arm"\ntitle = "t"\nabout = "a"\nsource = "s"\nduration = 1.0\n[cases.only]\n'
    wired = parsed(text).inputs
    assert wired["controller.f_h[3]"] == "operator.f_h[3]"
    own = parsed(text + '[inputs]\n"controller.f_h[2]" = "plant.f_h_measured[2]"\n').inputs
    assert {key: source for key, source in own.items() if key.startswith("controller.f_h")} == {
        "controller.f_h[2]": "plant.f_h_measured[2]"
    }
    assert own["controller.q[3]"] == "plant.q[3]"


def test_an_element_set_above_a_base_s_range_wins(tmp_path: Path) -> None:
    (tmp_path / "base.toml").write_text(MINI + '[parameters]\n"plant.x[2]" = 2.0\n"plant.x[1..3]" = 1.0\n')
    data = parsed('base = "base.toml"\n[parameters]\n"plant.x[2]" = 5.0\n', tmp_path)
    assert data.components["plant"].parameters == {"M": 6.0, "x[1]": 1.0, "x[2]": 5.0, "x[3]": 1.0}
    data = parsed('base = "base.toml"\n[parameters]\n"plant.x[1..3]" = 4.0\n', tmp_path)
    assert {data.components["plant"].parameters[f"x[{i}]"] for i in (1, 2, 3)} == {4.0}


def test_inputs_come_before_the_wiring_by_name() -> None:
    assert parsed(MINI).inputs == {
        "controller.q": "plant.q",
        "controller.tau_h": "profile.tau_h",
        "plant.tau_a": "controller.tau_a",
        "plant.tau_h": "profile.tau_h",
    }
    measured = MINI.replace("[profiles]", '[inputs]\n"controller.tau_h" = "plant.tau_h_measured"\n[profiles]')
    assert parsed(measured).inputs["controller.tau_h"] == "plant.tau_h_measured"


def test_without_by_name_nothing_is_wired_by_itself() -> None:
    text = MINI.replace(
        'base = "testbed"',
        'base = "testbed"\nwiring = "explicit"\ndelayed = []\ninputs = { "controller.q" = "plant.q" }',
    )
    assert parsed(text).inputs == {"controller.q": "plant.q"}


def test_the_known_pairs_are_variables_of_the_fmus(archives: Mapping[str, Archive]) -> None:
    for taker, givers in wiring.pairs().items():
        for giver, names in givers.items():
            for name in (one for array in names for one in elements(array)):
                assert archives[taker].variable(name).causality == "input", (taker, name)
                assert giver == wiring.PROFILE or archives[giver].variable(name).causality == "output", (giver, name)


def test_braces_are_only_braces_where_there_are_no_axes() -> None:
    text = """
id = "plain"
title = "{law}"
about = "a"
source = "s"
duration = 1.0
step = 0.002
inputs = {}
[components.plant]
archive = "Testbed.fmu"
[[cases]]
id = "only"
label = "{law}"
"""
    assert parsed(text).cases[0].label == "{law}"


def test_a_misspelt_field_is_found_where_the_axis_has_no_other() -> None:
    text = MINI.replace("{form.text}", "{form}").replace('text = "a drive", "controller.form"', '"controller.form"')
    text = text.replace('{ text = "a force" }', "{ duratin = 2.0 }").replace(', coupling = "exchange_at_once"', "")
    text = text.replace('"controller.form" = "position_servo"', "")
    with pytest.raises(ScenarioError, match=r"axes\.form\.torque\.duratin: nothing uses it"):
        parsed(text)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ('base = "testbed"', 'base = "testbet"', r"mini\.toml: base: unknown base testbet .*testbed"),
        ('base = "testbed"', 'base = "other.toml"', r"mini\.toml: base: no such file other\.toml"),
        ('base = "testbed"', "base = 3", r"mini\.toml: base: got 3; expected the name of a base or a path"),
        (
            '{form}_K{K}"]\nlabel',
            '{from}_K{K}"]\nlabel',
            r"mini\.toml: cases\.\{from\}_K\{K\}: unknown axis from .*form",
        ),
        ("{form.text}", "{form.txt}", r"cases\..*: \{form\.txt\}: servo of axis form has no txt .*text"),
        ('torque = { text = "a force" }', "torque = {}", r"\{form\.text\}: torque of axis form has no text"),
        ("coupling =", "couplng =", r"mini\.toml: axes\.form\.servo\.couplng: nothing uses it; expected .*coupling"),
        (
            'servo = { text = "a drive", "controller.form" = "position_servo", coupling = "exchange_at_once" }',
            'servo = { text = "a drive", duratin = 2.0 }',
            r"mini\.toml: axes\.form\.servo\.duratin: nothing uses it; expected .*duration",
        ),
        ("K = [7.5, 15.0]", "K = 7.5", r"mini\.toml: axes\.K: got 7\.5; expected a list of values or a table"),
        ('label = "{form.text}', 'over = { K = [8.0] }\nlabel = "{form.text}', r"over\.K: no value 8 .*7\.5"),
        ('label = "{form.text}', 'over = { k = [7.5] }\nlabel = "{form.text}', r"over: unknown axis k .*K"),
        ('label = "{form.text}', 'lable = "{form.text}', r"mini\.toml: cases\.servo_K7\.5\.lable: unknown key"),
        ("[1.0, 2.0]", "[1.0]", r"metrics\.m\.expected\.torque_K\{K\}\.at_most: got 1 numbers; expected 2, one a case"),
        ('unit = "m"', 'like = "relase_delay"', r"metrics\.m\.like: no metric relase_delay .*release_delay"),
        ('function = "maximum"', "function = 3", r"mini\.toml: metrics\.m\.function: got 3; expected"),
        ('"sway"', '"swy"', r"mini\.toml: profiles\.tau_h: no known profile swy .*sway"),
        ("tau_h = ", "tau_H = ", r"mini\.toml: profiles\.tau_H: feeds no input; expected .*tau_h"),
        ("duration = 1.0", 'duration = 1.0\nwiring = "auto"', r"mini\.toml: wiring: got 'auto'; expected .*'by_name'"),
        (
            "duration = 1.0",
            'duration = 1.0\nparameters = { "plnt.M" = 1.0 }',
            r"parameters: plnt\.M: unknown component plnt .*plant",
        ),
        (
            "duration = 1.0",
            "duration = 1.0\nparameters = { M = 1.0 }",
            r"parameters\.M: got 1\.0; expected a name as component",
        ),
        ("duration = 1.0", "duration = 1.0\nknown = { metric = {} }", r"known\.metric: unknown key .*metrics"),
        (
            "duration = 1.0",
            "duration = 1.0\nknown = { metrics = { m = 3 } }",
            r"known\.metrics\.m: got 3; expected the keys",
        ),
        ("duration = 1.0", "duration = 1.0\ninputs = 3", r"mini\.toml: inputs: got 3; expected"),
        ("duration = 1.0", "duration = 1.0\nratios = 3", r"mini\.toml: ratios: got 3; expected a table for each id"),
        (
            'label = "{form.text}',
            'parameters = 3\nlabel = "{form.text}',
            r"cases\.servo_K7\.5\.parameters: got 3; expected",
        ),
        ('y_label = "q"', 'y_lable = "q"', r"figures\.f\.panels\.0\.y_lable: unknown key"),
    ],
)
def test_what_is_wrong_is_named(old: str, new: str, message: str) -> None:
    assert old in MINI
    with pytest.raises(ScenarioError) as error:
        parsed(MINI.replace(old, new, 1))
    assert re.search(message, str(error.value), re.DOTALL), str(error.value)


def test_a_base_of_itself_is_refused(tmp_path: Path) -> None:
    for one, other in (("a", "b"), ("b", "a")):
        (tmp_path / f"{one}.toml").write_text(f'base = "{other}.toml"\n')
    with pytest.raises(ScenarioError, match=r"b\.toml: base: a\.toml starts from itself|a\.toml: base: b\.toml starts"):
        scenario.load(str(tmp_path / "a.toml"))


def test_two_that_could_give_are_refused() -> None:
    text = MINI.replace("[profiles]", '[components.second]\narchive = "Testbed.fmu"\n[profiles]')
    with pytest.raises(ScenarioError, match=r"controller\.q: Testbed\.fmu is plant and second; expected one"):
        parsed(text)


def test_a_metric_s_component_is_the_one_of_that_name_or_must_be_there(tmp_path: Path) -> None:
    text = MINI.replace('function = "maximum"\narguments = { column = "plant.q" }', 'function = "boundary_share"')
    with pytest.raises(ScenarioError, match=r"mini: metric m: boundary_share: operator: unknown component operator"):
        run(scenario=parsed(text), fmu_dir=tmp_path)
