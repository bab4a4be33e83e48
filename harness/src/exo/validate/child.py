"""A process of its own for foreign machine code: what it does to itself, the checker survives and reports.

`run` starts the process and gives it a task as JSON; the process appends one JSON line for each fact to a file, so that
all facts from before a crash are kept. Its standard streams belong to the FMU: whatever comes there is a fact, too.
"""

import json
import signal
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import Any

#: For loading, one step and reading all variables. The slowest of this project's FMUs needs a hundredth of it.
TIMEOUT_S = 60.0
#: Run by its path: as a module it would import the whole package first.
PROBE = Path(__file__).with_name("probe.py")


@dataclass(frozen=True)
class Answer:
    """What the process said, and how it ended."""

    lines: tuple[dict[str, Any], ...]
    #: Empty for a process that came to its end; else signal, exit code or timeout.
    ended: str
    #: What came on the standard streams.
    output: str

    def facts(self, name: str) -> list[Any]:
        """The values of all facts of this name."""
        return [line[name] for line in self.lines if name in line]

    @property
    def last_call(self) -> str:
        """The last function that was about to be called."""
        calls = self.facts("call")
        return str(calls[-1]) if calls else "loading the library"


def run(task: dict[str, Any]) -> Answer:
    """Runs `probe.py` on the task."""
    with tempfile.TemporaryDirectory(prefix="exo-validate-") as folder:
        facts = Path(folder) / "facts.jsonl"
        streams = Path(folder) / "streams.txt"
        with streams.open("wb") as out:
            process = subprocess.Popen(
                [sys.executable, "-X", "utf8", "-P", str(PROBE), str(facts)],
                stdin=subprocess.PIPE,
                stdout=out,
                stderr=subprocess.STDOUT,
                cwd=folder,
            )
            try:
                process.communicate(json.dumps(task).encode(), timeout=TIMEOUT_S)
                ended = _ending(process.returncode)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
                ended = f"no answer within {TIMEOUT_S:g} s"
        return Answer(_lines(facts), ended, streams.read_text(encoding="utf-8", errors="replace"))


def _lines(path: Path) -> tuple[dict[str, Any], ...]:
    if not path.is_file():
        return ()
    lines = []
    for text in path.read_text(encoding="utf-8", errors="replace").splitlines():
        try:
            lines.append(json.loads(text))
        except ValueError:  # the last line of a process that died
            break
    return tuple(lines)


def _ending(code: int) -> str:
    if code == 0:
        return ""
    if code < 0:
        return f"ended by {signal.Signals(-code).name}"
    return f"ended with exit code {code}"
