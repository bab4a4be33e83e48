"""The systems without inputs from outside: tools run them from the archive alone, to the harness' numbers.

Ecos and libcosim exchange while they initialize, then set all inputs, step all FMUs and follow the connections: the
harness' `exchange_at_once`, from the first step on.
"""

import re
import zipfile
from collections.abc import Callable, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any, NamedTuple

import fmpy.ssp
import numpy as np
import pytest
from fmpy.ssp.ssd import read_ssd
from lxml import etree
from typer.testing import CliRunner, Result

from exo.cli import app
from exo.errors import ScenarioError
from exo.fmu import Archive
from exo.master import Plan, simulate
from exo.profile import evaluate
from exo.recording import Recording
from exo.scenario import Segment
from exo.systems import closed, ssp, system

from foreign.ecos import tbb
from foreign.ssp_runs import through_ecos, through_fmpy, through_libcosim

NAMESPACES = {"ssd": ssp.SSD, "ssc": ssp.SSC, "ssv": ssp.SSV, "oms": ssp.OMS}
#: A step whose multiples are exact in seconds and in libcosim's nanoseconds: 1,953,125 ns.
EXACT_T = 2.0**-9


class Of(NamedTuple):
    """A case, how long it runs (s) and an output that changes in it."""

    system: str
    case: str
    duration: float
    changes: str


WALL = Of("TestbedSystem", "wall-passive_bounded_5_0.5", 4.0, "plant.tau_e")
SWAY = Of("TestbedSystem", "gain_study-K7.5", 1.0, "plant.q")
MOVE = Of("ExoskeletonSystem", "arm_performance-K500", 2.0, "plant.p[1]")
LIFT = Of("ExoskeletonSystem", "arm_payload-passive_bounded_17.5kg", 2.5, "plant.attached")


# fmpy exchanges after the first step only: the testbed's position is zero there in truth, the arm's is not.
@pytest.mark.parametrize(
    ("run", "of"),
    [
        *((run, of) for run in (through_ecos, through_libcosim) for of in (WALL, SWAY, MOVE, LIFT)),
        *((through_fmpy, of) for of in (WALL, SWAY)),
    ],
)
def test_a_closed_system_gives_the_harness_numbers_bit_for_bit(
    run: Callable[..., dict[str, list[float]]], of: Of, archives: Mapping[str, Archive], tmp_path: Path
) -> None:
    steps = round(of.duration / EXACT_T)
    case = closed.case_plans(of.system)[of.case]
    parameters = dict(case.parameters) | {"controller.T": EXACT_T}
    plan = replace(case, coupling="exchange_at_once", step=EXACT_T, duration=steps * EXACT_T, parameters=parameters)
    data = replace(closed.load(of.system, default=of.case), step=EXACT_T, parameter_sets={of.case: parameters})
    path = ssp.write(system=data, archives=archives, folder=tmp_path)
    outputs = known_outputs(data, archives)
    harness = simulate(plan=plan, archives=archives)
    found = run(path, data, steps, {key: variable.type for key, variable in outputs.items()})
    assert differences(harness, found, outputs) == {}
    assert harness.columns["controller.engaged"].all()
    assert np.ptp(np.asarray(found[of.changes], dtype=float)) > 0.0, f"{of.changes} did not change"


def known_outputs(data: system.System, archives: Mapping[str, Archive]) -> dict[str, Any]:
    """The outputs that the archive has connectors for, by `component.name`."""
    return {
        f"{part}.{output}": archives[file].variable(output)
        for part, file in data.components.items()
        for output in archives[file].names("output")
        if archives[file].variable(output).type in ssp.TYPES
    }


def differences(
    harness: Recording, found: Mapping[str, list[float]], outputs: Mapping[str, Any]
) -> dict[str, tuple[int, float]]:
    """First row and largest difference of each output that differs. Row k of a tool is what step k left; the harness'
    is that for a sampled output, else the instant t_k."""
    assert len(outputs) > 20
    beyond = {}
    for key, variable in outputs.items():
        ours, theirs = np.asarray(harness.columns[key], dtype=float), np.asarray(found[key], dtype=float)
        ours, theirs = (ours, theirs) if variable.variability == "discrete" else (ours[1:], theirs[:-1])
        assert ours.shape == theirs.shape
        if (other := ours != theirs).any():
            beyond[key] = int(np.argmax(other)), float(np.max(np.abs(ours - theirs)))
    return beyond


