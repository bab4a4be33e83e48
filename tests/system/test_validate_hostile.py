"""`exo validate` and FMUs that mean harm, are damaged or huge: a finding each, in bounded time, and nothing stays."""

import cProfile
import os
import pstats
import random
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import pytest
from fmpy.model_description import ModelDescription, ModelVariable
from fmpy.validation import validate_model_description

from exo.errors import FmuError
from exo.validate import Report, binaries, check, child, naming
from exo.validate.documentation import Page

from broken.large import large
from broken.parts import INDEX, XML, plain


@pytest.fixture(autouse=True)
def temporary(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The folder for extractions, a test's own."""
    folder = tmp_path / "temporary"
    folder.mkdir()
    monkeypatch.setattr(tempfile, "tempdir", str(folder))
    return folder


@pytest.fixture
def only_loading(monkeypatch: pytest.MonkeyPatch) -> None:
    """Leaves the library unparsed, as if it had passed."""
    monkeypatch.setattr(binaries, "findings", lambda *_, **__: iter(()))


def rules(report: Report) -> set[str]:
    """The rules that are broken."""
    return {finding.rule for finding in report.findings}


@pytest.mark.parametrize(
    ("macro", "ending"),
    [
        ("-DEXIT=0", "fmi2DoStep: ended with exit code 0 before the run was over"),
        ("-DEXIT=7", "fmi2DoStep: ended with exit code 7"),
        ("-DSIGNAL=SIGKILL", "fmi2DoStep: ended by SIGKILL"),
        ("-DSIGNAL=SIGBUS", "fmi2DoStep: ended by SIGBUS"),
        ("-DSIGNAL=40", "fmi2DoStep: ended by signal 40"),
    ],
)
@pytest.mark.usefixtures("only_loading")
def test_however_a_library_ends_its_process_it_is_found_and_nothing_stays(
    macro: str, ending: str, tmp_path: Path, temporary: Path
) -> None:
    (finding,) = check(plain(tmp_path, macro).write(tmp_path)).findings
    assert (finding.rule, finding.value) == ("load-crash", ending)
    assert list(temporary.iterdir()) == []


@pytest.mark.parametrize("share", [0.02, 0.3, 0.6, 0.9])
def test_a_cut_library_is_found(share: float, tmp_path: Path, temporary: Path) -> None:
    parts = plain(tmp_path)
    whole = parts.entries[parts.library]
    parts.entries[parts.library] = whole[: int(share * len(whole))]
    report = check(parts.write(tmp_path))
    # The last tenth are names of sections, which no loader reads.
    assert rules(report) == ({"binary-format"} if share < 0.9 else set()), report
    assert list(temporary.iterdir()) == []


@pytest.mark.usefixtures("only_loading")
def test_a_cut_library_that_is_loaded_ends_the_child_only(tmp_path: Path, temporary: Path) -> None:
    """Pages of a mapped file beyond its end are SIGBUS, here at the first write of a relocation."""
    parts = plain(tmp_path)
    whole = parts.entries[parts.library]
    ended = set()
    for size in range(4096, len(whole) - 1024, 1024):
        parts.entries[parts.library] = whole[:size]
        ended |= {finding.value for finding in check(parts.write(tmp_path)).findings}
    assert any("SIGBUS" in value or "SIGSEGV" in value for value in ended), ended
    assert list(temporary.iterdir()) == []


@pytest.mark.usefixtures("only_loading")
def test_the_output_of_a_library_is_cut(tmp_path: Path) -> None:
    """40 MB."""
    path = plain(tmp_path, "-DFLOOD=40000").write(tmp_path)
    answers: list[child.Answer] = []
    run = child.run
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(child, "run", lambda task: answers.append(run(task)) or answers[-1])
        report = check(path)
    assert rules(report) == {"load-streams"}
    (answer,) = answers
    assert len(answer.output) < child.OUTPUT_LIMIT + 100
    assert answer.output.endswith(f"(cut after {child.OUTPUT_LIMIT} bytes)")


@pytest.mark.usefixtures("only_loading")
def test_a_process_that_a_library_starts_ends_with_the_run(tmp_path: Path) -> None:
    (finding,) = check(plain(tmp_path, "-DFORK").write(tmp_path)).findings
    assert finding.rule == "load-streams"
    assert ended(int(finding.value.strip("wrote '")))


def ended(process: int) -> bool:
    """Whether a process is gone, or dead and not yet fetched by its parent."""
    for _ in range(100):
        try:
            stat = Path(f"/proc/{process}/stat").read_text(encoding="ascii")
        except FileNotFoundError:
            return True
        if stat.rsplit(")", 1)[1].split()[0] == "Z":
            return True
        time.sleep(0.05)
    return False


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGINT, signal.SIGHUP])
def test_who_ends_the_checker_leaves_neither_files_nor_processes(
    number: signal.Signals, tmp_path: Path, temporary: Path
) -> None:
    path = plain(tmp_path, "-DHANG").write(tmp_path)
    # A shell's background jobs ignore SIGINT, those of nohup SIGHUP, and so would the checker if the tests are one.
    heard = "import signal as s; s.signal(s.SIGINT, s.default_int_handler); s.signal(s.SIGHUP, s.SIG_DFL)"
    command = [sys.executable, "-c", f"{heard}; from exo.cli import app; app()", "validate", str(path)]
    checker = subprocess.Popen(
        command, env={**os.environ, "TMPDIR": str(temporary)}, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
    )
    try:
        until = time.monotonic() + 120.0
        while not any('"fmi2DoStep"' in file.read_text() for file in temporary.glob("*/facts.jsonl")):
            assert time.monotonic() < until
            assert checker.poll() is None
            time.sleep(0.05)
        children = Path(f"/proc/{checker.pid}/task/{checker.pid}/children").read_text(encoding="ascii").split()
        assert children
        checker.send_signal(number)
        assert checker.wait(60.0) != 0
    finally:
        checker.kill()
        checker.wait()
    assert list(temporary.iterdir()) == []
    assert all(ended(int(process)) for process in children)


