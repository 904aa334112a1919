"""Writing a file, and bringing it to the disk, beside what goes on."""

from __future__ import annotations

import os
import threading
from collections.abc import Callable
from concurrent.futures import Future, ThreadPoolExecutor


class OnDisk:
    """Has what is written to a file brought to the disk, which takes 20 ms and at times 400.

    Nobody waits for it: what is written meanwhile is brought there next, all at once.
    """

    def __init__(self) -> None:
        self._lock = threading.Lock()
        # To start a thread waits until it runs, which for every step is too long.
        self._pool = ThreadPoolExecutor(max_workers=1, thread_name_prefix="on disk")
        self._under_way: Future[None] | None = None
        self._writes: list[Callable[[], object]] = []
        self._working = self._writing = self._wanted = False
        self._error: Exception | None = None

    def keep(self, handle: int, write: Callable[[], object], long: bool = False) -> None:
        """Write, and begin to bring what was written to the disk.

        Parameters
        ----------
        handle : descriptor of the file
        write : writes to it
        long : whether that takes long; then it is done later, and so is all that follows until then

        Raises
        ------
        OSError
            or what else ``write`` raises, when this or what was kept before could not be written
            or brought there; told once
        """
        with self._lock:
            # Under the lock: what failed in between must not be followed by anything.
            self._raise()
            later = long or self._writing
            if later:
                self._writes.append(write)
                self._writing = True
        # What writes at once is never two threads at a time: only this one begins to.
        if not later:
            write()
        with self._lock:
            self._wanted = True
            if not self._working:
                self._under_way = self._pool.submit(self._work, handle)
                self._working = True

    def wait(self) -> None:
        """Return once everything is there; errors as in :meth:`keep`."""
        if self._under_way is not None:
            self._under_way.result()
        self._raise()

    def settle(self) -> None:
        """Return once nothing is left to be written, and forget what went wrong with it."""
        if self._writing and self._under_way is not None:
            self._under_way.result()
        self._error = None

    def close(self) -> None:
        """Let go of the thread, once everything is there; nothing can be kept afterwards."""
        self._pool.shutdown()

    def _raise(self) -> None:
        """Tell of what went wrong."""
        error, self._error = self._error, None
        if error is not None:
            raise error

    def _work(self, handle: int) -> None:
        """Write what is to be written later, and bring all to the disk, until nothing is left."""
        while True:
            with self._lock:
                if not self._wanted:
                    self._working = False
                    return
                writes, self._writes, self._wanted = self._writes, [], False
            try:
                for write in writes:
                    write()
                with self._lock:
                    self._writing = bool(self._writes)
                os.fsync(handle)
            except Exception as error:
                with self._lock:
                    # What follows would continue something that is not there.
                    self._writes, self._writing, self._wanted = [], False, False
                    self._error, self._working = error, False
                return
