"""The lock on a review's journal: it marks the review as open, and dies with its process."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import IO


def open_locked(path: Path) -> IO[bytes] | None:
    """Open the journal under the operating system's lock, or None when another holds it."""
    # Unbuffered, so that nothing a full disk refused is left to be written by a later step.
    handle = open(path, "a+b", buffering=0)  # noqa: SIM115 - held open for the life of the review
    try:
        if sys.platform == "win32":
            import msvcrt

            # Far behind the content, so that other programs can still read the journal.
            handle.seek(1 << 30)
            msvcrt.locking(handle.fileno(), msvcrt.LK_NBLCK, 1)
        else:
            import fcntl

            fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        handle.close()
        return None
    return handle
