"""`exo validate X.ssp`: good archives have no finding, broken ones that of their rule, hostile ones no traceback."""

import json
import zipfile
from collections.abc import Callable, Mapping
from pathlib import Path

import pytest
from typer.testing import CliRunner

from exo.cli import app
from exo.fmu import Archive
from exo.systems import closed, ssp, system
from exo.systems.form import SSP_1, SSP_2, Form
from exo.validate import Report, check, child
from exo.validate.ssp import RULES, findings

from broken import systems
from broken.parts import Parts
from broken.systems import MUTANTS, SET, Mutant, good, zipped


def no_fault(path: Path) -> Report:
    """A judge of FMUs that finds nothing: those of the archives written by hand have a description only."""
    return Report(path, (), ())


def judged(files: Mapping[str, bytes], folder: Path) -> tuple[list[str], list[str]]:
    """Findings, as they are printed, and what was left out."""
    path = folder / "system.ssp"
    path.write_bytes(zipped(dict(files)))
    found, skipped = findings(path, no_fault)
    return [str(finding) for finding in found], skipped


def test_a_good_archive_has_no_finding(tmp_path: Path) -> None:
    assert judged(good(), tmp_path) == ([], [])


@pytest.mark.parametrize("mutant", MUTANTS, ids=lambda mutant: mutant.id)
def test_one_broken_thing_is_found_with_place_and_value(mutant: Mutant, tmp_path: Path) -> None:
    files = good()
    mutant.change(files)
    path = tmp_path / "system.ssp"
    path.write_bytes(zipped(files))
    found = [finding for finding in findings(path, no_fault)[0] if finding.rule == mutant.rule]
    assert found
    assert {finding.severity for finding in found} == {RULES[mutant.rule].severity}
    assert any(mutant.where in finding.where and mutant.value in finding.value for finding in found), found
    assert all(finding.expected for finding in found)


def test_each_rule_has_a_broken_archive() -> None:
    assert {mutant.rule for mutant in MUTANTS} == set(RULES)


@pytest.mark.parametrize("form", [SSP_1, SSP_2, Form(inline=True)], ids=["1.0", "2.0", "inline"])
@pytest.mark.parametrize("load", [system.load, closed.load])
@pytest.mark.parametrize("name", system.RECIPES)
def test_this_project_s_archives_have_no_finding(
    name: str, load: Callable[[str], system.System], form: Form, archives: Mapping[str, Archive], tmp_path: Path
) -> None:
    path = ssp.write(system=load(name), archives=archives, folder=tmp_path, form=form)
    assert findings(path, no_fault) == ([], [])


def test_the_fmus_inside_are_judged_as_fmus(archives: Mapping[str, Archive], tmp_path: Path) -> None:
    path = ssp.write(system=system.load("TestbedSystem"), archives=archives, folder=tmp_path)
    report = check(path)
    assert (report.findings, report.skipped) == ((), ())
    with zipfile.ZipFile(path) as files:
        entries = {name: files.read(name) for name in files.namelist()}
    inner = tmp_path / "inner"
    inner.mkdir()
    (inner / "Testbed.fmu").write_bytes(entries["resources/Testbed.fmu"])
    parts = Parts.of(inner / "Testbed.fmu")
    parts.edit("ModelVariables/ScalarVariable[@causality='output']", name="plant q?")
    entries["resources/Testbed.fmu"] = parts.write(inner).read_bytes()
    path.write_bytes(zipped(entries))
    found = check(path, run=False).findings
    assert any(
        finding.rule == "variable-structured" and finding.where.startswith("resources/Testbed.fmu: ")
        for finding in found
    )


def test_an_archive_inside_is_judged_once_and_so_is_one_in_itself(tmp_path: Path) -> None:
    files = good()
    inner = dict(files)
    Mutant("", systems.in_default('stopTime="1.0"', 'stopTime="0.0"'), "", "").change(inner)
    component = '<ssd:Component name="{}" type="application/x-ssp-package" source="resources/inner.ssp"/>'
    both = component.format("a") + component.format("b")
    at = '<ssd:SignalDictionaryReference name="bus"'
    for _ in range(5):
        deeper = dict(files) | {"resources/inner.ssp": zipped(inner)}
        Mutant("", systems.in_default(at, both + at), "", "").change(deeper)
        inner = deeper
    found, skipped = judged(inner, tmp_path)
    assert found == []
    assert [sentence.split(": ")[-1] for sentence in skipped] == ["an archive in 3 archives"]
    shallow = dict(files) | {"resources/inner.ssp": zipped(dict(files) | {"stray.txt": b""})}
    Mutant("", systems.in_default(at, both + at), "", "").change(shallow)
    assert [line.split(": ")[1] for line in judged(shallow, tmp_path)[0]] == ["resources/inner.ssp"]


