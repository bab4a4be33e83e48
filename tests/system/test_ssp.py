"""The SSP archives: valid, reproducible, and what fmpy's SSP simulation makes of them.

fmpy sets all inputs, steps all FMUs, reads all outputs and only then follows the connections. Between FMUs that is the
harness' `exchange_at_once`. Before the first step it exchanges nothing: every wired input is zero there, so that
`engage` holds the controllers. What enters the system from outside reaches its FMU one step late: the tests feed it one
early.
"""

import sys
import zipfile
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import fmpy.ssp
import numpy as np
import pytest
from fmpy.ssp.simulation import simulate_ssp
from fmpy.ssp.ssd import Parameter, read_ssd, read_ssv
from lxml import etree

from exo import profile
from exo.errors import ExoError, FmuError, ScenarioError
from exo.fmu import Archive
from exo.master import Plan, simulate
from exo.scenario import PROFILE, Segment
from exo.systems import ssp, system

from commands import full_beyond

SCHEMAS = Path(fmpy.ssp.__file__).parent / "schema"
NAMESPACES = {"ssd": ssp.SSD, "ssc": ssp.SSC, "ssv": ssp.SSV, "oms": ssp.OMS}
#: Sample period whose multiples and sums are exact, so that fmpy's summed time equals the harness' k·T.
EXACT_T = 2.0**-10


@pytest.fixture(scope="module", params=system.RECIPES)
def archive(request: pytest.FixtureRequest, archives: Mapping[str, Archive], tmp_path_factory: Any) -> Path:
    """Each SSP archive in turn."""
    folder = tmp_path_factory.mktemp("ssp")
    return ssp.write(system=system.load(request.param), archives=archives, folder=folder)


def parsed(archive: Path, name: str) -> Any:
    with zipfile.ZipFile(archive) as files, files.open(name) as file:
        return etree.parse(file)


def schema(name: str) -> Any:
    return etree.XMLSchema(etree.parse(str(SCHEMAS / name)))


def test_the_description_obeys_the_schema_of_ssp_1_0(archive: Path) -> None:
    judge, document = schema("SystemStructureDescription.xsd"), parsed(archive, "SystemStructure.ssd")
    assert judge.validate(document), judge.error_log
    document.getroot().append(etree.Element("Unknown"))
    assert not judge.validate(document)


def test_every_parameter_set_obeys_the_schema_of_ssp_1_0(archive: Path) -> None:
    judge = schema("SystemStructureParameterValues.xsd")
    names = list(system.load(archive.stem).parameter_sets)
    assert len(names) >= 16
    for name in names:
        document = parsed(archive, ssp.resource(name))
        assert judge.validate(document), judge.error_log
    document.getroot()[0][0].append(etree.Element("Unknown"))
    assert not judge.validate(document)


def test_two_archives_are_the_same_bytes(archive: Path, archives: Mapping[str, Archive]) -> None:
    assert archive.read_bytes() == ssp.content(system=system.load(archive.stem), archives=archives)


def test_the_archive_holds_the_description_the_sets_and_the_fmus_unchanged(archive: Path, fmu_dir: Path) -> None:
    data = system.load(archive.stem)
    fmus = sorted(set(data.components.values()))
    with zipfile.ZipFile(archive) as files:
        assert files.namelist() == [
            "SystemStructure.ssd",
            *(ssp.resource(name) for name in data.parameter_sets),
            *(f"resources/{name}" for name in fmus),
        ]
        for name in fmus:
            assert files.read(f"resources/{name}") == (fmu_dir / name).read_bytes()


def test_omsimulator_s_annotation_names_a_fixed_step_master_with_the_controller_s_period(archive: Path) -> None:
    document = parsed(archive, "SystemStructure.ssd")
    path = "ssd:System/ssd:Annotations/ssc:Annotation[@type='org.openmodelica']/oms:Annotations"
    (master,) = document.findall(f"{path}/oms:SimulationInformation/oms:FixedStepMaster", NAMESPACES)
    assert master.get("description") == "oms-ma"
    assert float(master.get("stepSize")) == system.load(archive.stem).step


