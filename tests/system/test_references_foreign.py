"""References of FMUs that are not ours: FMI 2.0 and 3.0 in C, every construct of the standard, and rubbish."""

import random
import subprocess
from collections.abc import Mapping
from pathlib import Path

import pytest

from exo.references import experiments, manifest, series, variables
from exo.references.names import DESCRIPTION, FMI_LS, FOLDER, MANIFEST
from exo.references.player import Stimulus
from exo.references.replay import Replay, replay

from broken.parts import XML, Parts, plain
from broken.references import FILES, PLAYED, TABLES

HERE = Path(__file__).parent
WHERE = f"{FOLDER}/{MANIFEST}"
HEAD = f"""<?xml version="1.0" encoding="UTF-8"?>
<fmiReferences xmlns:fmi-ls="{FMI_LS}" fmi-ls:fmi-ls-name="org.fmi-standard.fmi-ls-ref"
    fmi-ls:fmi-ls-version="1.0.0-beta.1" fmi-ls:fmi-ls-description="{DESCRIPTION}">
"""
SMOKE = """<Related type="application/x-ma-hs-experiments" source="tests.exp" role="experiment"/>"""
#: Every construct of the standard's own example and more: roles with and without more, labels, annotations, both names
#: of the experiments' type, addresses that are absolute, that leave the folder and that are escaped.
EVERYTHING = f"""{HEAD}
  <!-- a comment -->
  <Related type="text/modelica" source="modelica/plain.mo" role="model" description="Source">
    <Annotations><Annotation type="org.example"><e:seen xmlns:e="org.example" by="me"/></Annotation></Annotations>
  </Related>
  <Related type="application/x-ssp-parameter-set" source="base%20set.ssv" role="parameter" description="Base">
    <Label name="variant:base" description="The base variant"/><Label name="os:any"/>
  </Related>
  <Related type="application/x-ma-ls-experiments" source="smoke.exp" role="experiment" description="Smoke tests"/>
  <Related type="application/x-ma-hs-experiments" source="new.exp" role="experiment/validation"/>
  <Related source="../../documentation/index.html" role="document"/>
  <Related source="https://example.org/state.bin" role="serialized-state/x86_64-linux"/>
  <Related source="any.bin" role="other"/>
</fmiReferences>"""
OLD = """<Experiments name="Smoke Tests" description="As the format was">
  <Experiment name="Test1" description="steady" startTime="0.0" stopTime="1.0" stepSize="0.1" tolerance="0.004">
    <Stimuli source="in.csv"/><References source="ref.csv"/>
  </Experiment>
  <Experiment name="Test2" startTime="0.0" stopTime="1.0" stepSize="0.10">
    <Parameters source="base%20set.ssv"/><Stimuli source="in.csv"/>
    <References source="ref.hdf5" type="application/hdf5"/>
  </Experiment>
</Experiments>"""
NEW = """<Experiments name="New">
  <Experiment name="Test3" tolerance="0.004"><TransientSimulation startTime="0.0" stopTime="1.0" stepSize="0.1"/>
    <Stimuli source="in.csv"/><References source="ref.csv"/></Experiment>
  <Experiment name="Test4"><SteadyState/><References source="ref.csv"/></Experiment>
</Experiments>"""
SET = b"""<ssv:ParameterSet name="b" version="1.0" xmlns:ssv="http://ssp-standard.org/SSP1/SystemStructureParameterValues">
<ssv:Parameters><ssv:Parameter name="u"><ssv:Real value="0.25" unit="rad"/></ssv:Parameter></ssv:Parameters>
</ssv:ParameterSet>"""
#: The input is held, and read at the beginning of a step: what is set at t is put out at t + 0.1 s.
IN, REF = b"time,u\n0,1\n0.25,2\n0.5,3\n", b"time,y\n0,1\n0.1,1\n0.3,1\n0.4,2\n0.6,3\n1,3\n"
EXPERIMENT = """<Experiments name="e"><Experiment name="one" {tolerance}>
<TransientSimulation startTime="0" stopTime="1" stepSize="0.1"/>{files}</Experiment></Experiments>"""


def told(parts: Parts, folder: Path, files: Mapping[str, str | bytes]) -> Replay:
    """What a replay says of an FMU with these files as references."""
    for name, data in files.items():
        parts.entries[f"{FOLDER}/{name}"] = data.encode() if isinstance(data, str) else data
    return replay(parts.write(folder))


