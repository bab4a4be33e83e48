"""What the commands print: tables that no pipe cuts, and the numbers of a run."""

import io
import math
import os
import shlex
import signal
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any

import typer
from rich.console import Console
from rich.table import Table
from rich.text import Text
from typer.core import TyperGroup

from exo.compare import Difference
from exo.errors import ExoError
from exo.experiment import Experiment
from exo.references.outcome import Replay
from exo.verdict import Result

#: More than any table has.
ENDLESS = 100_000
ORDER = ("fail", "info", "pass")
#: Findings of one rule that `exo references` prints.
SHOWN = 5
COLORS = {"pass": "green", "fail": "bold red", "info": "blue"}
#: The shell's codes of a command that Ctrl-C and that a pipe's other end have ended; of a signal, this and its number.
INTERRUPTED, BROKEN_PIPE, SIGNALLED = 130, 141, 128
#: What a terminal that is closed and what a system that shuts down sends. Windows has no SIGHUP.
ENDS = tuple(getattr(signal, name) for name in ("SIGHUP", "SIGTERM") if hasattr(signal, name))


class _Console(Console):
    def on_broken_pipe(self) -> None:
        """rich would end with exit code 1, which is that of a failed verdict."""
        raise BrokenPipeError


console = _Console(highlight=False, soft_wrap=True)
errors = _Console(stderr=True, highlight=False, soft_wrap=True)


def take_any_letter() -> None:
    """A terminal or a pipe that knows no ≥ gets `\\u2265`."""
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="backslashreplace")


class Commands(TyperGroup):
    """The commands; what they print, and what their help prints, may have nowhere to go."""

    def make_context(self, *arguments: Any, **settings: Any) -> Any:
        with _printed():
            return super().make_context(*arguments, **settings)

    def invoke(self, ctx: Any) -> Any:
        with _printed():
            return super().invoke(ctx)


@contextmanager
def _printed() -> Iterator[None]:
    """Exit code 141 where who reads has seen enough, as `head`; 2 and a sentence where the disk of a log is full."""
    try:
        try:
            yield
        finally:
            if sys.stdout is not None:
                sys.stdout.flush()
    except BrokenPipeError as error:
        _drop_output()
        raise typer.Exit(BROKEN_PIPE) from error
    except SystemExit as error:
        # By the console that prints help.
        if isinstance(error.__context__, BrokenPipeError):
            raise typer.Exit(BROKEN_PIPE) from error
        raise
    except OSError as error:
        _drop_output()
        with suppress(OSError):
            errors.print(f"exo: {error.filename or 'standard output'}: {error.strerror or error}", markup=False)
        raise typer.Exit(2) from error


def _drop_output() -> None:
    """What is still buffered has nowhere to go."""
    with suppress(OSError, ValueError):
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


@contextmanager
def sentences() -> Iterator[None]:
    """Turns errors that are meant for the user into one message and exit code 2."""
    main = threading.current_thread() is threading.main_thread()
    # What is ignored, as by nohup, stays ignored.
    heard = [one for one in ENDS if main and signal.getsignal(one) is not signal.SIG_IGN]
    before = {one: signal.signal(one, _terminated) for one in heard}
    try:
        yield
    except ExoError as error:
        errors.print(f"exo: {error}", markup=False)
        raise typer.Exit(2) from error
    except MemoryError as error:
        errors.print("exo: out of memory; expected fewer cases, a shorter duration or a longer step", markup=False)
        raise typer.Exit(2) from error
    except BrokenPipeError:
        raise
    except OSError as error:
        where = f"{error.filename}: " if error.filename else ""
        errors.print(f"exo: {where}{error.strerror or error}", markup=False)
        raise typer.Exit(2) from error
    except (typer.Exit, typer.Abort, typer.BadParameter):
        raise
    except KeyboardInterrupt as error:
        errors.print("exo: interrupted; what was finished before stays", markup=False)
        raise typer.Exit(INTERRUPTED) from error
    except Exception as error:
        if os.environ.get("EXO_TRACEBACK"):
            raise
        said = " ".join(str(error).split())
        errors.print(
            f"exo: an error of exo itself: {type(error).__name__}: {said}; EXO_TRACEBACK=1 shows where it is",
            markup=False,
        )
        raise typer.Exit(2) from error
    finally:
        for one, handler in before.items():
            signal.signal(one, handler)


def _terminated(number: int, _frame: object) -> None:
    """A signal ends the process as an exception does: what is open is closed, folders are removed."""
    raise SystemExit(SIGNALLED + number)


def table(*headers: str) -> Table:
    """A table; `add` its rows."""
    return Table(*headers, box=None, pad_edge=False)


def add(found: Table, *cells: str) -> None:
    """A row of plain text: `[` is no markup."""
    found.add_row(*(Text(cell) for cell in cells))