def test_connectors_and_connections_name_variables_of_the_fmus_with_their_kind_and_type(
    archive: Path, archives: Mapping[str, Archive]
) -> None:
    top = parsed(archive, "SystemStructure.ssd").find("ssd:System", NAMESPACES)
    kinds: dict[tuple[str | None, str], str] = {
        (None, one.get("name")): one.get("kind") for one in top.findall("ssd:Connectors/ssd:Connector", NAMESPACES)
    }
    for component in top.findall("ssd:Elements/ssd:Component", NAMESPACES):
        assert component.get("type") == "application/x-fmu-sharedlibrary"
        fmu = archives[component.get("source").removeprefix("resources/")]
        for connector in component.findall("ssd:Connectors/ssd:Connector", NAMESPACES):
            variable = fmu.variable(connector.get("name"))
            assert variable.causality == connector.get("kind")
            assert etree.QName(connector[0]).localname == variable.type
            kinds[component.get("name"), variable.name] = variable.causality
    ends = []
    for one in top.findall("ssd:Connections/ssd:Connection", NAMESPACES):
        start = (one.get("startElement"), one.get("startConnector"))
        end = (one.get("endElement"), one.get("endConnector"))
        assert kinds[start] == ("output" if start[0] else "input")
        assert kinds[end] == "input"
        ends.append(end)
    assert sorted(ends) == sorted(key for key, kind in kinds.items() if key[0] and kind == "input")


def test_the_bound_parameter_set_is_one_of_the_archive(archive: Path) -> None:
    (binding,) = read_ssd(str(archive)).system.parameterBindings
    assert binding.source == ssp.resource(system.load(archive.stem).default)
    assert binding.parameterValues[0].parameters


def test_a_parameter_set_says_what_its_scenario_says(archives: Mapping[str, Archive], tmp_path: Path) -> None:
    path = ssp.write(system=system.load("TestbedSystem"), archives=archives, folder=tmp_path)
    read = {
        p.name: (p.type, p.value, p.unit)
        for p in read_ssv(str(path), resource=ssp.resource("wall-standard_10_0.5")).parameters
    }
    # The scenario's own lines; law 1 is `standard` (docs/specification.md section 1). The last two are of the
    # exchange order.
    assert read == {
        "controller.K": ("Real", "30.0", "N.s/m"),
        "controller.K_P": ("Real", "10.0", "1/s"),
        "controller.tau_max": ("Real", "12.5", "N"),
        "controller.law": ("Integer", "1", None),
        "controller.M_n": ("Real", "10.0", "kg"),
        "controller.D_n": ("Real", "0.5", "N.s/m"),
        "plant.M": ("Real", "6.0", "kg"),
        "plant.F_c": ("Real", "0.64", "N"),
        "plant.b": ("Real", "0.19", "N.s/m"),
        "plant.wall.q": ("Real", "0.3", "m"),
        "controller.delay": ("Integer", "1", None),
        "engage": ("Boolean", "true", None),
    }


def test_a_boolean_that_fmpy_would_turn_round_is_refused(archives: Mapping[str, Archive]) -> None:
    data = system.load("TestbedSystem")
    wrong = replace(data, parameter_sets={"off": {"controller.engage": False}})
    with pytest.raises(FmuError, match=r"TestbedController\.fmu: engage"):
        ssp.parameter_set(system=wrong, archives=archives, name="off")


def test_an_unknown_system_is_named_with_those_that_are_close() -> None:
    with pytest.raises(ScenarioError, match="unknown system Testbed"):
        system.load("Testbed")


class Runs:
    """One case through fmpy's SSP simulation and through the harness."""

    def __init__(
        self, archives: Mapping[str, Archive], folder: Path, name: str, case: str, *, duration: float, T: float
    ) -> None:
        self.system = system.load(name)
        self.archives = {part: archives[file] for part, file in self.system.components.items()}
        path = ssp.write(system=self.system, archives=archives, folder=folder)
        steps = round(duration / T)
        self.plan = engaged_late(
            replace(
                system.case_plans(name)[case],
                coupling="exchange_at_once",
                step=T,
                duration=steps * T,
            ),
            T,
        )
        self.harness = simulate(plan=self.plan, archives=archives)
        parameters = read_ssv(str(path), resource=ssp.resource(case))
        parameters.parameters.append(Parameter(name="controller.T", type="Real", value=repr(T)))
        # Half a step short of the end, so that no rounding of the summed time adds a step.
        self.fmpy = simulate_ssp(
            str(path), stop_time=(steps - 0.5) * T, step_size=T, parameter_set=parameters, input=self.inputs(T)
        )
        assert len(self.fmpy) == steps

    def inputs(self, T: float) -> dict[str, Any]:
        """Each input of the system as a function of fmpy's time, one step early."""
        time = np.arange(self.plan.steps + 1) * T
        values = {
            name: profile.evaluate(segments=self.plan.profiles[name], time=time)
            for name in self.system.inputs
            if name in self.plan.profiles
        }
        return {name: lambda t, column=column: float(column[round(t / T) + 1]) for name, column in values.items()}

    def differences(self) -> dict[str, float]:
        """Largest difference of each output. The first step is left out where a controller that does not yet take part
        shows the position that it has not yet got; in the second one it names the jump from there."""
        found = {}
        for part, archive in self.archives.items():
            for name in archive.names("output"):
                key, variable = f"{part}.{name}", archive.variable(name)
                if variable.type not in ssp.TYPES:
                    continue
                ours, theirs = np.asarray(self.harness.columns[key], dtype=float), self.fmpy[key].astype(float)
                # fmpy's row k is what step k left; the harness' is that for a sampled output, else the instant t_k.
                first = 2 if variable.name == "encoder.fault" else 1
                pair = (ours[first:], theirs[first:]) if variable.variability == "discrete" else (ours[1:], theirs[:-1])
                found[key] = float(np.max(np.abs(pair[0] - pair[1])))
        return found


