"""`documentation/index.html` of each FMU: its OMSimulator script builds a system that is wired, its words stand once.

OMSimulator is not run here. A stand-in takes its place that checks what OMSimulator's own Python sources check: that a
resource, a component and a connector exist, and that a connection goes from an output to an input.
"""

import html
import re
import sys
import zipfile
from collections import Counter
from collections.abc import Mapping
from pathlib import Path
from types import ModuleType
from typing import Any, ClassVar

import pytest

from exo.fmu import Archive

#: FMU → components and connections of its quick start.
SYSTEMS = {
    "TestbedController": (3, 6),
    "Testbed": (3, 6),
    "ArmController": (3, 18),
    "ExoskeletonArm": (3, 18),
    "HumanOperator": (3, 18),
    "ExoskeletonArms": (5, 36),
}


def page_of(fmu: Path) -> str:
    with zipfile.ZipFile(fmu) as archive:
        return archive.read("documentation/index.html").decode()


def reference(*names: str) -> tuple[str, ...]:
    """In place of `CRef`."""
    return names


class Model:
    """In place of `SSP`, and of what its `instantiate` returns."""

    made: ClassVar[list["Model"]] = []
    known: ClassVar[Mapping[str, Archive]] = {}

    def __init__(self) -> None:
        self.resources: list[str] = []
        self.components: dict[str, Archive] = {}
        self.wires: dict[tuple[str, str], tuple[str, str]] = {}
        self.calls: list[str] = []
        Model.made.append(self)

    def addResource(self, filename: str, new_name: str) -> None:  # noqa: N802 - OMSimulator's name
        assert filename in self.known
        assert new_name == f"resources/{filename}"
        assert new_name not in self.resources
        self.resources.append(new_name)

    def addComponent(self, cref: tuple[str, ...], resource: str) -> None:  # noqa: N802
        system, name = cref
        assert system == "default"
        assert name not in self.components
        assert resource in self.resources
        self.components[name] = self.known[resource.removeprefix("resources/")]

    def addConnection(self, source: tuple[str, ...], target: tuple[str, ...]) -> None:  # noqa: N802
        (_, giver, output), (_, taker, taken) = source, target
        given, needed = self.components[giver].variable(output), self.components[taker].variable(taken)
        assert (given.causality, needed.causality) == ("output", "input")
        assert (given.type, given.unit) == (needed.type, needed.unit)
        assert (taker, taken) not in self.wires, "an input has one source"
        self.wires[taker, taken] = (giver, output)

    def setValue(self, cref: tuple[str, ...], value: float) -> None:  # noqa: N802
        _, component, name = cref
        self.components[component].start_value(name, value)

    def instantiate(self) -> "Model":
        return self

    def __getattr__(self, name: str) -> Any:
        return lambda *_: self.calls.append(name)


def test_the_omsimulator_script_wires_the_system_that_the_fmu_is_part_of(
    fmu: Path, archives: Mapping[str, Archive], monkeypatch: pytest.MonkeyPatch
) -> None:
    (script,) = re.findall(r'<pre class="python omsimulator">(.*?)</pre>', page_of(fmu), re.DOTALL)
    stand_in = ModuleType("OMSimulator")
    stand_in.CRef, stand_in.SSP = reference, Model  # type: ignore[attr-defined]
    monkeypatch.setitem(sys.modules, "OMSimulator", stand_in)
    monkeypatch.setattr(Model, "made", [])
    monkeypatch.setattr(Model, "known", archives)
    exec(compile(html.unescape(script), f"{fmu.stem}.py", "exec"), {})
    (model,) = Model.made
    assert (len(model.components), len(model.wires)) == SYSTEMS[fmu.stem]
    assert f"{fmu.stem}.fmu" in {archive.path.name for archive in model.components.values()}
    prepared = ["setResultFile", "setStopTime", "setFixedStepSize"]
    assert model.calls == [*prepared, "initialize", "simulate", "terminate", "delete"]


def test_lua_is_gone(fmu: Path) -> None:
    assert re.findall(r"\blua\b|\boms_\w+\(", page_of(fmu), re.IGNORECASE) == []


def test_no_description_stands_twice_because_a_vector_has_elements(fmu: Path, archives: Mapping[str, Archive]) -> None:
    rows = re.findall(r"<tr><td><code>([^<]+)</code>.*?<td>([^<]*)<small>", page_of(fmu))
    names = Counter(name for name, _ in rows)
    declared = {re.sub(r"\[\d+\]", "[i]", name) for name in archives[fmu.name].variables}
    assert set(names) == declared
    assert set(names.values()) == {1}


def test_the_xml_orders_variables_by_causality_and_group(fmu: Path, archives: Mapping[str, Archive]) -> None:
    variables = list(archives[fmu.name].variables.values())
    order = ["input", "output", "parameter", "calculatedParameter", "local"]
    places = [order.index(one.causality) for one in variables]
    assert places == sorted(places)
    groups = [(one.causality, one.name.partition(".")[0] if "." in one.name else "") for one in variables]
    groups = [(causality, re.sub(r"\[\d+\]", "", group)) for causality, group in groups]
    runs = [group for group, before in zip(groups, [None, *groups], strict=False) if group != before]
    assert len(runs) == len(set(runs)), "each group stands together"
