"""An FMU of another maker, packed by PythonFMU, coupled with this project's. Run by test_python_fmu.py."""

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import exo
from exo.loop import ENGINES, Engine

#: The hand of an operator who wants to be at `target`, seen by PythonFMU.
HAND = """
from pythonfmu import Boolean, Fmi2Causality, Fmi2Slave, Fmi2Variability, Integer, Real

PARAMETER = {"causality": Fmi2Causality.parameter, "variability": Fmi2Variability.tunable}


class Hand(Fmi2Slave):
    def __init__(self, **kwargs):
        super().__init__(**kwargs)
        self.stiffness, self.damping, self.target = 40.0, 8.0, 0.2
        self.q = self.dq = self.tau_h = self.stretch = 0.0
        self.steps, self.pulls = 0, False
        for name in ("stiffness", "damping", "target"):
            self.register_variable(Real(name, **PARAMETER))
        for name in ("q", "dq"):
            self.register_variable(Real(name, causality=Fmi2Causality.input))
        self.register_variable(Real("tau_h", causality=Fmi2Causality.output))
        self.register_variable(Integer("steps", causality=Fmi2Causality.output))
        self.register_variable(Boolean("pulls", causality=Fmi2Causality.output))
        self.register_variable(Real("stretch", causality=Fmi2Causality.local))

    def do_step(self, t, dt):
        self.stretch = self.target - self.q
        self.tau_h = self.stiffness * self.stretch - self.damping * self.dq
        self.steps, self.pulls = self.steps + 1, self.tau_h < 0.0
        if self.steps > 2000:
            raise ValueError("the hand is tired")
        return True
"""
WIRES = {
    "hand.q": "plant.q",
    "hand.dq": "plant.dq",
    "controller.q": "plant.q",
    "controller.tau_h": "hand.tau_h",
    "plant.tau_a": "controller.tau_a",
    "plant.tau_h": "hand.tau_h",
}
STEP = 0.002


@pytest.fixture(scope="module")
def system(tmp_path_factory: pytest.TempPathFactory, fmu_dir: Path) -> exo.System:
    """The hand, the controller and the testbed, in this order."""
    folder = tmp_path_factory.mktemp("hand")
    (folder / "hand.py").write_text(HAND, encoding="utf-8")
    command = [sys.executable, "-m", "pythonfmu", "build", "-f", "hand.py", "-d", "."]
    subprocess.run(command, cwd=folder, check=True, capture_output=True, timeout=120)
    fmus = {
        "hand": folder / "Hand.fmu",
        "controller": fmu_dir / "TestbedController.fmu",
        "plant": fmu_dir / "Testbed.fmu",
    }
    return exo.couple(fmus, wires=WIRES, step=STEP, record=["hand.stretch"])


@pytest.mark.parametrize("engine", ENGINES)
def test_a_hand_in_python_moves_the_testbed_as_its_recorded_force_does(engine: Engine, system: exo.System) -> None:
    """Against the same run without that FMU, whose force is given tick by tick."""
    parameters = {"hand.target": 0.25, "controller.K": 20.0}
    run = exo.simulate(system, duration=3.0, parameters=parameters, engine=engine)
    assert system.fmus["hand"].tool.startswith("PythonFMU")
    assert run["plant.q"][-1] == pytest.approx(0.25, abs=0.64 / 40.0 + 1e-3)  # what Coulomb friction holds
    # The hand steps first: from the position at t_k comes the force of tick k.
    force = 40.0 * (0.25 - run["plant.q"]) - 8.0 * run["plant.dq"]
    np.testing.assert_array_equal(run["controller.tau_h"], force)
    np.testing.assert_array_equal(run["hand.stretch"][1:], (0.25 - run["plant.q"])[:-1])
    assert (run["hand.steps"] == np.arange(1500)).all()
    assert run["hand.pulls"].dtype == bool
    assert run["hand.pulls"].any()
    wires = {target: source for target, source in WIRES.items() if "hand" not in target + source}
    two = {name: fmu for name, fmu in system.fmus.items() if name != "hand"}
    alone = exo.couple(two, wires=wires, step=STEP)
    inputs = {"controller.tau_h": force, "plant.tau_h": force}
    again = exo.simulate(alone, duration=3.0, inputs=inputs, parameters={"controller.K": 20.0}, engine=engine)
    for name in ("plant.q", "plant.dq", "controller.tau_a", "controller.energy.tank"):
        assert again[name].tobytes() == run[name].tobytes(), name


@pytest.mark.parametrize("engine", ENGINES)
def test_an_error_in_the_python_of_the_fmu_is_one_sentence_with_its_time(engine: Engine, system: exo.System) -> None:
    with pytest.raises(exo.FmuError, match=r"hand: fmi2DoStep returned fmi2.*\(step at t = 4 s\)$") as caught:
        exo.simulate(system, duration=5.0, engine=engine)
    assert "\n" not in str(caught.value)
