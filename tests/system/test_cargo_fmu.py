"""`cargo fmu` where something is not as it should be, and on a package of this repository."""

import os
import re
import subprocess
import zipfile
from collections.abc import Callable
from pathlib import Path

import pytest

from cargo_fmu import ROOT, cargo_fmu

MODEL = f'fmu-export = {{ path = "{ROOT.as_posix()}/modelDescription/export" }}'
#: What the package of a crate has beside what cargo adds: files and folders.
CRATE = {
    "README.md",
    "LICENSE-MIT",
    "LICENSE-APACHE",
    "src",
    "tests",
    "examples",
    "template",
    "model.png",
    "wheels.lock",
}
CRATE |= {".cargo_vcs_info.json", "Cargo.lock", "Cargo.toml", "Cargo.toml.orig"}


def package(
    folder: Path, name: str, *, dependency: str = MODEL, lib: str = 'crate-type = ["cdylib"]', more: str = ""
) -> Path:
    """A package that need not compile."""
    here = folder / name
    (here / "src").mkdir(parents=True)
    (here / "src" / "lib.rs").write_text("", encoding="utf-8")
    head = f'[package]\nname = "{name}"\nversion = "0.1.0"\nedition = "2024"'
    manifest = f"{head}\n[lib]\n{lib}\n[dependencies]\n{dependency}\n{more}"
    (here / "Cargo.toml").write_text(manifest, encoding="utf-8")
    return here


def refused(*words: str, cwd: Path) -> str:
    """What a command says that fails: nothing but the error, and no traceback."""
    run = cargo_fmu(*words, cwd=cwd)
    assert run.returncode == 1, run.stdout + run.stderr
    assert "panicked" not in run.stderr
    return run.stderr[run.stderr.index("error:") :]


def test_of_several_models_in_a_workspace_one_must_be_named(tmp_path: Path) -> None:
    for name in ("one", "two"):
        package(tmp_path, name)
    package(tmp_path, "beside", dependency="", lib="")
    (tmp_path / "Cargo.toml").write_text(
        '[workspace]\nresolver = "3"\nmembers = ["*"]\nexclude = ["target"]\n', encoding="utf-8"
    )
    said = refused("build", "--offline", cwd=tmp_path)
    assert "expected --package with one of one, two" in said
    said = refused("build", "--offline", "--package", "three", cwd=tmp_path)
    assert "--package three: expected a package of the workspace" in said
    assert "beside, one, two" in said
    assert "beside does not depend on fmu-export" in refused("build", "--offline", "-p", "beside", cwd=tmp_path)
    assert "--example x: expected one of library one of one" in refused(
        "build", "--offline", "--manifest-path", str(tmp_path / "one" / "Cargo.toml"), "--example", "x", cwd=ROOT
    )


