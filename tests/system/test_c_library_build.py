"""The C library as a C or C++ program meets it: linked in every way, in both precisions, installed; examples and stack.

`cargo xtask law --prefix target/law/installed` builds what is tested here. What needs a tool that a machine may lack
(a C++ compiler, pkg-config, make) names it and is left out there.
"""

import json
import re
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
INSTALLED = ROOT / "target" / "law" / "installed"
EXAMPLES = ROOT / "fmu" / "c" / "examples"
HOST = ROOT / "tests" / "host"

#: Warnings are errors: a header that warns is turned off by its users, with the warnings.
STRICT = ["-Wall", "-Wextra", "-Wpedantic", "-Werror"]

LANGUAGES = ["-std=c99", "-std=c11", "-std=c++11", "-std=c++17"]

#: What defines the precision of a program, and the library that it links.
PRECISIONS = {"f64": ([], "exo_law"), "f32": (["-DEXO_LAW_F32"], "exo_law_f32")}

#: What the library may ask of a program (xtask/src/law/pack.rs).
ASKED = {"memcpy", "memmove", "memset", "memcmp", "bcmp"}

#: A program with both precisions in one file.
BOTH = """
#include <stdio.h>
#include "exo_law.h"
#include "exo_law_f32.h"
int main(void) {
  static exo_arm_state law;
  static exo_f32_arm_state law_f32;
  exo_arm_parameters parameters;
  exo_f32_arm_parameters parameters_f32;
  exo_arm_inputs in;
  exo_f32_arm_inputs in_f32;
  exo_arm_outputs out;
  exo_f32_arm_outputs out_f32;
  exo_arm_defaults(&parameters);
  exo_f32_arm_defaults(&parameters_f32);
  exo_arm_inputs_defaults(&in);
  exo_f32_arm_inputs_defaults(&in_f32);
  if (exo_arm_init(&law, &parameters, 0) != EXO_STATUS_OK) return 1;
  if (exo_f32_arm_init(&law_f32, &parameters_f32, 0) != EXO_STATUS_OK) return 1;
  in.f_h[2] = 5.0;
  in_f32.f_h[2] = 5.0f;
  for (int tick = 0; tick < 100; tick++) {
    if (exo_arm_tick(&law, &in, &out, 0) != EXO_STATUS_OK) return 1;
    if (exo_f32_arm_tick(&law_f32, &in_f32, &out_f32, 0) != EXO_STATUS_OK) return 1;
  }
  printf("%zu %zu %.17g %.17g\\n", exo_law_real_size(), exo_f32_law_real_size(), out.f_a[2], (double)out_f32.f_a[2]);
  return 0;
}
"""


@pytest.fixture(scope="module", autouse=True)
def installed() -> None:
    """What all tests are about."""
    where = "target/law/installed"
    assert (ROOT / where).is_dir(), f"{where} is missing: run `cargo xtask law --prefix {where}` first"


def tool(name: str) -> str:
    """A program that a machine may lack; the test is then left out."""
    found = shutil.which(name)
    if found is None:
        pytest.skip(f"{name} is not on PATH")
    return found


def run(*words: str | Path, cwd: Path | None = None) -> subprocess.CompletedProcess[str]:
    """Runs a program, whatever its exit code."""
    return subprocess.run([str(word) for word in words], capture_output=True, text=True, check=False, cwd=cwd)


def succeeds(*words: str | Path, cwd: Path | None = None) -> str:
    """What a program prints that must not fail."""
    answer = run(*words, cwd=cwd)
    assert answer.returncode == 0, f"{' '.join(map(str, words))}\n{answer.stdout}{answer.stderr}"
    return answer.stdout


def compiler(language: str) -> list[str]:
    """The compiler of a language, to which any source is one of it."""
    if "++" in language:
        return [tool("c++"), "-x", "c++", language]
    return ["cc", "-x", "c", language]


def library(precision: str) -> Path:
    """The installed archive."""
    return INSTALLED / "lib" / f"lib{PRECISIONS[precision][1]}.a"


