"""Runs the notebooks of docs/notebooks; `python tests/system/notebooks.py` writes their outputs anew.

They read `results/`: `exo run wall` first.
"""

from pathlib import Path
from typing import Any

import nbformat
from nbclient import NotebookClient

FOLDER = Path(__file__).resolve().parents[2] / "docs" / "notebooks"
NOTEBOOKS = sorted(FOLDER.glob("*.ipynb"))


def executed(path: Path, *, folder: Path) -> Any:
    """The notebook with its outputs, run in `folder`; without times, which differ from run to run."""
    notebook = nbformat.read(path, as_version=4)
    NotebookClient(notebook, timeout=300, resources={"metadata": {"path": str(folder)}}).execute()
    for cell in notebook.cells:
        cell.metadata.pop("execution", None)
    notebook.metadata["language_info"] = {"name": "python"}
    return notebook


def texts(notebook: Any) -> list[str]:
    """What the cells have printed, and the texts of what they show, without those of pictures."""
    found = []
    for cell in notebook.cells:
        for output in cell.get("outputs", ()):
            shown = output.get("data", {})
            if "image/png" not in shown:
                found.append(output.get("text") or shown.get("text/html") or shown.get("text/plain"))
    return found


def pictures(notebook: Any) -> list[str]:
    """What the cells have drawn, as base64."""
    outputs = [output for cell in notebook.cells for output in cell.get("outputs", ())]
    return [output["data"]["image/png"] for output in outputs if "image/png" in output.get("data", {})]


if __name__ == "__main__":
    for notebook in NOTEBOOKS:
        nbformat.write(executed(notebook, folder=FOLDER), notebook)
