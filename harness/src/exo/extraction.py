"""Where archives lie extracted: a folder each, removed at the end; also, by the next run, that of a killed process.

A folder is locked as long as its process lives, and appears under its name only when it is locked. So whoever can lock
it may remove it. On systems without `flock` nothing is swept.
"""

import os
import shutil
import sys
import tempfile
from contextlib import ExitStack, suppress
from pathlib import Path
from types import TracebackType
from typing import Self

from exo.errors import FmuError
from exo.validate.archive import Contents, open_archive

if sys.platform != "win32":
    import fcntl

PREFIX = "exo-fmu-"
LOCK = "lock"


def opened(path: Path, stack: ExitStack) -> Contents:
    """What an archive holds that is safe to extract; it stays open until the stack is left."""
    contents, found = open_archive(path, stack)
    if contents is None:
        first = next(finding for finding in found if finding.severity == "error")
        raise FmuError(
            f"{path}: no FMU that is safe to extract: {first.where}: {first.value}; expected {first.expected}"
        )
    return contents


class Place:
    """A folder of its own below the system's temporary one, until `close`."""

    def __init__(self) -> None:
        """OSError, if it cannot be made."""
        self._lock = -1
        self.folder = Path(tempfile.mkdtemp(prefix=f".{PREFIX}"))
        try:
            self._lock = os.open(self.folder / LOCK, os.O_CREAT | os.O_RDWR)
            if sys.platform != "win32":
                fcntl.flock(self._lock, fcntl.LOCK_EX)
            self.folder = self.folder.rename(self.folder.with_name(self.folder.name.removeprefix(".")))
        except BaseException:
            self.close()
            raise

    def close(self) -> None:
        """Removes the folder."""
        shutil.rmtree(self.folder, ignore_errors=True)
        if self._lock >= 0:
            os.close(self._lock)
            self._lock = -1


class Extraction:
    """The files of an archive in a folder of their own. Use with `with`."""

    def __init__(self, path: Path) -> None:
        self._path = path
        self._place: Place | None = None

    @property
    def folder(self) -> Path:
        """Where the files are, while they are."""
        return (self._place.folder if self._place is not None else Path()) / "fmu"

    def __enter__(self) -> Self:
        sweep()
        try:
            self._place = Place()
            with ExitStack() as stack:
                opened(self._path, stack).extract(self.folder)
        except OSError as error:
            self.close()
            reason = error.strerror or error
            raise FmuError(f"{self._path}: cannot be extracted to {tempfile.gettempdir()}: {reason}") from error
        except BaseException:
            self.close()
            raise
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def close(self) -> None:
        """Removes the folder."""
        if self._place is not None:
            self._place.close()


def sweep() -> None:
    """Removes what processes left behind that an FMU or a signal has ended."""
    if sys.platform == "win32":
        return
    for folder in Path(tempfile.gettempdir()).glob(f"{PREFIX}*"):
        with suppress(OSError):
            try:
                lock = os.open(folder / LOCK, os.O_RDWR | os.O_NOFOLLOW)
            except FileNotFoundError:
                # Who removed it has been ended before it was done.
                shutil.rmtree(folder, ignore_errors=True)
                continue
            try:
                fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
                shutil.rmtree(folder, ignore_errors=True)
            finally:
                os.close(lock)
