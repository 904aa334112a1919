"""Text as bytes, whatever names are in it: those of files need not be text."""

from __future__ import annotations

import re

# What Python makes of bytes in a file name that are not UTF-8; no encoding takes them.
_ALONE = re.compile("[\ud800-\udfff]")


def printable(text: str) -> str:
    """Put the replacement character (``�``) where a file name has bytes that are no text."""
    return _ALONE.sub("\ufffd", text)


def utf8(text: str) -> bytes:
    """Encode text that people or programs read, as :func:`printable` has it."""
    try:
        return text.encode()
    except UnicodeEncodeError:
        return printable(text).encode()


def json_kept(text: str) -> str:
    r"""Write such bytes in JSON as escapes (``\udcff``), so that a path in it is found again."""
    return _ALONE.sub(lambda found: f"\\u{ord(found[0]):04x}", text)