HOSTILE = {
    "a bomb": lambda files: files.update({SET: b"0" * (1 << 24)}),
    "a path that leaves": lambda files: files.update({"../x.ssv": b""}),
    "entities without end": lambda files: files.update(
        {SET: b'<?xml version="1.0"?><!DOCTYPE a [<!ENTITY b "bb">' + b'<!ENTITY c "&b;&b;">' * 30 + b"]><a>&c;</a>"}
    ),
    "an entity that is a file": lambda files: files.update(
        {SET: b'<?xml version="1.0"?><!DOCTYPE a [<!ENTITY b SYSTEM "file:///etc/passwd">]><a>&b;</a>'}
    ),
    "depth": lambda files: files.update({SET: b"<a>" * 100_000 + b"</a>" * 100_000}),
    "no bytes": lambda files: files.update(dict.fromkeys(files, b"")),
    "noise": lambda files: files.update({name: bytes(range(256)) * 4 for name in files}),
    "a number of many digits": lambda files: files.update(
        {SET: files[SET].replace(b'"7000"', b'"' + b"9" * 100_000 + b'"')}
    ),
    "a dimension beyond memory": lambda files: files.update(
        {systems.DRIVEN: systems.fmu(systems.text("Drive.xml").replace('start="3"', 'start="99999999999"'))}
    ),
    "a description without an FMU's root": lambda files: files.update({systems.MASS: systems.fmu("<a/>")}),
    "an FMU with a document type": lambda files: files.update(
        {systems.MASS: systems.fmu('<!DOCTYPE a [<!ENTITY b "c">]><a/>')}
    ),
    "a URI that is none": lambda files: files.update(
        {systems.DEFAULT: files[systems.DEFAULT].replace(b"resources/Plant.fmu", b"http://[")}
    ),
    "a name of a hundred thousand dots": lambda files: files.update(
        {SET: files[SET].replace(b'"plant.M"', b'"' + b"plant." * 100_000 + b'"')}
    ),
    "control characters in names": lambda files: files.update({"resources/\x1b[2J.ssv": b""}),
}


@pytest.mark.parametrize("attack", HOSTILE)
def test_a_hostile_archive_is_a_finding(attack: str, tmp_path: Path) -> None:
    files = good()
    HOSTILE[attack](files)
    found, _ = judged(files, tmp_path)
    assert found
    assert all(line.isprintable() for line in found)
    assert "root:" not in "".join(found)


def test_every_cut_of_an_archive_is_a_finding(tmp_path: Path) -> None:
    data = zipped(good())
    path = tmp_path / "cut.ssp"
    for length in range(0, len(data), 97):
        path.write_bytes(data[:length])
        found, skipped = findings(path, no_fault)
        assert found, length
        assert skipped == ["all but the archive: it is not safe or not an SSP archive"]


def test_damage_anywhere_in_a_document_ends_no_checker(tmp_path: Path) -> None:
    clean = good()
    for file in (systems.DEFAULT, SET, "resources/names.ssm", "resources/signals.ssb"):
        for at in range(0, len(clean[file]), 29):
            damaged = clean[file][:at] + b'"<' + clean[file][at + 2 :]
            judged(clean | {file: damaged}, tmp_path)
        # Each attribute away in turn, and each element: the schema complains, the other rules go on.
        words = clean[file].decode().split('"')
        for i in range(1, len(words), 2):
            emptied = '"'.join([*words[:i], "", *words[i + 1 :]])
            judged(clean | {file: emptied.encode()}, tmp_path)


def test_the_work_grows_with_the_number_of_connections_and_no_faster(tmp_path: Path) -> None:
    files = good()
    one = '<ssd:Connection startElement="plant" startConnector="q" endElement="nobody{}" endConnector="x"/>'
    many = "".join(one.format(i) for i in range(20_000))
    at = systems.CONNECTION
    Mutant("", systems.in_default(at, at + many), "", "").change(files)
    assert len(judged(files, tmp_path)[0]) == 20_000


def test_the_command_says_what_is_wrong_and_lists_the_rules(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(child, "TIMEOUT_S", 5.0)
    files = good()
    Mutant("", systems.in_default('endConnector="hand"', 'endConnector="arm"'), "", "").change(files)
    path = tmp_path / "system.ssp"
    path.write_bytes(zipped(files))
    answer = CliRunner().invoke(app, ["validate", "--no-load", str(path)])
    assert answer.exit_code == 1
    line = next(line for line in answer.output.splitlines() if "ssp-connection-end" in line)
    assert line.startswith(f"{path}: error: SystemStructure.ssd:")
    assert "connection hand → plant.arm: plant.arm; expected a connector of plant [ssp-connection-end]" in line
    (report,) = json.loads(CliRunner().invoke(app, ["validate", "--no-load", "--json", str(path)]).stdout)
    assert report["failed"]
    gone = CliRunner().invoke(app, ["validate", str(tmp_path / "gone.ssp")])
    assert gone.exit_code == 2
    assert "gone.ssp: no such SSP archive: run `cargo xtask ssp` first" in gone.stderr
    listed = CliRunner().invoke(app, ["validate", "--rules"]).output
    assert all(rule in listed for rule in RULES)


def test_the_documents_list_the_rules() -> None:
    text = (Path(__file__).parents[2] / "docs" / "validate-ssp.md").read_text(encoding="utf-8")
    rows = [line for line in text.splitlines() if line.startswith("| `ssp-")]
    assert rows == [f"| `{rule.id}` | {rule.severity} | {rule.text} |" for rule in RULES.values()]
