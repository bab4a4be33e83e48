"""What this project's archives carry as references: recorded anew, valid, small, and replayable by fmpy alone."""

import csv
import io
import json
import zipfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import fmpy
import fmpy.ssp
import numpy as np
import pytest
from fmpy.ssp.ssd import read_ssv
from lxml import etree
from typer.testing import CliRunner

from exo.cli import app
from exo.fmu import Archive
from exo.master import simulate
from exo.references import experiments, manifest, recipes, record, sets, write
from exo.references.names import FOLDER, MANIFEST
from exo.references.record import Experiment
from exo.references.replay import replay

from conftest import NAMES

HERE = Path(__file__).parent
COMMITTED = HERE.parents[1] / "modelDescription" / "references"
SSP_SCHEMA = Path(fmpy.ssp.__file__).parent / "schema" / "SystemStructureParameterValues.xsd"
#: A stimulus has nine digits: 1e-10 rad of a joint are 1e-7 rad/s of its speed, on which K acts.
OF_STIMULI = 1e-4


@pytest.fixture(scope="module")
def files(archives: Mapping[str, Archive]) -> dict[str, bytes]:
    """All files, recorded now."""
    return write.contents(archives)


@pytest.fixture(scope="module")
def recorded(archives: Mapping[str, Archive]) -> dict[tuple[str, str], Experiment]:
    """All experiments by name and archive."""
    runs = recipes.load().runs
    return {(name, one.archive): one for name, run in runs.items() for one in record.record(name, run, archives)}


def inside(fmu: Path) -> dict[str, bytes]:
    """The archive's references by path."""
    with zipfile.ZipFile(fmu) as archive:
        return {name: archive.read(name) for name in archive.namelist() if name.startswith(f"{FOLDER}/")}


def rng(name: str) -> Any:
    """A schema of this folder."""
    return etree.RelaxNG(etree.parse(HERE / "schemas" / f"{name}.rng"))


def test_the_committed_references_are_what_the_fmus_give(files: dict[str, bytes]) -> None:
    assert write.differences(files, COMMITTED) == []


def test_two_recordings_are_the_same_bytes(files: dict[str, bytes], archives: Mapping[str, Archive]) -> None:
    assert write.contents(archives) == files


def test_what_is_missing_changed_or_left_over_is_told_and_blessed(files: dict[str, bytes], tmp_path: Path) -> None:
    names = list(files)
    write.write(files, tmp_path)
    (tmp_path / names[0]).unlink()
    (tmp_path / names[1]).write_bytes(b"x")
    (tmp_path / "old.csv").write_bytes(b"x")
    assert sorted(write.differences(files, tmp_path)) == sorted([names[0], names[1], "old.csv"])
    assert sorted(write.write(files, tmp_path)) == sorted([names[0], names[1], "old.csv"])
    assert write.differences(files, tmp_path) == []


def test_each_archive_has_the_committed_files_at_their_paths(fmu: Path) -> None:
    folder = COMMITTED / fmu.stem
    committed = {path.relative_to(folder).as_posix(): path for path in folder.rglob("*") if path.is_file()}
    with zipfile.ZipFile(fmu) as archive:
        assert {name: archive.read(name) for name in committed} == {n: p.read_bytes() for n, p in committed.items()}
        packed = sum(archive.getinfo(name).compress_size for name in committed)
        assert b'href="fmi-ls-ref.html"' in archive.read("documentation/index.html")
    assert set(inside(fmu)) <= set(committed)
    assert packed < 100_000


def test_every_fmu_has_an_experiment_and_all_together_are_small(files: dict[str, bytes]) -> None:
    assert {name.split("/")[0] for name in files} == set(NAMES)
    for name in NAMES:
        read, found = experiments.read(files[f"{name}/{FOLDER}/smoke-tests.exp"], "x.exp")
        assert found == []
        assert read
    assert sum(map(len, files.values())) < 1_500_000