@pytest.mark.parametrize(
    ("made", "said"),
    [
        ({"lib": 'crate-type = ["rlib"]'}, "plant builds no shared library: expected in"),
        ({"dependency": ""}, "plant does not depend on fmu-export: expected it among the dependencies in"),
        (
            {"more": "[package.metadata.fmu]\nlogo = 'x'\n"},
            "[package.metadata.fmu]: logo: expected one of the keys author, copyright, licenses, icon, guide,",
        ),
        ({"more": "[package.metadata.fmu]\nicon = 'Cargo.toml'\n"}, 'icon = "Cargo.toml": expected a PNG file'),
        ({"more": "[package.metadata.fmu]\nfmi = ['4.0']\n"}, 'fmi = ["4.0"]: expected ["2.0"], ["3.0"] or both'),
        ({"more": "[package.metadata.fmu]\nfmi = []\n"}, 'fmi = []: expected ["2.0"], ["3.0"] or both'),
        (
            {"more": "[package.metadata.fmu]\nguide = 'no.html'\n"},
            'guide = "no.html": expected a path beside Cargo.toml',
        ),
        ({"more": "[package.metadata.fmu]\npicture = 'Cargo.toml'\n"}, "expected a file that begins with <svg"),
        ({"more": "[package.metadata.fmu]\nauthor = 3\n"}, "author = 3: expected a text"),
        ({"more": "[package.metadata.fmu]\nicon = ['a.png']\n"}, 'icon = ["a.png"]: expected a text'),
        ({"more": "[package.metadata.fmu]\nlicenses = 'LICENSE'\n"}, 'licenses = "LICENSE": expected a list of paths'),
        ({"more": "[package.metadata.fmu]\nlicenses = ['a', 2]\n"}, 'licenses = ["a",2]: expected a list of paths'),
        ({"more": "[package.metadata.fmu]\nfmi = '3.0'\n"}, 'fmi = "3.0": expected ["2.0"], ["3.0"] or both'),
        ({"more": "[package.metadata.fmu]\nfmi = [3.0]\n"}, 'fmi = [3.0]: expected ["2.0"], ["3.0"] or both'),
        ({"more": f"[package.metadata.fmu]\nresources = [{'1,' * 1000}]\n"}, "1,1…: expected a text"),
        (
            {"more": "[package.metadata]\nfmu = 3\n"},
            "[package.metadata.fmu] = 3: expected a table with some of the keys",
        ),
        ({"more": "[[package.metadata.fmu]]\nauthor = 'x'\n"}, "expected a table with some of the keys author,"),
        ({"more": "[package.metadata.FMU]\nauthor = 'x'\n"}, "[package.metadata.FMU]: expected [package.metadata.fmu]"),
        (
            {"more": "[package.metadata.cargo-fmu]\nauthor = 'x'\n"},
            "[package.metadata.cargo-fmu]: expected [package.metadata.fmu]",
        ),
        (
            {"more": '[package.metadata.fmu]\nauthor = "a\\u0007b"\n'},
            'author = "a\\u{7}b": expected one line without control characters',
        ),
        (
            {"more": '[package.metadata.fmu]\ncopyright = "a\\nb"\n'},
            'copyright = "a\\nb": expected one line without control characters',
        ),
        (
            {"more": "[package.metadata.fmu]\nlicenses = ['Cargo.toml', 'src/../Cargo.toml']\n"},
            "licence texts Cargo.toml and Cargo.toml: expected file names that differ",
        ),
        (
            {"more": "[package.metadata.fmu]\nresources = 'Cargo.toml'\n"},
            'resources = "Cargo.toml": expected a folder (',
        ),
        ({"more": "[package.metadata.fmu]\nextra = 'none'\n"}, 'extra = "none": expected a folder ('),
    ],
)
def test_what_a_package_says_wrong_is_named(tmp_path: Path, made: dict[str, str], said: str) -> None:
    assert said in refused("build", "--offline", cwd=package(tmp_path, "plant", **made))


def loop(folder: Path) -> None:
    """Two links that lead up: each folder has 2ⁿ paths of n parts."""
    (folder / "maps").mkdir()
    for name in ("again", "back"):
        (folder / "maps" / name).symlink_to(folder)


def out(folder: Path) -> None:
    """A link to the package, in which the folder lies."""
    (folder / "package").symlink_to(folder.parent)


def pipe(folder: Path) -> None:
    """Nobody writes into it: reading would wait for ever."""
    os.mkfifo(folder / "pipe")


def endless(folder: Path) -> None:
    """A link to a file without end."""
    (folder / "zeros").symlink_to("/dev/zero")


def nowhere(folder: Path) -> None:
    """A link to what is not there."""
    (folder / "lost").symlink_to("gone")


def two_spellings(folder: Path) -> None:
    """One file where case does not count."""
    for name in ("Map.csv", "map.csv"):
        (folder / name).write_text("", encoding="utf-8")


def huge(folder: Path) -> None:
    """A file of 2 GB, of which none is on the disk."""
    with (folder / "huge").open("wb") as file:
        file.truncate(2 << 30)


@pytest.mark.parametrize(
    ("made", "said"),
    [
        (
            loop,
            r"a folder \(\S*/data/maps/(again|back) leads back to \S*/data: expected links that lead to no folder",
        ),
        (out, r"a folder \(\S*/data/package/data leads back to \S*/data: expected links"),
        (pipe, r"\S*/data/pipe is neither a file nor a folder: expected files and folders"),
        (endless, r"\S*/data/zeros is neither a file nor a folder"),
        (nowhere, r"\S*/data/lost: No such file"),
        (two_spellings, r"resources/map.csv beside resources/Map.csv: expected names that differ by more than case"),
        (lambda f: (f / "größe.csv").write_bytes(b""), r"data/größe.csv\": expected a name of printable ASCII"),
        (lambda f: (f / "a\\b").write_bytes(b""), r"expected a name of printable ASCII without a backslash"),
        (lambda f: (f / "a\nb").write_bytes(b""), r"data/a\\nb\": expected a name of printable ASCII"),
        (
            lambda f: Path(os.fsdecode(os.fsencode(f) + b"/\xff")).write_bytes(b""),
            r"expected a name of printable ASCII",
        ),
        (huge, r"data/huge has 2147483648 bytes: expected at most 1073741824"),
    ],
)
def test_a_folder_that_cannot_go_into_an_archive_is_named(
    tmp_path: Path, made: Callable[[Path], None], said: str
) -> None:
    here = package(tmp_path, "plant", more="[package.metadata.fmu]\nresources = 'data'\n")
    (here / "data").mkdir()
    made(here / "data")
    assert re.search(
        r'resources = "data": expected ' + (said if said.startswith("a folder") else ".*" + said),
        refused("build", "--offline", cwd=here),
    )


