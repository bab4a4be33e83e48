"""FMUs of others from Python, as they come: descriptions with flaws, libraries that lack another, runs that end."""

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import exo
from exo.errors import FmuError
from exo.fmu import Archive
from exo.loop import ENGINES, Engine

from broken.parts import XML, plain

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="the FMU in C is compiled for Linux")


def system(path: Path, **more: object) -> exo.System:
    return exo.couple({"one": path}, step=0.01, **more)  # type: ignore[arg-type]


@pytest.mark.parametrize("engine", ENGINES)
def test_an_fmu_whose_units_are_declared_nowhere_is_coupled_and_its_flaw_is_told(
    engine: Engine, tmp_path: Path
) -> None:
    """As OpenModelica 1.13 writes them."""
    parts = plain(tmp_path)
    parts.drop("UnitDefinitions")
    path = parts.write(tmp_path)
    with pytest.raises(FmuError, match='The unit "rad"'):
        Archive(path)
    loaded = exo.load(path)
    assert 'The unit "rad"' in loaded.problems
    assert repr(loaded).splitlines()[0].endswith("`exo validate broken.fmu` says where it breaks the standard")
    assert loaded["y"].unit == "rad"
    run = exo.simulate(system(path), duration=1.0, inputs={"one.u": np.sin}, engine=engine)
    assert np.array_equal(run["one.u"], np.sin(run.time))
    assert np.array_equal(run["one.y"], run["one.u"])


@pytest.mark.parametrize("engine", ENGINES)
def test_a_string_is_set_at_the_start_and_is_nothing_that_a_wire_carries(engine: Engine, tmp_path: Path) -> None:
    """As the file's name that many models of a table take."""
    parts = plain(tmp_path, "-DTEXT")
    for name, reference, causality in (("file", 2, "parameter"), ("say", 3, "input"), ("said", 4, "output")):
        start = "" if causality == "output" else ' start="none"'
        fixed = "fixed" if causality == "parameter" else "discrete"
        parts.insert(
            "ModelVariables",
            f'<ScalarVariable name="{name}" valueReference="{reference}" causality="{causality}" variability="{fixed}">'
            f"<String{start}/></ScalarVariable>",
        )
    path = parts.write(tmp_path)
    for text in ("map.csv", "größe", ""):
        run = exo.simulate(system(path), duration=0.1, parameters={"one.file": text}, engine=engine)
        assert (run["one.y"] == sum(text.encode())).all()
        held = exo.simulate(system(path), duration=0.1, inputs={"one.say": text}, engine=engine)
        assert held["one.y"].tobytes() == run["one.y"].tobytes()
    assert "one.said" not in run
    both = {"one": path, "other": path}
    with pytest.raises(FmuError, match=r"one\.say: a String takes no wire .*; expected a text, which is held"):
        exo.couple(both, wires={"one.say": "other.said"}, step=0.01)
    with pytest.raises(FmuError, match=r"one\.say: a String takes no wire and no signal"):
        exo.simulate(system(path), duration=0.1, inputs={"one.say": 3.0})
    with pytest.raises(FmuError, match="file: expected String, got 3"):
        exo.simulate(system(path), duration=0.1, parameters={"one.file": 3})


def test_what_is_no_description_at_all_is_refused_in_one_sentence(tmp_path: Path) -> None:
    for change in (b"", b"<fmiModelDescription/>", b"<a"):
        parts = plain(tmp_path)
        parts.entries[XML] = change
        with pytest.raises(FmuError, match=r"broken\.fmu: ") as caught:
            exo.load(parts.write(tmp_path))
        assert "\n" not in str(caught.value)


def test_a_library_that_lacks_another_one_says_which(tmp_path: Path) -> None:
    """As an FMU that was linked against LAPACK on another machine."""
    gone = tmp_path / "libgone.so.3"
    source = tmp_path / "gone.c"
    source.write_text("int gone(void) { return 0; }\n", encoding="utf-8")
    subprocess.run(["cc", "-shared", "-fPIC", source, "-o", gone, f"-Wl,-soname,{gone.name}"], check=True)
    parts = plain(tmp_path, "-Wl,--no-as-needed", str(gone))
    gone.unlink()
    with pytest.raises(FmuError, match=r"its library cannot be loaded: libgone\.so\.3: cannot open") as caught:
        exo.simulate(system(parts.write(tmp_path)), duration=1.0)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("engine", ENGINES)
def test_an_fmu_that_ends_the_simulation_says_when(engine: Engine, tmp_path: Path) -> None:
    path = plain(tmp_path, "-DDISCARD=0.5", "-DENDS=0.505").write(tmp_path)
    with pytest.raises(FmuError, match=r"one: has ended the simulation at t = 0\.505 s; expected a shorter duration"):
        exo.simulate(system(path), duration=1.0, engine=engine)
    assert len(exo.simulate(system(path), duration=0.5, engine=engine).time) == 50
    refused = plain(tmp_path, "-DDISCARD=0.5").write(tmp_path, "refused")
    with pytest.raises(FmuError, match=r"fmi2DoStep returned fmi2Discard: .*\(step at t = 0\.5 s\)"):
        exo.simulate(system(refused), duration=1.0, engine=engine)


@pytest.mark.parametrize("engine", ENGINES)
def test_a_variable_that_is_no_output_is_recorded_where_it_is_asked_for(engine: Engine, tmp_path: Path) -> None:
    parts = plain(tmp_path)
    parts.replace(XML, 'causality="output"', 'causality="local"')
    parts.drop("ModelStructure/Outputs")
    path = parts.write(tmp_path)
    assert "one.y" not in exo.simulate(system(path), duration=0.1, inputs={"one.u": 1.0}, engine=engine)
    run = exo.simulate(system(path, record=["one.y"]), duration=0.1, inputs={"one.u": lambda t: t}, engine=engine)
    assert np.array_equal(run["one.y"], run.time)
    assert run.units["one.y"] == "rad"


def test_two_components_of_one_fmu_do_not_share_what_the_library_has(tmp_path: Path) -> None:
    path = plain(tmp_path).write(tmp_path)
    chain = exo.couple({"a": path, "b": path, "c": path}, wires={"b.u": "a.y", "c.u": "-b.y"}, step=0.01)
    run = exo.simulate(chain, duration=0.1, inputs={"a.u": lambda t: 1.0 + t})
    assert np.array_equal(run["b.y"], 1.0 + run.time)
    assert np.array_equal(run["c.y"], -(1.0 + run.time))
