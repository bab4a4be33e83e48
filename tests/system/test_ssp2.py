"""SSP 2.0: valid, with a variant for each parameter set, and with FMI 3.0 twins whose vectors are one connection."""

import re
import zipfile
from collections.abc import Callable, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from lxml import etree
from typer.testing import CliRunner

from exo import systems
from exo.cli import app
from exo.errors import FmuError
from exo.fmu import Archive
from exo.systems import closed, ssp, system
from exo.systems.form import SSP_2, Form, Twin, forms
from exo.validate import Report
from exo.validate.ssp import findings

from foreign import described

SCHEMAS = Path(str(systems.__file__)).parent / "schema"
NAMESPACES = {"ssd": ssp.SSD, "ssc": ssp.SSC, "ssv": ssp.SSV}
Load = Callable[[str], system.System]


@pytest.fixture(scope="module")
def twins(archives: Mapping[str, Archive], tmp_path_factory: pytest.TempPathFactory) -> dict[str, Twin]:
    """FMI 3.0 descriptions of all archives."""
    folder = tmp_path_factory.mktemp("fmi3")
    return {file: Twin.of(described.write(archive, folder)) for file, archive in archives.items()}


def documents(path: Path) -> dict[str, Any]:
    """The XML documents of an archive, by name."""
    with zipfile.ZipFile(path) as files:
        return {
            name: etree.fromstring(files.read(name)) for name in files.namelist() if name.endswith((".ssd", ".ssv"))
        }


@pytest.fixture(scope="module", params=[(load, name) for load in (system.load, closed.load) for name in system.RECIPES])
def written(
    request: pytest.FixtureRequest, archives: Mapping[str, Archive], tmp_path_factory: pytest.TempPathFactory
) -> tuple[system.System, dict[str, Any]]:
    """Each system and its documents in SSP 2.0."""
    load, name = request.param
    data = load(name)
    path = ssp.write(system=data, archives=archives, folder=tmp_path_factory.mktemp("ssp2"), form=SSP_2)
    return data, documents(path)


def test_every_document_obeys_the_schema_of_ssp_2_0(written: tuple[system.System, dict[str, Any]]) -> None:
    kinds = {".ssd": "SystemStructureDescription.xsd", ".ssv": "SystemStructureParameterValues.xsd"}
    judges = {kind: etree.XMLSchema(etree.parse(str(SCHEMAS / file))) for kind, file in kinds.items()}
    for name, root in written[1].items():
        judge = judges[name[-4:]]
        assert root.get("version") == "2.0"
        assert judge.validate(root), (name, judge.error_log)
    root.append(etree.Element("Unknown"))
    assert not judge.validate(root)


def test_the_committed_schemas_are_of_version_2_0_and_carry_their_licence() -> None:
    files = sorted(SCHEMAS.glob("*.xsd"))
    assert len(files) == 5
    for file in files:
        text = file.read_text(encoding="utf-8")
        assert re.search(r"^\s*Version: 2\.0$", text, re.MULTILINE), file.name
        assert "Redistribution and use in source and binary forms" in text, file.name


def test_each_parameter_set_is_a_variant_with_a_name_and_a_length_of_its_own(
    written: tuple[system.System, dict[str, Any]],
) -> None:
    data, found = written
    plans = (system if data.inputs else closed).case_plans(data.name.removesuffix(closed.CLOSED))
    variants = {name: root for name, root in found.items() if name.endswith(".ssd")}
    assert set(variants) == {ssp.DEFAULT, *(f"{name}.ssd" for name in data.parameter_sets if name != data.default)}
    assert len({root.get("name") for root in variants.values()}) == len(variants)
    for file, root in variants.items():
        of_case = data.default if file == ssp.DEFAULT else file.removesuffix(".ssd")
        bindings = root.findall(".//ssd:ParameterBinding", NAMESPACES)
        assert [one.get("source") for one in bindings] == [ssp.resource(of_case, part) for part in ssp.bound_at(data)]
        assert all(one.get("source") in found for one in bindings)
        (experiment,) = root.findall("ssd:DefaultExperiment", NAMESPACES)
        assert float(experiment.get("stopTime")) == plans[of_case].duration
        assert root.find("ssd:System", NAMESPACES).get("name") == data.name


def test_the_metadata_of_each_component_names_a_page_in_its_fmu(
    written: tuple[system.System, dict[str, Any]], archives: Mapping[str, Archive]
) -> None:
    data, found = written
    components = found[ssp.DEFAULT].findall(".//ssd:Component", NAMESPACES)
    assert [one.get("name") for one in components] == list(data.components)
    for component in components:
        (metadata,) = component.findall("ssc:MetaData", NAMESPACES)
        assert metadata.get("sourceBase") == "resource"
        with zipfile.ZipFile(archives[data.components[component.get("name")]].path) as fmu:
            assert metadata.get("source") in fmu.namelist()


@pytest.mark.parametrize("load", [system.load, closed.load])
@pytest.mark.parametrize("name", system.RECIPES)
def test_an_archive_of_fmi_3_0_twins_has_no_finding(
    name: str, load: Load, archives: Mapping[str, Archive], twins: Mapping[str, Twin], tmp_path: Path
) -> None:
    path = ssp.write(system=load(name), archives=archives, folder=tmp_path, form=replace(SSP_2, twins=twins))
    assert findings(path, lambda one: Report(one, (), ())) == ([], [])


