"""Requirements as formulas of signal temporal logic over a scenario's signals: each has a margin in its own unit.

`requirements.toml` holds those of the paper (section II) and of this project; a file of one's own has the same form
(docs/requirements.md). rtamt reads and evaluates the formulas.
"""

from exo.requirements.document import Requirement, Requirements, Shown, built_in, load
from exo.requirements.judged import PREFIX, results
from exo.requirements.places import check, check_cases, scenario_of

__all__ = [
    "PREFIX",
    "Requirement",
    "Requirements",
    "Shown",
    "built_in",
    "check",
    "check_cases",
    "load",
    "results",
    "scenario_of",
]
