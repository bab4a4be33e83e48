"""README and docs/ name what exists: files, scenarios, names, the paper's equations; the assumptions have effects."""

from pathlib import Path

import pytest

from exo import scenario
from exo.sensitivity import Runner, jobs, load, rounded

from documents import assumptions, citations, names
from documents.names import DOCUMENTS, ROOT

EXPERIMENTS = (ROOT / "docs/experiments.md").read_text(encoding="utf-8")
MAP = list(names.paper_map((ROOT / "docs/map.md").read_text(encoding="utf-8")))


def read(document: str) -> str:
    return (ROOT / document).read_text(encoding="utf-8")


@pytest.mark.parametrize("document", DOCUMENTS)
def test_what_a_document_names_exists(document: str) -> None:
    text = read(document)
    assert names.missing(document, text) == [], "no such file"
    assert [name for name in names.scenarios(text) if name not in scenario.built_in()] == [], "no such scenario"
    assert [word for word in names.words(text) if word not in names.known_words()] == [], "in no source"
    assert [one for one in names.tests(text) if one[1] not in read(one[0])] == [], "no such test"


def test_a_file_a_scenario_and_a_name_that_are_gone_are_found() -> None:
    text = "`docs/gone.md`, [x](gone.png), `gone.rs`, `README.md`, scenarios `wall` and `gone_too`; `gone_three`\n"
    text += "    fmu/admittance/  here\n    fmu/gone/  gone\n"
    assert names.missing("README.md", text) == ["gone.png", "docs/gone.md", "gone.rs", "fmu/gone/"]
    assert names.scenarios(text) == ["wall", "gone_too"]
    assert [word for word in names.words(text) if word not in names.known_words()] == ["gone_too", "gone_three"]
    assert names.tests("`README.md` and `docs/paper.md::title`") == [("docs/paper.md", "title")]


def test_the_experiments_list_every_scenario() -> None:
    table = EXPERIMENTS.split("| scenario | what it shows |")[1].split("\n\n")[0]
    assert sorted(scenario.built_in()) == sorted(
        names.quoted("\n".join(row.split("|")[1] for row in table.splitlines()[2:]))
    )


@pytest.mark.parametrize("row", MAP, ids=[row.paper for row in MAP])
def test_a_place_of_the_paper_map_mentions_what_it_is_named_for(row: names.Row) -> None:
    assert row.labels or row.symbols
    assert row.places
    assert [place for place in row.places if not (ROOT / place).exists()] == [], "no such place"
    assert [place for place in row.places if not row.mentioned(place)] == [], "has neither label nor symbol"


def test_a_place_that_has_nothing_to_do_with_an_equation_is_found() -> None:
    row = names.Row(paper="", labels=("eq:obs_dyn",), symbols=(), places=())
    assert row.mentioned("fmu/admittance/tests/nominal_dynamics.rs")
    assert not row.mentioned("fmu/admittance/tests/transfer.rs")
    # eq:obs_dyn_cart is another equation.
    assert not names.Row(paper="", labels=("eq:obs",), symbols=(), places=()).mentioned("docs/paper.md")


def test_every_label_that_is_used_is_explained_once() -> None:
    rows = [line.split("|")[1].strip() for line in read("docs/paper.md").splitlines() if line.startswith("|")][2:]
    assert len(rows) == len(set(rows))
    kinds = (".rs", ".py", ".toml", ".md", ".jinja")
    used = {
        path: names.labels(read(path))
        for path in names.files()
        if path.endswith(kinds) and not path.startswith(names.OWN)
    }
    assert {path: found - set(rows) for path, found in used.items() if found - set(rows)} == {}


@pytest.mark.parametrize("document", ["README.md", "docs/paper.md", "docs/specification.md"])
def test_the_paper_is_cited_so_that_a_reader_finds_it(document: str) -> None:
    text = " ".join(read(document).split())
    for part in ("Kim", "A Passivity-based Nonlinear Admittance Control", "arxiv.org/abs/1904.08833", "2019"):
        assert part in text


def test_what_is_cited_of_specification_and_passivity_stands_there() -> None:
    wrong = {path: citations.unfounded(read(path)) for path in citations.sources()}
    assert {path: found for path, found in wrong.items() if found} == {}


@pytest.mark.parametrize(
    ("citation", "wrong"),
    [
        ("docs/specification.md section 5, wall: bounded", []),
        ("docs/specification.md section 6, Exp 3; fig:exp_actual", []),
        ("docs/specification.md section 4: the balance closes", []),
        ("docs/passivity.md, The proof, step 4", []),
        ("docs/specification.md section 5, floor", ["section 5, floor"]),
        ("docs/specification.md section 9", ["section 9, "]),
        ("docs/passivity.md, The proofs of others", []),
        ("docs/passivity.md, No such heading", ["No such heading"]),
    ],
)
def test_a_citation_that_leads_nowhere_is_found(citation: str, wrong: list[str]) -> None:
    assert citations.unfounded(citation) == wrong


@pytest.mark.parametrize("plant", assumptions.PLANTS)
def test_the_assumptions_table_has_every_parameter_once_and_all_its_effects(plant: str) -> None:
    study, effects = load(assumptions.STUDY), assumptions.effects()
    listed = [name for one in study.parameter if one.plant == plant for name in one.names]
    assert sorted(listed) == sorted(assumptions.declared(plant))
    for figure in study.figures(plant):
        expected = [name for parameter, name, one in jobs(study) if one == figure]
        assert list(effects[figure.id]["changed"]) == expected
        assert sorted(effects[figure.id]["parameters"]) == sorted(listed)


def test_the_arm_starts_with_the_values_of_the_specification() -> None:
    specified, declared = assumptions.specified(), assumptions.declared("ExoskeletonArm")
    assert len(specified) == 3 * 16
    assert {name: float(declared[name].start) for name in specified} == specified


def test_the_specification_shows_the_table_as_it_is() -> None:
    text = assumptions.DOCUMENT.read_text(encoding="utf-8")
    assert assumptions.filled(text) == text, "cd tests/system && python -m documents.assumptions"
    # Another table is another text.
    assert assumptions.filled(text.replace("| none | none |", "| none | off |", 1)) == text
    assert "| none | none |" in text


# A few of the 350 changes of `exo sensitivity`: of five figures, large and small, and one with a table that moves.
@pytest.mark.parametrize(
    ("figure", "name"),
    [("error", "F_c"), ("release", "M"), ("e_x", "rotor.I[1]"), ("leaving", "pad.z"), ("drift", "payload.m")],
)
def test_an_effect_is_what_it_was_measured_to_be(figure: str, name: str, fmu_dir: Path) -> None:
    study, effects = load(assumptions.STUDY), assumptions.effects()
    runner = Runner(study=study, fmu_dir=fmu_dir)
    (chosen,) = (one for one in study.figure if one.id == figure)
    (parameter,) = (one for one in study.parameter if name in one.names and one.plant == chosen.plant)
    base = runner.base(chosen)
    known = effects[figure]
    assert rounded(base.values[figure]) == pytest.approx(known["value"], rel=1e-6)  # seven digits are kept
    found = [rounded(value) for value in runner.changed(chosen, parameter, name)]
    assert found == pytest.approx(known["changed"][name], rel=1e-6)
    own = {one: base.parameters[f"plant.{one}"] for one in known["parameters"]}
    assert {one: rounded(value) for one, value in own.items()} == known["parameters"]
