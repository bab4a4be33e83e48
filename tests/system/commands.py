"""The command `exo` in this process, and a scenario that takes it no time."""

from collections.abc import Iterator
from contextlib import contextmanager

from typer.testing import CliRunner, Result

from exo.cli import app

SHORT = """
id = "short"
title = "A second of pushing"
about = "Law passive_bounded, free mass."
source = "here"
duration = 1.0
step = 0.002
[components.controller]
archive = "TestbedController.fmu"
[components.plant]
archive = "Testbed.fmu"
[components.plant.parameters]
"wall.q" = 1e9
[inputs]
"controller.q" = "plant.q"
"controller.tau_h" = "profile.tau_h"
"plant.tau_a" = "controller.tau_a"
"plant.tau_h" = "profile.tau_h"
[[profiles.tau_h]]
kind = "constant"
amplitude = 3.0
[[cases]]
id = "push"
[[metrics]]
id = "moved"
title = "how far it moved"
unit = "m"
function = "maximum"
arguments = { column = "plant.q" }
check = { at_least = 0.1 }
source = "here"
[[figures]]
id = "q"
title = "q"
[[figures.panels]]
y_label = "q [m]"
curves = [{ case = "push", column = "plant.q", label = "q" }]
"""


def exo(*arguments: object) -> Result:
    """Runs the command; arguments are made texts."""
    return CliRunner().invoke(app, [str(argument) for argument in arguments])


@contextmanager
def full_beyond(size: int) -> Iterator[None]:
    """No file of this process may have more bytes: what a full disk is to a file that does not fit."""
    import resource  # noqa: PLC0415  not on Windows

    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (size, before[1]))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)
