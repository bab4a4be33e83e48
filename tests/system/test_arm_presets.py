"""Scenario arm_presets on the built FMUs, and presets by name: scenario files, command line, SSP archives."""

from collections.abc import Mapping
from math import pi
from pathlib import Path

import pytest
from fmpy.ssp.ssd import read_ssv

from exo import presets, scenario, theory
from exo.commands.scenarios import preset_settings
from exo.errors import ScenarioError
from exo.experiment import Experiment
from exo.fmu import Archive
from exo.systems import closed, ssp, system

SCENARIO = "arm_presets"

#: The issue's gains: Λ_n (kg), D_n (N·s/m), K (N·s/m).
GAINS = {"paper": (5.0, 20.0, 1000.0), "stiff_grip": (10.0, 40.0, 3000.0), "stiff_grip_low_gain": (20.0, 60.0, 2000.0)}
NAMED = 'base = "arm"\ntitle = "t"\nabout = "a"\nsource = "s"\nduration = 1.0\n[cases.one]\npreset = "stiff_grip"\n'


def test_every_preset_is_measured_by_the_scenario() -> None:
    assert set(presets.names()) == set(GAINS)
    cases = {case.id for case in scenario.load(SCENARIO).cases}
    assert cases == {f"{name}_{kind}" for name in GAINS for kind in ("grip", "ideal", "slow", "error")}


def test_each_case_runs_with_its_preset_s_gains(experiment: Experiment) -> None:
    for case, run in experiment.recordings.items():
        gains = GAINS[case.rsplit("_", 1)[0]]
        for i in (1, 2, 3):
            assert tuple(run.parameter(f"controller.{name}[{i}]") for name in ("Lambda_n", "D_n", "K")) == gains


def test_the_paper_s_preset_is_the_start_values(archives: Mapping[str, Archive]) -> None:
    archive = archives["ArmController.fmu"]
    for name, value in system.by_element(presets.load("paper").qualified({"c": archive.path.name})).items():
        assert float(archive.variable(name.removeprefix("c.")).start) == value


@pytest.mark.parametrize(("name", "holds"), [("paper", False), ("stiff_grip", True), ("stiff_grip_low_gain", True)])
def test_a_hand_of_1000_newton_a_metre_is_beyond_the_paper_s_gains_only(name: str, holds: bool) -> None:
    M_n, D_n, K = GAINS[name]
    for T, substep in ((1e-3, 1e-4), (5e-4, 5e-5)):
        loop = theory.Loop(M=99.93, M_n=M_n, D_n=D_n, K=K, K_P=20.0, alpha=1.0, T=T, substep=substep)
        assert (theory.hand_growth_rate(loop=loop, k_h=1000.0) < 0.0) is holds


def test_the_strokes_that_are_expected_are_those_of_the_nominal_dynamics() -> None:
    (stroke,) = (metric for metric in scenario.load(SCENARIO).metrics if metric.id == "stroke")
    omega = 2.0 * pi * 0.4
    for name, (M_n, D_n, _) in GAINS.items():
        expected = 2.0 * 6.9 / (omega * abs(1j * omega * M_n + D_n))
        assert stroke.expected[f"{name}_error"].value == pytest.approx(expected, rel=1e-3)


def test_a_case_takes_a_preset_by_name_and_its_own_values_come_last() -> None:
    plain = scenario.parse(text=NAMED, origin="mine.toml").cases[0].parameters
    assert plain["controller.K[2]"] == 3000.0
    own = scenario.parse(text=NAMED + '"controller.K[2]" = 1500.0\n', origin="mine.toml").cases[0].parameters
    assert (own["controller.K[1]"], own["controller.K[2]"]) == (3000.0, 1500.0)


def test_an_unknown_preset_is_named_with_those_that_there_are() -> None:
    with pytest.raises(ScenarioError, match=r"mine\.toml: cases\.one\.preset: unknown preset stif_grip.*paper"):
        scenario.parse(text=NAMED.replace('"stiff_grip"', '"stif_grip"'), origin="mine.toml")


def test_a_scenario_without_the_preset_s_controller_is_refused_by_name() -> None:
    with pytest.raises(ScenarioError, match=r"wall: preset paper: .*TestbedController\.fmu.*expected .*ArmController"):
        preset_settings(presets.load("paper"), scenario.load("wall"))


@pytest.mark.parametrize("name", GAINS)
def test_each_preset_is_a_parameter_set_of_the_exoskeleton_s_archives(
    name: str, archives: Mapping[str, Archive], tmp_path: Path
) -> None:
    for data, resource, prefix in (
        (system.load("ExoskeletonSystem"), ssp.resource(f"preset-{name}"), "controller."),
        (closed.load("ExoskeletonSystem"), ssp.resource(f"preset-{name}", "controller"), ""),
    ):
        path = ssp.write(system=data, archives=archives, folder=tmp_path)
        read = {p.name: (p.value, p.unit) for p in read_ssv(str(path), resource=resource).parameters}
        Lambda_n, D_n, K = GAINS[name]
        for i in (1, 2, 3):
            assert read[f"{prefix}Lambda_n[{i}]"] == (repr(Lambda_n), "kg")
            assert read[f"{prefix}D_n[{i}]"] == (repr(D_n), "N.s/m")
            assert read[f"{prefix}K[{i}]"] == (repr(K), "N.s/m")
    assert not [key for key in system.load("TestbedSystem").parameter_sets if key.startswith("preset-")]
