"""Child process of test_places: runs an FMU from a folder that cannot be written, and prints the outputs as JSON.

    frozen_child.py X.fmu FOLDER

A process with the rights of root writes where nobody may; it gives up that right first.
"""

import ctypes
import json
import os
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1]))

from exo.fmu import Archive

from foreign.contents import contents
from foreign.record import record
from foreign.runs import by_calls, product

#: linux/capability.h: the version of the call, and CAP_DAC_OVERRIDE.
VERSION, WRITE_ANYWHERE = 0x20080522, 1


def give_up_to_write_anywhere() -> None:
    libc = ctypes.CDLL(None, use_errno=True)
    header, rights = (ctypes.c_uint32 * 2)(VERSION, 0), (ctypes.c_uint32 * 6)()
    assert libc.capget(header, rights) == 0, os.strerror(ctypes.get_errno())
    rights[0] &= ~(1 << WRITE_ANYWHERE)
    assert libc.capset(header, rights) == 0, os.strerror(ctypes.get_errno())


def unwritable(folder: Path) -> bool:
    try:
        (folder / "written").touch()
    except PermissionError:
        return True
    return False


path, folder = Path(sys.argv[1]), Path(sys.argv[2])
tempfile.tempdir = str(folder)
with Archive(path) as archive:
    inside = [folder, *folder.rglob("*")]
    for entry in inside:
        entry.chmod(entry.stat().st_mode & ~0o222)
    give_up_to_write_anywhere()
    frozen = all(unwritable(entry) for entry in inside if entry.is_dir())
    before = contents(folder)
    found = by_calls(archive, record(archive, steps=100), product)
    changed = sorted(set(before.items()) ^ set(contents(folder).items()))
    for entry in inside:
        entry.chmod(entry.stat().st_mode | 0o200)
outputs = {name: values.tolist() for name, values in found.items()}
print(json.dumps({"frozen": frozen, "changed": changed, "outputs": outputs}))
