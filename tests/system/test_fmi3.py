"""The FMI 3.0 twins: valid for the schemas and for fmpy, and the same numbers as the FMI 2.0 archives, bit for bit."""

import re
import subprocess
import sys
import zipfile
from collections.abc import Mapping
from ctypes import c_double, c_int, c_uint32
from dataclasses import replace
from pathlib import Path
from typing import Any

import fmpy
import numpy as np
import pytest
from fmpy.validation import validate_fmu
from lxml import etree

from exo import scenario as scenarios
from exo.fmu import Archive
from exo.master import plan, simulate

from foreign import box3
from foreign.matrix import NAMES_SCHEDULED, ROOT, names
from foreign.record import SETTINGS, record
from foreign.runs import by_calls, product
from foreign.twin import CLOCK, Twin, by_twin, place, system

STEPS = 400
TWINS = [f"fmi3/{name}.fmu" for name in names()]
SCHEDULED = [f"fmi3/scheduled/{name}.fmu" for name in NAMES_SCHEDULED]


@pytest.fixture(params=TWINS + SCHEDULED)
def archive3(request: pytest.FixtureRequest, fmu_dir: Path) -> Path:
    """Each archive of FMI 3.0."""
    return fmu_dir / str(request.param)


def apart(found: Mapping[str, Any], expected: Mapping[str, Any]) -> list[str]:
    """Names of what is not the same in every bit."""
    assert sorted(found) == sorted(expected)
    return [
        name
        for name, values in expected.items()
        if found[name].astype(np.float64).tobytes() != values.astype(np.float64).tobytes()
    ]


def test_each_model_has_a_twin_and_each_controller_one_for_a_scheduler(fmu_dir: Path) -> None:
    there = sorted(path.relative_to(fmu_dir).as_posix() for path in (fmu_dir / "fmi3").rglob("*.fmu"))
    assert there == sorted(TWINS + SCHEDULED)
    committed = ROOT / "modelDescription" / "fmi3"
    assert sorted(path.stem for path in committed.glob("*.xml")) == sorted(names())
    assert sorted(NAMES_SCHEDULED) == ["ArmController", "TestbedController"]


@pytest.mark.parametrize(
    ("path", "xsd"),
    [
        ("modelDescription.xml", "fmi3ModelDescription.xsd"),
        ("terminalsAndIcons/terminalsAndIcons.xml", "fmi3TerminalsAndIcons.xsd"),
    ],
)
def test_descriptions_and_terminals_obey_the_official_schemas(archive3: Path, path: str, xsd: str) -> None:
    schema = etree.XMLSchema(etree.parse(str(Path(fmpy.__file__).parent / "schema" / "fmi3" / xsd)))
    with zipfile.ZipFile(archive3) as archive, archive.open(path) as file:
        document = etree.parse(file)
    assert schema.validate(document), schema.error_log
    document.getroot().append(etree.Element("Unknown"))
    assert not schema.validate(document)


def test_the_description_in_the_archive_is_the_committed_one(archive3: Path, fmu_dir: Path) -> None:
    committed = ROOT / "modelDescription" / archive3.relative_to(fmu_dir).with_suffix(".xml")
    with zipfile.ZipFile(archive3) as archive:
        assert archive.read("modelDescription.xml") == committed.read_bytes()


def test_fmpy_finds_no_problems(archive3: Path) -> None:
    assert validate_fmu(str(archive3)) == []


def test_terminals_name_variables_that_are_there_and_pictures_that_are_pngs(archive3: Path) -> None:
    variables = {v.name: v for v in fmpy.read_model_description(str(archive3)).modelVariables}
    with zipfile.ZipFile(archive3) as archive:
        root = etree.fromstring(archive.read("terminalsAndIcons/terminalsAndIcons.xml"))
        assert root.get("fmiVersion") == "3.0"
        terminals = root.findall("Terminals/Terminal")
        assert terminals
        for terminal in terminals:
            picture = terminal.find("TerminalGraphicalRepresentation").get("iconBaseName")
            assert archive.read(f"terminalsAndIcons/{picture}.png").startswith(b"\x89PNG\r\n\x1a\n")
            members = terminal.findall("TerminalMemberVariable")
            assert members
            for member in members:
                assert variables[member.get("variableName")].causality in {"input", "output"}
        assert archive.read("terminalsAndIcons/icon.png").startswith(b"\x89PNG\r\n\x1a\n")


