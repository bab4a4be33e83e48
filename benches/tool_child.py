"""Child process of `peers`: another tool's threads stay out of the process that measures. Not imported.

Reads a job as JSON and prints the seconds that its steps took, by the clock or by the process' time, whichever is less.

| key | what |
|---|---|
| `tool` | `libcosim`, `ecos`, `ecos with its CSV writer` |
| `folder` | where the archives lie |
| `ssp`, `set` | for Ecos: path of an SSP archive, name of the parameter sets |
| `csv`, `tbb` | for Ecos: what it writes, path of the library libtbb.so.12 |
| `step`, `steps` | the macro step (s), and how many |
"""

import ctypes
import json
import os
import sys
from collections.abc import Callable
from time import perf_counter, process_time
from typing import Any


def libcosim(job: dict[str, Any]) -> Callable[[], None]:
    """The testbed's pair with a time series observer of all Reals."""
    from libcosimpy.CosimEnums import CosimVariableType  # noqa: PLC0415 - only this tool is needed
    from libcosimpy.CosimExecution import CosimExecution  # noqa: PLC0415
    from libcosimpy.CosimLogging import CosimLogLevel, log_output_level  # noqa: PLC0415
    from libcosimpy.CosimObserver import CosimObserver  # noqa: PLC0415
    from libcosimpy.CosimSlave import CosimLocalSlave  # noqa: PLC0415

    log_output_level(CosimLogLevel.WARNING)
    execution = CosimExecution.from_step_size(step_size=round(1e9 * job["step"]))
    known = {}
    for name, file in (("controller", "TestbedController"), ("plant", "Testbed")):
        slave = CosimLocalSlave(fmu_path=f"{job['folder']}/{file}.fmu", instance_name=name)
        index = execution.add_local_slave(local_slave=slave)
        for v in execution.slave_variables(index):
            known[f"{name}.{v.name.decode()}"] = (index, v.reference, CosimVariableType(v.type), v.causality)
    for source, target in (("plant.q", "controller.q"), ("controller.tau_a", "plant.tau_a")):
        execution.connect_real_variables(*known[source][:2], *known[target][:2])
    for name in ("controller", "plant"):
        execution.real_initial_value(*known[f"{name}.tau_h"][:2], 3.0)
    observer = CosimObserver.create_time_series(buffer_size=job["steps"] + 2)
    execution.add_observer(observer=observer)
    for index, reference, kind, causality in known.values():
        if kind is CosimVariableType.REAL and causality == 0:
            observer.start_time_series(index, reference, kind)
    execution.step()

    def steps() -> None:
        assert execution.step(step_count=job["steps"])

    return steps


def ecos(job: dict[str, Any]) -> Callable[[], None]:
    """The closed testbed, without a recording or with a CSV file of all variables."""
    ctypes.CDLL(job["tbb"], mode=ctypes.RTLD_GLOBAL)
    from ecospy import EcosLib, EcosSimulation  # noqa: PLC0415 - its library needs the one above

    EcosLib.set_log_level("warn")
    simulation = EcosSimulation(ssp_path=job["ssp"], step_size=job["step"])
    if job["tool"] != "ecos":
        simulation.add_csv_writer(job["csv"])
    assert simulation.init(parameter_set=job["set"]), EcosLib.get_last_error()
    simulation.step(1)

    def steps() -> None:
        simulation.step(job["steps"])

    return steps


def main() -> None:
    """Does the job."""
    job = json.load(sys.stdin)
    if hasattr(os, "sched_setaffinity"):
        os.sched_setaffinity(0, job["cores"])  # its threads may use them all
    steps = libcosim(job) if job["tool"] == "libcosim" else ecos(job)
    began = perf_counter(), process_time()
    steps()
    print("took", min(perf_counter() - began[0], process_time() - began[1]), flush=True)
    os._exit(0)  # what a tool does at its end is not measured


if __name__ == "__main__":
    main()