def experiment(files: str, tolerance: str = 'tolerance="1e-6"') -> dict[str, str | bytes]:
    """A manifest and one experiment."""
    return {
        MANIFEST: f"{HEAD}{SMOKE}</fmiReferences>",
        "tests.exp": EXPERIMENT.format(files=files, tolerance=tolerance),
    }


FILES_OF_ONE = '<Stimuli source="in.csv"/><References source="ref.csv"/>'


@pytest.fixture(scope="module")
def vector(tmp_path_factory: pytest.TempPathFactory) -> dict[str, bytes]:
    """The FMI 3.0 FMU in C, by entry."""
    library = tmp_path_factory.mktemp("vector") / "Vector.so"
    command = ["cc", "-O1", "-shared", "-fPIC", "-o", library, HERE / "broken" / "vector.c"]
    subprocess.run(command, check=True, capture_output=True)
    entries = {XML: (HERE / "broken" / "vector.xml").read_bytes()}
    return entries | {"binaries/x86_64-linux/Vector.so": library.read_bytes()}


def test_nothing_happens_without_references(tmp_path: Path) -> None:
    assert replay(plain(tmp_path).write(tmp_path)) == Replay()


def test_every_construct_of_the_standard_is_taken_and_what_is_not_replayed_is_named(tmp_path: Path) -> None:
    files: dict[str, str | bytes] = {MANIFEST: EVERYTHING, "smoke.exp": OLD, "new.exp": NEW, "base set.ssv": SET}
    files |= {"in.csv": IN, "ref.csv": REF, "ref.hdf5": b"\x89HDF", "any.bin": b"\0", "modelica/plain.mo": b"model"}
    answer = told(plain(tmp_path), tmp_path, files)
    assert answer.findings == []
    assert [(one.experiment, one.output, one.good) for one in answer.outcomes] == [
        ("Test1", "y", True),
        ("Test3", "y", True),
    ]
    assert answer.skipped == [
        "references: https://example.org/state.bin lies outside of the archive",
        "experiment Test2: ref.hdf5 has the type application/hdf5",
        "experiment Test4: SteadyState is no simulation",
    ]


def test_inputs_of_an_fmu_that_puts_them_out_come_one_step_later(tmp_path: Path) -> None:
    answer = told(plain(tmp_path), tmp_path, experiment(FILES_OF_ONE) | {"in.csv": IN, "ref.csv": REF})
    assert answer.findings == []
    ((one,)) = answer.outcomes
    assert (one.difference, one.unit, one.allowed) == (0.0, "rad", pytest.approx(3e-6))
    assert answer.sentences() == [
        "experiment one: 1 outputs replayed; y differs most, by 0 rad of 3e-06 rad allowed",
    ]


def test_a_difference_is_told_with_its_place_and_judged_by_the_stated_tolerance(tmp_path: Path) -> None:
    wrong = REF.replace(b"0.4,2", b"0.4,2.5")
    for tolerance, rules in (
        ('tolerance="1e-6"', ["reference-result"]),
        ('tolerance="0.2"', []),
        ("", ["reference-result-unstated"]),
    ):
        answer = told(plain(tmp_path), tmp_path, experiment(FILES_OF_ONE, tolerance) | {"in.csv": IN, "ref.csv": wrong})
        assert [finding.rule for finding in answer.findings] == rules
        assert [one.difference for one in answer.outcomes] == [0.5]
    assert "one: y differs by 0.5 rad at 0.4 s; expected at most 0.003 rad" in str(answer.findings[0])


def test_a_result_that_no_experiment_names_is_told_and_never_a_finding(tmp_path: Path) -> None:
    """Reference-FMUs carry such results, of the default experiment; the standard does not say that they are."""
    result = '<Related type="text/csv" source="ref.csv" role="result"/>'
    files: dict[str, str | bytes] = {MANIFEST: f"{HEAD}{result}</fmiReferences>", "ref.csv": b"time,y\n0,0\n1,0\n"}
    answer = told(plain(tmp_path), tmp_path, files)
    assert (answer.findings, answer.skipped, [one.difference for one in answer.outcomes]) == ([], [], [0.0])
    answer = told(plain(tmp_path), tmp_path, files | {"ref.csv": b"time,y\n0,7\n1,0\n"})
    assert (answer.findings, [one.difference for one in answer.outcomes]) == ([], [7.0])
    answer = told(plain(tmp_path), tmp_path, files | {"ref.csv": b"when;what\n"})
    assert (answer.findings, answer.outcomes) == ([], [])
    assert answer.skipped == [f"references: ref.csv is not replayed: {FOLDER}/ref.csv: first column 'when;what'"]