def engaged_late(plan: Plan, T: float) -> Plan:
    """The plan with `engage` false in the first step, as fmpy has it."""
    late = (Segment(kind="constant", amplitude=1.0, t_on=T / 2),)
    return replace(
        plan,
        parameters=dict(plan.parameters) | {"controller.T": T},
        inputs=dict(plan.inputs) | {"controller.engage": f"{PROFILE}.{system.ENGAGE}"},
        profiles=dict(plan.profiles) | {system.ENGAGE: late},
    )


def test_fmpy_runs_the_testbed_to_the_harness_result_bit_for_bit(
    archives: Mapping[str, Archive], tmp_path: Path
) -> None:
    runs = Runs(archives, tmp_path, "TestbedSystem", "wall-passive_bounded_5_0.5", duration=4.0, T=0.002)
    assert np.max(np.abs(runs.harness.columns["plant.tau_e"])) > 0.0, "the wall was met"
    differences = runs.differences()
    assert len(differences) > 20
    assert {name: d for name, d in differences.items() if d != 0.0} == {}


def test_fmpy_runs_the_gain_study_to_the_harness_result_bit_for_bit(
    archives: Mapping[str, Archive], tmp_path: Path
) -> None:
    runs = Runs(archives, tmp_path, "TestbedSystem", "gain_study-K7.5", duration=1.0, T=0.002)
    assert {name: d for name, d in runs.differences().items() if d != 0.0} == {}


def test_fmpy_runs_the_exoskeleton_to_the_harness_result_bit_for_bit(
    archives: Mapping[str, Archive], tmp_path: Path
) -> None:
    """Experiment 3 until the payload is sucked on."""
    runs = Runs(archives, tmp_path, "ExoskeletonSystem", "arm_payload-passive_bounded_17.5kg", duration=2.1, T=EXACT_T)
    assert runs.harness.columns["plant.attached"][-1], "the vacuum came through"
    differences = runs.differences()
    # fmpy hands p over after the first step: the hand has taken hold in the origin, which nothing feels at k_h = 0.
    held_at = {f"operator.p_target[{i}]": differences.pop(f"operator.p_target[{i}]") for i in (1, 2, 3)}
    start = {f"operator.p_target[{i}]": abs(float(runs.harness.columns[f"plant.p[{i}]"][0])) for i in (1, 2, 3)}
    assert held_at == start
    assert runs.harness.parameter("operator.k_h") == 0.0
    assert len(differences) > 50
    assert {name: d for name, d in differences.items() if d != 0.0} == {}


def test_at_one_millisecond_fmpy_s_summed_time_is_the_only_difference(
    archives: Mapping[str, Archive], tmp_path: Path
) -> None:
    runs = Runs(archives, tmp_path, "ExoskeletonSystem", "arm_performance-K500", duration=0.5, T=0.001)
    time = np.arange(runs.plan.steps) * 0.001
    # The sum of 500 milliseconds is off by some ulp of 0.5 s; the force follows at no more than 6.9 N · 2π · 0.4 Hz.
    off = float(np.max(np.abs(runs.fmpy["time"] - time)))
    assert 0.0 < off < 1e-13
    differences = runs.differences()
    assert differences["operator.f_h[1]"] <= (6.9 * 2.0 * np.pi * 0.4 + 6.9 / 2.0) * off + 1e-15
    # From there through the nominal, 1/Λ_n and friction's set-valued force: positions to far below 1e-12 m.
    assert max(differences[f"plant.p[{i}]"] for i in (1, 2, 3)) < 1e-12


@pytest.mark.skipif(sys.platform != "linux", reason="limits of a process")
def test_an_archive_that_does_not_fit_is_named_and_the_one_before_stays(
    archives: Mapping[str, Archive], tmp_path: Path
) -> None:
    path = tmp_path / "TestbedSystem.ssp"
    path.write_bytes(b"as before")
    with (
        full_beyond(1000),
        pytest.raises(ExoError, match=r"System\.ssp: cannot be written: File too large; what was there before stays"),
    ):
        ssp.write(system=system.load("TestbedSystem"), archives=archives, folder=tmp_path)
    assert path.read_bytes() == b"as before"
    assert [one.name for one in tmp_path.iterdir()] == [path.name]