def print_table(found: Table) -> None:
    """Prints it, a row a line, as wide as it is: a pipe has no width, and a terminal goes on in its next line."""
    wide = Console(width=ENDLESS, highlight=False)
    with wide.capture() as lines:
        wide.print(found)
    typer.echo("\n".join(line.rstrip() for line in lines.get().splitlines()))


def number(value: float | None) -> str:
    """Six digits; what is undefined says so."""
    return "undefined" if value is None or not math.isfinite(value) else f"{value:.6g}"


def print_replay(path: Path, answer: Replay) -> None:
    """What is wrong, then by how much each output differs."""
    for rule in dict.fromkeys(finding.rule for finding in answer.findings):
        broken = [finding for finding in answer.findings if finding.rule == rule]
        for finding in broken[:SHOWN]:
            console.print(f"{path}: {finding}", markup=False)
        if len(broken) > SHOWN:
            console.print(f"{path}: {len(broken) - SHOWN} more of {rule}: see --json", markup=False)
    for sentence in answer.skipped:
        console.print(f"{path}: not checked: {sentence}", markup=False)
    if not answer.outcomes:
        console.print(f"{path}: nothing to replay", markup=False)
        return
    console.print(f"{path}:", markup=False)
    found = table("experiment", "output", "unit", "differs by", "allowed", "at, s", "")
    for one in answer.outcomes:
        numbers = (f"{one.difference:.3g}", f"{one.allowed:.3g}", number(one.at))
        add(found, one.experiment, one.output, one.unit, *numbers, "" if one.good else "too much")
    print_table(found)


def print_run(
    done: Experiment, *, folder: Path, shown: tuple[str, ...] = ("fail", "info", "pass"), unwired: bool = True
) -> None:
    """Verdict and counts, then the numbers whose verdict is to be shown, and where the pictures lie."""
    counts = {v: sum(r.verdict == v for r in done.results) for v in COLORS}
    verdict = done.verdict
    simulated = sum(plan.duration for plan in done.plans.values())
    computing = sum(run.wall_time for run in done.recordings.values())
    console.print(
        f"[{COLORS[verdict]}]{verdict}[/] {done.scenario.id}: {_counted(counts)}; "
        f"{simulated:.6g} s simulated in {computing:.2f} s"
    )
    if not any(result.kind != "none" for result in done.results):
        console.print("  no metric has an expectation, and no requirement is of this scenario", markup=False)
    for case, run in done.recordings.items():
        if run.deadlines is not None:
            console.print(f"  {case}: {run.deadlines.sentence()}", markup=False)
    results = sorted((r for r in done.results if r.verdict in shown), key=lambda result: ORDER.index(result.verdict))
    if results:
        rows = table("", "metric", "value", "unit", "expected", "margin")
        for result in results:
            add(rows, f"  {result.verdict}", result.id, number(result.value), result.unit, *_judged(result))
        print_table(rows)
    failed: dict[str, dict[str, None]] = {}
    for result in done.results:
        if result.verdict == "fail":
            failed.setdefault(result.source, {})[result.id.split("/")[0]] = None
    for source, names in failed.items():
        console.print(f"  {', '.join(names)} expected by: {source}", markup=False)
    changed = sorted({name for result in done.results for name in result.void_by})
    if changed:
        console.print(f"  expectations in brackets hold without {', '.join(changed)}", markup=False)
    if done.unwired and unwired:
        console.print(f"  not wired, at their start values: {', '.join(done.unwired)}", markup=False)
    for note in done.notes if unwired else ():
        console.print(f"  {note}", markup=False)
    pictures = [f"{figure.id}.png" for figure in done.scenario.figures]
    console.print(f"  results: {folder}{': ' if pictures else ''}{', '.join(pictures)}", markup=False)


def _counted(counts: dict[str, int]) -> str:
    """How many numbers have which verdict; that nothing has been judged is no pass."""
    if not counts["pass"] + counts["fail"]:
        return f"nothing judged, {counts['info']} info"
    return ", ".join(f"{counts[one]} {one}" for one in ("pass", "fail", "info"))


def print_page(out: Path) -> None:
    """How a page is made of the results in `out`."""
    where = "" if out == Path("results") else f" --out {shlex.quote(str(out))}"
    console.print(f"`exo report{where}` makes a page of the results: {out / 'report.html'}", markup=False)


def print_differences(beyond: list[Difference]) -> None:
    """Numbers and signals of two results that differ."""
    if not beyond:
        return
    rows = table("kind", "name", "a", "b", "unit", "difference")
    for d in beyond:
        numbers = ("–" if x is None else f"{x:.9g}" for x in (d.a, d.b))
        add(rows, d.kind, d.name, *numbers, d.unit, f"{d.share:.3g}" if math.isfinite(d.share) else d.why)
    print_table(rows)


def _judged(result: Result) -> tuple[str, str]:
    """Expectation and margin."""
    if result.kind == "none":
        return "–", "–"
    if result.void_by:
        return f"({result.expectation()})", "–"
    return result.expectation(), number(result.margin)
