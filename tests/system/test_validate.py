"""`exo validate` on good FMUs, on FMUs with one thing broken, on foreign ones and on rubbish."""

import json
import os
import random
import re
from collections.abc import Mapping
from pathlib import Path

import fmpy
import pytest
from typer.testing import CliRunner

from exo import validate
from exo.cli import app
from exo.validate import RULES, behaviour, binaries, check, child, problems
from exo.validate.archive import Contents
from exo.validate.si import meaning, written

from broken.moving import DYNAMIC
from broken.mutants import ARM, MUTANTS, TC, Mutant
from broken.mutants3 import MUTANTS3
from broken.parts import COMPILED, XML, Parts, plain
from broken.references import PLAYED, REFERENCES


@pytest.fixture(scope="module")
def bases(fmu_dir: Path) -> Mapping[str, Path]:
    return {name: fmu_dir / f"{name}.fmu" for name in (TC, ARM)}


def test_a_good_fmu_has_no_finding(fmu: Path) -> None:
    report = check(fmu)
    assert [str(finding) for finding in report.findings] == []
    assert report.skipped == ()
    assert not report.failed(strict=True)


@pytest.mark.parametrize("name", COMPILED)
def test_neither_has_a_good_fmu_that_is_not_ours(name: str, tmp_path: Path) -> None:
    report = check(COMPILED[name](tmp_path).write(tmp_path), max_glibc="99.0")
    assert (report.findings, report.skipped, report.verdicts) == ((), (), ())


@pytest.mark.parametrize("mutant", [*MUTANTS, *MUTANTS3, *REFERENCES], ids=lambda mutant: mutant.id)
def test_one_broken_thing_is_found(
    mutant: Mutant, tmp_path: Path, bases: Mapping[str, Path], monkeypatch: pytest.MonkeyPatch
) -> None:
    dynamic = mutant.rule.startswith("run-")
    if not mutant.rule.startswith(("binary-", "load-")):
        # Its library is a good one: a second for each of a hundred FMUs.
        monkeypatch.setattr(binaries, "findings", lambda *_, **__: iter(()))
    if dynamic:
        monkeypatch.setattr(behaviour, "TRIALS", [one for one in behaviour.TRIALS if one.rule.id == mutant.rule])
    parts = compiled(mutant, tmp_path) if mutant.base in COMPILED else Parts.of(bases[mutant.base])
    mutant.change(parts)
    path = parts.write(tmp_path)
    run = dynamic or mutant in PLAYED or mutant.rule.startswith("load-")
    report = check(path, run=run, dynamic=dynamic, **mutant.options)
    found = {finding.rule for finding in report.findings}
    assert mutant.rule in found, report
    (severity,) = {finding.severity for finding in report.findings if finding.rule == mutant.rule}
    assert severity == RULES[mutant.rule].severity
    assert report.failed(strict=True)
    assert [verdict.verdict for verdict in report.verdicts] == (["failed"] if dynamic else [])
    if mutant.fmpy is not None:
        # Where the description cannot be read, check does not ask fmpy.
        # variable-structured is fmpy's rule, judged faster.
        asked = problems(path) if mutant.rule.startswith("xml-") else found & {"fmpy", "variable-structured"}
        assert bool(asked) == mutant.fmpy, report


#: Good libraries by base, compiled once.
GOOD: dict[str, Parts] = {}


def compiled(mutant: Mutant, folder: Path) -> Parts:
    """The FMU in C; where no macro breaks it, a copy of one that is there already."""
    if mutant.macros:
        return COMPILED[mutant.base](folder, *mutant.macros)
    if mutant.base not in GOOD:
        GOOD[mutant.base] = COMPILED[mutant.base](folder)
    return Parts(dict(GOOD[mutant.base].entries))


def test_each_rule_has_a_broken_fmu() -> None:
    assert {mutant.rule for mutant in (*MUTANTS, *MUTANTS3, *REFERENCES)} == set(RULES)
    assert {mutant.rule for mutant in MUTANTS3} >= {rule.id for rule in RULES.values() if rule.only == "3.0"}
    assert {rule for rule, *_ in DYNAMIC} == {trial.rule.id for trial in behaviour.TRIALS}