def build(*, source: Path, to: Path, precision: str, language: str = "-std=c11", options: tuple[str, ...] = ()) -> Path:
    """Compiles a program and links it with the installed library."""
    define = PRECISIONS[precision][0]
    include = ["-I", str(INSTALLED / "include")]
    words = [*compiler(language), *STRICT, "-O1", *define, *include, *options, str(source)]
    succeeds(*words, "-x", "none", library(precision), "-lm", "-lpthread", "-o", to)
    return to


@pytest.mark.parametrize("precision", PRECISIONS)
def test_an_archive_is_one_object_that_shows_the_laws_functions_only(precision: str) -> None:
    lines = [line.split() for line in succeeds("nm", "-g", library(precision)).splitlines()]
    shown = {words[-1] for words in lines if len(words) == 3}
    needed = {words[-1] for words in lines if len(words) == 2}
    prefix = {"f64": "exo_", "f32": "exo_f32_"}[precision]
    calls = ["defaults", "inputs_defaults", "init", "tune", "tick", "tick_after", "variable"]
    names = {f"exo_{law}_{call}" for law in ("arm", "axis") for call in calls}
    names |= {"exo_law_real_size", "exo_law_version"}
    assert shown == {name.replace("exo_", prefix, 1) for name in names}
    assert needed <= ASKED
    assert len(succeeds("ar", "t", library(precision)).splitlines()) == 1
    # It was 4.7 MB. The law itself has some 0.3 MB of code and constants, the rest says where they are put.
    assert library(precision).stat().st_size < 650_000


def test_both_archives_link_whole_into_a_shared_library_that_leaves_nothing_undefined(tmp_path: Path) -> None:
    shared = tmp_path / "libboth.so"
    whole = ["-Wl,--whole-archive", library("f64"), library("f32"), "-Wl,--no-whole-archive"]
    succeeds("cc", "-shared", "-o", shared, *whole, "-Wl,-z,defs")
    exported = succeeds("nm", "-D", "--defined-only", shared)
    assert "exo_arm_tick" in exported
    assert "exo_f32_arm_tick" in exported


def test_both_archives_link_whole_into_a_program(tmp_path: Path) -> None:
    source = tmp_path / "empty.c"
    source.write_text("int main(void) { return 0; }\n")
    whole = ["-Wl,--whole-archive", library("f64"), library("f32"), "-Wl,--no-whole-archive"]
    succeeds("cc", source, *whole, "-o", tmp_path / "empty")
    succeeds(tmp_path / "empty")


@pytest.mark.parametrize("language", LANGUAGES)
def test_one_program_has_both_precisions(language: str, tmp_path: Path) -> None:
    source = tmp_path / "both.c"
    source.write_text(BOTH)
    program = tmp_path / "both"
    words = [*compiler(language), *STRICT, "-I", str(INSTALLED / "include"), str(source), "-x", "none"]
    succeeds(*words, library("f64"), library("f32"), "-o", program)
    double, single, f_a, f_a_single = map(float, succeeds(program).split())
    assert (double, single) == (8, 4)
    # Single precision keeps f_a within 1e-3 f_max (docs/real-time.md), and is another one.
    assert abs(f_a) > 0.1
    assert 0 < abs(f_a - f_a_single) <= 0.4


def test_a_program_of_one_precision_does_not_link_with_the_library_of_the_other(tmp_path: Path) -> None:
    include = ["-I", INSTALLED / "include"]
    control = EXAMPLES / "control.c"
    wrong = run("cc", *include, control, library("f32"), "-o", tmp_path / "wrong")
    assert wrong.returncode != 0
    assert "exo_arm_tick" in wrong.stderr
    wrong = run("cc", "-DEXO_LAW_F32", *include, control, library("f64"), "-o", tmp_path / "wrong")
    assert wrong.returncode != 0
    assert "exo_f32_arm_tick" in wrong.stderr


