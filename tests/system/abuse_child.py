"""Child process of test_abuse: abuses one FMU through fmpy and prints what happened as JSON.

Every attempt is [name, outcome, messages logged by the FMU during it]. What is abused comes from the description: the
first Real input, the first Real output, the first fixed Real parameter; every Real input is pushed.
"""

import json
import math
import sys
from ctypes import byref
from typing import Any

import fmpy
from fmpy.fmi2 import (
    FMU2Slave,
    fmi2CallbackAllocateMemoryTYPE,
    fmi2CallbackFreeMemoryTYPE,
    fmi2CallbackFunctions,
    fmi2CallbackLoggerTYPE,
)
from fmpy.logging import addLoggerProxy

messages: list[list[Any]] = []


def log(_environment: int, _name: bytes, status: int, category: bytes, message: bytes) -> None:
    messages.append([status, category.decode(), message.decode()])


callbacks = fmi2CallbackFunctions()
callbacks.logger = fmi2CallbackLoggerTYPE(log)
callbacks.allocateMemory = fmi2CallbackAllocateMemoryTYPE(fmpy.calloc)
callbacks.freeMemory = fmi2CallbackFreeMemoryTYPE(fmpy.free)
addLoggerProxy(byref(callbacks))

path, push, settings = sys.argv[1], float(sys.argv[2]), json.loads(sys.argv[3])
description = fmpy.read_model_description(path)
folder = fmpy.extract(path)
variables = {v.name: v for v in description.modelVariables}
references = {name: v.valueReference for name, v in variables.items()}


def reals(**wanted: str) -> list[str]:
    return [
        name
        for name, v in variables.items()
        if v.type == "Real" and all(getattr(v, key) == value for key, value in wanted.items())
    ]


INPUTS, OUTPUTS = reals(causality="input"), reals(causality="output")
#: Inputs that refuse NaN: all but a controller's force sensor, whose faults are named instead.
STRICT = [name for name in INPUTS if not name.startswith(("f_h", "ft.")) or "ft.fault" not in variables]
INPUT, OUTPUT, FIXED = INPUTS[0], OUTPUTS[0], reals(causality="parameter", variability="fixed")[0]
T = float(description.defaultExperiment.stepSize)
report: list[list[Any]] = []


def make(name: str, guid: str | None = None) -> Any:
    instance = FMU2Slave(
        guid=guid or description.guid,
        unzipDirectory=folder,
        modelIdentifier=description.coSimulation.modelIdentifier,
        instanceName=name,
    )
    instance.instantiate(callbacks=callbacks, loggingOn=True)
    return instance


def attempt(name: str, call: Any) -> None:
    messages.clear()
    try:
        call()
        outcome = "OK"
    except Exception as error:
        outcome = str(error)
    errors = [text for status, category, text in messages if status == 3 and category == "logStatusError"]
    report.append([name, outcome, errors])


def steps(instance: Any, first: int, count: int) -> list[list[float]]:
    values = []
    for k in range(first, first + count):
        instance.setReal([references[name] for name in INPUTS], [push] * len(INPUTS))
        instance.doStep(k * T, T)
        values.append(instance.getReal([references[name] for name in OUTPUTS]))
    return values


def initialize(instance: Any) -> None:
    for name, value in settings.items():
        (instance.setReal if variables[name].type == "Real" else instance.setInteger)([references[name]], [value])
    instance.setupExperiment(startTime=0.0)
    instance.enterInitializationMode()
    instance.exitInitializationMode()


undisturbed = make("undisturbed")
initialize(undisturbed)
expected = steps(undisturbed, 0, 40)
undisturbed.freeInstance()

attempt("wrong guid", lambda: make("wrong", guid="{00000000-0000-0000-0000-000000000000}"))

x = make("abused")
attempt("step before initialization", lambda: x.doStep(0.0, T))
attempt("exit before enter", x.exitInitializationMode)
initialize(x)
attempt("enter initialization twice", x.enterInitializationMode)
values = steps(x, 0, 20)
for name, value in (("NaN", math.nan), ("+inf", math.inf), ("-inf", -math.inf)):
    attempt(f"input {name}", lambda value=value: x.setReal([references[INPUT]], [value]))
for name, h in (("zero", 0.0), ("negative", -1.0), ("NaN", math.nan), ("inf", math.inf)):
    attempt(f"h {name}", lambda h=h: x.doStep(20 * T, h))
attempt("wrong communication point", lambda: x.doStep(7.0, T))
attempt("NaN communication point", lambda: x.doStep(math.nan, T))
attempt("get of a bad value reference", lambda: x.getReal([0x7FFFFFFF]))
attempt("set of a bad value reference", lambda: x.setReal([0x7FFFFFFF], [1.0]))
attempt("get of another type", lambda: x.getInteger([references[INPUT]]))
attempt("set of an output", lambda: x.setReal([references[OUTPUT]], [1.0]))
attempt("set of a fixed parameter", lambda: x.setReal([references[FIXED]], [1.0]))
attempt(
    "a good value beside a bad one",
    lambda: x.setReal([references[INPUTS[0]], references[STRICT[-1]]], [1.0, math.nan]),
)


def make_terminated() -> None:
    instance = make("terminated")
    initialize(instance)
    instance.terminate()
    instance.terminate()


attempt("terminate twice", make_terminated)
values += steps(x, 20, 20)
x.freeInstance()

moved = len({tuple(row) for row in expected}) > 1
print(json.dumps({"report": report, "survived": values == expected, "moved": moved, "last_input": STRICT[-1]}))
