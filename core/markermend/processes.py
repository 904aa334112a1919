"""Work in several processes; Ctrl-C, which reaches all of a terminal, is the parent's alone."""

from __future__ import annotations

import os
import signal
import threading
import time
import warnings
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from importlib import import_module
from typing import Any, TypeVar

from markermend.memory import give_back, keep_memory

T = TypeVar("T")
TRIM_S = 1.0
"""Seconds of work after which memory that lies idle is given back, once."""
_given_back_s = [0.0]
"""When this process last did that, by the monotonic clock."""


@contextmanager
def in_processes(
    work: Callable[..., T], arguments: Iterable[tuple[Any, ...]], jobs: int
) -> Iterator[Iterator[T]]:
    """Call a function many times, in processes.

    Parameters
    ----------
    work : function of a module
    arguments : of each call; taken as they are needed
    jobs : processes; 1 calls in this one, -1 takes as many as there are cores

    Yields
    ------
    Iterator
        of the results, in order and as they come; leaving the block ends what is not done
    """
    from joblib import Parallel, delayed

    calls = (delayed(_apart)(os.getpid(), work, each) for each in arguments)
    with deaf():
        results = Parallel(n_jobs=jobs, return_as="generator", pre_dispatch="2*n_jobs")(calls)
    try:
        yield results
    finally:
        with warnings.catch_warnings():
            # Leaving early is meant; joblib advises against it.
            warnings.filterwarnings("ignore", message=".*tasks which were still being processed")
            results.close()


@contextmanager
def processes_start(module: str, jobs: int) -> Iterator[None]:
    """Have processes started and a module imported there beside what is done in the block.

    :func:`in_processes` with as many jobs finds them ready then; one that is late imports what it
    needs by itself.

    Parameters
    ----------
    module : by name, the one of the functions to be called
    jobs : processes; nothing is started for 1
    """
    from joblib import effective_n_jobs

    count = effective_n_jobs(jobs)
    if count == 1:
        yield
        return
    with in_processes(_load, [(module,)] * count, jobs) as loaded:
        yield
        # One that still loads when the block is left would be ended.
        for _ in loaded:
            pass


def _load(module: str) -> None:
    import_module(module)


def _apart(parent: int, work: Callable[..., T], arguments: tuple[Any, ...]) -> T:
    """Call a function; a process started for it keeps its memory.

    After a second's work what lies idle is given back: joblib looks as often, and replaces a
    process that seems to grow.
    """
    if os.getpid() == parent:
        return work(*arguments)
    keep_memory()
    try:
        return work(*arguments)
    finally:
        if time.monotonic() - _given_back_s[0] > TRIM_S:
            give_back()
            _given_back_s[0] = time.monotonic()


@contextmanager
def deaf() -> Iterator[None]:
    """Let processes that are started here ignore Ctrl-C from the first moment on.

    One that is interrupted while it still starts would end in a traceback. Only the main thread
    may say so, and what has a terminal works there.
    """
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    before = signal.signal(signal.SIGINT, signal.SIG_IGN)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)
