"""Memory that was taken from the system is kept for what comes next."""

from __future__ import annotations

import ctypes
import sys
from functools import cache
from typing import Any

TRIM_THRESHOLD, TOP_PAD, MMAP_THRESHOLD, ARENA_MAX = -1, -2, -3, -8
"""What glibc's ``mallopt`` calls them."""

_KEPT = {
    # Threads that each keep what they were given would hold several times as much.
    ARENA_MAX: (1,),
    # Before version 2.35 no more than 32 MB are taken.
    MMAP_THRESHOLD: (1 << 30, 1 << 25),
    TRIM_THRESHOLD: ((1 << 31) - 1,),
    TOP_PAD: (1 << 26,),
}


@cache
def keep_memory() -> bool:
    """Have large arrays made of memory that is there already, where the C library can; if it can.

    By itself glibc asks the system for every array above some megabytes and gives it back when
    the array goes. Each new page is then cleared by the kernel when first touched, under a lock
    of the whole process: a search spends a tenth of its time there, and a worker that smooths a
    take makes a window wait again and again. The process grows to what it needed at once, and
    stays there. Call it in a process of one's own, before arrays are made; other C libraries keep
    their ways.
    """
    mallopt = _of_the_library("mallopt")
    if mallopt is None:
        return False
    # Each is tried, whatever became of those before.
    done = [any(mallopt(what, size) == 1 for size in sizes) for what, sizes in _KEPT.items()]
    return all(done)


def give_back() -> None:
    """Give the system what is kept and not used, as between two pieces of work."""
    trim = _of_the_library("malloc_trim")
    if trim is not None:
        trim(ctypes.c_size_t(0))


@cache
def _of_the_library(name: str) -> Any:
    """A function of the C library, or None where that is not glibc."""
    return getattr(ctypes.CDLL(None), name, None) if sys.platform.startswith("linux") else None
