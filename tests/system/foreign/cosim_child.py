"""Child process of `cosim`: libcosim ends it with a segmentation fault when it refuses an FMU.

Reads a job as JSON and prints the outputs after each step:

| key | what |
|---|---|
| `step_ns`, `steps` | the communication step (ns), which libcosim counts in whole numbers, and how many |
| `ssp` | path of an SSP archive, or null; then the next three are empty |
| `instances` | name → path of an FMU |
| `start` | `name.variable` → start value |
| `connections` | input → output, both as `name.variable` |
| `inputs` | `name.variable` → a value for each step |
| `outputs` | `name.variable`s to print |
"""

import json
import sys

from libcosimpy.CosimEnums import CosimVariableType
from libcosimpy.CosimExecution import CosimExecution
from libcosimpy.CosimLogging import CosimLogLevel, log_output_level
from libcosimpy.CosimManipulator import CosimManipulator
from libcosimpy.CosimObserver import CosimObserver
from libcosimpy.CosimSlave import CosimLocalSlave

job = json.load(sys.stdin)
log_output_level(CosimLogLevel.INFO)
if job.get("ssp"):
    execution = CosimExecution.from_ssp_file(ssp_path=job["ssp"], step_size=job["step_ns"])
    indices = {slave.name.decode(): slave.index for slave in execution.slave_infos()}
else:
    execution = CosimExecution.from_step_size(step_size=job["step_ns"])
    indices = {
        instance: execution.add_local_slave(local_slave=CosimLocalSlave(fmu_path=path, instance_name=instance))
        for instance, path in job["instances"].items()
    }
known = {}
for instance, index in indices.items():
    for v in execution.slave_variables(index):
        known[f"{instance}.{v.name.decode()}"] = (index, v.reference, CosimVariableType(v.type))


def typed(kind, value):
    return {CosimVariableType.REAL: float, CosimVariableType.INTEGER: int, CosimVariableType.BOOLEAN: bool}[kind](value)


begin = {
    CosimVariableType.REAL: execution.real_initial_value,
    CosimVariableType.INTEGER: execution.integer_initial_value,
    CosimVariableType.BOOLEAN: execution.boolean_initial_value,
}
for key, value in job["start"].items():
    index, reference, kind = known[key]
    assert begin[kind](index, reference, typed(kind, value)), key
for target, source in job["connections"].items():
    (to, to_reference, _), (origin, origin_reference, _) = known[target], known[source]
    execution.connect_real_variables(origin, origin_reference, to, to_reference)

observer, override = CosimObserver.create_last_value(), CosimManipulator.create_override()
execution.add_observer(observer=observer)
execution.add_manipulator(manipulator=override)
read = {
    CosimVariableType.REAL: observer.last_real_values,
    CosimVariableType.INTEGER: observer.last_integer_values,
    CosimVariableType.BOOLEAN: observer.last_boolean_values,
}
write = {
    CosimVariableType.REAL: override.slave_real_values,
    CosimVariableType.INTEGER: override.slave_integer_values,
    CosimVariableType.BOOLEAN: override.slave_boolean_values,
}


def together(keys):
    """Keys by FMU and type, which one call reads or writes together."""
    groups = {}
    for key in keys:
        index, reference, kind = known[key]
        groups.setdefault((index, kind), []).append((key, reference))
    return groups.items()


found = {key: [] for key in job["outputs"]}
for k in range(job["steps"]):
    for (index, kind), group in together(job["inputs"]):
        values = [typed(kind, job["inputs"][key][k]) for key, _ in group]
        assert write[kind](index, [reference for _, reference in group], values), group
    assert execution.step()
    for (index, kind), group in together(found):
        values = read[kind](index, [reference for _, reference in group])
        for (key, _), value in zip(group, values, strict=True):
            found[key].append(value)
print("found", json.dumps(found))
