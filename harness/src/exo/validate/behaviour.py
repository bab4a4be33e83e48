"""Dynamic rules: an FMU is used as the standard allows, each time in a process of its own, and must keep its word.

What is done stands in `exo.probe.trials`; here stand the rules, for which FMUs they hold, and the verdicts.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial
from typing import Any

from exo.validate import child
from exo.validate.description import Description
from exo.validate.rule import Finding, Rule, error, printable, warning

REPEAT = warning("run-repeat", "two equal runs have equal outputs, bit for bit")
ORDER = warning("run-order", "the outputs do not depend on the order and number of reads")
STATE = error(
    "run-state", "after an FMU state is set, a run goes on as it did from there, bit for bit, as often as one likes"
)
SERIALIZED = error("run-serialized", "so it does from a deserialized state, in the same instance and in another one")
RESET = error("run-reset", "an instance that is reset is as a fresh one: values and outputs, bit for bit")
INSTANCES = error("run-instances", "two instances do not disturb each other, nor does one that is freed")
STEP_SIZE = error(
    "run-step-size",
    "uneven steps are accepted if canHandleVariableCommunicationStepSize says so; equal runs are equal, bit for bit",
)
NOT_FINITE = warning("run-not-finite", "NaN and infinity as inputs are refused or survived, and a reset forgets them")
STOP_TIME = error("run-stop-time", "a step beyond a stop time that was defined returns fmi2Error, fmi3Error")
LOG_SET = error("run-log-set", "each declared log category can be switched on and off")
LOG_CATEGORY = error("run-log-category", "log messages carry declared categories only")
ENDING = error("run-ending", "instances can be freed at each point of their life, in any order, and NULL is ignored")
EVENT_MODE = error(
    "run-event-mode", "with hasEventMode, event mode is entered and left, and comes to an end", only="3.0"
)
EARLY = error(
    "run-early-return", "a step returns early only when that is allowed, and says how far it came", only="3.0"
)


@dataclass(frozen=True)
class Verdict:
    """How one dynamic rule ended for one FMU."""

    rule: str
    #: passed, failed or skipped.
    verdict: str
    #: Why it was skipped, or what failed.
    reason: str = ""

    def __str__(self) -> str:
        return f"{self.verdict}: {self.rule}{f': {self.reason}' if self.reason else ''}"


@dataclass(frozen=True)
class Trial:
    """A rule, the experiment that judges it, and why an FMU may be left out."""

    rule: Rule
    name: str
    #: A reason to skip this FMU, empty for none.
    left_out: Callable[[Description], str] = lambda _: ""
    #: Whether it compares runs with each other, which says nothing of an FMU that never repeats itself.
    compares: bool = True


def _without(capability: Callable[[Description], str], description: Description) -> str:
    name = capability(description)
    return "" if description.capability(name) else f"{name} is false"


def _once(description: Description) -> str:
    name = "canBeInstantiatedOnlyOncePerProcess"
    return f"{name} is true" if description.capability(name) else ""


def _steps(description: Description) -> str:
    scheduled = description.interface is not None and description.interface.tag == "ScheduledExecution"
    return "scheduled execution has no communication steps" if scheduled else ""


def _events(description: Description) -> str:
    return _steps(description) or _without(lambda _: "hasEventMode", description)


TRIALS = (
    Trial(REPEAT, "repeat"),
    Trial(ORDER, "order"),
    Trial(STATE, "state", partial(_without, lambda one: one.version.get_state)),
    Trial(SERIALIZED, "serialized", partial(_without, lambda one: one.version.serialize)),
    Trial(RESET, "reset"),
    Trial(INSTANCES, "instances", _once),
    Trial(STEP_SIZE, "step_size", _steps),
    Trial(NOT_FINITE, "not_finite"),
    Trial(STOP_TIME, "stop_time", _steps, compares=False),
    Trial(LOG_SET, "log_set", compares=False),
    Trial(LOG_CATEGORY, "log_category", compares=False),
    Trial(ENDING, "ending", compares=False),
    Trial(EVENT_MODE, "event_mode", _events, compares=False),
    Trial(EARLY, "early_return", _steps, compares=False),
)


def findings(
    description: Description, task: dict[str, Any], where: str, verdicts: list[Verdict], *, broken: bool
) -> Iterator[Finding]:
    """All of this module's rules; adds a verdict for each. `broken`: a plain run has failed already."""
    repeats = True
    for trial in TRIALS:
        if trial.rule.only not in ("", description.version.name):
            continue
        reason = "a plain run fails already: see load-…" if broken else trial.left_out(description)
        if trial.compares and not task["outputs"]:
            reason = reason or "it has no output that could be compared"
        if not repeats and trial.compares:
            reason = f"equal runs differ: see {REPEAT.id}"
        if reason:
            verdicts.append(Verdict(trial.rule.id, "skipped", reason))
            continue
        found, verdict = _judged(trial, child.run(task | {"task": "trial", "trial": trial.name}), where)
        verdicts.append(verdict)
        yield from found
        repeats = repeats and (trial.rule is not REPEAT or verdict.verdict != "failed")


def _judged(trial: Trial, answer: child.Answer, where: str) -> tuple[list[Finding], Verdict]:
    found = [trial.rule.at(where, *wrong) for wrong in answer.facts("wrong")]
    # What happens after a call that the standard does not allow is nobody's fault but the caller's.
    if answer.ended and not found and not answer.facts("beyond"):
        found = [trial.rule.at(where, answer.end, "a run to its end")]
    if found:
        return found, Verdict(trial.rule.id, "failed", found[0].value)
    for reason in answer.facts("skip"):
        return [], Verdict(trial.rule.id, "skipped", printable(reason))
    return [], Verdict(trial.rule.id, "passed")