@pytest.fixture(scope="module", params=system.RECIPES)
def data(request: pytest.FixtureRequest) -> system.System:
    """Each closed system in turn."""
    return closed.load(request.param)


def described(data: system.System, archives: Mapping[str, Archive]) -> Any:
    return etree.fromstring(ssp.description(system=data, archives=archives))


def test_description_and_sets_obey_the_schemas_of_ssp_1_0(data: system.System, archives: Mapping[str, Archive]) -> None:
    schemas = Path(fmpy.ssp.__file__).parent / "schema"
    judge = etree.XMLSchema(etree.parse(str(schemas / "SystemStructureDescription.xsd")))
    assert judge.validate(described(data, archives)), judge.error_log
    judge = etree.XMLSchema(etree.parse(str(schemas / "SystemStructureParameterValues.xsd")))
    for component in data.components:
        text = ssp.parameter_set(system=data, archives=archives, name=data.default, component=component)
        assert judge.validate(etree.fromstring(text)), judge.error_log


def test_only_components_are_connected_and_bound(data: system.System, archives: Mapping[str, Archive]) -> None:
    top = described(data, archives).find("ssd:System", NAMESPACES)
    assert top.findall("ssd:Connectors", NAMESPACES) == []
    assert top.findall("ssd:ParameterBindings", NAMESPACES) == []
    connections = top.findall("ssd:Connections/ssd:Connection", NAMESPACES)
    assert len(connections) == len(data.connections)
    assert {one.get(end) for one in connections for end in ("startElement", "endElement")} <= set(data.components)
    for component in top.findall("ssd:Elements/ssd:Component", NAMESPACES):
        (binding,) = component.findall("ssd:ParameterBindings/ssd:ParameterBinding", NAMESPACES)
        assert binding.get("source") == ssp.resource(data.default, component.get("name"))


def test_the_parts_of_a_set_bear_its_name_and_say_what_the_whole_says(
    data: system.System, archives: Mapping[str, Archive]
) -> None:
    for name, values in data.parameter_sets.items():
        read = {}
        for component in data.components:
            root = etree.fromstring(ssp.parameter_set(system=data, archives=archives, name=name, component=component))
            assert root.get("name") == name, "Ecos chooses the sets of all components by one name"
            for one in root.iterfind("ssv:Parameters/ssv:Parameter", NAMESPACES):
                read[f"{component}.{one.get('name')}"] = one[0].get("value")
        assert read
        assert sorted(read) == sorted(values)
        for key, value in values.items():
            part, variable = key.split(".", 1)
            kind, number = archives[data.components[part]].start_value(variable, value)
            assert read[key] == ("true" if kind == "Boolean" else repr(number)), key


def test_the_archive_loads_in_fmpy_and_binds_the_default_set_at_each_component(
    data: system.System, archives: Mapping[str, Archive], tmp_path: Path
) -> None:
    path = ssp.write(system=data, archives=archives, folder=tmp_path)
    top = read_ssd(str(path)).system
    assert top.connectors == []
    for component in top.elements:
        (binding,) = component.parameterBindings
        assert binding.source == ssp.resource(data.default, component.name)
        assert binding.parameterValues[0].parameters
    with zipfile.ZipFile(path) as files:
        sets = [name for name in files.namelist() if name.endswith(".ssv")]
    assert len(sets) == len(data.parameter_sets) * len(data.components)


@pytest.mark.parametrize("open_or_closed", [system.load, closed.load])
@pytest.mark.parametrize("name", system.RECIPES)
def test_omsimulator_finds_what_it_records_in_the_default_experiment(
    name: str, open_or_closed: Callable[[str], system.System], archives: Mapping[str, Archive]
) -> None:
    data = open_or_closed(name)
    path = "ssd:DefaultExperiment/ssd:Annotations/ssc:Annotation[@type='org.openmodelica']/oms:Annotations"
    (information,) = described(data, archives).findall(f"{path}/oms:SimulationInformation", NAMESPACES)
    # The attributes that its own schema (schema/oms.xsd) lists; their values are its own defaults.
    assert dict(information.attrib) == {
        "resultFile": f"{data.name}_res.csv",
        "loggingInterval": "0.0",
        "bufferSize": "10",
        "signalFilter": "",
    }


