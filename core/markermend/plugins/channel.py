"""Values sent to another process and back: each pickled, its length before it.

The files are pipes without a buffer. A buffer has a lock, and a thread that waits in it for the
other side would keep a process from ending.
"""

from __future__ import annotations

import pickle
import struct
from io import FileIO
from typing import Any

_LENGTH = struct.Struct("<Q")
# From 5 on arrays that are read-only here would be so there, where they are copies to be changed.
_PROTOCOL = 4


def pack(value: Any) -> bytes:
    """Pickle a value; raises whatever its parts raise that cannot be pickled."""
    return pickle.dumps(value, protocol=_PROTOCOL)


def unpack(data: bytes | bytearray) -> Any:
    """The value again; raises whatever it raises where its parts are not known here."""
    return pickle.loads(data)


def send(file: FileIO, data: bytes) -> None:
    """Send a packed value.

    Raises
    ------
    EOFError
        when the other side is gone
    """
    try:
        for part in (_LENGTH.pack(len(data)), data):
            left = memoryview(part)
            while left:
                left = left[file.write(left) :]
    except OSError as error:  # broken pipe; Windows has another word for it
        raise EOFError from error


def receive(file: FileIO) -> bytearray:
    """Wait for a value, which comes packed.

    Raises
    ------
    EOFError
        when the other side is gone
    """
    (length,) = _LENGTH.unpack(_exactly(file, _LENGTH.size))
    return _exactly(file, length)


def _exactly(file: FileIO, size: int) -> bytearray:
    """Read so many bytes."""
    data = bytearray(size)
    left = memoryview(data)
    while left:
        try:
            count = file.readinto(left)
        except OSError as error:
            raise EOFError from error
        if not count:
            raise EOFError
        left = left[count:]
    return data
