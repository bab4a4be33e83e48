"""Experiments of the paper on FMUs: scenario (data) → simulate → recording → metrics → verdict → report.

Numbers are SI; names are the FMUs' variable names, prefixed with the component's name: `controller.e_nr`, `plant.q`.
The harness loads archives and knows nothing of how they were made.
"""

__version__ = "0.1.0"
