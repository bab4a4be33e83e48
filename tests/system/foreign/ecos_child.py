"""Child process of `ecos`: Ecos and its threads stay out of the process that tests.

Reads a job as JSON and prints the outputs after each step:

| key | what |
|---|---|
| `tbb` | path of the library libtbb.so.12, which Ecos needs |
| `ssp` | path of an SSP archive |
| `set` | name of the parameter sets to apply, one at each component |
| `step`, `steps` | the communication step (s), and how many |
| `outputs` | `component.variable` → Real, Integer or Boolean |
"""

import ctypes
import json
import sys

job = json.load(sys.stdin)
ctypes.CDLL(job["tbb"], mode=ctypes.RTLD_GLOBAL)

from ecospy import EcosLib, EcosSimulation  # noqa: E402 - its library needs the one above

EcosLib.set_log_level("warn")
found: dict[str, list[float]] = {key: [] for key in job["outputs"]}
with EcosSimulation(ssp_path=job["ssp"], step_size=job["step"]) as simulation:
    read = {
        "Real": simulation.get_real,
        "Integer": simulation.get_integer,
        "Boolean": simulation.get_bool,
    }
    assert simulation.init(parameter_set=job["set"]), EcosLib.get_last_error()
    for _ in range(job["steps"]):
        simulation.step()
        for key, kind in job["outputs"].items():
            found[key].append(read[kind](key.replace(".", "::", 1)))
    simulation.terminate()
print("found", json.dumps(found))
