"""Scenario arm_boundary_layer on the built FMUs, and what the effective disturbance is computed from."""

from pathlib import Path

import numpy as np
import pytest

from exo import derived, theorems
from exo.errors import ExoError, ScenarioError
from exo.experiment import Experiment, run
from exo.handle import handle_of
from exo.scenario import load, parse

from conftest import recording

SCENARIO = "arm_boundary_layer"


def test_the_jacobian_is_the_slope_of_the_handle(experiment: Experiment) -> None:
    run = experiment.recordings["push_x"]
    J = handle_of(run, plant="plant").J
    dq, dp = (np.stack([run[f"plant.{name}[{i}]"] for i in (1, 2, 3)], axis=1) for name in ("q_joint", "p"))
    # Differences over a tick of a motion of .1 m/s with 2 m/s²: second order, 1e-9.
    assert np.diff(dp, axis=0) == pytest.approx(
        np.einsum("nij,nj->ni", 0.5 * (J[1:] + J[:-1]), np.diff(dq, axis=0)), abs=2e-9
    )
    assert np.ptp(dp[:, 0]) > 1e-3


def test_the_step_of_the_effective_disturbance_is_what_the_paper_s_definition_gives_at_rest(
    experiment: Experiment,
) -> None:
    # At rest eq:effective_dist is Λ Λ_n⁻¹ f_h − (f_h + f_d): of a push of 1 N (Λ/5 − 1) N, of a load its opposite.
    for i, axis in enumerate("xyz"):
        run = experiment.recordings[f"push_{axis}"]
        Lambda = handle_of(run, plant="plant").Lambda[50]
        f_h = np.eye(3)[i]
        found = [run[f"derived.f_ed[{k}]"][50] for k in (1, 2, 3)]
        # dp, ddp of the first step stand in for those at its beginning: a hundredth of a newton.
        assert found == pytest.approx(Lambda @ f_h / 5.0 - f_h, abs=0.01)


def test_the_control_has_found_the_disturbance_once_the_layer_is_over(experiment: Experiment) -> None:
    for i, axis in ((2, "y"), (3, "z")):
        run = experiment.recordings[f"load_{axis}"]
        f_a, f_ed = (run[f"{name}[{i}]"][350:] for name in ("controller.f_a", "derived.f_ed"))
        assert f_a == pytest.approx(f_ed, rel=0.01)
        assert np.abs(f_ed).min() > 10.0


def test_the_closed_form_tends_to_the_boundary_layer_of_the_theorem() -> None:
    # 1 − exp(−K t/M): the overshoot and the distance of the 63 % from M/K go as 1/K.
    M, K_P = 14.29, 20.0
    off = []
    for K in (1e4, 1e5):
        sigma = np.linspace(0.01, 5.0, 500)
        found = theorems.found_disturbance(M=M, K=K, K_P=K_P, time=sigma * M / K)
        off.append(np.max(np.abs(found - (1.0 - np.exp(-sigma)))))
    assert off[0] < 0.03
    assert off[1] == pytest.approx(0.1 * off[0], rel=0.1)  # the next order: a few times K_P M/K = 2.9 %


def test_the_closed_form_is_the_solution_of_its_equation() -> None:
    # M (dde + K_P de) + K (de + K_P e) = 1 + M K_P de by small Euler steps, for real and for complex poles.
    for M, K, K_P in ((99.93, 1000.0, 20.0), (14.29, 1000.0, 20.0), (1.0, 40.0, 10.0)):
        dt, e, de = 1e-6, 0.0, 0.0
        shown = []
        for n in range(100_000):
            if n % 10_000 == 0:
                shown.append(K * (de + K_P * e))
            dde = (1.0 - K * (de + K_P * e)) / M
            e, de = e + dt * de, de + dt * dde
        closed = theorems.found_disturbance(M=M, K=K, K_P=K_P, time=np.arange(10) * 1e-2)
        assert shown == pytest.approx(closed, abs=1e-4)


def test_a_derived_signal_that_does_not_exist_is_named_with_the_close_ones() -> None:
    with pytest.raises(ScenarioError, match=r"mini: unknown derived signal f_de .*f_ed"):
        derived.columns(["f_de"], owner="mini")


def test_a_component_cannot_take_the_name_of_the_derived_signals() -> None:
    text = 'id = "mini"\ntitle = "x"\nabout = "x"\nsource = "x"\nduration = 1.0\nstep = 0.002\ninputs = {}\n'
    text += '[components.derived]\narchive = "Testbed.fmu"\n[cases.only]\n'
    with pytest.raises(ScenarioError, match=r"components\.derived: this name stands for the derived signals"):
        parse(text=text, origin="mini.toml")


def test_the_testbed_s_effective_disturbance_is_friction_against_the_motion_when_the_masses_are_equal() -> None:
    # M = M_n and D_n = 0: eq:effective_dist is −τ_d. A mass of 2 kg under 3 N of hand and 1 N of friction.
    time = np.arange(50) * 0.01
    parameters = {"plant.M": 2.0, "controller.M_n": 2.0, "controller.D_n": 0.0}
    columns = {"plant__dq": time * 1.0, "plant__tau_h": np.full(50, 3.0), "plant__tau_a": np.zeros(50)}
    run = derived.added(recording(time=time, parameters=parameters, **columns), ["tau_ed"])
    assert run["derived.tau_ed"] == pytest.approx(np.full(50, 1.0), abs=1e-12)


def test_a_signal_of_another_plant_says_what_is_missing() -> None:
    time = np.arange(10) * 0.01
    with pytest.raises(ExoError, match=r"no parameter plant\.M"):
        derived.added(recording(time=time, x=time), ["tau_ed"])
    with pytest.raises(ExoError, match=r"no recorded column controller\.e_nr"):
        derived.added(recording(time=time, x=time), ["x_nr"])


def test_a_column_that_the_scenario_does_not_derive_is_refused_before_anything_runs(fmu_dir: Path) -> None:
    scenario = load(SCENARIO)
    with pytest.raises(ScenarioError, match=r"derived\.f_ed\[2\]: not among the scenario's derived signals"):
        run(scenario=scenario.model_copy(update={"derived": ()}), fmu_dir=fmu_dir)
