"""What an FMU does when it is used as the standard allows: one experiment a process.

A trial that comes to its end has passed. `WrongError` says that its rule is broken, `SkipError` that it cannot judge
this FMU.
"""

from collections.abc import Callable
from contextlib import suppress
from math import inf, isfinite, nan
from typing import Any

from exo.probe.fmi3 import MAX_ROUNDS, Library3
from exo.probe.library import GOOD, MAX_MESSAGES, Tell, Variable, status
from exo.probe.loading import opened
from exo.probe.subject import STEPS, SkipError, Subject, WrongError, next_to

#: A value reference that hardly any FMU has.
NOWHERE = 4_123_456_789
#: Uneven steps, as shares of the usual one.
SHARES = (0.5, 1.0, 2.0, 1.0 / 3.0, 1.0)


def repeat(fmu: Subject) -> None:
    """Two instances, one after the other."""
    traces = []
    for _ in range(2):
        instance = fmu.started()
        traces.append(fmu.run(instance))
        fmu.close(instance)
    fmu.same(traces[1], traces[0], "in the second of two equal runs")


def order(fmu: Subject) -> None:
    """Outputs that are read forwards, backwards and again."""
    instance = fmu.started()
    for number in range(STEPS):
        fmu.run(instance, first=number, steps=1)
        forwards = fmu.read(instance)
        backwards = fmu.read(instance, fmu.outputs[::-1])[::-1]
        fmu.same([backwards], [forwards], "when the outputs are read in another order")
        fmu.same([fmu.read(instance)], [forwards], "when the outputs are read again")
    fmu.close(instance)


def state(fmu: Subject) -> None:
    """Get, step, set, step, set, step."""
    instance = fmu.started()
    fmu.run(instance, states_are_left=True)
    answer, copy = fmu.fmu.get_state(instance)
    fmu.must("getting the FMU state", answer)
    before = fmu.read(instance)
    ahead = fmu.run(instance, first=STEPS, states_are_left=True)
    for time in ("first", "second"):
        fmu.must("setting the FMU state", fmu.fmu.set_state(instance, copy))
        fmu.same([fmu.read(instance)], [before], f"after the FMU state was set the {time} time")
        again = fmu.run(instance, first=STEPS, states_are_left=True)
        fmu.same(again, ahead, f"after the FMU state was set the {time} time")
    fmu.must("freeing the FMU state", fmu.fmu.free_state(instance, copy))
    fmu.close(instance)


def serialized(fmu: Subject) -> None:
    """Serialize; deserialize in the same instance and in another one."""
    instance = fmu.started()
    fmu.run(instance, states_are_left=True)
    answer, copy = fmu.fmu.get_state(instance)
    fmu.plain("getting the FMU state", answer)
    answer, data = fmu.fmu.serialized(instance, copy)
    fmu.must("serializing the FMU state", answer)
    fmu.fmu.free_state(instance, copy)
    ahead = fmu.run(instance, first=STEPS, states_are_left=True)
    places = [(instance, "in the same instance")]
    if not fmu.fmu.task["once"]:
        places.append((fmu.started(), "in another instance"))
    for other, where in places:
        answer, copy = fmu.fmu.deserialized(other, data)
        fmu.must(f"deserializing the FMU state {where}", answer)
        fmu.must(f"setting the deserialized FMU state {where}", fmu.fmu.set_state(other, copy))
        fmu.same(fmu.run(other, first=STEPS, states_are_left=True), ahead, f"from the deserialized FMU state {where}")
        fmu.fmu.free_state(other, copy)
    fmu.close(*(other for other, _ in places))


def reset(fmu: Subject) -> None:
    """A used instance that is reset, in the middle of a run and after its end, against a fresh one."""
    fresh = fmu.new()
    values, trace = _read_and_run(fmu, fresh)
    fmu.close(fresh)
    instance = _with_other_parameters(fmu)
    for end in ("in the middle of a run", "after a run"):
        if end == "after a run":
            fmu.start(instance)
        fmu.run(instance, seed=3)
        if end == "after a run":
            fmu.plain("ending the run", fmu.fmu.terminate(instance))
        fmu.must(f"{fmu.fmu.prefix}Reset {end}", fmu.fmu.reset(instance))
        again, rerun = _read_and_run(fmu, instance)
        fmu.same([again], [values], f"after a reset {end}", fmu.told)
        fmu.same(rerun, trace, f"after a reset {end}")
        fmu.must(f"{fmu.fmu.prefix}Reset", fmu.fmu.reset(instance))
    fmu.fmu.free(instance)