@pytest.mark.parametrize("name", ["wall-passive_bounded_5_0.5", "gain_study-K7.5"])
def test_the_operator_s_segments_are_the_scenario_s_force(name: str, archives: Mapping[str, Archive]) -> None:
    plan = closed.case_plans("TestbedSystem")[name]
    plan = replace(plan, coupling="exchange_at_once", duration=24.0)
    force = simulate(plan=plan, archives=archives).columns["operator.f_h[1]"]
    segments = system.case_plans("TestbedSystem")[name].profiles["tau_h"]
    expected = evaluate(segments=segments, time=np.arange(plan.steps) * plan.step)
    # Two sines of an argument of up to 50 rad that is rounded differently: 4.43 N · 50 · 2⁻⁵³ and the sines' own ulp.
    assert np.max(np.abs(force - expected)) < 1e-13
    assert np.ptp(force) > 8.0


def test_a_sine_s_phase_counts_from_zero_in_the_operator() -> None:
    late = Segment(kind="sine", amplitude=2.0, frequency=0.5, phase=0.25, t_on=3.0)
    values = closed.as_segments([late])
    for t in (3.0, 3.7, 11.1):
        expected = 2.0 * np.sin(2.0 * np.pi * 0.5 * (t - 3.0) + 0.25)
        theirs = 2.0 * np.sin(2.0 * np.pi * 0.5 * t + float(values["operator.segment[1].phase"]))
        assert theirs == pytest.approx(expected, abs=1e-12)


def test_a_profile_that_the_operator_does_not_know_is_refused() -> None:
    with pytest.raises(ScenarioError, match="a square segment: HumanOperator has sine and constant only"):
        closed.as_segments([Segment(kind="square", frequency=1.0)])


def test_vacuum_is_on_from_the_start_only_where_the_scenario_ever_switches_it() -> None:
    plans: dict[str, Plan] = closed.case_plans("ExoskeletonSystem")
    on = {name for name, plan in plans.items() if plan.parameters.get("plant.vacuum")}
    assert on == {name for name in plans if name.startswith("arm_payload-")}
    assert all(plan.parameters["controller.engage"] is True for plan in plans.values())


def test_the_command_binds_the_set_that_it_is_told(fmu_dir: Path, tmp_path: Path) -> None:
    name = "gain_study-K15"
    assert command(fmu_dir, tmp_path, "--set", name).exit_code == 0
    for archive, source in [
        ("TestbedSystem", ssp.resource(name)),
        ("TestbedSystemClosed", ssp.resource(name, "plant")),
        ("ExoskeletonSystemClosed", ssp.resource("arm_contact-passive_bounded", "plant")),
    ]:
        with zipfile.ZipFile(tmp_path / f"{archive}.ssp") as files:
            assert f'source="{source}"' in files.read("SystemStructure.ssd").decode()


@pytest.mark.parametrize(
    ("sets", "sentence"),
    [
        (["gain_study-K16"], r"exo: unknown parameter set gain_study-K16: expected <scenario>-<case>.*gain_study-K15"),
        (
            ["gain_study-K15", "wall-passive_5_5"],
            "exo: TestbedSystem takes one parameter set, got gain_study-K15 and wall",
        ),
    ],
)
def test_a_set_that_cannot_be_bound_is_named(fmu_dir: Path, tmp_path: Path, sets: list[str], sentence: str) -> None:
    answer = command(fmu_dir, tmp_path, *(word for one in sets for word in ("--set", one)))
    assert answer.exit_code == 2
    assert re.search(sentence, answer.stderr), answer.stderr
    assert list(tmp_path.iterdir()) == []


def command(fmu_dir: Path, folder: Path, *words: str) -> Result:
    return CliRunner().invoke(app, ["ssp", "--out", str(folder), "--fmu-dir", str(fmu_dir), *words])


def test_ecos_without_its_library_fails_with_the_library_s_name(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("foreign.ecos.metadata.files", lambda _: [])
    monkeypatch.setattr("foreign.ecos.find_library", lambda _: None)
    with pytest.raises(AssertionError, match=r"Ecos is not run: libtbb\.so\.12 is missing"):
        tbb()
