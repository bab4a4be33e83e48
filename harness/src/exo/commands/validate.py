"""`exo validate`."""

import json
import re
from collections import Counter
from pathlib import Path
from typing import Annotated

import typer

from exo import screen, validate
from exo.errors import FmuError
from exo.screen import console, sentences

#: Findings of one rule that are printed.
SHOWN = 5


def validate_fmus(
    fmus: Annotated[list[Path] | None, typer.Argument(metavar="FMU…")] = None,
    *,
    strict: Annotated[bool, typer.Option(help="Warnings, too, are exit code 1.")] = False,
    load: Annotated[
        bool | None,
        typer.Option(
            help="--load: ask the dynamic rules, too (states, reset, two instances, step sizes, …). --no-load: run no "
            "library. Without either, the library of this machine is run through one step.",
            show_default=False,
        ),
    ] = None,
    platforms: Annotated[
        list[str] | None, typer.Option("--platform", help="A folder that binaries/ must have; may be repeated.")
    ] = None,
    max_glibc: Annotated[str | None, typer.Option(help="Newest glibc that Linux libraries may need, as 2.17.")] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Findings and verdicts as JSON, or the rules.")] = False,
    rules: Annotated[bool, typer.Option("--rules", help="Lists the rules instead.")] = False,
) -> None:
    """Validates FMI 2.0 and 3.0 FMUs for co-simulation, and SSP archives; exit code 1 on an error.

    Of FMI 3.0, scheduled execution as well. What runs of an FMU runs in processes of its own.
    """
    if rules:
        _print_rules(as_json=as_json)
        return
    with sentences():
        if not fmus:
            raise FmuError("no FMU is given: exo validate FMU…, or --rules")
        if max_glibc is not None and not re.fullmatch(r"[0-9]+(\.[0-9]+)+", max_glibc):
            raise FmuError(f"--max-glibc {max_glibc}: expected a version, as 2.17")
        how = {"run": load is not False, "dynamic": load is True}
        reports = [validate.check(f, **how, platforms=tuple(platforms or ()), max_glibc=max_glibc) for f in fmus]
    if as_json:
        typer.echo(json.dumps([report.as_json(strict=strict) for report in reports], indent=2, ensure_ascii=False))
    else:
        for report in reports:
            _print_report(report)
    raise typer.Exit(1 if any(report.failed(strict=strict) for report in reports) else 0)


def _print_rules(*, as_json: bool) -> None:
    rows = [(rule.id, rule.severity, rule.only or "2.0, 3.0", rule.text) for rule in validate.RULES.values()]
    rows += [(rule.id, rule.severity, "SSP", rule.text) for rule in validate.ssp.RULES.values()]
    if as_json:
        keys = ("rule", "severity", "fmi", "text")
        typer.echo(json.dumps([dict(zip(keys, row, strict=True)) for row in rows], indent=2, ensure_ascii=False))
        return
    table = screen.table("rule", "severity", "FMI", "holds when")
    for row in rows:
        screen.add(table, *row)
    screen.print_table(table)


def _print_report(report: validate.Report) -> None:
    """At most `SHOWN` findings of one rule: an exporter that breaks a rule often breaks it in every variable."""
    seen: Counter[str] = Counter()
    for finding in report.findings:
        seen[finding.rule] += 1
        if seen[finding.rule] <= SHOWN:
            console.print(f"{report.path}: {finding}", markup=False)
    for rule, times in seen.items():
        if times > SHOWN:
            console.print(f"{report.path}: {times - SHOWN} more of {rule}: see --json", markup=False)
    for sentence in report.skipped:
        console.print(f"{report.path}: not checked: {sentence}", markup=False)
    for sentence in report.replayed:
        console.print(f"{report.path}: {sentence}", markup=False)
    for verdict in report.verdicts:
        console.print(f"{report.path}: {verdict}", markup=False)
    if not report.findings:
        console.print(f"{report.path}: No problems found.", markup=False)
