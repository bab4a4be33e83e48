"""What lies in the archives besides the description and the libraries, as an importer and its user meet it."""

import html
import json
import re
import subprocess
import sys
import zipfile
from importlib import resources
from pathlib import Path
from typing import Any

import fmpy
import jsonschema
import pytest
from cyclonedx.schema import _res as schemas
from fmpy.fmi2 import FMU2Slave
from referencing import Registry, Resource


@pytest.fixture
def bill(fmu: Path) -> dict[str, Any]:
    """The bill of materials."""
    with zipfile.ZipFile(fmu) as archive:
        data: dict[str, Any] = json.loads(archive.read("documentation/sbom.cdx.json"))
    return data


def test_version_and_git_hash_are_readable(fmu: Path, tmp_path: Path) -> None:
    description = fmpy.read_model_description(fmu)
    references = {v.name: v.valueReference for v in description.modelVariables}
    slave = FMU2Slave(
        guid=description.guid,
        unzipDirectory=fmpy.extract(fmu, tmp_path),
        modelIdentifier=description.coSimulation.modelIdentifier,
        instanceName="one",
    )
    slave.instantiate()
    try:
        version, git_hash = (
            value.decode() for value in slave.getString([references["version"], references["git_hash"]])
        )
    finally:
        slave.freeInstance()
    assert version == description.version
    assert re.fullmatch(r"[0-9a-f]{40}(-dirty)?|unknown", git_hash)


def test_the_first_example_of_the_document_runs_as_it_is(fmu: Path, tmp_path: Path) -> None:
    with zipfile.ZipFile(fmu) as archive:
        page = archive.read("documentation/index.html").decode()
    (example,) = re.findall(r'<pre class="python">(.*?)</pre>', page, re.DOTALL)
    (tmp_path / fmu.name).write_bytes(fmu.read_bytes())
    answer = subprocess.run(
        [sys.executable, "-c", html.unescape(example)], cwd=tmp_path, capture_output=True, text=True, check=False
    )
    assert answer.returncode == 0, answer.stdout + answer.stderr
    assert answer.stdout.startswith("('time',")
    assert float(answer.stdout.splitlines()[1].split(",")[0].strip("( ")) == pytest.approx(1.0, abs=1e-9)


def test_the_bill_of_materials_follows_cyclonedx(bill: dict[str, Any]) -> None:
    folder = resources.files(schemas)
    read = {file.name: json.loads(file.read_text("utf-8")) for file in folder.iterdir() if ".schema.json" in file.name}
    # They refer to each other by file name, from the place that the first one says.
    registry = Registry().with_resources(
        (f"http://cyclonedx.org/schema/{name}", Resource.from_contents(schema)) for name, schema in read.items()
    )
    validator = jsonschema.Draft7Validator(read["bom-1.5.SNAPSHOT.schema.json"], registry=registry)
    assert [error.message for error in validator.iter_errors(bill)] == []
    # The schema says no to what is wrong.
    assert not validator.is_valid({**bill, "specVersion": 1.5})
    assert not validator.is_valid({**bill, "components": [{"name": "no type"}]})


def test_the_bill_of_materials_refers_to_what_it_lists(bill: dict[str, Any], fmu: Path) -> None:
    references = [part["bom-ref"] for part in bill["components"]]
    assert references == sorted(set(references))
    known = {*references, bill["metadata"]["component"]["bom-ref"]}
    assert bill["metadata"]["component"]["name"] == fmu.stem
    assert {entry["ref"] for entry in bill["dependencies"]} == known
    # From the FMU everything is reached: nothing is listed that it does not use.
    uses = {entry["ref"]: entry["dependsOn"] for entry in bill["dependencies"]}
    reached, ahead = set(), [fmu.stem]
    while ahead:
        if (one := ahead.pop()) not in reached:
            reached.add(one)
            ahead += uses[one]
    assert reached == known


def test_each_foreign_part_has_its_licence_texts(bill: dict[str, Any], fmu: Path) -> None:
    with zipfile.ZipFile(fmu) as archive:
        names = archive.namelist()
        overview = archive.read("documentation/licenses/license.txt").decode()
        foreign = [part for part in bill["components"] if "purl" in part]
        assert len(foreign) >= 5
        for part in foreign:
            folder = f"documentation/licenses/{part['bom-ref']}/"
            texts = [name for name in names if name.startswith(folder)]
            assert texts, part["name"]
            assert max(len(archive.read(name)) for name in texts) > 500  # one may be a line that names the others
            assert re.search(
                rf"^{re.escape(part['bom-ref'])} +{re.escape(part['licenses'][0]['expression'])}$",
                overview,
                re.MULTILINE,
            )


def test_the_icon_is_a_small_png(fmu: Path) -> None:
    with zipfile.ZipFile(fmu) as archive:
        icon = archive.read("model.png")
    assert icon.startswith(b"\x89PNG\r\n\x1a\n")
    assert len(icon) < 30_000
