"""The command `exo` as a program, also `python -m exo`.

What the commands need takes most of a second to import. A Ctrl-C in that second ends the program as it ends any other,
without Python's traceback; from then on the commands answer to it (`exo.screen`).
"""

import signal


def main() -> None:
    """Runs the command line of this process."""
    # A job in the background has the signal ignored; that stays.
    ours = signal.getsignal(signal.SIGINT) is signal.default_int_handler
    if ours:
        signal.signal(signal.SIGINT, signal.SIG_DFL)
    from exo.cli import app  # noqa: PLC0415  see above

    if ours:
        signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        app()
    finally:
        # It is over: another Ctrl-C would only break into what Python puts away.
        signal.signal(signal.SIGINT, signal.SIG_IGN)


if __name__ == "__main__":
    main()
