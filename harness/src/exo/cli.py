"""The command `exo`. Exit codes: 0 good, 1 a failed verdict (or difference, or problem), 2 a wrong command."""

import logging
from typing import Annotated

import typer

from exo import __version__, screen
from exo.commands import (
    compare,
    export,
    identify_tool,
    measure,
    play,
    references,
    report,
    requirements,
    scenarios,
    ssp,
    sweep,
    tune,
    validate,
)

app = typer.Typer(
    cls=screen.Commands, no_args_is_help=True, add_completion=False, pretty_exceptions_enable=False, help=__doc__
)


def _version(wanted: bool) -> None:
    if wanted:
        typer.echo(f"exo {__version__}")
        raise typer.Exit


@app.callback()
def main(
    _wanted: Annotated[
        bool, typer.Option("--version", callback=_version, is_eager=True, help="Prints the version.")
    ] = False,
) -> None:
    screen.take_any_letter()
    # Of its cache and its fonts; what cannot be drawn is an exception.
    logging.getLogger("matplotlib").setLevel(logging.ERROR)


main.__doc__ = __doc__

# A line each, in the order of the help.
app.command("list")(scenarios.list_scenarios)
app.command("schema")(scenarios.print_schema)
app.command("run")(scenarios.run)
app.command("reproduce")(scenarios.reproduce)
app.command("report")(report.report)
app.command("play")(play.play)
app.command("sweep")(sweep.run_sweep)
app.command("compare")(compare.compare)
app.command("requirements")(requirements.list_requirements)
app.command("export")(export.export_run)
app.command("ssp")(ssp.write_ssp)
app.command("validate")(validate.validate_fmus)
app.command("references")(references.replay_references)
app.command("record")(references.record_references)
app.command("benchmark")(measure.benchmark)
app.command("sensitivity")(measure.measure_sensitivity)
app.command("identify-tool")(identify_tool.identify_tool)
app.command("tune")(tune.tune)

if __name__ == "__main__":
    app()
