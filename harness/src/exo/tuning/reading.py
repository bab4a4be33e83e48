"""Reads machine, gains and friction from a case of a scenario: what the FMUs hold after their initialization."""

import math
from collections.abc import Mapping
from contextlib import ExitStack
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from exo import master, trial
from exo import overrides as settings
from exo.errors import ScenarioError, close_matches
from exo.fmu import Archive
from exo.handle import handle_of
from exo.metrics.loops import COMPARATORS
from exo.recording import Recording
from exo.scenario import Scenario
from exo.tuning.friction import Friction, Stribeck

AXES = ("x", "y", "z")
#: Controller and plant that belong together.
PAIRS = (("TestbedController.fmu", "Testbed.fmu"), ("ArmController.fmu", "ExoskeletonArm.fmu"))
OPERATOR = "HumanOperator.fmu"
#: Below this (N or m) what a joint contributes to an axis is rounding.
ROUNDING = 1e-9


@dataclass(frozen=True, kw_only=True)
class Reading:
    """Values by the names of the fields of `Machine` and `Gains`, and the friction along the axis."""

    values: dict[str, float]
    friction: Friction


def read(*, scenario: Scenario, case: str | None, axis: str, texts: Mapping[str, str], fmu_dir: Path) -> Reading:
    """Of the case, or the only or first one; `axis` is the arm's; `texts` are settings of the command line.

    `ScenarioError` for a case or an axis that is not there, and for a law whose loop is not the guide's.
    """
    if axis not in AXES:
        raise ScenarioError(f"axis {axis}: expected one of {', '.join(AXES)}")
    cases = {one.id: one for one in scenario.cases}
    if case is not None and case not in cases:
        raise ScenarioError(f"{scenario.id}: no case {case}{close_matches(case, cases)}")
    chosen = cases[case] if case is not None else scenario.cases[0]
    with ExitStack() as stack:
        names = {part.archive for part in scenario.components.values()}
        archives = {name: stack.enter_context(Archive(fmu_dir / name)) for name in sorted(names)}
        for archive in archives.values():
            trial.check(archive)
        parsed = settings.parse(scenario, archives, texts)
        plan = master.plan(scenario=scenario, case=chosen, overrides=parsed)
        run = master.simulate(plan=replace(plan, duration=2.0 * plan.step), archives=archives)
    parts = {archive: name for name, archive in plan.components.items()}
    for controller, plant in PAIRS:
        if controller in parts and plant in parts:
            known = _loop(run, controller=parts[controller], late=plan.coupling != "zero_delay")
            found = _arm if controller.startswith("Arm") else _testbed
            place = AXES.index(axis) + 1
            values, friction = found(run, controller=parts[controller], plant=parts[plant], axis=place)
            hand = _hand(run, operator=parts[OPERATOR], axis=place) if OPERATOR in parts else {}
            return Reading(values={**known, **values, **hand}, friction=friction)
    pairs = " or ".join(f"{controller} and {plant}" for controller, plant in PAIRS)
    raise ScenarioError(f"{scenario.id}: got {', '.join(sorted(names))}; expected {pairs}")


def _loop(run: Recording, *, controller: str, late: bool) -> dict[str, float]:
    law = run.choice(f"{controller}.law")
    for key, only in (("form", "torque"), ("space", "task")):
        name = f"{controller}.{key}"
        if name in run.choices and run.choice(name) != only:
            raise ScenarioError(f"{name} = {run.choice(name)}: expected {only}, whose loop the guide knows")
    if law in COMPARATORS:
        raise ScenarioError(f"{controller}.law = {law}: expected one of the laws 1 to 4, whose loop the guide knows")
    return {
        "T": max(run.parameter(f"{controller}.T"), run.step),
        "delay": int(late or run.parameter(f"{controller}.delay") > 0.0),
        "alpha": 0.0 if law == "standard" else run.parameter(f"{controller}.alpha"),
    }


def _testbed(run: Recording, *, controller: str, plant: str, axis: int) -> tuple[dict[str, float], Friction]:
    del axis  # it has one
    M, F_c, b = (run.parameter(f"{plant}.{name}") for name in ("M", "F_c", "b"))
    values = {name: run.parameter(f"{controller}.{name}") for name in ("M_n", "D_n", "K", "K_P", "dq_cutoff")}
    values |= {"M_min": M, "M_max": M, "substep": run.parameter(f"{plant}.substep")}
    # Its stiction is its Coulomb friction: nothing falls with speed, whatever v_s is.
    return values, Friction((Stribeck(F_c=F_c, F_s=F_c, v_s=1.0, b=b),))


def _arm(run: Recording, *, controller: str, plant: str, axis: int) -> tuple[dict[str, float], Friction]:
    handle = handle_of(run, plant=plant)
    J, M = handle.J[0], float(handle.Lambda[0, axis - 1, axis - 1])
    names = {"M_n": "Lambda_n", "D_n": "D_n", "K": "K", "K_P": "K_P"}
    values = {name: run.parameter(f"{controller}.{key}[{axis}]") for name, key in names.items()}
    counts = [count_of(run, plant=plant, joint=joint) for joint in (1, 2, 3)]
    values |= {
        "M_min": M,
        "M_max": M,
        "substep": run.parameter(f"{plant}.substep"),
        "dq_cutoff": run.parameter(f"{controller}.dp_cutoff"),
        "f_cutoff": run.parameter(f"{controller}.ft.cutoff"),
        "drive_cutoff": run.parameter(f"{plant}.drive.cutoff"),
        "resolution": _kept(float(np.abs(J[axis - 1]) @ counts)),
    }
    # Along the axis alone the joints turn by J⁻¹ of a metre.
    turns = np.linalg.inv(J)[:, axis - 1]
    terms = []
    for joint, turn in enumerate(turns, start=1):
        own = {name: run.parameter(f"{plant}.friction.{name}[{joint}]") for name in ("F_c", "F_s", "v_s", "b")}
        terms.append(Stribeck(**own).along(float(turn)))
    return values, Friction(tuple(term for term in terms if term))


def count_of(run: Recording, *, plant: str, joint: int) -> float:
    """One count of the joint's encoder (rad): 2π/(counts · gear) on the motor's side, 2π/2^bits on the joint's; 0:
    ideal."""
    match run.choice(f"{plant}.encoder.kind"):
        case "motor":
            return 2.0 * math.pi / (run.parameter(f"{plant}.encoder.counts") * run.parameter(f"{plant}.gear[{joint}]"))
        case "joint":
            return 2.0 * math.pi / math.pow(2.0, run.parameter(f"{plant}.encoder.bits"))
        case _:
            return 0.0


def _hand(run: Recording, *, operator: str, axis: int) -> dict[str, float]:
    k_h, b_h = (
        run.parameter(f"{operator}.{n}") * run.parameter(f"{operator}.{n}_factor[{axis}]") for n in ("k_h", "b_h")
    )
    return {"k_h": k_h, "b_h": b_h, "hand_delay": run.parameter(f"{operator}.delay")}


def _kept(value: float) -> float:
    return value if value > ROUNDING else 0.0
