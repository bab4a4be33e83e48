"""Experiments of the paper on FMUs: scenario (data) → simulate → recording → metrics → verdict → report.

Numbers are SI; names are the FMUs' variable names, prefixed with the component's name: `controller.e_nr`, `plant.q`.
The harness loads archives and knows nothing of how they were made.
"""

from typing import TYPE_CHECKING, Any

__version__ = "0.1.0"

if TYPE_CHECKING:
    from exo.runs import batch

__all__ = ["__version__", "batch"]


def __getattr__(name: str) -> Any:
    # Imported when it is asked for: the command line has its version and its help without it.
    if name == "batch":
        from exo.runs import batch  # noqa: PLC0415

        return batch
    raise AttributeError(f"module exo has no {name}")