def _with_other_parameters(fmu: Subject) -> Any:
    """A started instance, of whose parameters as many as possible are not those of the description."""
    half = len(fmu.parameters) // 2
    for chosen in (fmu.parameters, fmu.parameters[:half], fmu.parameters[half:]):
        instance = fmu.new()
        if all(fmu.fmu.set(instance, variable, next_to(variable)) in GOOD for variable in chosen):
            with suppress(SkipError):  # a law may want two of them to be equal
                fmu.start(instance)
                return instance
        fmu.fmu.free(instance)
    return fmu.started()


def _read_and_run(fmu: Subject, instance: Any) -> tuple[list[Any], list[list[Any]]]:
    """What is read after initialization, when nothing was set, and a run."""
    fmu.start(instance)
    return fmu.read(instance, fmu.told), fmu.run(instance)


def instances(fmu: Subject) -> None:
    """Two instances step by turns, against each alone; then one goes on when the other is gone."""
    alone = []
    for seed in (0, 3):
        instance = fmu.started()
        alone.append(fmu.run(instance, steps=2 * STEPS, seed=seed))
        fmu.close(instance)
    first, second = fmu.started(), fmu.started()
    traces: tuple[list[Any], list[Any]] = ([], [])
    for number in range(STEPS):
        traces[0].extend(fmu.run(first, first=number, steps=1))
        traces[1].extend(fmu.run(second, first=number, steps=1, seed=3))
    fmu.close(second)
    traces[0].extend(fmu.run(first, first=STEPS))
    fmu.close(first)
    for trace, expected in zip(traces, alone, strict=True):
        fmu.same(trace, expected[: len(trace)], "when another instance runs in the same process")


def step_size(fmu: Subject) -> None:
    """Half a step, a whole one, two, a third, and a whole one; where steps may differ, all are accepted."""
    traces = []
    for _ in range(2):
        instance, time, trace = fmu.started(), fmu.start_time, []
        for number, share in enumerate(SHARES):
            fmu.feed(instance, number)
            size = share * fmu.size
            answer = fmu.fmu.step(instance, time, size)
            if answer not in GOOD:
                if fmu.fmu.task["variable step"]:
                    fmu.must(f"a step of {size:g} s at {time:g} s", answer)
                # Refused, as it may be.
                break
            time += size
            trace.append(fmu.read(instance))
        traces.append(trace)
        (fmu.close if len(trace) == len(SHARES) else fmu.fmu.free)(instance)
    fmu.same(traces[1], traces[0], "in the second of two equal runs with uneven steps")


def not_finite(fmu: Subject) -> None:
    """NaN and infinities in all inputs: refused or survived, and a reset leads back."""
    if not fmu.inputs:
        raise SkipError("it has no floating-point input")
    fresh = fmu.started()
    trace = fmu.run(fresh)
    fmu.close(fresh)
    for value in (nan, inf, -inf):
        instance = fmu.started()
        for variable in fmu.inputs:
            if fmu.fmu.set(instance, variable, [value] * variable.count) not in GOOD:
                break
        else:
            for number in range(STEPS):
                if fmu.fmu.step(instance, fmu.start_time + number * fmu.size, fmu.size) not in GOOD:
                    break
                fmu.read(instance)
        if fmu.fmu.reset(instance) in GOOD:
            fmu.start(instance)
            fmu.same(fmu.run(instance), trace, f"after inputs of {value} and a reset")
            fmu.fmu.terminate(instance)
        fmu.fmu.free(instance)


def stop_time(fmu: Subject) -> None:
    """A step that leads beyond the stop time."""
    stop = fmu.start_time + 2 * fmu.size
    instance = fmu.started(stop=stop)
    fmu.run(instance, steps=2)
    answer = fmu.fmu.step(instance, stop, fmu.size)
    if answer in GOOD or status(answer) == "Discard":
        value = (
            f"a step from the stop time {stop:g} s to {stop + fmu.size:g} s returned {fmu.fmu.prefix}{status(answer)}"
        )
        raise WrongError(value, f"{fmu.fmu.prefix}Error")
    fmu.fmu.free(instance)


def log_set(fmu: Subject) -> None:
    """Each declared category is switched on and off."""
    if not fmu.fmu.task["categories"]:
        raise SkipError("it declares no log category")
    instance = fmu.new(logging=True)
    for name in fmu.fmu.task["categories"]:
        for on in (False, True):
            answer = fmu.fmu.debug_logging(instance, on, [name])
            fmu.must(f"{fmu.fmu.prefix}SetDebugLogging {'on' if on else 'off'} for {name}", answer)
    fmu.must(f"{fmu.fmu.prefix}SetDebugLogging for all categories", fmu.fmu.debug_logging(instance, True, []))
    fmu.fmu.free(instance)


