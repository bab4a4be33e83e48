"""Wrong calls through fmpy: each is an error that says why, nothing goes to stderr, the instance runs on as before."""

import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

CHILD = Path(__file__).with_name("abuse_child.py")

#: Attempt → the function whose status must be fmi2Error, and words of the log message.
EXPECTED = {
    "wrong guid": ("Failed to instantiate", ["fmi2Instantiate", "00000000-0000-0000-0000-000000000000"]),
    "step before initialization": ("fmi2DoStep", ["fmi2DoStep"]),
    "exit before enter": ("fmi2ExitInitializationMode", ["fmi2ExitInitializationMode"]),
    "enter initialization twice": ("fmi2EnterInitializationMode", ["fmi2EnterInitializationMode"]),
    "input NaN": ("fmi2SetReal", ["fmi2SetReal", "NaN"]),
    "input +inf": ("fmi2SetReal", ["fmi2SetReal", "inf"]),
    "input -inf": ("fmi2SetReal", ["fmi2SetReal", "-inf"]),
    "h zero": ("fmi2DoStep", ["fmi2DoStep", "communicationStepSize"]),
    "h negative": ("fmi2DoStep", ["fmi2DoStep", "-1"]),
    "h NaN": ("fmi2DoStep", ["fmi2DoStep", "NaN"]),
    "h inf": ("fmi2DoStep", ["fmi2DoStep", "inf"]),
    "wrong communication point": ("fmi2DoStep", ["fmi2DoStep", "currentCommunicationPoint", "7"]),
    "NaN communication point": ("fmi2DoStep", ["fmi2DoStep", "NaN"]),
    "get of a bad value reference": ("fmi2GetReal", ["fmi2GetReal", "2147483647"]),
    "set of a bad value reference": ("fmi2SetReal", ["fmi2SetReal", "2147483647"]),
    "get of another type": ("fmi2GetInteger", ["fmi2GetInteger"]),
    "set of an output": ("fmi2SetReal", ["fmi2SetReal"]),
    "set of a fixed parameter": ("fmi2SetReal", ["fmi2SetReal"]),
    "a good value beside a bad one": ("fmi2SetReal", ["NaN"]),
    "terminate twice": ("fmi2Terminate", ["fmi2Terminate"]),
}


#: FMU → what every Real input is set to, and start values, so that the outputs move (the operator begins to push).
CASES = {
    "TestbedController": (3.0, {}),
    "Testbed": (3.0, {}),
    "ArmController": (0.3, {}),
    "ExoskeletonArm": (30.0, {}),
    "HumanOperator": (
        0.1,
        {"segment[1].axis": 3, "segment[1].kind": 2, "segment[1].t_on": 0.01, "segment[1].amplitude": 6.0, "k_h": 9.0},
    ),
}


@pytest.fixture(scope="module", params=CASES)
def outcome(request: pytest.FixtureRequest, fmu_dir: Path) -> dict[str, Any]:
    push, settings = CASES[request.param]
    child = subprocess.run(
        [sys.executable, CHILD, fmu_dir / f"{request.param}.fmu", str(push), json.dumps(settings)],
        capture_output=True,
        text=True,
        check=False,
        timeout=120,
    )
    assert child.returncode == 0, child.stderr
    return {**json.loads(child.stdout), "stderr": child.stderr}


def test_nothing_goes_to_stderr(outcome: dict[str, Any]) -> None:
    assert outcome["stderr"] == ""


def test_the_instance_runs_on_as_if_nothing_had_happened(outcome: dict[str, Any]) -> None:
    assert outcome["moved"]
    assert outcome["survived"]


def test_a_refused_value_is_named(outcome: dict[str, Any]) -> None:
    errors = next(errors for name, _, errors in outcome["report"] if name == "a good value beside a bad one")
    assert outcome["last_input"] in errors[0]


def test_every_attempt_was_made(outcome: dict[str, Any]) -> None:
    assert sorted(name for name, _, _ in outcome["report"]) == sorted(EXPECTED)


@pytest.mark.parametrize("attempt", EXPECTED)
def test_a_wrong_call_is_an_error_that_says_why(attempt: str, outcome: dict[str, Any]) -> None:
    function, words = EXPECTED[attempt]
    answer, errors = next((answer, errors) for name, answer, errors in outcome["report"] if name == attempt)
    assert function in answer
    if function.startswith("fmi2"):
        assert "status 3" in answer.lower() or "error" in answer.lower(), answer
    assert len(errors) == 1, errors
    assert all(word.lower() in errors[0].lower() for word in words), errors[0]
    assert "%" not in errors[0]
    assert not errors[0].endswith("\n")
