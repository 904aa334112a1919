"""Work in several processes; Ctrl-C, which reaches all of a terminal, is the parent's alone."""

from __future__ import annotations

import signal
import threading
import warnings
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from typing import Any, TypeVar

T = TypeVar("T")


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

    calls = (delayed(work)(*each) for each in arguments)
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