@pytest.mark.parametrize("identifier", ["../../../Evil", "../../Evil", "../linux64/Evil", "./Evil"])
def test_a_model_identifier_leads_to_no_library_elsewhere(identifier: str, tmp_path: Path, temporary: Path) -> None:
    mark = tmp_path / "loaded"
    evil = plain(tmp_path, f'-DMARK="{mark}"')
    library = evil.entries.pop(evil.library)
    # Beside the archive's folder, in it and in its binaries.
    (temporary / "Evil.so").write_bytes(library)
    evil.entries |= {"Evil.so": library, "binaries/linux64/Evil.so": library}
    evil.edit("CoSimulation", modelIdentifier=identifier)
    report = check(evil.write(tmp_path))
    assert not mark.exists()
    assert {"head-model-identifier", "binary-name"} <= rules(report)
    assert report.skipped == ("loading: modelIdentifier is no C identifier",)
    evil.edit("CoSimulation", modelIdentifier="Evil")
    check(evil.write(tmp_path))
    assert mark.exists()


def test_a_full_disk_is_one_sentence(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def full(_: Path, __: bytes) -> int:
        raise OSError(28, "No space left on device")

    path = plain(tmp_path).write(tmp_path)
    monkeypatch.setattr(Path, "write_bytes", full)
    with pytest.raises(FmuError, match=r"cannot be extracted into .*No space left"):
        check(path)


@pytest.mark.parametrize("name", ["resources", "documentation", "binaries", "binaries/linux64", "licenses"])
def test_a_file_where_a_folder_is_meant_ends_no_checker(name: str, tmp_path: Path) -> None:
    parts = plain(tmp_path)
    for inside in [entry for entry in parts.entries if entry.startswith(f"{name}/")]:
        del parts.entries[inside]
    parts.entries[name] = b"x"
    assert rules(check(parts.write(tmp_path)))


@pytest.mark.parametrize("name", ["binaries/linux64/Plain.so", INDEX, XML])
def test_a_folder_where_a_file_is_meant_ends_no_checker(name: str, tmp_path: Path) -> None:
    parts = plain(tmp_path)
    del parts.entries[name]
    parts.entries[f"{name}/x"] = b"x"
    assert rules(check(parts.write(tmp_path)))


@pytest.mark.usefixtures("only_loading")
def test_the_work_grows_with_the_number_of_variables_and_no_faster(tmp_path: Path) -> None:
    """Calls are counted: 100 000 variables took hours with 46 000 calls for each name."""

    def calls(size: int) -> int:
        path = large(plain(tmp_path), size).write(tmp_path)
        with cProfile.Profile() as profile:
            report = check(path, run=False)
        # All rules were asked, fmpy's among them.
        assert rules(report) == {"variable-array"}, report
        return int(pstats.Stats(profile).total_calls)  # type: ignore[attr-defined]

    few, many = calls(1000), calls(4000)
    assert many < 4.2 * few
    assert many < 1000 * 4000


def test_a_page_of_elements_that_never_end_takes_linear_time() -> None:
    """Both in one run: 16 times as much text takes 16 times as long, not 256 times; 60 kB took 87 s."""

    def seconds(copies: int) -> float:
        before = time.process_time()
        Page.of("<a " * copies)
        return time.process_time() - before

    assert seconds(20_000 * 16) < 64 * max(min(seconds(20_000) for _ in range(5)), 1e-4)


def test_a_link_is_found_in_whatever_surrounds_it(tmp_path: Path) -> None:
    parts = plain(tmp_path)
    parts.entries[INDEX] = b"<a " * 10 + b"<div>" * 1000 + b"<!-- <a href=one.html> --><A HREF = two.html >"
    found = [finding.value for finding in check(parts.write(tmp_path), run=False).findings]
    assert found == ["two.html"]


def test_structured_names_are_those_of_fmpy_s_grammar() -> None:
    """An oracle for the expression. Backslashes are left out, as fmpy reads them otherwise than the standard."""
    chance = random.Random(7)
    parts = ["a", "_b", "C9", "x[1]", "y[2,33]", "'q r'", "'[.(,'[4]"]
    odd = ["", ".", "1", "[]", "[a]", "[1", "'", "''", "der(", ")", ",2)", " ", "-", "é", "x"]
    names = {"der(x)", "der(a.b[1],2)", "der(a.b[1],-2)"}
    for _ in range(60):
        legal_name = ".".join(chance.choices(parts, k=chance.randrange(1, 4)))
        at = chance.randrange(len(legal_name) + 1)
        names |= {legal_name, f"der({legal_name})", legal_name[:at] + chance.choice(odd) + legal_name[at + 1 :]}
    agreed = {True: 0, False: 0}
    for name in names:
        legal = naming.NAME.fullmatch(name) is not None
        description = ModelDescription(fmiVersion="1.0", variableNamingConvention="structured")
        description.modelVariables.append(ModelVariable(name=name, valueReference=0, type="Real"))
        problems = validate_model_description(description, validate_variable_names=True)
        assert legal == (problems == []), (name, problems)
        agreed[legal] += 1
    assert min(agreed.values()) > 30, agreed


@pytest.mark.parametrize("name", [r"'it\'s'", r"'a\\b'.x", r"'\n'"])
def test_a_quoted_name_has_escapes(name: str) -> None:
    assert naming.NAME.fullmatch(name)
    assert not naming.NAME.fullmatch(name.replace("\\", "\\z", 1))


def test_links_and_files_are_not_searched_one_in_the_other(tmp_path: Path) -> None:
    """The archive's directory is read once, and a page's links ask a table."""
    parts = plain(tmp_path)
    parts.entries[INDEX] = "".join(f'<a href="NONE{i}.txt">x</a>' for i in range(2000)).encode()
    parts.entries |= {f"documentation/none{i}.html": b"x" for i in range(2000)}
    with cProfile.Profile() as profile:
        report = check(parts.write(tmp_path), run=False)
    assert sum(finding.rule == "documentation-link" for finding in report.findings) == 2000
    assert pstats.Stats(profile).total_calls < 2_000_000  # type: ignore[attr-defined]


def test_damage_anywhere_in_the_library_ends_no_checker(tmp_path: Path, temporary: Path) -> None:
    """Random bytes of headers and tables, parsed and loaded."""
    chance = random.Random(11)
    parts = plain(tmp_path)
    whole = parts.entries[parts.library]
    found = set()
    for _ in range(10):
        damaged = bytearray(whole)
        for _ in range(chance.choice((1, 4, 40))):
            damaged[chance.randrange(64, 2048) if chance.random() < 0.7 else chance.randrange(len(whole))] = (
                chance.randrange(256)
            )
        parts.entries[parts.library] = bytes(damaged)
        found |= rules(check(parts.write(tmp_path)))
    assert found & {"binary-format", "load-crash", "load-library"}, found
    assert list(temporary.iterdir()) == []