@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize("precision", PRECISIONS)
def test_the_control_loop_engages_follows_the_hand_and_stops(precision: str, language: str, tmp_path: Path) -> None:
    program = build(source=EXAMPLES / "control.c", to=tmp_path / "control", precision=precision, language=language)
    *states, lifted = succeeds(program, cwd=tmp_path).splitlines()
    assert [line.split(": ")[1] for line in states] == ["init", "ready", "engaged", "soft stop", "off"]
    # 5 N against D_n = 20 N.s/m for a second: at most 0.25 m, less while the nominal mass gains speed.
    millimetres = float(lifted.removeprefix("the hand has lifted it by ").removesuffix(" mm"))
    assert 200 < millimetres < 260
    assert list(tmp_path.iterdir()) == [program]


def test_a_refused_tick_of_the_control_loop_is_named_and_ends_it(tmp_path: Path) -> None:
    source = tmp_path / "control.c"
    text = (EXAMPLES / "control.c").read_text()
    spoilt = "in.hold = tick == 500 ? 7 : 0;\n    in.heartbeat = tick;"
    source.write_text(text.replace("in.heartbeat = tick;", spoilt))
    answer = run(build(source=source, to=tmp_path / "control", precision="f64"))
    assert answer.returncode == 1
    assert answer.stderr == "exo_arm_tick: status 4: hold[0] = 7: expected 0 (false) or 1 (true)\n"


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("K[99999999]", "replay: K[99999999]: expected an index from 1 to 3"),
        ("K[0]", "replay: K[0]: expected an index from 1 to 3"),
        ("K[4]", "replay: K[4]: expected an index from 1 to 3"),
        ("K[18446744073709551617]", "replay: K[18446744073709551617]: expected an index from 1 to 3"),
        ("K[2", "replay: K[2: expected an index from 1 to 3"),
        ("K", "replay: expected an index, as in K[2]: K"),
        ("no_such", "replay: the library has no variable of this name: no_such"),
    ],
)
def test_replay_refuses_an_element_that_is_not_there_by_name(name: str, message: str, tmp_path: Path) -> None:
    vectors = tmp_path / "vectors.txt"
    vectors.write_text(f"arm\nparameter {name} 100\ninputs q[1]\noutputs p[1]\n0 0.5\n")
    answer = run(ROOT / "target" / "law" / "f64" / "replay", vectors)
    assert (answer.returncode, answer.stderr) == (1, message + "\n")


@pytest.mark.parametrize("precision", PRECISIONS)
def test_pkg_config_says_what_a_program_needs_also_after_the_folder_has_moved(precision: str, tmp_path: Path) -> None:
    moved = tmp_path / "moved"
    shutil.copytree(INSTALLED, moved)
    folder = f"--define-variable=pcfiledir={moved}/lib/pkgconfig"
    name = PRECISIONS[precision][1]
    package = moved / "lib" / "pkgconfig" / f"{name}.pc"
    words = [tool("pkg-config"), folder, "--cflags", "--libs", str(package)]
    flags = succeeds(*words).split()
    assert str(INSTALLED) not in " ".join(flags)
    succeeds("cc", EXAMPLES / "control.c", *flags, "-o", tmp_path / "control")
    assert succeeds(tmp_path / "control").splitlines()[-1].startswith("the hand has lifted")
    assert succeeds(tool("pkg-config"), "--modversion", str(package)).strip() == version()


def test_cmake_finds_the_package_and_builds_with_each_target(tmp_path: Path) -> None:
    cmake = Path(sys.executable).with_name("cmake")
    if not cmake.is_file():
        cmake = Path(tool("cmake"))
    tool("make")
    (tmp_path / "both.c").write_text(BOTH)
    (tmp_path / "CMakeLists.txt").write_text(f"""
cmake_minimum_required(VERSION 3.10)
project(uses_the_law C)
find_package(exo_law 0.1 REQUIRED)
foreach(precision f64 f32)
  add_executable(${{precision}} {EXAMPLES}/control.c)
  target_link_libraries(${{precision}} exo_law::${{precision}})
endforeach()
add_executable(both both.c)
target_link_libraries(both exo_law::both)
""")
    built = tmp_path / "build"
    make = ["-G", "Unix Makefiles", "-S", tmp_path, f"-DCMAKE_PREFIX_PATH={INSTALLED}"]
    succeeds(cmake, *make, "-B", built)
    succeeds(cmake, "--build", built)
    for precision in PRECISIONS:
        assert "engaged" in succeeds(built / precision)
    assert succeeds(built / "both").startswith("8 4 ")
    # A version that is not there is not found: the next one may differ before 1.0.
    lists = (tmp_path / "CMakeLists.txt").read_text()
    (tmp_path / "CMakeLists.txt").write_text(lists.replace("exo_law 0.1 ", "exo_law 0.2 "))
    newer = run(cmake, *make, "-B", tmp_path / "again")
    assert newer.returncode != 0
    assert f"version: {version()}" in newer.stderr


