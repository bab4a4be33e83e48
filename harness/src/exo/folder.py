"""A scenario's folder of results: written under a temporary name beside it, then renamed into place.

So a folder is whole, and of one run: a run that is killed, or that finds the disk full, leaves the old one. Two runs
into one place each put their folders there, one after the other. Files that are not from exo stay.
"""

import json
import os
import shutil
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from exo.errors import ExoError

if sys.platform != "win32":
    import fcntl

MANIFEST = "manifest.json"
METRICS = "metrics.json"
#: What a run left before there were manifests.
BEFORE = ("metrics.json", "*.png", "signals/*.parquet", "signals/*.csv", "figures/*.parquet", "figures/*.csv")


def working() -> Path:
    """The working folder. ExoError, if it has been removed: nothing can be found or loaded from there."""
    try:
        return Path.cwd()
    except FileNotFoundError:
        raise ExoError("the working folder is not there any more; expected one that exists") from None


def check_name(path: Path) -> None:
    """ExoError for a name that is no UTF-8: Arrow neither reads nor writes there, and would say so after the run."""
    try:
        str(path).encode()
    except UnicodeEncodeError:
        shown = str(path).encode(errors="backslashreplace").decode()
        raise ExoError(f"{shown}: its name is no UTF-8; expected another folder or file") from None


def prepare(out: Path, scenarios: list[str]) -> None:
    """Refuses, before anything runs, a folder that cannot be written or whose contents are not exo's."""
    check_name(out)
    try:
        out.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(prefix=".exo-", dir=out):
            pass
    except OSError as error:
        raise ExoError(f"--out {out}: cannot be written: {error.strerror or error}; expected a folder") from error
    for name in scenarios:
        target = out / name
        if target.is_symlink() or (target.exists() and not target.is_dir()):
            raise ExoError(f"{target}: is no folder; expected another --out, or that it is moved away")
        if (
            target.is_dir()
            and any(target.iterdir())
            and not any((target / one).is_file() for one in (MANIFEST, METRICS))
        ):
            raise ExoError(f"{target}: holds no results of exo; expected another --out, so that nothing is overwritten")


def signal_files(folder: Path) -> dict[str, Path]:
    """The files of signals in a scenario's folder of results, by case. ExoError, if there are none."""
    found = {one.stem: one for one in sorted((folder / "signals").glob("*.parquet"))}
    if found:
        return found
    if not folder.is_dir():
        raise ExoError(f"{folder}: no such folder; expected a scenario's results, as results/wall")
    if (folder / METRICS).is_file():
        raise ExoError(f"{folder}: has no signals; expected a run that keeps them: `exo run {folder.name}`")
    there = [one.parent.parent.name for one in sorted(folder.glob("*/signals/*.parquet"))]
    known = f" ({', '.join(list(dict.fromkeys(there))[:6])})" if there else ""
    raise ExoError(f"{folder}: has no signals; expected the folder of one scenario's results{known}")


@contextmanager
def replaced(target: Path) -> Iterator[Path]:
    """A new folder that takes the place of `target` where the block ends without an error."""
    target.parent.mkdir(parents=True, exist_ok=True)
    with locked(target.parent):
        _sweep(target)
        fresh = Path(tempfile.mkdtemp(prefix=f".{target.name}.", suffix=".new", dir=target.parent))
        living = lock(fresh)
    try:
        fresh.chmod(0o777 & ~_umask())
        yield fresh
        with locked(target.parent):
            _swap(fresh, target)
    finally:
        shutil.rmtree(fresh, ignore_errors=True)
        if living is not None:
            os.close(living)


def _sweep(target: Path) -> None:
    """Removes what killed runs have left beside `target`, and puts back what one of them had just moved away."""
    if sys.platform == "win32":
        return
    for old in target.parent.glob(f".{target.name}.*.old"):  # lives only as long as the place is locked
        if not target.exists() and (old / "was").is_dir():
            (old / "was").rename(target)
        shutil.rmtree(old, ignore_errors=True)
    for fresh in target.parent.glob(f".{target.name}.*.new"):
        with suppress(OSError):
            handle = lock(fresh, wait=False)
            shutil.rmtree(fresh, ignore_errors=True)
            if handle is not None:
                os.close(handle)


