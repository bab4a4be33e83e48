"""The closed forms' loops, with the parameters that the FMUs held."""

from exo import forms, theory
from exo.recording import Recording
from exo.tuning.machine import Gains, Machine

#: Laws whose loop is one of `exo.forms`, by the names of the controller's items.
COMPARATORS = ("natural", "sliding_mode")
GAINS = ("M_n", "D_n", "K", "K_P", "alpha")


def loop_of(run: Recording, *, controller: str, plant: str) -> theory.Loop:
    """The loop of the testbed's controller on a mass."""
    names = {name: f"{controller}.{name}" for name in (*GAINS, "T")}
    names |= {"M": f"{plant}.M", "substep": f"{plant}.substep"}
    return theory.Loop(**{name: run.parameter(key) for name, key in names.items()})


def arm_loop_of(
    run: Recording, *, controller: str, plant: str, axis: int, Lambda: float, damping: float
) -> theory.Loop:
    """The loop of one axis at the arm's handle, of mass `Lambda` (kg), with `damping` (N·s/m) on top of D_n."""
    names = {"M_n": f"Lambda_n[{axis}]", "D_n": f"D_n[{axis}]", "K": f"K[{axis}]", "K_P": f"K_P[{axis}]"}
    names |= {"alpha": "alpha", "T": "T"}
    gains = {name: run.parameter(f"{controller}.{key}") for name, key in names.items()}
    gains["D_n"] += damping
    return theory.Loop(M=Lambda, substep=run.parameter(f"{plant}.substep"), **gains)


def desired_mass(run: Recording, *, controller: str) -> float:
    """Mass of the model that the motion should follow (kg): the robot's own under `natural`."""
    natural = run.choice(f"{controller}.law") == "natural"
    return run.parameter(f"{controller}.comparator.M" if natural else f"{controller}.M_n")


def comparator_of(run: Recording, *, controller: str, plant: str, k_h: float = 0.0) -> forms.Comparator:
    """The loop of a comparator, with a hand of stiffness k_h (N/m)."""
    return forms.Comparator(
        law=run.choice(f"{controller}.law"),
        M_n=desired_mass(run, controller=controller),
        H=run.parameter(f"{controller}.comparator.H"),
        **{name: run.parameter(f"{controller}.{name}") for name in ("D_n", "K", "K_P", "T")},
        **{name: run.parameter(f"{plant}.{name}") for name in ("M", "b", "substep")},
        k_h=k_h,
    )


def gains_of(run: Recording, *, controller: str) -> Gains:
    """The gains of the testbed's controller."""
    return Gains(**{name: run.parameter(f"{controller}.{name}") for name in GAINS})


def machine_of(run: Recording, *, controller: str, plant: str, operator: str) -> Machine:
    """The frictionless testbed and the hand on it."""
    return Machine(
        T=run.parameter(f"{controller}.T"),
        delay=int(run.parameter(f"{controller}.delay")),
        M_min=run.parameter(f"{plant}.M"),
        M_max=run.parameter(f"{plant}.M"),
        k_h=run.parameter(f"{operator}.k_h"),
        b_h=run.parameter(f"{operator}.b_h"),
        hand_delay=run.parameter(f"{operator}.delay"),
        substep=run.parameter(f"{plant}.substep"),
    )