def test_manifest_and_experiments_obey_the_layered_standard(fmu: Path) -> None:
    found = inside(fmu)
    for name, schema in ((MANIFEST, rng("manifest")), ("smoke-tests.exp", rng("experiments"))):
        document = etree.fromstring(found[f"{FOLDER}/{name}"])
        assert schema.validate(document), schema.error_log
        document[0].set("colour", "red")
        assert not schema.validate(document)


def test_the_manifest_names_every_file_and_no_other(fmu: Path) -> None:
    found = inside(fmu)
    where = f"{FOLDER}/{MANIFEST}"
    related, problems = manifest.read(found[where], where)
    assert problems == []
    paths = [one.path for one in related]
    assert len(set(paths)) == len(paths)
    assert set(paths) == (set(found) - {where}) | {"documentation/fmi-ls-ref.html"}


def test_parameter_sets_obey_the_schema_of_ssp_and_set_what_the_cases_set(
    fmu: Path, recorded: dict[tuple[str, str], Experiment]
) -> None:
    schema = etree.XMLSchema(etree.parse(SSP_SCHEMA))
    found = inside(fmu)
    mine = [one for (_, archive), one in recorded.items() if archive == fmu.name]
    wanted = sets.of(fmu.name, mine)
    assert {f"{FOLDER}/{one.source}" for one in wanted} == {name for name in found if name.endswith(".ssv")}
    for one in wanted:
        document = etree.fromstring(found[f"{FOLDER}/{one.source}"])
        assert schema.validate(document), schema.error_log
        names = [parameter.get("name") for parameter in document.iter("{*}Parameter")]
        assert names == list(one.values)


def test_the_fmu_alone_does_what_it_did_in_the_coupled_run(
    archives: Mapping[str, Archive], recorded: dict[tuple[str, str], Experiment]
) -> None:
    for name, run in recipes.load().runs.items():
        whole = simulate(plan=record.coupled(run), archives=archives)
        for component in run.record:
            one = recorded[name, record.coupled(run).components[component]]
            for output, column in one.results.items():
                # A sampled output stands beside the tick that made it, which is one before the time when it is read.
                sampled = archives[one.archive].variable(output).variability == "discrete"
                rows = np.rint(one.time / whole.step).astype(int) - int(sampled)
                inner = (rows >= 0) & (rows < len(whole.time))
                there = whole[f"{component}.{output}"].astype(float)[rows[inner]]
                limit = OF_STIMULI * max(float(np.abs(column).max()), 1e-9)
                assert np.abs(there - column[inner]).max() <= limit, (name, output)


def test_the_runs_show_what_they_are_for(recorded: dict[tuple[str, str], Experiment]) -> None:
    """An experiment in which nothing happens would replay well on a broken FMU."""
    plant, sticks = recorded["wall", "Testbed.fmu"], recorded["wall_standard", "TestbedController.fmu"]
    assert plant.results["q"].max() > 0.3  # the wall
    assert plant.results["q"][-1] < 0.2
    assert sticks.stimuli["q"][-1] > 0.299
    assert sticks.stimuli["tau_h"][-1] < -4.0
    assert {0.0, 1.0} == set(recorded["wall", "TestbedController.fmu"].results["saturated"])
    table = recorded["table", "ExoskeletonArm.fmu"].results
    assert table["f_e[3]"].max() > 100.0
    assert table["contact"][-1] == 0.0
    for name, archive in (("payload", "ExoskeletonArm.fmu"), ("both_arms", "ExoskeletonArms.fmu")):
        assert recorded[name, archive].results["attached"][-1] == 1.0
    assert recorded["payload", "ExoskeletonArm.fmu"].results["p[3]"][-1] > -0.2
    assert np.ptp(recorded["hand", "HumanOperator.fmu"].results["f_hand[1]"]) > 10.0


def test_a_replay_meets_every_result_to_a_thousandth_of_the_tolerance(fmu: Path) -> None:
    answer = replay(fmu)
    assert answer.findings == []
    assert answer.skipped == []
    assert {one.experiment for one in answer.outcomes} == {
        name.removesuffix("-ref.csv").split("/")[-1] for name in inside(fmu) if name.endswith("-ref.csv")
    }
    # Twelve digits are written, of a tolerance of six; fmpy's step is a difference of times and not the step itself.
    assert all(one.difference <= 1e-3 * one.allowed for one in answer.outcomes)