def lock(folder: Path, *, wait: bool = True) -> int | None:
    """Locks a folder until the handle is closed or the process ends; OSError, if another one has it."""
    if sys.platform == "win32":
        return None
    handle = os.open(folder, os.O_RDONLY)
    try:
        fcntl.flock(handle, fcntl.LOCK_EX | (0 if wait else fcntl.LOCK_NB))
    except OSError:
        os.close(handle)
        raise
    return handle


def _swap(fresh: Path, target: Path) -> None:
    if not target.exists():
        fresh.rename(target)
        return
    old = Path(tempfile.mkdtemp(prefix=f".{target.name}.", suffix=".old", dir=target.parent))
    try:
        target.rename(old / "was")
        try:
            fresh.rename(target)
        except OSError:
            (old / "was").rename(target)
            raise
        _keep_others(old / "was", target)
    finally:
        shutil.rmtree(old, ignore_errors=True)


def _keep_others(old: Path, new: Path) -> None:
    """Moves what someone else has put into the old folder into the new one."""
    ours = set(_listed(old))
    for file in [path for path in old.rglob("*") if path.is_file() or path.is_symlink()]:
        name = file.relative_to(old)
        if name.as_posix() not in ours and not (new / name).exists():
            with suppress(OSError):
                (new / name).parent.mkdir(parents=True, exist_ok=True)
                file.rename(new / name)


def _listed(folder: Path) -> list[str]:
    """Names of the files of a run, from its manifest."""
    try:
        document = json.loads((folder / MANIFEST).read_text(encoding="utf-8"))
        return [MANIFEST, *(str(file["path"]) for file in document["files"])]
    except (OSError, ValueError, KeyError, TypeError):
        return [path.relative_to(folder).as_posix() for pattern in BEFORE for path in folder.glob(pattern)]


#: What a message says of a file that could not be replaced.
STAYS = "what was there before stays"


def prepare_file(path: Path) -> None:
    """Refuses, before anything runs, a place where `write_file` could put no file."""
    if path.exists() and not path.is_file():
        raise ExoError(f"{path}: is no file; expected the name of a file to write")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=path.parent):
            pass
    except OSError as error:
        said = error.strerror or error
        raise ExoError(f"{path}: cannot be written: {said}; expected a folder that can be written") from error


def write_file(path: Path, data: bytes, *, kept: str = STAYS) -> None:
    """Writes a file under a temporary name, then renames it.

    ExoError, if it cannot be written; it ends with `kept`, what is left then.
    """
    try:
        _put(path, data)
    except OSError as error:  # names the temporary file, or none
        raise ExoError(f"{path}: cannot be written: {error.strerror or error}; {kept}") from error


def _put(path: Path, data: bytes) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    handle, name = tempfile.mkstemp(prefix=f".{path.name}.", dir=path.parent)
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(data)
        Path(name).chmod(0o666 & ~_umask())
        Path(name).replace(path)
    except BaseException:
        Path(name).unlink(missing_ok=True)
        raise


@contextmanager
def replaced_file(path: Path) -> Iterator[Path]:
    """A name beside `path`, of the same ending, for a file that takes its place where the block ends without an error.

    ExoError, if the folder cannot be written.
    """
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        fresh = Path(tempfile.mkdtemp(prefix=f".{path.name}.", suffix=".new", dir=path.parent))
    except OSError as error:
        raise ExoError(f"{path}: cannot be written: {error.strerror or error}; expected a folder") from error
    try:
        yield fresh / path.name
        (fresh / path.name).replace(path)
    except OSError as error:
        raise ExoError(f"{path}: cannot be written: {error.strerror or error}; {STAYS}") from error
    finally:
        shutil.rmtree(fresh, ignore_errors=True)


@contextmanager
def locked(out: Path) -> Iterator[None]:
    """One process at a time where folders are put into place. The lock ends with its process."""
    handle = lock(out)
    try:
        yield
    finally:
        if handle is not None:
            os.close(handle)


def _umask() -> int:
    mask = os.umask(0o022)
    os.umask(mask)
    return mask