@pytest.mark.parametrize(("macro", "said"), [("-DCRASH", "SIGABRT"), ("-DEXIT=0", "before the run was over")])
def test_an_fmu_that_dies_is_a_finding(macro: str, said: str, tmp_path: Path) -> None:
    answer = told(plain(tmp_path, macro), tmp_path, experiment(FILES_OF_ONE) | {"in.csv": IN, "ref.csv": REF})
    ((finding,)) = answer.findings
    assert finding.rule == "reference-run"
    assert said in finding.value
    assert answer.outcomes == []


@pytest.mark.parametrize(
    ("inputs", "results"),
    [
        # A cell holds the vector, as Reference-FMUs and fmpy write it.
        (b"time,u\n0,1 2 3\n0.5,4 5 6\n", b"time,y,n\n0,2 6 3,0\n0.5,2 6 3,5\n1,8 15 6,10\n"),
        # A column holds an element, as for the scalars of an FMI 2.0 archive; the others keep their start value, 0.5.
        (b"time,u[1],u[3]\n0,1,3\n0.5,4,6\n", b"time,y[3],y[2],y[1]\n0,3,1.5,2\n0.5,3,1.5,2\n1,6,1.5,8\n"),
    ],
)
def test_vectors_of_fmi_3_are_columns_of_cells_or_of_elements(
    inputs: bytes, results: bytes, vector: dict[str, bytes], tmp_path: Path
) -> None:
    """y = k u with k = (2, 3, 1), its third element not stated."""
    gains = SET.replace(b'"u"', b'"k[1]"').replace(b'"0.25" unit="rad"', b'"2"')
    second = b'<ssv:Parameter name="k[2]"><ssv:Real value="3"/></ssv:Parameter></ssv:Parameters>'
    files = experiment(f'<Parameters source="k.ssv"/>{FILES_OF_ONE}') | {
        "k.ssv": gains.replace(b"</ssv:Parameters>", second),
        "in.csv": inputs,
        "ref.csv": results,
    }
    answer = told(Parts(dict(vector)), tmp_path, files)
    assert [str(finding) for finding in answer.findings] == []
    assert {one.difference for one in answer.outcomes} == {0.0}
    assert len(answer.outcomes) == len(results.split(b"\n")[0].split(b",")) - 1


@pytest.mark.parametrize(
    ("inputs", "said"),
    [
        (b"time,u\n0,1 2\n", "row 2, column u: '1 2'; expected 3 numbers with blanks between them"),
        (b"time,u[4]\n0,1\n", "column u[4]: no variable of this name"),
        (b"time,u[0]\n0,1\n", "column u[0]: no variable of this name"),
        (b'time,"u[1,1]"\n0,1\n', "column u[1,1]: no variable of this name"),
    ],
)
def test_a_vector_of_another_length_is_found(
    inputs: bytes, said: str, vector: dict[str, bytes], tmp_path: Path
) -> None:
    files = experiment(FILES_OF_ONE) | {"in.csv": inputs, "ref.csv": b"time,n\n0,0\n"}
    answer = told(Parts(dict(vector)), tmp_path, files)
    assert said in " ".join(map(str, answer.findings))


def test_an_element_of_a_matrix_is_found_in_c_s_order() -> None:
    class Matrix:
        name, shape, type = "A", (2, 3), "Float64"

    meant = variables.place("A[2,1]", {"A": Matrix()})
    assert meant is not None
    assert meant.element == 3
    assert variables.place("A[3,1]", {"A": Matrix()}) is None


def test_a_scalar_of_an_array_of_structures_is_an_element_of_a_vector() -> None:
    """`segment[2].axis` of FMI 2.0 is the second element of `segment.axis` in FMI 3.0."""

    class Axis:
        name, shape, type = "segment.axis", (16,), "Int32"

    known = {"segment.axis": Axis()}
    meant = variables.place("segment[2].axis", known)
    assert meant is not None
    assert (meant.variable.name, meant.element) == ("segment.axis", 1)
    for name in ("segment[17].axis", "segment[0].axis", "segment[1].kind", "segment[1].axis[1]"):
        assert variables.place(name, known) is None, name


