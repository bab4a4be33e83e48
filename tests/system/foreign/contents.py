"""What is in a folder, so that a change of it can be seen."""

import hashlib
from pathlib import Path


def contents(folder: Path) -> dict[str, str]:
    """Every entry of a folder, a file by what is in it."""
    return {
        str(entry.relative_to(folder)): hashlib.sha256(entry.read_bytes()).hexdigest() if entry.is_file() else ""
        for entry in folder.rglob("*")
    }
