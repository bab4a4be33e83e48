"""Short ways to write arrays in scenarios: what they stand for, and what is refused."""

import pytest

from exo import scenario
from exo.errors import ScenarioError
from exo.naming import elements, expand_values, expand_wires

ARM = """
id = "mini"
title = "A mini scenario"
about = "One case."
source = "here"
duration = 1.0
step = 0.001
delayed = ["plant.tau_a[1..3]"]
signals = ["plant.p[1..3]", "plant.contact"]
[components.controller]
archive = "ArmController.fmu"
[components.controller.parameters]
"K[1..3]" = 500.0
[components.plant]
archive = "ExoskeletonArm.fmu"
[inputs]
"plant.tau_a[1..3]" = "controller.tau_a[1..3]"
[[cases]]
id = "only"
parameters = { "plant.q_start" = [0.0, -1.0, 1.5], "plant.segment" = [{ axis = 1 }, { axis = 3, t_on = 2.0 }] }
"""


def test_a_range_is_its_elements_and_another_name_is_itself() -> None:
    assert elements("plant.p[1..3]") == ["plant.p[1]", "plant.p[2]", "plant.p[3]"]
    assert elements("operator.segment[2..3].t_on") == ["operator.segment[2].t_on", "operator.segment[3].t_on"]
    assert elements("plant.p[2]") == ["plant.p[2]"]
    with pytest.raises(ValueError, match=r"p\[3\.\.1\]: the range must increase"):
        elements("p[3..1]")


def test_a_scenario_s_arrays_are_kept_by_element() -> None:
    data = scenario.parse(text=ARM, origin="mini.toml")
    assert data.inputs == {f"plant.tau_a[{i}]": f"controller.tau_a[{i}]" for i in (1, 2, 3)}
    assert data.delayed == tuple(data.inputs)
    assert data.signals == ("plant.p[1]", "plant.p[2]", "plant.p[3]", "plant.contact")
    assert data.components["controller"].parameters == {"K[1]": 500.0, "K[2]": 500.0, "K[3]": 500.0}
    assert data.cases[0].parameters == {
        "plant.q_start[1]": 0.0,
        "plant.q_start[2]": -1.0,
        "plant.q_start[3]": 1.5,
        "plant.segment[1].axis": 1,
        "plant.segment[2].axis": 3,
        "plant.segment[2].t_on": 2.0,
    }


def test_wires_of_different_length_are_refused() -> None:
    with pytest.raises(ValueError, match=r"c\.q\[1\.\.3\] has 3 elements and p\.q\[1\] has 1"):
        expand_wires({"c.q[1..3]": "p.q[1]"})
    text = ARM.replace('"controller.tau_a[1..3]"', '"controller.tau_a[1..2]"')
    with pytest.raises(ScenarioError, match=r"mini\.toml: inputs: .*has 3 elements and .* has 2"):
        scenario.parse(text=text, origin="mini.toml")


def test_what_is_no_array_is_left_to_the_scenario_s_own_checks() -> None:
    assert expand_values(3) == 3
    assert expand_wires({"a": 1}) == {"a": 1}
    with pytest.raises(ScenarioError, match=r"mini\.toml: signals: .*valid array"):
        scenario.parse(text=ARM.replace('["plant.p[1..3]", "plant.contact"]', '"plant.p"'), origin="mini.toml")
