"""Numbers and texts as one text of letters: it lies in a `<script>` that no browser runs, until its section is opened.

Packed is base64 of what `deflate` (RFC 1951, raw) has made of

    length of the head, 4 bytes | head, JSON in UTF-8 | body

all little-endian. The body's blocks follow each other as the head says. A block of numbers has its bytes sorted: first
the lowest byte of every number, then the next one, which packs much better. `web/unpack.js` reads it.
"""

import base64
import json
import struct
import zlib
from typing import Any

import numpy as np
from numpy.typing import NDArray


def pack(head: Any, blocks: list[bytes]) -> str:
    """Head and blocks as letters."""
    text = json.dumps(head, ensure_ascii=False, separators=(",", ":"), allow_nan=False).encode()
    packer = zlib.compressobj(9, zlib.DEFLATED, -15)
    plain = struct.pack("<I", len(text)) + text + b"".join(blocks)
    return base64.b64encode(packer.compress(plain) + packer.flush()).decode("ascii")


def unpack(letters: str) -> tuple[Any, bytes]:
    """Head and body of what `pack` has made."""
    plain = zlib.decompress(base64.b64decode(letters), -15)
    (length,) = struct.unpack_from("<I", plain)
    return json.loads(plain[4 : 4 + length]), plain[4 + length :]


def numbers(values: NDArray[Any]) -> bytes:
    """A block of 4-byte numbers, shape (n,), with its bytes sorted."""
    return values.view(np.uint8).reshape(len(values), 4).T.tobytes()


def numbers_of(block: bytes, kind: str) -> NDArray[Any]:
    """The numbers of a block; `kind` is `<u4` or `<f4`."""
    return np.ascontiguousarray(np.frombuffer(block, np.uint8).reshape(4, -1).T).view(kind).ravel()