@pytest.mark.parametrize("name", NAMES)
def test_the_twin_of_fmi_3_meets_the_same_results_with_the_same_files(name: str, fmu_dir: Path) -> None:
    """Its vectors are told element by element, as the scalars of FMI 2.0."""
    path = fmu_dir / "fmi3" / f"{name}.fmu"
    assert inside(path) == inside(fmu_dir / f"{name}.fmu")
    answer = replay(path)
    assert [str(finding) for finding in answer.findings] == []
    assert answer.skipped == []
    assert len(answer.outcomes) == len(replay(fmu_dir / f"{name}.fmu").outcomes)
    assert all(one.difference <= 1e-3 * one.allowed for one in answer.outcomes)


@pytest.mark.parametrize("name", ["Testbed", "TestbedController", "ExoskeletonArm"])
def test_an_importer_that_knows_fmpy_alone_gets_the_results(name: str, fmu_dir: Path, tmp_path: Path) -> None:
    """fmpy reads the CSV files and the parameter set, sets the inputs in its own way and simulates."""
    path = fmu_dir / f"{name}.fmu"
    read, _ = experiments.read(inside(path)[f"{FOLDER}/smoke-tests.exp"], f"{FOLDER}/smoke-tests.exp")
    for one in read:
        assert one.stimuli is not None
        assert one.references is not None
        for file in (one.stimuli, one.references):
            (tmp_path / Path(str(file.path)).name).write_bytes(inside(path)[str(file.path)])
        parameters = read_ssv(path, resource=one.parameters.path).parameters if one.parameters else []
        signals = fmpy.read_csv(tmp_path / Path(str(one.stimuli.path)).name)
        results = fmpy.read_csv(tmp_path / Path(str(one.references.path)).name)
        outputs = [name for name in results.dtype.names if name != "time"]
        got = fmpy.simulate_fmu(
            path,
            start_time=one.start,
            stop_time=one.stop,
            output_interval=one.step,
            input=signals,
            output=outputs,
            start_values={parameter.name: parameter.value for parameter in parameters},
        )
        rows = np.searchsorted(got["time"], results["time"] - 1e-9)
        for output in outputs:
            apart = np.abs(got[output][rows].astype(float) - results[output]).max()
            assert apart <= one.tolerance * max(np.abs(results[output]).max(), 1e-6), (one.name, output)


def test_an_fmu_that_computes_otherwise_is_found_by_its_own_references(fmu_dir: Path, tmp_path: Path) -> None:
    """The controller's references in front of a controller with another nominal mass: 6 kg and not 5."""
    with zipfile.ZipFile(fmu_dir / "TestbedController.fmu") as good:
        entries = {name: good.read(name) for name in good.namelist()}
    name = f"{FOLDER}/parameters/wall-passive_bounded_5_0.5.ssv"
    entries[name] = entries[name].replace(b'value="5.0"', b'value="6.0"')
    with zipfile.ZipFile(tmp_path / "x.fmu", "w") as other:
        for entry, data in entries.items():
            other.writestr(entry, data)
    answer = replay(tmp_path / "x.fmu")
    assert {finding.rule for finding in answer.findings} == {"reference-result"}
    assert {one.experiment for one in answer.outcomes if not one.good} == {"wall"}
    assert any("q_n differs by" in finding.value for finding in answer.findings)


def test_the_requirements_name_the_paper_s_and_the_judged_numbers(files: dict[str, bytes]) -> None:
    text = files[f"TestbedController/{FOLDER}/requirements.md"].decode()
    assert [f"| `{key}` |" in text for key in ("operator", "environment", "model")] == [True] * 3
    assert (
        "| wall | passive_bounded_5_0.5 | release delay: first q < wall − 1 mm after 20.25 s | 0.332 ± 0.03 | s |"
        in text
    )
    assert "The paper asks nothing of this FMU" in files[f"Testbed/{FOLDER}/requirements.md"].decode()
    for name in NAMES:
        rows = [line for line in files[f"{name}/{FOLDER}/requirements.md"].decode().splitlines() if line[:1] == "|"]
        assert len(rows) >= 4, name


