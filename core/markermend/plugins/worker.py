"""A process of its own for the work of one plugin: it ends when the work is cancelled."""

from __future__ import annotations

import atexit
import multiprocessing
import threading
from collections.abc import Callable
from importlib.metadata import entry_points
from multiprocessing.connection import Connection
from typing import Any

from markermend.errors import MarkermendError, MethodError
from markermend.progress import Progress, heed

_LOOK_S = 0.05


class Worker:
    """Runs one plugin, call after call, in a process that is started when it is needed.

    Parameters
    ----------
    group, name : of its entry point
    """

    def __init__(self, group: str, name: str) -> None:
        self.group, self.name = group, name
        self._lock = threading.Lock()
        self._process: Any = None
        self._pipe: Connection | None = None
        atexit.register(self.stop)

    def call(self, *arguments: Any, member: str = "run", progress: Progress | None = None) -> Any:
        """Call the plugin.

        Parameters
        ----------
        arguments : go to the other process, so that the plugin cannot change ours
        member : which function of the plugin
        progress : gets what the plugin reports, where it is given a progress function as its last
            argument; may raise ``Cancelled``. Without one, that of the job all this is part of

        Raises
        ------
        MethodError
            when the plugin raises or its process dies
        """
        with self._lock:
            pipe = self._started()
            done = False
            try:
                pipe.send((member, arguments, progress is not None))
                answer = _answer(pipe, progress or _heeding)
                done = True
            except (EOFError, BrokenPipeError, ConnectionResetError) as error:
                raise MethodError(
                    f"The plugin “{self.name}” broke off: its process died."
                ) from error
            finally:
                # Also when cancelled: a process in the middle of something is of no more use.
                if not done:
                    self.stop()
        match answer:
            case ("done", result):
                return result
            case ("error", error):
                raise error
        raise MethodError(f"The plugin “{self.name}” failed ({answer[1]}).")

    def stop(self) -> None:
        """End the process."""
        if self._process is not None:
            self._process.kill()
            self._process.join()
            self._process = None
        if self._pipe is not None:
            self._pipe.close()
            self._pipe = None

    def _started(self) -> Connection:
        if self._pipe is None:
            # Spawned, since a fork of a process with threads and a window may hang.
            context = multiprocessing.get_context("spawn")
            self._pipe, theirs = context.Pipe()
            self._process = context.Process(
                target=_serve, args=(self.group, self.name, theirs), daemon=True
            )
            self._process.start()
            theirs.close()
        return self._pipe


def _heeding(share: float, doing: str) -> None:
    """Give whoever waits for the whole the chance to stop."""
    heed()


def _answer(pipe: Connection, progress: Progress) -> Any:
    """Wait for an answer, passing progress on and heeding a wish to stop."""
    told = 0.0, ""
    while True:
        if not pipe.poll(_LOOK_S):
            progress(*told)
            continue
        answer = pipe.recv()
        if answer[0] != "progress":
            return answer
        told = answer[1:]
        progress(*told)


def _serve(group: str, name: str, pipe: Connection) -> None:
    """Answer calls until the other side leaves; runs in the process of the plugin."""
    plugin = next(iter(entry_points(group=group, name=name))).load()
    while True:
        try:
            member, arguments, reports = pipe.recv()
        except EOFError:
            return
        if reports:
            arguments = (*arguments, _reporting(pipe))
        try:
            answer: tuple[str, Any] = ("done", getattr(plugin, member)(*arguments))
        except MarkermendError as error:
            answer = ("error", error)
        except Exception as error:  # a stranger's code may raise anything
            answer = ("failed", f"{type(error).__name__}: {error}")
        try:
            pipe.send(answer)
        except (TypeError, AttributeError, ValueError) as error:
            pipe.send(("failed", f"its result cannot be passed on, {error}"))


def _reporting(pipe: Connection) -> Callable[[float, str], None]:
    """Make a progress function that reports to the other side."""

    def report(share: float, doing: str) -> None:
        pipe.send(("progress", float(share), str(doing)))

    return report
