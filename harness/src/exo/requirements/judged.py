"""Requirements of a scenario that has run, as results beside its metrics: the margin must be at least zero."""

import math
import re
from collections.abc import Iterator, Mapping

from exo.dimensions import names_differ
from exo.errors import ExoError, ScenarioError
from exo.overrides import void
from exo.recording import Recording
from exo.requirements import formula, trace
from exo.requirements.document import Requirements, Shown
from exo.scenario import Check
from exo.verdict import Result, judge

#: What makes another unit of those of the signals.
ARITHMETIC = re.compile(r"[*/]|\b(sqrt|exp|pow)\b")
#: What stands before `<requirement>.<key>/<case>` in a result's id.
PREFIX = "requirement."


def results(
    requirements: Requirements,
    *,
    scenario: str,
    recordings: Mapping[str, Recording],
    changed: Mapping[str, tuple[str, ...]],
) -> Iterator[Result]:
    """One result a requirement, place and case. `changed`: what the command line has changed of each case."""
    for name, key, requirement, shown in requirements.of_scenario(scenario):
        for case in shown.meant(tuple(recordings)):
            where = f"{scenario}: requirement {name}.{key}: case {case}"
            narrowed = bool({"duration", "step"} & set(changed[case]))
            margin, undefined = math.nan, False
            try:
                margin = _margin(shown, recordings[case], where=where)
            except ScenarioError:
                # A run of another length or step may end before the formula looks.
                if not narrowed:
                    raise
                undefined = True
            yield judge(
                metric=f"{PREFIX}{name}.{key}/{case}",
                title=shown.title,
                value=margin,
                unit=shown.unit,
                check=Check(at_least=0.0, because=shown.formula),
                source=f"requirement {name}: {requirement.text} ({requirement.source})",
                void_by=changed[case] if undefined else void(shown.rests_on, changed[case]),
            )


def _margin(shown: Shown, run: Recording, *, where: str) -> float:
    first = round(shown.at / run.step)
    if first >= len(run.time) or not math.isclose(first * run.step, shown.at, abs_tol=1e-9):
        raise ScenarioError(
            f"{where}: at = {shown.at:g} s; expected a multiple of the step, {run.step:g} s, within the run"
        )
    if not ARITHMETIC.search(shown.formula):
        for name, one in shown.signals.items():
            unit = trace.unit(one, run)
            if unit and names_differ(unit, shown.unit):
                raise ScenarioError(f"{where}: unit: got {shown.unit}, and {name} is in {unit}; expected one unit")
    try:
        signals = {name: trace.signal(one, run)[first:] for name, one in shown.signals.items()}
        return formula.robustness(shown.formula, signals, step=run.step)
    except (ExoError, ValueError) as error:
        raise ScenarioError(f"{where}: {error}") from error
