"""Instructions as callgrind counts them (`cargo xtask bench` hands the files over): each FMU beside what is committed,
and beside the FMI floor."""

import json
from collections.abc import Iterator, Mapping
from pathlib import Path

from benches.row import Bench, Found, NotRun, Row

COMMITTED = Path(__file__).parents[1] / "tests" / "abi" / "instructions.json"
#: What a call may have more than what is committed.
LIMIT = 1.05
CALLS = ("set", "step", "get")


def measure(bench: Bench) -> Iterator[Found]:
    """A row for what has most above its committed count, one for each FMU beside the floor."""
    if "fmu" not in bench.counts:
        yield NotRun(
            name="instructions", reason="nothing was counted: `cargo xtask bench` counts, with valgrind on PATH"
        )
        return
    counted = _counts(bench.counts["fmu"])
    committed = json.loads(COMMITTED.read_text())
    yield beside_committed(
        counted["instructions"], committed["instructions"], counted["compiler"], committed["compiler"]
    )
    if "floor" in bench.counts:
        yield from beside_floor(counted["instructions"], _counts(bench.counts["floor"])["instructions"])


def _counts(path: Path) -> Mapping[str, Mapping[str, int]]:
    return dict(json.loads(path.read_text()))


def beside_committed(
    counted: Mapping[str, int], committed: Mapping[str, int], compiler: object, its_compiler: object
) -> Found:
    """The call that has most in units of its committed count."""
    if compiler != its_compiler:
        reason = f"the committed counts are of {its_compiler}, these of {compiler}"
        return NotRun(name="instructions / committed", reason=reason)
    ratios = {name: count / committed[name] for name, count in counted.items() if name in committed}
    most = max(ratios, key=lambda name: ratios[name])
    return Row(
        name=f"instructions / committed ones, the largest of {len(ratios)}",
        value=ratios[most],
        limit=LIMIT,
        aim=1.0,
        told=f"{most}: {counted[most]:,} / {committed[most]:,}",
    )


def beside_floor(counted: Mapping[str, int], floor: Mapping[str, int]) -> Iterator[Row]:
    """Set of all inputs, a moving step and get of all outputs, each FMU."""
    names = sorted({name.removesuffix(" get") for name in floor if name.endswith(" get")})
    for name in names:
        ours = sum(counted[f"{name} {call}{', moving' if call == 'step' else ''}"] for call in CALLS)
        bottom = sum(floor[f"{name} {call}"] for call in CALLS)
        yield Row(
            name=f"{name}: instructions of set + step + get / FMI floor",
            value=ours / bottom,
            told=f"{ours:,} / {bottom:,}; all inputs, all outputs, moving",
        )
