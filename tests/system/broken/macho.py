"""A Mach-O library that exports by its symbol table, as linkers wrote it before there was an export trie.

Written by hand from Apple's <mach-o/loader.h> and <mach-o/nlist.h>: this machine has no linker that still does so.
"""

import struct

HEADER, SEGMENT, SECTION, SYMTAB, DYLIB = 32, 72, 80, 24, 48
EXTERNAL, PRIVATE, IN_SECTION, UNDEFINED, DEBUGGER = 0x01, 0x10, 0x0E, 0x00, 0x20
CODE = b"\xc3" * 16


def library(exported: list[str]) -> bytes:
    """An x86-64 dylib with these functions, a private one, an imported one and one for debuggers only."""
    symbols = [(name, EXTERNAL | IN_SECTION) for name in exported]
    symbols += [("hidden", EXTERNAL | PRIVATE | IN_SECTION), ("static", IN_SECTION)]
    symbols += [("malloc", EXTERNAL | UNDEFINED), ("debugged", EXTERNAL | DEBUGGER | IN_SECTION)]
    texts, table = b"\0", b""
    for name, kind in symbols:
        section = 0 if kind & IN_SECTION == UNDEFINED else 1
        table += struct.pack("<IBBHQ", len(texts), kind, section, 0, 0x1000 if section else 0)
        texts += f"_{name}\0".encode()
    commands = 2 * SEGMENT + SECTION + SYMTAB + DYLIB
    code_at = 0x1000
    table_at = code_at + len(CODE)
    texts_at = table_at + len(table)
    end = texts_at + len(texts)
    parts = [
        struct.pack("<8I", 0xFEEDFACF, 0x01000007, 3, 6, 4, commands, 0x85, 0),
        _segment("__TEXT", address=0, size=table_at, offset=0, sections=1),
        struct.pack("<16s16sQQ8I", b"__text", b"__TEXT", code_at, len(CODE), code_at, 0, 0, 0, 0x80000400, 0, 0, 0),
        _segment("__LINKEDIT", address=0x2000, size=end - table_at, offset=table_at, sections=0),
        struct.pack("<6I", 0x2, SYMTAB, table_at, len(symbols), texts_at, len(texts)),
        struct.pack("<6I24s", 0xD, DYLIB, 24, 0, 0x10000, 0x10000, b"Plain.dylib"),
    ]
    head = b"".join(parts)
    assert len(head) == HEADER + commands
    return head.ljust(code_at, b"\0") + CODE + table + texts


def _segment(name: str, *, address: int, size: int, offset: int, sections: int) -> bytes:
    length = SEGMENT + SECTION * sections
    return struct.pack(
        "<2I16s4Q4I", 0x19, length, name.encode(), address, (size + 0xFFF) & ~0xFFF, offset, size, 5, 5, sections, 0
    )
