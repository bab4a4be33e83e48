"""`requirements.md` of an archive: what the paper asks for, and what the scenarios of its experiments are judged by."""

from collections.abc import Mapping, Sequence

from exo import scenario as scenarios
from exo.references.record import Experiment
from exo.requirements import built_in
from exo.scenario import Check, Metric

#: Of the paper's requirements a plant or a hand is no subject.
CONTROLLERS = ("TestbedController", "ArmController")


def text(name: str, shows: Mapping[str, Sequence[str]], experiments: list[Experiment]) -> str:
    """The file's text for the FMU of this name. `shows`: requirement of the paper → runs that show a part of it."""
    lines = [f"# Requirements: {name}", ""]
    if name in CONTROLLERS:
        lines += [
            "## What the paper asks of the controller",
            "",
            "| id | requirement | source | experiments here that show a part of it |",
            "|---|---|---|---|",
        ]
        here = {one.name for one in experiments}
        for key, run_names in shows.items():
            one = built_in().requirements[key]
            runs = ", ".join(run for run in run_names if run in here) or "–"
            lines.append(f"| `{key}` | {one.text} | {one.source} | {runs} |")
    else:
        lines += ["The paper asks nothing of this FMU: it is what the controller's requirements are shown on."]
    lines += [
        "",
        "## What the scenarios are judged by",
        "",
        "Each experiment is a case of a scenario, with all FMUs coupled, drawn together to a short time. The scenario",
        "at its full length must give these numbers.",
        "",
        "| scenario | case | number | must be | unit | source |",
        "|---|---|---|---|---|---|",
    ]
    for scenario, case in sorted({(one.scenario, one.case) for one in experiments}):
        for metric, check in judged(scenario, case):
            cells = (scenario, case, metric.title, _must_be(check), metric.unit, metric.source)
            lines.append("| " + " | ".join(cell.replace("|", r"\|") for cell in cells) + " |")
    return "\n".join(lines) + "\n"


def judged(scenario: str, case: str) -> list[tuple[Metric, Check]]:
    """The metrics of a case that have an expectation."""
    metrics = [one for one in scenarios.load(scenario).metrics if one.cases is None or case in one.cases]
    found = [(one, one.expected.get(case, one.check)) for one in metrics]
    return [(metric, check) for metric, check in found if _must_be(check)]


def _must_be(check: Check) -> str:
    if check.at_most is not None:
        return f"at most {check.at_most:g}"
    if check.at_least is not None:
        return f"at least {check.at_least:g}"
    if check.value is None:
        return ""
    beyond = f"{check.within:g}" if check.within is not None else f"{100.0 * (check.relative or 0.0):g} %"
    return f"{check.value:g} ± {beyond}"
