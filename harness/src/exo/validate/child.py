"""A process of its own for foreign machine code: what it does to itself, the checker survives and reports.

`run` starts the process (`exo.probe`) and gives it a task as JSON; the process appends one JSON line for each fact to
a file, so that all facts from before a crash are kept. The last fact says that the task is done, as an exit code of 0
does not: foreign code can call exit. The standard streams belong to the FMU: whatever comes there is a fact, too, up to
a limit.
"""

import json
import os
import signal
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path
from threading import Thread
from typing import IO, Any

from exo.validate.workspace import workspace

#: For loading, one step and reading all variables. The slowest of this project's FMUs needs a hundredth of it.
TIMEOUT_S = 60.0
#: What is kept of the standard streams. The rest is read and thrown away, so that the FMU does not wait.
OUTPUT_LIMIT = 1 << 16
#: For what is left in the pipe once the process has ended; a process that it left behind may hold the pipe open.
DRAIN_S = 1.0


@dataclass(frozen=True)
class Answer:
    """What the process said, and how it ended."""

    lines: tuple[dict[str, Any], ...]
    #: Empty for a task that was done; else signal, exit code or timeout.
    ended: str
    #: What came on the standard streams, at most `OUTPUT_LIMIT` bytes and a sentence that it was cut.
    output: str

    def facts(self, name: str) -> list[Any]:
        """The values of all facts of this name."""
        return [line[name] for line in self.lines if name in line]

    @property
    def last_call(self) -> str:
        """The last function that was about to be called."""
        calls = self.facts("call")
        return str(calls[-1]) if calls else "loading the library"

    @property
    def end(self) -> str:
        """Where and how it ended before its time; of an exit code also what it said last."""
        reason = self.output.strip().splitlines()[-1:] if self.ended.startswith("ended with") else []
        return "; ".join([f"{self.last_call}: {self.ended}", *reason])


class _Streams(Thread):
    """Reads a pipe to its end and keeps the beginning."""

    def __init__(self, pipe: IO[bytes]) -> None:
        super().__init__(daemon=True)
        self.pipe = pipe
        self.kept = bytearray()
        self.cut = False
        self.start()

    def run(self) -> None:
        with self.pipe:
            while chunk := os.read(self.pipe.fileno(), 1 << 16):
                room = OUTPUT_LIMIT - len(self.kept)
                self.kept += chunk[:room]
                self.cut = self.cut or len(chunk) > room

    def text(self) -> str:
        """What was kept."""
        kept = bytes(self.kept).decode("utf-8", "replace")
        return f"{kept}\n(cut after {OUTPUT_LIMIT} bytes)" if self.cut else kept


def run(task: dict[str, Any], program: str = "exo.probe") -> Answer:
    """Runs `exo.probe`, or another module like it, on the task; no process and no file of it is left."""
    with workspace() as folder:
        facts = folder / "facts.jsonl"
        process = subprocess.Popen(
            [sys.executable, "-X", "utf8", "-P", "-m", program, str(facts)],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            cwd=folder,
            # A group of its own, which ends with it.
            start_new_session=True,
        )
        assert process.stdin is not None
        assert process.stdout is not None
        streams = _Streams(process.stdout)
        try:
            _hand_over(process.stdin, task)
            code: int | None = process.wait(TIMEOUT_S)
        except subprocess.TimeoutExpired:
            code = None
        finally:
            _end(process)
            streams.join(DRAIN_S)
        lines = _lines(facts)
        return Answer(lines, _ending(code, done={"done": True} in lines[-1:]), streams.text())


def _hand_over(stdin: IO[bytes], task: dict[str, Any]) -> None:
    try:
        with stdin:
            stdin.write(json.dumps(task).encode())
    except BrokenPipeError:
        pass  # it has died already: its exit code says how


def _end(process: subprocess.Popen[bytes]) -> None:
    """Kills the process and what it has started; what has ended already is left in peace."""
    try:
        if hasattr(os, "killpg"):
            os.killpg(process.pid, signal.SIGKILL)
        else:
            process.kill()
    except (ProcessLookupError, PermissionError):
        pass
    process.wait()


def _lines(path: Path) -> tuple[dict[str, Any], ...]:
    lines = []
    try:
        with path.open(encoding="utf-8", errors="replace") as file:
            for text in file:
                line = json.loads(text)
                if isinstance(line, dict):
                    lines.append(line)
    except (OSError, ValueError):  # the last line of a process that died
        pass
    return tuple(lines)


def _ending(code: int | None, *, done: bool) -> str:
    if code is None:
        return f"no answer within {TIMEOUT_S:g} s"
    if code < 0:
        return f"ended by {_signal(-code)}"
    if code > 0:
        return f"ended with exit code {code}"
    return "" if done else "ended with exit code 0 before the run was over"


def _signal(number: int) -> str:
    try:
        return signal.Signals(number).name
    except ValueError:  # a real-time signal
        return f"signal {number}"