def test_licences_and_bill_of_materials_are_installed() -> None:
    bill = json.loads((INSTALLED / "share" / "sbom" / "exo_law.cdx.json").read_text())
    assert (bill["bomFormat"], bill["metadata"]["component"]["name"]) == ("CycloneDX", "exo-law")
    assert bill["metadata"]["component"]["version"] == version()
    licences = INSTALLED / "share" / "licenses" / "exo_law"
    for component in bill["components"]:
        # What has no purl is this project's own.
        assert "purl" not in component or any((licences / component["bom-ref"]).iterdir()), component["name"]
    assert {"libm", "nalgebra", "rust-std", "arm-law", "arm-law-f32"} <= {part["name"] for part in bill["components"]}
    overview = (licences / "license.txt").read_text()
    assert "MIT OR Apache-2.0" in overview
    assert "libm-" in overview
    assert (licences / "LICENSE-MIT.txt").is_file()
    assert (licences / "LICENSE-APACHE.txt").is_file()


def test_no_installed_file_names_this_machine() -> None:
    for path in INSTALLED.rglob("*"):
        assert path.is_dir() or str(ROOT).encode() not in path.read_bytes(), path


def version() -> str:
    """The version of the workspace."""
    cargo = tomllib.loads((ROOT / "Cargo.toml").read_text())
    return str(cargo["workspace"]["package"]["version"])


def documented() -> dict[str, dict[str, int]]:
    """The table of stacks in docs/real-time.md: bytes by precision and function."""
    text = (ROOT / "docs" / "real-time.md").read_text()
    table = re.search(r"\| stack, bytes \| f64 \| f32 \| .*?\n\n", text, re.DOTALL)
    assert table, "docs/real-time.md has no table `stack, bytes | f64 | f32`"
    stacks: dict[str, dict[str, int]] = {precision: {} for precision in PRECISIONS}
    for line in table.group().splitlines()[2:]:
        if cells := [cell.strip() for cell in line.split("|")[1:-1]]:
            for precision, bytes_ in zip(PRECISIONS, cells[1:3], strict=True):
                stacks[precision][cells[0].strip("`")] = int(bytes_.replace(" ", ""))
    return stacks


@pytest.mark.parametrize("precision", PRECISIONS)
def test_no_function_takes_more_stack_than_is_documented(precision: str, tmp_path: Path) -> None:
    program = build(
        source=HOST / "law.c",
        to=tmp_path / "law",
        precision=precision,
        options=("-DMEASURE_STACK=65536",),
    )
    lines = [line.split() for line in succeeds(program).splitlines() if line.startswith("exo_")]
    measured = {name: int(bytes_) for name, bytes_ in lines}
    stacks = documented()[precision]
    assert measured.keys() == stacks.keys()
    for name, bytes_ in measured.items():
        # Another compiler lays out frames otherwise: a tenth is left to it. Far less is out of date.
        assert 0.6 * stacks[name] <= bytes_ <= 1.1 * stacks[name], f"{name}: {bytes_} bytes"


@pytest.mark.parametrize("precision", PRECISIONS)
def test_ticks_run_in_a_thread_with_the_smallest_stack_that_the_system_gives(precision: str, tmp_path: Path) -> None:
    program = build(source=HOST / "thread.c", to=tmp_path / "thread", precision=precision)
    assert succeeds(program) == "all ticks in 16384 bytes\n"