def test_vectors_of_twins_are_one_connection_and_a_part_of_one_is_named_by_its_index(
    archives: Mapping[str, Archive], twins: Mapping[str, Twin]
) -> None:
    form = replace(SSP_2, twins=twins)
    arm = etree.fromstring(ssp.description(system=closed.load("ExoskeletonSystem"), archives=archives, form=form))
    joined = [dict(one.attrib) for one in arm.iterfind(".//ssd:Connection", NAMESPACES)]
    named = {(one["startElement"], one["startConnector"], one["endElement"], one["endConnector"]) for one in joined}
    assert ("plant", "q", "controller", "q") in named
    assert ("controller", "tau_a", "plant", "tau_a") in named
    assert len(named) == len(joined)
    assert not any("Indices" in key for one in joined for key in one)
    (q,) = arm.findall(".//ssd:Component[@name='controller']//ssd:Connector[@name='q']", NAMESPACES)
    assert [child.tag for child in q] == [f"{{{ssp.SSC}}}Float64", f"{{{ssp.SSC}}}Dimension"]
    assert q[1].get("size") == "3"
    axis = etree.fromstring(ssp.description(system=closed.load("TestbedSystem"), archives=archives, form=form))
    of_force = [dict(one.attrib) for one in axis.iterfind(".//ssd:Connection[@startElement='operator']", NAMESPACES)]
    assert of_force
    assert {one["startIndices"] for one in of_force} == {"1"}


def test_the_parameters_of_twins_are_those_of_fmi_2_0_element_by_element(
    archives: Mapping[str, Archive], twins: Mapping[str, Twin]
) -> None:
    data = system.load("ExoskeletonSystem")
    form = replace(SSP_2, twins=twins)
    for name, given in data.parameter_sets.items():
        root = etree.fromstring(ssp.parameter_set(system=data, archives=archives, name=name, form=form))
        found = {one.get("name"): one for one in root.iterfind("ssv:Parameters/ssv:Parameter", NAMESPACES)}
        for key, value in given.items():
            part, variable = key.split(".", 1)
            _, number = archives[data.components[part]].start_value(variable, value)
            indices = [int(index) for index in re.findall(r"\[(\d+)\]", variable)]
            parameter = found[re.sub(r"\[\d+\]", "", key)]
            values = [one.get("value") for one in parameter[0]] or parameter[0].get("value").split()
            text = values[indices[0] - 1 if indices else 0]
            items = twins[data.components[part]].interface.element(variable)[0].items
            assert number == (items[text] if items else text == "true" if text in ("true", "false") else float(text))


def test_what_a_case_does_not_say_of_an_array_is_its_start_value(
    archives: Mapping[str, Archive], twins: Mapping[str, Twin]
) -> None:
    data = system.load("ExoskeletonSystem")
    one = replace(data, parameter_sets={"one": {"controller.K[2]": 123.0, "operator.segment[2].kind": "sine"}})
    form = replace(SSP_2, twins=twins)
    root = etree.fromstring(ssp.parameter_set(system=one, archives=archives, name="one", form=form))
    arm, operator = archives[data.components["controller"]], archives[data.components["operator"]]
    (gain,) = root.findall(".//ssv:Parameter[@name='controller.K']/ssv:Float64", NAMESPACES)
    start = [float(arm.variable(f"K[{i}]").start) for i in (1, 2, 3)]
    assert [float(text) for text in gain.get("value").split()] == [start[0], 123.0, start[2]]
    kinds = root.findall(".//ssv:Parameter[@name='operator.segment.kind']/ssv:Enumeration/ssv:Value", NAMESPACES)
    assert len(kinds) == sum(1 for name in operator.variables if re.fullmatch(r"segment\[\d+\]\.kind", name))
    assert kinds[1].get("value") == "sine"


def test_the_command_writes_both_versions_and_twins_where_all_are_there(
    fmu_dir: Path, twins: Mapping[str, Twin], tmp_path: Path
) -> None:
    given = next(iter(twins.values())).path.parent
    words = ["ssp", "--out", str(tmp_path), "--fmu-dir", str(fmu_dir), "--fmi3-dir", str(given)]
    assert CliRunner().invoke(app, words).exit_code == 0
    names = {f"{name}{end}.ssp" for name in system.RECIPES for end in ("", closed.CLOSED)}
    for folder, version in (("", "1.0"), ("ssp2", "2.0"), ("ssp2/fmi3", "2.0")):
        assert {path.name for path in (tmp_path / folder).glob("*.ssp")} == names
        assert {documents(tmp_path / folder / name)[ssp.DEFAULT].get("version") for name in names} == {version}
    with zipfile.ZipFile(tmp_path / "ssp2" / "fmi3" / "TestbedSystem.ssp") as files:
        assert files.read("resources/Testbed.fmu") == (given / "Testbed.fmu").read_bytes()


def test_a_folder_that_lacks_a_twin_serves_none_and_is_named_where_it_was_asked_for(tmp_path: Path) -> None:
    files = ["Testbed.fmu"]
    found = forms(tmp_path, files, twins=None, default_twins=tmp_path, inline=False)
    assert {path.name: form.version for path, form in found.items()} == {tmp_path.name: "1.0", "ssp2": "2.0"}
    with pytest.raises(FmuError, match=r"Testbed\.fmu: no such FMU"):
        forms(tmp_path, files, twins=tmp_path, default_twins=tmp_path, inline=False)


def test_an_fmi_2_0_archive_is_no_twin_and_ssp_1_0_takes_none(fmu_dir: Path, twins: Mapping[str, Twin]) -> None:
    with pytest.raises(FmuError, match=r"Testbed\.fmu: expected an FMI 3\.0 co-simulation FMU, got FMI 2\.0"):
        Twin.of(fmu_dir / "Testbed.fmu")
    with pytest.raises(FmuError, match=r"SSP 1\.0 knows no FMI 3\.0: expected version 2\.0"):
        Form(twins=twins)
    with pytest.raises(FmuError, match=r"SSP 3\.0: expected 1\.0 or 2\.0"):
        Form(version="3.0")
