"""A temporary folder that does not stay behind: not after an error, not after Ctrl-C, not after a polite kill."""

import signal
import tempfile
import threading
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path
from types import FrameType

#: Signals that ask a process to end, and that Python would follow without leaving its `with` statements.
ASKED = tuple(getattr(signal, name) for name in ("SIGTERM", "SIGHUP") if hasattr(signal, name))


@contextmanager
def workspace() -> Iterator[Path]:
    """An empty folder, removed at the end of the `with` statement."""
    with ExitStack() as stack:
        if threading.current_thread() is threading.main_thread():
            stack.enter_context(_leaving_when_asked())
        # What foreign code still writes there must not turn a verdict into a traceback.
        folder = tempfile.TemporaryDirectory(prefix="exo-validate-", ignore_cleanup_errors=True)
        yield Path(stack.enter_context(folder)).resolve()


@contextmanager
def _leaving_when_asked() -> Iterator[None]:
    def leave(number: int, _: FrameType | None) -> None:
        raise SystemExit(128 + number)

    before = {number: signal.getsignal(number) for number in ASKED}
    try:
        for number, handler in before.items():
            # A caller's own handler, or that the signal is ignored (nohup), stays.
            if handler is signal.SIG_DFL:
                signal.signal(number, leave)
        yield
    finally:
        for number, handler in before.items():
            if handler is signal.SIG_DFL:
                signal.signal(number, signal.SIG_DFL)
