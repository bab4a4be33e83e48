"""What `exo validate` must not hold against an FMU of another tool, and what must not keep it from going on."""

import re
from pathlib import Path

import fmpy
import pytest

from exo.validate import binaries, check
from exo.validate.binaries import FUNCTIONS
from exo.validate.documentation import decoded
from exo.validate.load import host_platforms, missing
from exo.validate.versions import VERSIONS, Version

from broken import macho
from broken.parts import INDEX, PNG, TERMINALS, XML, Parts, moving3, plain

FOLDER = "binaries/linux64"


def found(parts: Parts, folder: Path, **options: bool) -> list[str]:
    """Rules that are broken."""
    report = check(parts.write(folder), **options)
    return [finding.rule for finding in report.findings]


@pytest.fixture
def unparsed(monkeypatch: pytest.MonkeyPatch) -> None:
    """Leaves the library alone, which takes most of the time."""
    monkeypatch.setattr(binaries, "findings", lambda *_, **__: iter(()))


@pytest.mark.usefixtures("unparsed")
@pytest.mark.parametrize(
    "page",
    [
        '<meta charset="iso-8859-1"><p>größer'.encode("latin-1"),
        '<meta http-equiv="Content-Type" content="text/html; charset=windows-1252"><p>größer – €'.encode("cp1252"),
        '<?xml version="1.0" encoding="ISO-8859-1"?><html><p>größer</p></html>'.encode("latin-1"),
        "\ufeff<p>größer".encode(),
        "<p>größer".encode("utf-16"),
        "<p>größer".encode(),
    ],
)
def test_a_page_in_the_charset_that_it_declares_is_right(page: bytes, tmp_path: Path) -> None:
    parts = plain(tmp_path)
    parts.entries[INDEX] = page
    assert found(parts, tmp_path, run=False) == []
    text, problem = decoded(page)
    assert "größer" in text
    assert problem == ""


@pytest.mark.usefixtures("unparsed")
def test_a_page_in_no_known_charset_is_a_warning_and_its_links_are_judged(tmp_path: Path) -> None:
    parts = plain(tmp_path)
    parts.entries[INDEX] = '<p>größer<a href="none.html">'.encode("latin-1")
    report = check(parts.write(tmp_path), run=False)
    assert [(f.rule, f.severity) for f in report.findings] == [
        ("documentation-encoding", "warning"),
        ("documentation-link", "error"),
    ]


def test_a_mach_o_library_without_export_trie_exports_by_its_symbol_table(tmp_path: Path) -> None:
    parts = plain(tmp_path)
    parts.entries["binaries/darwin64/Plain.dylib"] = macho.library(sorted(FUNCTIONS))
    assert found(parts, tmp_path) == []
    parts.entries["binaries/darwin64/Plain.dylib"] = macho.library(sorted(FUNCTIONS - {"fmi2DoStep"}))
    report = check(parts.write(tmp_path))
    (finding,) = report.findings
    assert (finding.rule, finding.value) == ("binary-exports", "without fmi2DoStep")
    # It is loaded all the same: the library of this machine is another one.
    assert report.skipped == ()


@pytest.mark.parametrize("version", VERSIONS.values(), ids=lambda version: version.name)
def test_the_functions_of_a_version_are_those_of_the_standard_s_header(version: Version) -> None:
    header = Path(fmpy.__file__).parent / "c-code" / f"{version.prefix}Functions.h"
    declared = re.findall(r"^\s*FMI\d_Export \w+TYPE\s+(fmi\d\w+);", header.read_text(encoding="utf-8"), re.MULTILINE)
    known = [name for names in version.functions.values() for name in names]
    assert sorted(known) == sorted(declared)


def test_a_library_may_serve_both_versions(tmp_path: Path) -> None:
    assert found(moving3(tmp_path, "-DTWO"), tmp_path, run=False) == []


@pytest.mark.usefixtures("unparsed")
def test_terminals_of_an_fmi_2_fmu_are_judged_too(tmp_path: Path) -> None:
    """FMI 2.0 refers to FMI 3.0 for them; their version is that of the schema."""
    parts = plain(tmp_path)
    terminals = moving3(tmp_path).entries[TERMINALS].replace(b'"x"', b'"y"').replace(b'"x_mm"', b'"y"')
    parts.entries |= {TERMINALS: terminals, "terminalsAndIcons/flange.png": PNG}
    assert found(parts, tmp_path, run=False) == []
    parts.replace(TERMINALS, b'"y"', b'"z"')
    assert found(parts, tmp_path, run=False) == ["terminals-variable"]


def test_a_platform_of_fmi_3_that_is_not_known_by_its_file_is_no_finding(tmp_path: Path) -> None:
    parts = moving3(tmp_path)
    parts.entries["binaries/riscv64-linux/Moving.so"] = b"x"
    assert found(parts, tmp_path, run=False) == []


def test_an_array_may_have_one_start_value_for_all_elements_and_a_size_of_its_own(tmp_path: Path) -> None:
    parts = moving3(tmp_path)
    parts.edit("ModelVariables/Float64[@name='x']/Dimension", remove=("valueReference",), start="2")
    parts.edit("ModelVariables/Float64[@name='x']", start="0")
    assert found(parts, tmp_path) == []