def stimulus(kind: str, held: bool, time: list[float], values: list[float]) -> Stimulus:
    """One variable of one value."""
    task = {"values": [[value] for value in values], "reference": 1, "held": held, "kind": kind}
    return Stimulus(task, time, is_fmi3=False)


def test_a_continuous_input_goes_straight_and_jumps_where_two_samples_share_an_instant() -> None:
    ramp = stimulus("Real", False, [0.0, 1.0, 1.0, 2.0], [0.0, 10.0, 20.0, 20.0])
    assert [ramp.at(t)[0] for t in (-1.0, 0.0, 0.25, 1.0, 1.5, 2.0, 9.0)] == [0.0, 0.0, 2.5, 20.0, 20.0, 20.0, 20.0]


def test_a_discrete_input_is_held_and_a_time_that_is_a_sum_still_meets_its_sample() -> None:
    steps = stimulus("Real", True, [0.0, 0.3], [1.0, 2.0])
    assert [steps.at(t)[0] for t in (0.0, 0.29, 0.1 + 0.1 + 0.1, 0.3 - 1e-12, 0.3)] == [1.0, 1.0, 2.0, 2.0, 2.0]
    switch = stimulus("Boolean", True, [0.0, 0.5], [0.0, 1.0])
    assert [switch.at(t) for t in (0.4, 0.5)] == [[0], [1]]


def test_no_damage_ends_the_reader(tmp_path: Path) -> None:
    """Pieces of the four kinds of files are exchanged and cut; what is wrong is a finding, never an exception."""
    chance = random.Random(7)
    good = {MANIFEST: EVERYTHING, "smoke.exp": OLD, "new.exp": NEW, "base set.ssv": SET.decode()}
    good |= {"in.csv": IN.decode(), "ref.csv": REF.decode()}
    odd = [
        "",
        '"',
        "<",
        "NaN",
        "1e999",
        "-1",
        "\0",
        "é",
        "../../..",
        "9" * 400,
        ",",
        "\n",
        "x[1]",
        "__",
        "&#0;",
        "http://[",
        "1_0",
    ]
    parts, found = plain(tmp_path), set()
    for _ in range(400):
        name = chance.choice(list(good))
        text = good[name]
        for _ in range(chance.choice((1, 1, 3))):
            begin = chance.randrange(len(text))
            text = text[:begin] + chance.choice(odd) + text[begin + chance.choice((0, 1, 5, 60)) :]
        for entry, data in (good | {name: text}).items():
            parts.entries[f"{FOLDER}/{entry}"] = data.encode("utf-8", "replace")
        found |= {finding.rule for finding in replay(parts.write(tmp_path), run=False).findings}
    assert {"reference-xml", "reference-manifest", "reference-series", "reference-missing"} <= found


def test_each_kind_of_rule_names_file_place_and_what_was_expected() -> None:
    """One sentence a kind, as a user reads it."""
    names = {"q": type("V", (), {"name": "q", "shape": None, "type": "Real"})()}
    _, found = series.read(b"time,q\n0,1\n1,nan\n", "in.csv", names)
    assert str(found[0]) == "error: in.csv: row 3, column q: 'nan'; expected a finite number [reference-series]"
    _, found = series.read(b"time,q\n0,1,2\n", "in.csv", names)
    assert str(found[0]) == "error: in.csv: row 2: 3 cells; expected 2, as in the header [reference-series]"
    _, found = series.read(b"time,p\n0,1\n", "in.csv", names)
    assert str(found[0]) == (
        "error: in.csv: column p: no variable of this name; expected a variable (known: q) [reference-variable]"
    )
    _, found = experiments.read(b'<Experiments name="x"><Experiment name="y" stopTime="-1"/></Experiments>', "t.exp")
    assert (
        str(found[0]) == "error: t.exp: line 1: stopTime -1 s; expected one after startTime, 0 s [reference-experiment]"
    )
    _, found = manifest.read(HEAD.encode() + b'<Related source="a" role="b"/></fmiReferences>', WHERE)
    assert str(found[0]).startswith(f"warning: {WHERE}: line 4: role 'b'; expected one of document, requirement,")


def test_no_broken_reference_is_left_out_of_the_validator_s_mutants() -> None:
    assert len({mutant.id for mutant in FILES + TABLES + PLAYED}) == len(FILES + TABLES + PLAYED)
