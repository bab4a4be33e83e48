"""Runs the task from stdin."""

import json
import sys
from pathlib import Path
from typing import Any

from exo.probe import inspection, loading, trials


def main() -> None:
    """Appends a JSON line for each fact; the last one says that the task is done."""
    task = json.load(sys.stdin)
    with Path(sys.argv[1]).open("a", encoding="utf-8") as file:

        def tell(fact: dict[str, Any]) -> None:
            file.write(json.dumps(fact) + "\n")
            file.flush()

        tasks = {"load": loading.load, "inspect": inspection.inspect, "trial": trials.run}
        tasks[task["task"]](task, tell)
        tell({"done": True})


if __name__ == "__main__":
    main()
