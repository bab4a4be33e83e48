"""Couples FMUs and runs them, and repeats the paper's experiments with them: scenario (data) → run → metrics → verdict.

    import exo
    exo.load("Testbed.fmu")                                    # its variables, with units and start values
    system = exo.couple({"plant": "Testbed.fmu"}, step=0.002)
    run = exo.simulate(system, duration=6.0, inputs={"plant.tau_h": 1.0})
    run.plot("plant.q", "plant.dq")                            # run.frame(), run.dataset(), run.save("push.csv")

`__all__` is the public interface; its manual is docs/python.md. The modules below `exo` are what it is made of and may
change from version to version.

Numbers are SI; names are the FMUs' variable names, prefixed with the component's name: `controller.e_nr`, `plant.q`.
The harness loads archives and knows nothing of how they were made.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

__version__ = "0.1.0"

if TYPE_CHECKING:
    from exo.api.fmu import Fmu, Variable, load
    from exo.api.run import Run, read_run
    from exo.api.simulating import read_scenario, simulate
    from exo.api.system import System, couple
    from exo.errors import ExoError, FmuError, ScenarioError
    from exo.runs import batch
    from exo.scenario import Scenario

__all__ = [
    "ExoError",
    "Fmu",
    "FmuError",
    "Run",
    "Scenario",
    "ScenarioError",
    "System",
    "Variable",
    "__version__",
    "batch",
    "couple",
    "load",
    "read_run",
    "read_scenario",
    "simulate",
]

#: Where each name is. A name is imported when it is asked for: the command line has its version without any of them.
_PLACES = {
    "ExoError": "errors",
    "Fmu": "api.fmu",
    "FmuError": "errors",
    "Run": "api.run",
    "Scenario": "scenario",
    "ScenarioError": "errors",
    "System": "api.system",
    "Variable": "api.fmu",
    "batch": "runs",
    "couple": "api.system",
    "load": "api.fmu",
    "read_run": "api.run",
    "read_scenario": "api.simulating",
    "simulate": "api.simulating",
}


def __getattr__(name: str) -> Any:
    if name not in _PLACES:
        raise AttributeError(f"module exo has no {name}")
    return getattr(import_module(f"exo.{_PLACES[name]}"), name)


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