def test_a_table_has_its_times_in_full_and_its_numbers_short(files: dict[str, bytes]) -> None:
    text = files[f"Testbed/{FOLDER}/wall-in.csv"].decode()
    rows = list(csv.reader(io.StringIO(text)))
    assert "\r" not in text
    assert [float(row[0]) for row in rows[1:]] == [k * 0.002 for k in range(1200)]
    assert max(len(cell) for row in rows[1:] for cell in row[1:]) <= len("-1.23456789e-05")


def test_the_command_tells_each_output_and_fails_where_one_differs(fmu_dir: Path, tmp_path: Path) -> None:
    path = fmu_dir / "Testbed.fmu"
    good = CliRunner().invoke(app, ["references", str(path)])
    assert good.exit_code == 0, good.output
    assert "energy.loss_impact" in good.output
    told = json.loads(CliRunner().invoke(app, ["references", "--json", str(path)]).output)
    assert {one["experiment"] for one in told[0]["outputs"]} == {"free_motion", "wall"}
    assert all(one["good"] for one in told[0]["outputs"])
    validated = CliRunner().invoke(app, ["validate", "--strict", str(path)])
    assert "experiment wall: 7 outputs replayed;" in validated.output
    with zipfile.ZipFile(path) as archive, zipfile.ZipFile(tmp_path / "x.fmu", "w") as other:
        for name in archive.namelist():
            data = archive.read(name)
            other.writestr(name, data.replace(b"\n0.04,", b"\n0.04,9") if name.endswith("wall-ref.csv") else data)
    for command in ("references", "validate"):
        bad = CliRunner().invoke(app, [command, str(tmp_path / "x.fmu")])
        assert bad.exit_code == 1, bad.output
        assert "wall: q differs by" in bad.output
    assert CliRunner().invoke(app, ["references", str(tmp_path / "none.fmu")]).exit_code == 2


def test_recording_into_an_outdated_folder_fails_until_it_is_blessed(fmu_dir: Path, tmp_path: Path) -> None:
    command = ["record", str(tmp_path), "--fmu-dir", str(fmu_dir)]
    old = CliRunner().invoke(app, command)
    assert old.exit_code == 1
    assert "out of date" in old.output
    assert CliRunner().invoke(app, [*command, "--bless"]).exit_code == 0
    assert CliRunner().invoke(app, command).exit_code == 0


def test_an_fmu_with_references_whose_description_cannot_be_read_is_no_good_one(fmu_dir: Path, tmp_path: Path) -> None:
    with zipfile.ZipFile(fmu_dir / "Testbed.fmu") as good, zipfile.ZipFile(tmp_path / "bad.fmu", "w") as bad:
        for one in good.infolist():
            bad.writestr(one, b"" if one.filename == "modelDescription.xml" else good.read(one))
    answer = CliRunner().invoke(app, ["references", str(tmp_path / "bad.fmu")])
    assert answer.exit_code == 2
    assert "bad.fmu: modelDescription.xml: cannot be read; `exo validate` says what is wrong" in answer.output


@pytest.mark.parametrize("there", [(), ("ArmController", "ExoskeletonArm")])
def test_recording_without_an_fmu_names_it_and_the_command(
    there: tuple[str, ...], fmu_dir: Path, tmp_path: Path
) -> None:
    built = tmp_path / "built"
    built.mkdir()
    for name in there:
        (built / f"{name}.fmu").symlink_to(fmu_dir / f"{name}.fmu")
    answer = CliRunner().invoke(app, ["record", str(tmp_path / "references"), "--fmu-dir", str(built), "--bless"])
    assert answer.exit_code == 2
    missing = "ExoskeletonArms" if there else "ArmController"
    assert answer.stderr == f"exo: {built / missing}.fmu: no such FMU: run `cargo xtask fmu` first\n"
    assert not (tmp_path / "references").exists()
