"""What runs in the process of a plugin: it answers calls and ends with who started it."""

from __future__ import annotations

import os
import signal
import sys
import threading
from collections.abc import Callable
from importlib.metadata import entry_points
from io import FileIO
from queue import SimpleQueue
from typing import Any

from markermend.errors import MarkermendError
from markermend.plugins.channel import pack, receive, send, unpack


def main() -> None:
    """Serve the plugin that the last two words of the command line name: group, entry point."""
    # Ctrl-C reaches all processes of a terminal; the parent alone decides.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    group, name = sys.argv[-2:]
    ours, theirs = _streams()
    calls: SimpleQueue[bytearray] = SimpleQueue()
    # Before anything of the plugin runs, so that none outlives who started it.
    threading.Thread(target=_hear, args=(ours, calls), daemon=True).start()
    plugin = next(iter(entry_points(group=group, name=name))).load()
    while True:
        _reply(theirs, _answer(plugin, calls.get(), theirs))


def _streams() -> tuple[FileIO, FileIO]:
    """Where calls come from and answers go to: standard input and output, taken from the plugin.

    What it prints goes where errors go, so that it mixes with no answer and with nothing that the
    command line tells programs.
    """
    ours, theirs = FileIO(os.dup(0), "r"), FileIO(os.dup(1), "w")
    nothing = os.open(os.devnull, os.O_RDONLY)
    os.dup2(nothing, 0)
    os.close(nothing)
    os.dup2(2, 1)
    if hasattr(sys.stdout, "reconfigure"):
        # The process is killed in the end, with what it has not yet printed.
        sys.stdout.reconfigure(line_buffering=True)
    return ours, theirs


def _hear(file: FileIO, calls: SimpleQueue[bytearray]) -> None:
    """Pass calls on until the other side leaves; what is at work then is of no more use."""
    while True:
        try:
            calls.put(receive(file))
        except EOFError:
            os._exit(1)


def _answer(plugin: Any, call: bytearray, theirs: FileIO) -> tuple[str, Any]:
    """Do what is asked for."""
    try:
        member, arguments, reports = unpack(call)
        if reports:
            arguments = (*arguments, _reporting(theirs))
        return "done", getattr(plugin, member)(*arguments)
    except MarkermendError as error:
        return "error", error
    except Exception as error:  # a stranger's code may raise anything
        return "failed", f"{type(error).__name__}: {error}"


def _reply(theirs: FileIO, answer: tuple[str, Any]) -> None:
    """Send an answer, or why it cannot be sent."""
    try:
        data = pack(answer)
    except Exception as error:  # whatever the parts of a result raise
        data = pack(("failed", f"its result cannot be passed on, {error}"))
    send(theirs, data)


def _reporting(theirs: FileIO) -> Callable[[float, str], None]:
    """Make a progress function that reports to the other side."""
    # A plugin may report from threads of its own.
    lock = threading.Lock()

    def report(share: float, doing: str) -> None:
        with lock:
            send(theirs, pack(("progress", float(share), str(doing))))

    return report


if __name__ == "__main__":
    main()