def log_category(fmu: Subject) -> None:
    """Everything is logged, through a run and for a variable that is not there."""
    declared = fmu.fmu.task["categories"]
    instance = fmu.started(logging=True)
    fmu.run(instance)
    _categories(fmu, declared)
    # A wrong call is no use of the standard: what happens in it is not judged, but what is logged is.
    fmu.fmu.tell({"beyond": True})
    kind = next((one.kind for one in fmu.told if one.kind != "Binary"), None)
    if kind is not None:
        fmu.fmu.get(instance, Variable(0, kind, NOWHERE))
    _categories(fmu, declared)
    fmu.fmu.free(instance)
    _categories(fmu, declared)


def _categories(fmu: Subject, declared: list[str]) -> None:
    messages = fmu.fmu.messages
    for category, text in messages[:MAX_MESSAGES]:
        if category not in declared and not (category is None and not declared):
            value = f"a message of category {'NULL' if category is None else category!r}: {text}"
            raise WrongError(value, f"one of {', '.join(declared)}" if declared else "NULL, as no category is declared")


def ending(fmu: Subject) -> None:
    """Instances that are freed at each point of their life, and none at all."""
    fmu.fmu.free(fmu.new())
    fmu.fmu.free(fmu.started())
    instance = fmu.started()
    fmu.run(instance)
    fmu.fmu.free(instance)
    instance = fmu.started()
    fmu.run(instance)
    fmu.must(f"{fmu.fmu.prefix}Terminate", fmu.fmu.terminate(instance))
    fmu.must(f"{fmu.fmu.prefix}Reset after it", fmu.fmu.reset(instance))
    fmu.start(instance)
    fmu.run(instance)
    fmu.must(f"{fmu.fmu.prefix}Terminate after a reset", fmu.fmu.terminate(instance))
    fmu.fmu.free(instance)
    if not fmu.fmu.task["once"]:
        first, second, third = fmu.started(), fmu.started(), fmu.started()
        fmu.fmu.free(second)
        fmu.run(third)
        fmu.fmu.free(first)
        fmu.fmu.free(third)
    fmu.fmu.free(None)


def event_mode(fmu: Subject) -> None:
    """Into event mode and out again after initialization and between steps."""
    library = _third(fmu)
    instance = fmu.started(event_mode=True)
    for number in range(STEPS):
        answer, settled = library.handle_event(instance, enter=number > 0)
        fmu.must("event mode", answer)
        if not settled:
            raise WrongError(f"fmi3UpdateDiscreteStates asks for more after {MAX_ROUNDS} rounds", "an end")
        fmu.run(instance, first=number, steps=1)
        if library.last_step.terminate:
            break
    fmu.close(instance)


def early_return(fmu: Subject) -> None:
    """No early return where it is not allowed; where it is asked for, the time says how far the step came."""
    library = _third(fmu)
    instance = fmu.started()
    for number in range(STEPS):
        fmu.run(instance, first=number, steps=1)
        _time_is_within(library, fmu.start_time + number * fmu.size, fmu.size)
        if library.last_step.early:
            raise WrongError("earlyReturn is true, but earlyReturnAllowed was false", "the whole step")
    fmu.close(instance)
    if not library.task["early return"]:
        return
    instance = fmu.started(early=True)
    time = fmu.start_time
    for number in range(STEPS):
        fmu.feed(instance, number)
        asked = library.early_returns
        fmu.must(f"a step at {time:.17g} s", library.step(instance, time, fmu.size))
        _time_is_within(library, time, fmu.size)
        early = library.last_step.early
        if early and library.early_returns == asked and not library.task["may return early"]:
            raise WrongError("an early return that nobody asked for", "mightReturnEarlyFromDoStep, or the whole step")
        time = library.last_step.last if early else time + fmu.size
        if library.last_step.terminate:
            break
    fmu.close(instance)


def _time_is_within(library: Library3, time: float, size: float) -> None:
    last = library.last_step.last
    if not isfinite(last) or not time - 1e-9 * size <= last <= time + size * (1.0 + 1e-6) + 1e-9 * abs(time):
        raise WrongError(f"lastSuccessfulTime {last!r}", f"between {time!r} and {time + size!r}")


def _third(fmu: Subject) -> Library3:
    assert isinstance(fmu.fmu, Library3)
    return fmu.fmu


TRIALS: dict[str, Callable[[Subject], None]] = {
    trial.__name__: trial
    for trial in (
        *(repeat, order, state, serialized, reset, instances, step_size, not_finite, stop_time, log_set),
        *(log_category, ending, event_mode, early_return),
    )
}


def run(task: dict[str, Any], tell: Tell) -> None:
    """Runs one trial and tells what is wrong, or why it does not apply."""
    fmu = opened(task, tell)
    if fmu is None:
        return
    try:
        TRIALS[task["trial"]](Subject(fmu, task))
    except WrongError as wrong:
        tell({"wrong": list(wrong.args)})
    except SkipError as reason:
        tell({"skip": str(reason)})