def test_a_library_that_hangs_is_found(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(binaries, "findings", lambda *_, **__: iter(()))
    monkeypatch.setattr(child, "TIMEOUT_S", 10.0)
    report = check(plain(tmp_path, "-DHANG").write(tmp_path))
    (finding,) = report.findings
    assert finding.rule == "load-crash"
    assert finding.value == "fmi2DoStep: no answer within 10 s"


def fmpy_library(pattern: str) -> bytes:
    """A library of another machine that comes with fmpy."""
    (path,) = Path(fmpy.__file__).parent.glob(pattern)
    return path.read_bytes()


@pytest.mark.parametrize(
    ("platform", "file", "pattern"),
    [
        ("win64", "Plain.dll", "logging/win64/logging.dll"),
        ("darwin64", "Plain.dylib", "logging/darwin64/logging.dylib"),
        ("aarch64-darwin", "Plain.dylib", "sundials/aarch64-darwin/sundials_cvode.dylib"),
    ],
)
def test_libraries_of_other_systems_are_read(platform: str, file: str, pattern: str, tmp_path: Path) -> None:
    """They are known for what they are; that they are no FMUs shows in their exports."""
    parts = plain(tmp_path)
    parts.entries[f"binaries/{platform}/{file}"] = fmpy_library(pattern)
    rules = {finding.rule for finding in check(parts.write(tmp_path)).findings}
    assert "binary-exports" in rules
    assert "binary-format" not in rules
    other = next(name for name in ("aarch64-windows", "x86_64-linux") if name != platform)
    parts.entries[f"binaries/{other}/Plain{'.dll' if 'windows' in other else '.so'}"] = fmpy_library(pattern)
    assert "binary-format" in {finding.rule for finding in check(parts.write(tmp_path), run=False).findings}


def test_an_unsafe_archive_is_not_extracted(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def extract(*_: object) -> None:
        raise AssertionError

    monkeypatch.setattr(Contents, "extract", extract)
    parts = plain(tmp_path)
    parts.add("../evil", b"x")
    report = check(parts.write(tmp_path))
    assert [finding.rule for finding in report.findings] == ["archive-path"]
    assert report.skipped


def test_a_terminal_code_in_a_name_is_not_printed(tmp_path: Path) -> None:
    parts = plain(tmp_path)
    parts.add("resources/\x1b[2J", b"x")
    assert all("\x1b" not in str(finding) for finding in check(parts.write(tmp_path)).findings)


def test_no_damage_ends_the_checker(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Random bytes of the archive, then random pieces of the description; fmpy is left out for time."""
    monkeypatch.setattr(validate, "problems", lambda _: [])
    monkeypatch.setattr(binaries, "findings", lambda *_, **__: iter(()))
    chance = random.Random(5)
    good = plain(tmp_path)
    whole = good.write(tmp_path).read_bytes()
    for _ in range(300):
        damaged = bytearray(whole)
        for _ in range(chance.choice((1, 4, 40))):
            # The directory at the end decides most.
            damaged[-chance.randrange(1, 600)] = chance.randrange(256)
        check(write(tmp_path, bytes(damaged)), run=False)
    found = set()
    # Values of attributes at odd places, what is between them at even ones.
    pieces = re.split(r"(\"[^\"]*\")", good.entries[XML].decode())
    odd = ['""', '"-1"', '"NaN"', '"1e999"', f'"{"9" * 5000}"', '"\u0663"', '"a/(b"', "", '"<"']
    for _ in range(300):
        changed = pieces.copy()
        for _ in range(chance.choice((1, 3))):
            changed[2 * chance.randrange(len(pieces) // 2) + 1] = chance.choice([*odd, *pieces[1::2]])
        parts = Parts({**good.entries, XML: "".join(changed).encode()})
        found |= {finding.rule for finding in check(parts.write(tmp_path), run=False).findings}
    assert len(found) > 20, found


def write(folder: Path, data: bytes) -> Path:
    """A file of these bytes."""
    path = folder / "damaged.fmu"
    path.write_bytes(data)
    return path


@pytest.mark.parametrize(
    ("name", "meant"),
    [
        ("N.m.s/rad", "kg m2 s-1 rad-1"),
        ("kg.m2", "kg m2"),
        ("J/(kg.K)", "m2 s-2 K-1"),
        ("m^-1", "m-1"),
        ("1/s", "s-1"),
        ("mm", "m"),
        ("Wb", "kg m2 s-2 A-1"),
        ("1", "1"),
    ],
)
def test_a_unit_s_name_says_its_exponents(name: str, meant: str) -> None:
    said = meaning(name)
    assert said is not None
    assert written(said.exponents) == meant


@pytest.mark.parametrize("name", ["ft", "pH", "PS", "J/kg.K", "m/", "", "degC/s", "widgets", "N m"])
def test_a_name_that_can_be_misread_says_nothing(name: str) -> None:
    assert meaning(name) is None


def test_the_command_prints_json_and_the_rules(fmu_dir: Path, tmp_path: Path) -> None:
    parts = plain(tmp_path)
    parts.entries["readme.txt"] = b"x"
    warned = parts.write(tmp_path)
    answer = CliRunner().invoke(app, ["validate", "--json", "--no-load", str(fmu_dir / "Testbed.fmu"), str(warned)])
    assert answer.exit_code == 0, answer.output
    good, other = json.loads(answer.output)
    assert (good["failed"], good["findings"], good["skipped"]) == (False, [], ["loading: not wanted"])
    assert good["verdicts"] == []
    (finding,) = other["findings"]
    assert set(finding) == {"rule", "severity", "where", "value", "expected"}
    assert (finding["rule"], finding["severity"], finding["where"]) == ("layout-root", "warning", "readme.txt")
    assert CliRunner().invoke(app, ["validate", "--strict", "--no-load", str(warned)]).exit_code == 1
    assert CliRunner().invoke(app, ["validate"]).exit_code == 2
    assert CliRunner().invoke(app, ["validate", "--max-glibc", "new", str(warned)]).exit_code == 2
    listed = CliRunner().invoke(app, ["validate", "--rules"], env={"COLUMNS": "200"})
    assert all(rule in listed.output for rule in RULES)


def test_the_documents_list_the_rules() -> None:
    page = (Path(__file__).parents[2] / "docs" / "validate.md").read_text(encoding="utf-8")
    rows = re.findall(r"^\| `([a-z-]+)` \| (error|warning) \| (.*?) \| (.*) \|$", page, re.MULTILINE)
    assert rows == [(rule.id, rule.severity, rule.only or "2.0, 3.0", rule.text) for rule in RULES.values()]


@pytest.mark.parametrize("name", ["folder", "folder.fmu", "folder.ssp"])
def test_what_is_there_and_no_file_is_told_so(name: str, tmp_path: Path) -> None:
    (tmp_path / name).mkdir()
    answer = CliRunner().invoke(app, ["validate", str(tmp_path / name)])
    said = f"exo: {tmp_path / name}: is no file; expected an FMU or an SSP archive\n"
    assert (answer.exit_code, answer.stderr) == (2, said)


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="no named pipes here")
def test_a_pipe_is_no_file_and_nobody_waits_for_it(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe.fmu")
    answer = CliRunner().invoke(app, ["validate", str(tmp_path / "pipe.fmu")])
    assert (answer.exit_code, "pipe.fmu: is no file; expected an FMU or an SSP archive" in answer.stderr) == (2, True)


def test_the_rules_as_json_say_what_the_documents_list() -> None:
    answer = CliRunner().invoke(app, ["validate", "--rules", "--json"])
    assert answer.exit_code == 0, answer.output
    rows = [(row["rule"], row["severity"], row["fmi"], row["text"]) for row in json.loads(answer.stdout)]
    docs = Path(__file__).parents[2] / "docs"
    page, of_systems = ((docs / name).read_text(encoding="utf-8") for name in ("validate.md", "validate-ssp.md"))
    listed = re.findall(r"^\| `([a-z-]+)` \| (error|warning) \| (.*?) \| (.*) \|$", page, re.MULTILINE)
    listed += re.findall(r"^\| `(ssp-[a-z-]+)` \| (error|warning) \|() (.*) \|$", of_systems, re.MULTILINE)
    assert rows == [(rule, severity, fmi or "SSP", text) for rule, severity, fmi, text in listed]