def test_the_archive_has_the_library_of_fmi_2_byte_by_byte(archive3: Path, fmu_dir: Path) -> None:
    def library(path: Path) -> list[bytes]:
        with zipfile.ZipFile(path) as archive:
            return [archive.read(name) for name in archive.namelist() if name.startswith("binaries/")]

    assert library(archive3) == library(fmu_dir / archive3.name)
    with zipfile.ZipFile(archive3) as archive:
        folders = {name.split("/")[1] for name in archive.namelist() if name.startswith("binaries/")}
    assert folders <= {"x86_64-linux", "x86_64-windows", "aarch64-linux", "x86_64-darwin", "aarch64-darwin"}


@pytest.mark.parametrize("twin", TWINS)
def test_variables_of_both_versions_say_the_same(twin: str, fmu_dir: Path) -> None:
    two = fmpy.read_model_description(str(fmu_dir / Path(twin).name))
    three = {v.name: v for v in fmpy.read_model_description(str(fmu_dir / twin)).modelVariables}
    assert three.pop("time").causality == "independent"
    types = {"Float64": {"Real"}, "Int32": {"Integer"}, "Enumeration": {"Integer", "Enumeration"}}
    seen: dict[str, int] = {}
    for old in two.modelVariables:
        name, element = place(old.name)
        new = three[name]
        assert old.type in types.get(new.type, {new.type})
        assert (old.causality, old.variability, old.unit) == (new.causality, new.variability, new.unit)
        assert old.valueReference == new.valueReference + element
        assert [old.min, old.max] == [new.min, new.max]
        if old.start is not None:
            starts = new.start.split() if new.type != "String" else [new.start]
            assert starts[element] == old.start
        seen[name] = seen.get(name, 0) + 1
    assert seen == {name: int(np.prod(v.shape)) if v.shape else 1 for name, v in three.items()}
    # The order in which importers show them.
    order = list(dict.fromkeys(place(v.name)[0] for v in two.modelVariables))
    assert list(three) == order


@pytest.mark.parametrize("twin", TWINS)
def test_fmpy_simulates_both_versions_to_the_same_bits(twin: str, fmu_dir: Path) -> None:
    name = Path(twin).stem
    settings: dict[str, Any] = dict(SETTINGS.get(name, {}))
    if name == "ExoskeletonArm":
        settings["f_h[3]"] = 20.0
    three = {v.name: v for v in fmpy.read_model_description(str(fmu_dir / twin)).modelVariables}
    whole: dict[str, Any] = {}
    for key, value in settings.items():
        array, element = place(key)
        variable = three[array]
        whole.setdefault(array, variable.start.split() if variable.shape else [value])[element] = value
    starts = {key: values if three[key].shape else values[0] for key, values in whole.items()}
    old = fmpy.simulate_fmu(str(fmu_dir / f"{name}.fmu"), stop_time=0.5, start_values=settings)
    new = fmpy.simulate_fmu(str(fmu_dir / twin), stop_time=0.5, start_values=starts)
    found = {}
    for column in new.dtype.names:
        values = new[column]
        if values.ndim == 1:
            found[column] = values
        else:
            found |= {f"{column}[{i + 1}]": values[:, i] for i in range(values.shape[1])}
    assert apart(found, {column: old[column] for column in old.dtype.names}) == []
    assert len(old) > 200


@pytest.mark.parametrize("path", TWINS + SCHEDULED)
def test_a_twin_gives_the_outputs_of_fmi_2_bit_for_bit(
    path: str, fmu_dir: Path, archives: Mapping[str, Archive]
) -> None:
    two = archives[Path(path).name]
    one = record(two, steps=STEPS)
    expected = by_calls(two, one, product)
    assert sum(np.ptp(values) > 0.0 for values in expected.values()) > 0.4 * len(expected)
    assert apart(by_twin(fmu_dir / path, one, product), expected) == []


