"""Worker processes that may die: each has one job at a time and a pipe of its own.

A killed worker costs its current job only, which another one takes up. The executors of the
standard library and joblib give up all jobs when one worker dies.
"""

from __future__ import annotations

import contextlib
import multiprocessing
import os
import signal
import threading
import time
from collections import deque
from collections.abc import Callable, Generator, Iterator, Sequence
from dataclasses import dataclass
from multiprocessing.connection import Connection, wait
from typing import Any

from markermend.batch.work import why
from markermend.processes import deaf
from markermend.progress import Progress

# One that kills two workers would go on to kill all.
_TRIES = 2
_TELL_EVERY_S = 0.1
_ONE_THREAD = (
    *("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"),
    *("VECLIB_MAXIMUM_THREADS", "NUMEXPR_NUM_THREADS"),
)


@dataclass(frozen=True)
class Message:
    """What happened to a job.

    Attributes
    ----------
    job : its number
    what : ``"started"``, ``"progress"``, ``"done"`` or ``"failed"``
    share, doing : how far it is, and what is being done
    result : of the work, when done; one sentence, when failed
    """

    job: int
    what: str
    share: float = 0.0
    doing: str = ""
    result: Any = None


@dataclass
class _Worker:
    process: Any
    pipe: Connection
    job: int | None = None


def run_jobs(
    jobs: Sequence[Any], work: Callable[[Any, Progress], Any], processes: int
) -> Generator[Message, None, None]:
    """Do jobs in processes, in the order given.

    Parameters
    ----------
    jobs : can be pickled
    work : function of a module, called with a job and a progress function
    processes : how many; each has one thread for linear algebra

    Yields
    ------
    Message
        as things happen. Closing the generator ends the processes.
    """
    waiting = deque(range(len(jobs)))
    tries = [0] * len(jobs)
    workers = [_start(work) for _ in range(min(processes, len(jobs)))]
    try:
        while waiting or any(w.job is not None for w in workers):
            for worker in workers:
                if worker.job is None and waiting:
                    worker.job = waiting.popleft()
                    tries[worker.job] += 1
                    # One that has died already is noticed below, by its pipe's end.
                    with contextlib.suppress(OSError):
                        worker.pipe.send(jobs[worker.job])
                    yield Message(worker.job, "started")
            ready = wait([w.pipe for w in workers])
            for worker in [w for w in workers if w.pipe in ready]:
                try:
                    message = worker.pipe.recv()
                except (EOFError, OSError):
                    workers.remove(worker)
                    yield from _bury(worker, waiting, tries)
                    if waiting:
                        workers.append(_start(work))
                    continue
                assert worker.job is not None
                yield Message(worker.job, *message)
                if message[0] != "progress":
                    worker.job = None
    finally:
        for worker in workers:
            _end(worker)


def _bury(worker: _Worker, waiting: deque[int], tries: list[int]) -> Iterator[Message]:
    """Put a dead worker's job in front again, or give it up."""
    _end(worker)
    if worker.job is None:
        return
    if tries[worker.job] < _TRIES:
        waiting.appendleft(worker.job)
        return
    sentence = (
        f"The process that cleaned it ended {_TRIES} times before it was done "
        f"(exit code {worker.process.exitcode}); perhaps there is not enough memory for it."
    )
    yield Message(worker.job, "failed", result=sentence)


def _start(work: Callable[[Any, Progress], Any]) -> _Worker:
    """Start a process that waits for jobs."""
    context = multiprocessing.get_context("spawn")
    ours, theirs = context.Pipe()
    process = context.Process(target=_serve, args=(theirs, work), daemon=True)
    with _one_thread(), deaf():
        process.start()
    # Ours alone is left, so that the worker's end is the pipe's end.
    theirs.close()
    return _Worker(process, ours)


def _end(worker: _Worker) -> None:
    """End a process, idle or not."""
    worker.pipe.close()
    worker.process.terminate()
    worker.process.join()


@contextlib.contextmanager
def _one_thread() -> Iterator[None]:
    """Set what a new process's linear algebra reads before it can be told otherwise."""
    before = {name: os.environ.get(name) for name in _ONE_THREAD}
    os.environ.update(dict.fromkeys(_ONE_THREAD, "1"))
    try:
        yield
    finally:
        for name, value in before.items():
            if value is None:
                del os.environ[name]
            else:
                os.environ[name] = value


def _end_with_parent() -> None:
    """End this process when its parent does, even where it hears nothing of the job it is at."""
    parent = multiprocessing.parent_process()
    if parent is not None:
        parent.join()
        os._exit(1)


def _serve(pipe: Connection, work: Callable[[Any, Progress], Any]) -> None:
    """Do jobs until the pipe ends: the life of a worker."""
    # Ctrl-C reaches all processes of a terminal; the parent alone decides.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    threading.Thread(target=_end_with_parent, daemon=True).start()
    told = 0.0

    def tell(*message: Any) -> None:
        try:
            pipe.send(message)
        except OSError:
            # The parent is gone, and nobody waits for the rest of this job.
            os._exit(1)

    def progress(share: float, doing: str) -> None:
        nonlocal told
        now = time.monotonic()
        if now - told >= _TELL_EVERY_S:
            told = now
            tell("progress", share, doing)

    while True:
        try:
            job = pipe.recv()
        except (EOFError, OSError):
            return
        try:
            result = work(job, progress)
        except Exception as error:
            tell("failed", 1.0, "", why(error))
        else:
            tell("done", 1.0, "", result)
