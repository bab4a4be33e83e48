"""Mutants of the FMU that moves: dynamic rules in both versions of the standard, and what an FMI 3.0 library does."""

from broken.mutants import Mutant, edit, nothing

MOVING2, MOVING3 = "Moving2", "Moving3"
BOTH = (MOVING2, MOVING3)

#: Rule, what is broken, the macro, and for which versions.
DYNAMIC = [
    ("run-repeat", "a number that grows with each run", "UNREPEATABLE", BOTH),
    ("run-order", "reading counts", "READS_COUNT", BOTH),
    ("run-state", "the place is not in it", "STATE_WITHOUT_X", BOTH),
    ("run-state", "it works once", "STATE_ONCE", BOTH),
    ("run-serialized", "the place is not in it", "SERIAL_WITHOUT_X", BOTH),
    ("run-serialized", "in the same instance only", "SERIAL_OWN", BOTH),
    ("run-reset", "the place stays", "RESET_KEEPS_X", BOTH),
    ("run-reset", "a parameter stays", "RESET_KEEPS_K", BOTH),
    ("run-reset", "refused", "RESET_REFUSED", BOTH),
    ("run-instances", "one state for all", "SHARED", BOTH),
    ("run-step-size", "one size only", "STEP_FIXED", BOTH),
    ("run-step-size", "odd sizes leave a trace", "STEP_DRIFTS", BOTH),
    ("run-not-finite", "a crash", "NAN_CRASHES", BOTH),
    ("run-not-finite", "it stays after a reset", "NAN_STAYS", BOTH),
    ("run-stop-time", "passed by", "STOP_IGNORED", BOTH),
    ("run-log-set", "one is refused", "LOG_REFUSED", BOTH),
    ("run-log-category", "a secret one in a step", "LOG_SECRET", BOTH),
    ("run-log-category", "a secret one for an error", "LOG_SECRET_ERROR", BOTH),
    ("run-ending", "NULL crashes", "NULL_CRASHES", BOTH),
    ("run-ending", "freed in the middle of a run", "EARLY_FREE_CRASHES", BOTH),
    ("run-ending", "a second run crashes", "SECOND_RUN_CRASHES", BOTH),
    ("run-event-mode", "no end", "EVENT_ENDLESS", (MOVING3,)),
    ("run-event-mode", "refused", "EVENT_REFUSED", (MOVING3,)),
    ("run-early-return", "though not allowed", "EARLY", (MOVING3,)),
    ("run-early-return", "beyond the step", "LATE", (MOVING3,)),
]
BEHAVIOUR = [
    Mutant(rule, f"{what}, {base}", nothing, base, macros=(f"-D{macro}",))
    for rule, what, macro, bases in DYNAMIC
    for base in bases
]
RUN3 = [
    Mutant("load-version", "FMI 3.1, Moving3", nothing, MOVING3, macros=('-DVERSION="3.1"',)),
    Mutant("load-instantiate", "another token, Moving3", edit(".", instantiationToken="{other}"), MOVING3),
    Mutant("load-guid", "takes any token, Moving3", nothing, MOVING3, macros=("-DANY_TOKEN",)),
    Mutant("load-read", "no arrays, Moving3", nothing, MOVING3, macros=("-DNO_ARRAYS",)),
    Mutant("load-start", "a Float32, Moving3", nothing, MOVING3, macros=("-DOTHER_START",)),
    Mutant("load-start", "an array, Moving3", edit("ModelVariables/Float64[@name='x']", start="0 1"), MOVING3),
    Mutant("load-start", "a Binary, Moving3", edit("ModelVariables/Binary/Start", value="00fe"), MOVING3),
    Mutant("load-start", "a String, Moving3", edit("ModelVariables/String/Start", value="a  place"), MOVING3),
    Mutant("load-bounds", "an element, Moving3", edit("ModelVariables/Float64[@name='x']", min="1"), MOVING3),
    Mutant("binary-exports", "74 functions, Moving3", nothing, MOVING3, macros=("-DINCOMPLETE",)),
]
