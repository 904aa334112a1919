"""A process of its own for the work of one plugin: it ends when the work is cancelled.

It is started as a program, not by ``multiprocessing``, which would run a script once more that has
no ``if __name__ == "__main__":``, and which forbids the processes of a batch to start others.
"""

from __future__ import annotations

import atexit
import subprocess
import sys
import threading
from dataclasses import dataclass
from io import FileIO
from queue import Empty, SimpleQueue
from typing import Any

from markermend.errors import MethodError
from markermend.plugins.channel import pack, receive, send, unpack
from markermend.processes import deaf
from markermend.progress import Progress, heed

_LOOK_S = 0.05
_SERVE = "markermend.plugins.serve"


@dataclass(frozen=True)
class _Running:
    """A process, what it has answered (None when it is gone), and the thread that listens."""

    process: subprocess.Popen[bytes]
    calls: FileIO
    answers: SimpleQueue[bytearray | None]
    listening: threading.Thread


class Worker:
    """Runs one plugin, call after call, in a process that is started when it is needed.

    Parameters
    ----------
    group, name : of its entry point
    """

    def __init__(self, group: str, name: str) -> None:
        self.group, self.name = group, name
        self._lock = threading.Lock()
        self._running: _Running | None = None
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
            when the plugin raises, its process dies or cannot be started
        """
        with self._lock:
            done = False
            try:
                running = self._started()
                send(running.calls, pack((member, arguments, progress is not None)))
                answer = _answer(running.answers, progress or _heeding)
                done = True
            except EOFError as error:
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
        running, self._running = self._running, None
        if running is None:
            return
        running.process.kill()
        running.process.wait()
        running.calls.close()
        # Its end of the pipe is closed now, unless it gave it to others; nobody waits for those.
        running.listening.join(_LOOK_S)

    def _started(self) -> _Running:
        """The process, started where there is none."""
        if self._running is None:
            try:
                self._running = _start(self.group, self.name)
            except OSError as error:
                raise MethodError(
                    f"The plugin “{self.name}” cannot run, since no process can be started "
                    f"({error.strerror or error})."
                ) from error
        return self._running


def _start(group: str, name: str) -> _Running:
    """Start the process of a plugin."""
    with deaf():
        process = subprocess.Popen(
            [*_program(), group, name],
            bufsize=0,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            # A window without a terminal has nowhere to print to.
            stderr=subprocess.DEVNULL if sys.__stderr__ is None else None,
            creationflags=getattr(subprocess, "CREATE_NO_WINDOW", 0),
        )
    calls, said = process.stdin, process.stdout
    assert isinstance(calls, FileIO)
    assert isinstance(said, FileIO)
    answers: SimpleQueue[bytearray | None] = SimpleQueue()
    # Windows has no way to look whether a pipe holds something, so a thread waits for it.
    listening = threading.Thread(target=_listen, args=(said, answers), daemon=True)
    listening.start()
    return _Running(process, calls, answers, listening)


def _program() -> list[str]:
    """Words that start Python with what plugins need, as this process has it."""
    if getattr(sys, "frozen", False):
        # The bundle's own program, whose start knows this module.
        return [sys.executable, "-m", _SERVE]
    # What multiprocessing takes over too, such as -X utf8.
    flags: list[str] = getattr(subprocess, "_args_from_interpreter_flags", list)()
    # Packages are found as they are here, whatever a script has added to the path.
    paths = [path for path in sys.path if isinstance(path, str)]
    code = f"import sys; sys.path[:] = {paths!a}; from {_SERVE} import main; main()"
    return [sys.executable, *flags, "-c", code]


def _listen(said: FileIO, answers: SimpleQueue[bytearray | None]) -> None:
    """Pass on what a process says, and that it is gone."""
    with said:
        while True:
            try:
                answers.put(receive(said))
            except EOFError:
                answers.put(None)
                return


def _heeding(share: float, doing: str) -> None:
    """Give whoever waits for the whole the chance to stop."""
    heed()


def _answer(answers: SimpleQueue[bytearray | None], progress: Progress) -> Any:
    """Wait for an answer, passing progress on and heeding a wish to stop."""
    told = 0.0, ""
    while True:
        try:
            data = answers.get(timeout=_LOOK_S)
        except Empty:
            progress(*told)
            continue
        if data is None:
            raise EOFError
        try:
            answer = unpack(data)
        except Exception as error:  # a result of something that is known there only
            return "failed", f"its result cannot be passed on, {error}"
        if answer[0] != "progress":
            return answer
        told = answer[1:]
        progress(*told)