def test_outside_of_a_package_and_on_what_is_no_fmu_it_says_what_was_expected(tmp_path: Path) -> None:
    assert "no Cargo.toml in" in refused("build", cwd=tmp_path)
    nothing = tmp_path / "Cargo.tom"
    assert f"--manifest-path {nothing}: expected the path of a Cargo.toml" in refused(
        "build", "--manifest-path", str(nothing), cwd=tmp_path
    )
    (tmp_path / "x.fmu").write_bytes(b"no zip")
    assert "expected an FMU, a zip archive with modelDescription.xml" in refused("describe", "x.fmu", cwd=tmp_path)
    assert "platform win32: expected one of linux64, win64" in refused("dist", "--platform", "win32", cwd=tmp_path)


def test_a_new_package_in_a_workspace_that_does_not_name_it_is_told(tmp_path: Path) -> None:
    (tmp_path / "Cargo.toml").write_text("[workspace]\nmembers = []\n", encoding="utf-8")
    said = refused("new", "plant", "--sdk", str(ROOT), cwd=tmp_path)
    assert "add it to `members`" in said
    assert "plant: is there already" in refused("new", "plant", cwd=tmp_path)


def test_the_interface_from_the_library_is_that_from_the_declaration(tmp_path: Path, fmu_dir: Path) -> None:
    """The same model, packed by this project, whose packer is linked with it, and by a stranger's way."""
    run = cargo_fmu(
        "build",
        "--offline",
        "--locked",
        "--package",
        "fmu-export",
        "--example",
        "integrator",
        "--out",
        str(tmp_path),
        cwd=ROOT,
    )
    assert run.returncode == 0, run.stderr
    with (
        zipfile.ZipFile(fmu_dir / "test" / "integrator.fmu") as ours,
        zipfile.ZipFile(tmp_path / "Integrator.fmu") as theirs,
    ):
        assert set(ours.namelist()) == set(theirs.namelist())
        # The libraries tell of the commit, which may have changed since ours was built.
        names = [name for name in ours.namelist() if not name.startswith("binaries/")]
        differ = {name for name in names if ours.read(name) != theirs.read(name)}
        xml = [re.sub(rb' copyright="[^"]*"', b"", archive.read("modelDescription.xml")) for archive in (ours, theirs)]
    assert xml[0] == xml[1]
    # What names the holder of the copyright, which fmu-export's Cargo.toml does not.
    assert differ == {"modelDescription.xml", "documentation/index.html", "documentation/licenses/license.txt"}


def test_each_crate_of_the_sdk_can_be_packaged_with_page_and_licences(tmp_path: Path) -> None:
    crates = ["fmu-declaration-derive", "fmu-declaration", "fmu-archive", "fmu-export", "cargo-fmu"]
    command = ["cargo", "package", "--quiet", "--no-verify", "--offline", "--locked", "--allow-dirty"]
    command += ["--target-dir", str(tmp_path)]
    for crate in crates:
        command += ["--package", crate]
    subprocess.run(command, cwd=ROOT, check=True, capture_output=True, timeout=300)
    for crate in crates:
        (packed,) = (tmp_path / "package").glob(f"{crate}-[0-9]*.crate")
        listed = subprocess.run(
            ["tar", "tzf", packed], check=True, capture_output=True, encoding="utf-8"
        ).stdout.split()
        files = {name.split("/", 1)[1] for name in listed}
        assert {"Cargo.toml", "README.md", "LICENSE-MIT", "LICENSE-APACHE", "src/lib.rs"} <= files
        # Those of the project beside the crate's stay out.
        assert {name.split("/", 1)[0] for name in files} <= CRATE, crate