def test_a_difference_of_one_bit_in_one_input_is_seen(fmu_dir: Path, archives: Mapping[str, Archive]) -> None:
    one = record(archives["Testbed.fmu"], steps=STEPS)
    expected = by_calls(archives["Testbed.fmu"], one, product)
    inputs = dict(one.inputs) | {"tau_h": one.inputs["tau_h"].copy()}
    inputs["tau_h"][0] = np.nextafter(inputs["tau_h"][0], np.inf)
    assert apart(by_twin(fmu_dir / TWINS[names().index("Testbed")], replace(one, inputs=inputs), product), expected)


@pytest.mark.parametrize(
    ("case", "duration", "moves"),
    [
        ("wall/passive_5_0.5", 24.0, "plant.tau_e"),
        ("arm_payload/passive_bounded_17.5kg", 4.0, "plant.f_h_measured[3]"),
    ],
)
def test_a_scenario_with_the_twins_is_the_recording_of_the_harness(
    case: str, duration: float, moves: str, fmu_dir: Path, archives: Mapping[str, Archive]
) -> None:
    scenario, _, name = case.partition("/")
    read = scenarios.load(scenario)
    chosen = next(one for one in read.cases if one.id == name)
    short = replace(plan(scenario=read, case=chosen), duration=duration)
    recording = simulate(plan=short, archives=archives)
    found = system(short, fmu_dir / "fmi3")
    assert np.ptp(recording.columns[moves]) > 1.0
    expected = {key: column for key, column in recording.columns.items() if key in found}
    assert len(expected) >= 40
    assert set(expected) == set(found)
    assert apart(found, expected) == []


@pytest.mark.parametrize("system_of", box3.BOXES)
def test_a_container_links_arrays_whole_and_gives_what_the_harness_records_of_fmi_2(
    system_of: str, fmu_dir: Path, archives: Mapping[str, Archive], tmp_path: Path
) -> None:
    box = box3.BOXES[system_of]
    recording = simulate(plan=box.plan(1.0), archives=archives)
    assert max(np.ptp(column) for key, column in recording.columns.items() if re.search(r"^plant\..*q", key)) > 0.01
    found = box3.run(box, 1.0, fmu_dir / "fmi3", tmp_path)
    assert apart(found, {key: recording.columns[key] for key in found}) == []
    assert len(found) >= 40


def test_every_twin_is_in_a_container() -> None:
    files = {file for box in box3.BOXES.values() for file in box.components.values()}
    assert files == {f"{name}.fmu" for name in names()}


def test_fmutool_finds_nothing(archive3: Path) -> None:
    answer = subprocess.run(
        [sys.executable, "-m", "fmu_manipulation_toolbox.cli.fmutool", "-input", archive3, "-check"],
        capture_output=True,
        text=True,
        check=False,
    )
    said = answer.stdout + answer.stderr
    assert answer.returncode == 0, said
    assert "No semantic error against the FMI-3 standard." in said
    assert not any(word in said for word in ("ERROR", "WARNING", "CRITICAL")), said


def test_the_clock_is_told_by_the_library_as_the_description_has_it(fmu_dir: Path) -> None:
    for path in SCHEDULED:
        with Twin(fmu_dir / path) as twin:
            clock = twin.variables["clock"]
            assert (clock.type, clock.valueReference, clock.intervalVariability) == ("Clock", CLOCK, "constant")
            twin.slave.enterInitializationMode(startTime=0.0)
            interval, qualifier = (c_double * 1)(), (c_int * 1)()
            twin.slave.getIntervalDecimal((c_uint32 * 1)(CLOCK), interval, qualifier)
            with zipfile.ZipFile(fmu_dir / path) as archive:
                said = etree.fromstring(archive.read("modelDescription.xml")).find("ModelVariables/Clock")
            assert list(interval) == [float(said.get("intervalDecimal"))]
            twin.slave.exitInitializationMode()


def test_time_is_the_independent_variable_and_cannot_be_set(fmu_dir: Path) -> None:
    with Twin(fmu_dir / "fmi3" / "Testbed.fmu") as twin:
        time = twin.variables["time"]
        twin.initialize(1.0, {})
        for k in range(3):
            assert twin.slave.getFloat64([time.valueReference]) == [k * 0.002]
            twin.step(k * 0.002, 0.002)
        with pytest.raises(Exception, match="fmi3SetFloat64"):
            twin.slave.setFloat64([time.valueReference], [1.0])
        assert any("time" in text for text in twin.messages)
