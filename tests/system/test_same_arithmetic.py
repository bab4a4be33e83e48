"""The law and the arm in C, against which the benches measure, compute what the FMUs compute: bit for bit.

They are a second derivation besides: written from the equations, without Rust, on another compiler."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from benches.in_c import InC, compiled, recorded
from numpy.typing import NDArray

from exo.fmu import find_fmu_dir
from exo.recording import Recording


def pressed_stuck_and_carried(run: Recording) -> bool:
    still = run["plant.dq[2]"] == 0.0
    breaks_away = (still[:-1] & ~still[1:]).sum() > 3
    return bool(run["plant.contact"].any() and run["plant.attached"].any() and breaks_away)


#: Scenario, case, other parameters, and what must have happened.
CASES: tuple[tuple[str, str, dict[str, Any], Callable[[Recording], bool]], ...] = (
    ("arm_payload", "passive_bounded_17.5kg", {}, pressed_stuck_and_carried),
    ("arm_payload", "passive_bounded_17.5kg", {"controller__workspace__limited": 1}, pressed_stuck_and_carried),
    # The wall.
    ("arm_contact", "passive_bounded", {}, lambda run: bool((run["plant.f_e[1]"] < 0.0).any())),
    # The edges of the workspace, which hold the nominal.
    ("arm_workspace", "task_-z", {}, lambda run: bool(run["controller.held"].any())),
    # A tank that is soon empty: springs are given up, and a share of the torques.
    (
        "arm_payload",
        "passive_bounded_25kg",
        {"controller__energy__E_0": 0.02},
        lambda run: bool((run["controller.energy.share"] < 1.0).any()),
    ),
)


@pytest.fixture(scope="module")
def library(tmp_path_factory: pytest.TempPathFactory) -> Any:
    """All in C."""
    return compiled(tmp_path_factory.mktemp("in_c"))


def unequal(name: str, replayed: NDArray[Any], run: Recording, component: str) -> list[str]:
    """In which steps a column differs in its bits: what the FMU showed after step k lies in row k, or in row k + 1."""
    column = run.columns.get(f"{component}.{name}")
    if column is None:
        return []  # a local
    shown = np.asarray(column)
    if component == "plant" and shown.dtype != bool:
        shown, replayed = shown[1:], replayed[:-1]  # continuous: the instant at which a step begins
    steps = np.flatnonzero(
        shown.view(np.int64) != replayed.copy().view(np.int64) if shown.dtype == float else shown != replayed
    )
    return [f"{component}.{name}: step {steps[0]} and {len(steps) - 1} more"] if len(steps) else []


@pytest.mark.parametrize(("scenario", "case", "parameters", "happened"), CASES)
def test_law_and_arm_in_c_give_the_bits_of_the_fmus(
    library: Any, scenario: str, case: str, parameters: dict[str, Any], happened: Callable[[Recording], bool]
) -> None:
    run, of = recorded(scenario, case, find_fmu_dir().resolve(), **parameters)
    assert happened(run)
    compared = 0
    wrong: list[str] = []
    for name, component in (("law", "controller"), ("plant", "plant")):
        for variable, column in InC(library, name, of).replayed().items():
            wrong += unequal(variable, column, run, component)
            compared += f"{component}.{variable}" in run.columns
    assert not wrong
    assert compared > 100
