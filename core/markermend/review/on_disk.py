"""Bringing a file to the disk beside what goes on."""

from __future__ import annotations

import os
import threading


class OnDisk:
    """Has what was written to a file brought to the disk, which takes 20 ms and more."""

    def __init__(self) -> None:
        self._thread: threading.Thread | None = None
        self._error: OSError | None = None

    def bring(self, handle: int) -> None:
        """Begin to bring what was written to a file, given by its descriptor, to the disk."""
        self._thread = threading.Thread(target=self._bring, args=(handle,), name="on disk")
        self._thread.start()

    def wait(self) -> None:
        """Return once it is there.

        Raises
        ------
        OSError
            when it could not be brought there; told once
        """
        if self._thread is not None:
            self._thread.join()
            self._thread = None
        error, self._error = self._error, None
        if error is not None:
            raise error

    def _bring(self, handle: int) -> None:
        try:
            os.fsync(handle)
        except OSError as error:
            self._error = error
