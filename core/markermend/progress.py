"""How long work tells what it is doing, and how it is stopped.

A progress function takes the share done in [0, 1] and what is being done. It may raise
:class:`markermend.errors.Cancelled`; the work then stops and the exception reaches the caller.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar

Progress = Callable[[float, str], None]


def quiet(share: float, doing: str) -> None:
    """Report to nobody."""


def part(progress: Progress | None, start: float, stop: float) -> Progress:
    """Map a sub-task's own [0, 1] onto ``[start, stop]`` of the whole task.

    Parameters
    ----------
    progress : of the whole task; None tells nobody
    start, stop : shares of the whole task

    Returns
    -------
    What the sub-task tells; it raises what ``progress`` raises
    """
    if progress is None:
        return quiet
    whole = progress

    def report(share: float, doing: str) -> None:
        whole(start + (stop - start) * min(max(share, 0.0), 1.0), doing)

    return report


_heeded: ContextVar[Callable[[], None] | None] = ContextVar("heeded", default=None)


@contextmanager
def heeded(progress: Progress) -> Iterator[Progress]:
    """Let work deep inside, which is given no progress function, be stopped by this one.

    Yields the function to report to instead; :func:`heed` repeats its last report.
    """
    told = 0.0, ""

    def report(share: float, doing: str) -> None:
        nonlocal told
        told = share, doing
        progress(share, doing)

    token = _heeded.set(lambda: progress(*told))
    try:
        yield report
    finally:
        _heeded.reset(token)


def heed() -> None:
    """Raise ``Cancelled`` when whoever waits for this work wants it stopped."""
    look = _heeded.get()
    if look is not None:
        look()
