"""`python -m benches`: measures all, prints the table, with `--write` also commits it to `docs`.

Exit code 0 whatever the ratios are: a clock decides them. 1 where a provider fails, after the others have run. A tool
that is not there is named.
"""

import argparse
import sys
import tempfile
import traceback
from collections.abc import Iterable, Sequence
from importlib import import_module
from pathlib import Path

from benches import document, machine, picture
from benches.floor import archives
from benches.row import Bench, Found, NotRun, Row
from exo.fmu import find_fmu_dir

#: Modules of this package, in the order of the table.
PROVIDERS = ("same_arithmetic", "floor", "instructions", "arm_step", "engines", "peers", "sweeps", "clock", "lifetime")
DOCS = Path(__file__).parents[1] / "docs"


def gathered(bench: Bench, providers: Iterable[str]) -> tuple[list[Found], list[str]]:
    """What all providers found, and which of them failed."""
    found: list[Found] = []
    failed = []
    for name in providers:
        print(f"measuring: {name}", file=sys.stderr, flush=True)
        try:
            found += import_module(f"benches.{name}").measure(bench)
        except Exception as error:
            traceback.print_exc()
            failed.append(name)
            found.append(NotRun(name=name, reason=f"failed: {type(error).__name__}: {error}".split("\n")[0]))
    return found, failed


def write(found: Sequence[Found], facts: dict[str, str], docs: Path) -> None:
    """Writes table and picture."""
    (docs / "benchmarks.md").write_text(document.of(found, facts), encoding="utf-8")
    picture.draw([one for one in found if isinstance(one, Row)], docs / "benchmarks.png")


def main(arguments: Sequence[str] | None = None) -> int:
    """The command."""
    parser = argparse.ArgumentParser(prog="python -m benches", description=__doc__)
    parser.add_argument("--only", nargs="+", choices=PROVIDERS, default=PROVIDERS, help="some of the providers")
    parser.add_argument("--rounds", type=int, default=9, help="of each comparison")
    parser.add_argument("--write", action="store_true", help="also write docs/benchmarks.md and its picture")
    parser.add_argument("--floors", type=Path, metavar="DIR", help="only write the archives of the floor there")
    for what in ("fmu", "floor"):
        parser.add_argument(f"--counts-{what}", type=Path, metavar="FILE", help=f"counted instructions, {what}")
    given = parser.parse_args(arguments)
    if given.rounds < 1:
        parser.error(f"--rounds {given.rounds}: expected 1 or more")
    counts = {"fmu": given.counts_fmu, "floor": given.counts_floor}
    with tempfile.TemporaryDirectory(prefix="exo-bench-") as folder:
        bench = Bench(
            fmu_dir=find_fmu_dir().resolve(),
            work=Path(folder),
            rounds=given.rounds,
            counts={what: path for what, path in counts.items() if path is not None and path.is_file()},
        )
        if given.floors is not None:
            archives(bench, given.floors)
            return 0
        facts = machine.facts()
        found, failed = gathered(bench, given.only)
    print(document.of(found, facts))
    if given.write and not failed:
        write(found, facts, DOCS)
    for name in failed:
        print(f"{name} failed; nothing was written" if given.write else f"{name} failed", file=sys.stderr)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