def test_an_empty_folder_beside_a_good_library_is_as_if_it_were_not_there(tmp_path: Path) -> None:
    parts = plain(tmp_path)
    parts.add("binaries/win64/")
    assert found(parts, tmp_path, run=False) == []
    assert [finding.rule for finding in check(parts.write(tmp_path), run=False, platforms=("win64",)).findings] == [
        "binary-wanted"
    ]
    parts.entries["binaries/win64/readme.txt"] = b"x"
    assert found(parts, tmp_path, run=False) == ["binary-name"]


@pytest.mark.usefixtures("unparsed")
@pytest.mark.parametrize(
    ("attributes", "told"),
    [
        ('causality="local" variability="discrete" initial="exact"', False),
        ('causality="local" variability="constant"', True),
        ('causality="parameter" variability="fixed"', True),
    ],
)
def test_a_start_value_is_compared_where_an_importer_relies_on_it(attributes: str, told: bool, tmp_path: Path) -> None:
    parts = plain(tmp_path)
    # Its reference is that of the output, whose value is 0.
    parts.insert(
        "ModelVariables",
        f'<ScalarVariable name="x" valueReference="1" description="d" {attributes}>'
        '<Real unit="rad" start="7"/></ScalarVariable>',
    )
    assert ("load-start" in found(parts, tmp_path)) == told


def test_a_library_that_needs_what_this_machine_lacks_is_not_judged(tmp_path: Path) -> None:
    (tmp_path / "gone").mkdir()
    plain(tmp_path / "gone")
    (tmp_path / "gone" / "Plain.so").rename(tmp_path / "gone" / "libgone.so.1")
    parts = plain(tmp_path, "-Wl,--no-as-needed", f"-L{tmp_path / 'gone'}", "-l:libgone.so.1")
    report = check(parts.write(tmp_path))
    assert report.findings == ()
    assert report.skipped == ("loading: binaries/linux64/Plain.so needs libgone.so.1, which this machine lacks",)
    assert not report.failed(strict=True)


@pytest.mark.parametrize(
    ("sentence", "what"),
    [
        ("libgone.so.1: cannot open shared object file: No such file or directory", "libgone.so.1"),
        ("/lib/x86_64-linux-gnu/libc.so.6: version `GLIBC_2.99' not found (required by /tmp/x/Plain.so)", "GLIBC_2.99"),
        (
            "Error loading shared library libgone.so.1: No such file or directory (needed by /tmp/x/Plain.so)",
            "libgone.so.1",
        ),
        (
            "dlopen(/tmp/x/Plain.dylib, 0x0006): Library not loaded: @rpath/libgone.1.dylib\n  Referenced from: …",
            "@rpath/libgone.1.dylib",
        ),
        ("/tmp/x/Plain.so: undefined symbol: nowhere", None),
        ("/tmp/x/Plain.so: file too short", None),
    ],
)
def test_the_loader_s_sentence_names_what_is_missing(sentence: str, what: str | None) -> None:
    assert missing(sentence) == what


@pytest.mark.usefixtures("unparsed")
def test_backslashes_do_not_hide_what_else_is_wrong(tmp_path: Path) -> None:
    """All of it is there under names with forward slashes: the library is run, too."""
    parts = plain(tmp_path, "-DWARNS")
    parts.edit("ModelVariables/ScalarVariable", remove=("description",))
    for name in list(parts.entries):
        if "/" in name:
            parts.add(name.replace("/", "\\"), parts.entries.pop(name))
    report = check(parts.write(tmp_path))
    assert {finding.rule for finding in report.findings} == {"archive-backslash", "variable-description", "load-status"}
    assert report.skipped == ()


@pytest.mark.usefixtures("unparsed")
def test_neither_do_letters_beyond_ascii_in_a_name(tmp_path: Path) -> None:
    parts = plain(tmp_path)
    parts.edit("ModelVariables/ScalarVariable", remove=("description",))
    parts.add("resources/größe.csv", b"x")
    assert found(parts, tmp_path) == ["archive-ascii", "variable-description"]


@pytest.mark.usefixtures("unparsed")
@pytest.mark.parametrize("encoding", ["ISO-8859-1", "windows-1252", "UTF-16"])
def test_neither_does_another_encoding(encoding: str, tmp_path: Path) -> None:
    parts = plain(tmp_path)
    parts.edit("ModelVariables/ScalarVariable", description="größer")
    parts.edit("ModelVariables/ScalarVariable[@name='y']", description="")
    text = parts.entries[XML].decode()
    assert "encoding='UTF-8'" in text
    parts.entries[XML] = text.replace("encoding='UTF-8'", f"encoding='{encoding}'").encode(encoding)
    assert found(parts, tmp_path) == ["xml-encoding", "variable-description"]


@pytest.mark.usefixtures("unparsed")
def test_an_input_may_be_set_twice_where_there_is_model_exchange(tmp_path: Path) -> None:
    parts = plain(tmp_path)
    parts.edit("ModelVariables/ScalarVariable", canHandleMultipleSetPerTimeInstant="false")
    assert found(parts, tmp_path, run=False) == ["variable-multiple-set"]
    parts.replace(XML, "<CoSimulation", '<ModelExchange modelIdentifier="Plain"/><CoSimulation')
    assert "variable-multiple-set" not in found(parts, tmp_path, run=False)


def test_this_machine_s_library_is_among_the_platforms() -> None:
    assert FOLDER.removeprefix("binaries/") in host_platforms()
