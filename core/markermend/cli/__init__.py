"""The command line: ``markermend COMMAND …``.

Engine modules are imported by the command that needs them, so that help and version are instant.
Every failure ends as one sentence on standard error; set ``MARKERMEND_DEBUG=1`` to see where an
unexpected one came from.
"""

from __future__ import annotations

import importlib
import os
import signal
import sys
from collections.abc import Sequence
from pathlib import Path

from markermend.cli.parser import COMMANDS, make_parser
from markermend.encoding import printable
from markermend.errors import Cancelled, MarkermendError, RangeError
from markermend.memory import keep_memory

DONE, FAILED = 0, 1

__all__ = ["main"]


def main(arguments: Sequence[str] | None = None) -> int:
    """Run one command.

    Parameters
    ----------
    arguments : words after the program's name; those of this process when not given

    Returns
    -------
    0 when done, 1 when the work could not be done (one sentence on standard error), 2 for bad
    usage
    """
    _set_up(own=arguments is None)
    given = _with_command(list(sys.argv[1:] if arguments is None else arguments))
    try:
        options = make_parser(given[0]).parse_args(given)
    except SystemExit as leaving:
        return int(leaving.code or DONE)
    # A window, whose loop is not Python's, would not hear it any more.
    if arguments is None and options.command != "open":
        signal.signal(signal.SIGTERM, signal.default_int_handler)
    try:
        command = importlib.import_module(f"markermend.cli.{options.command}")
        code: int = command.run(options)
        sys.stdout.flush()
    except (KeyboardInterrupt, Cancelled):
        return _fail("Stopped.")
    except BrokenPipeError:
        # The reader left (``| head``); nothing more may be written, not even at exit.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return FAILED
    except RangeError as error:
        return _fail(f"{error} (--float does that.)")
    except MarkermendError as error:
        return _fail(str(error))
    except OSError as error:
        return _fail(_sentence(error))
    except MemoryError:
        return _fail("There is not enough memory for this take.")
    except Exception as error:
        if os.environ.get("MARKERMEND_DEBUG"):
            raise
        return _fail(
            f"Markermend itself failed ({type(error).__name__}: {error}); "
            "set MARKERMEND_DEBUG=1 to see where, and please report it."
        )
    return code


def _set_up(own: bool) -> None:
    """Let no character end the output, and a process of its own keep its memory."""
    # Closed streams are None; what is said there is said to nobody.
    for name in ("stdout", "stderr"):
        if getattr(sys, name) is None:
            # A command is called “open”, which hides Python's own here.
            setattr(sys, name, Path(os.devnull).open("w", encoding="utf-8"))  # noqa: SIM115
    for stream in (sys.stdout, sys.stderr):
        if hasattr(stream, "reconfigure"):
            stream.reconfigure(errors="replace")
    if own:
        keep_memory()


def _with_command(words: list[str]) -> list[str]:
    """Put ``open`` before what is no command: nothing at all, or a take's path."""
    if not words:
        return ["open"]
    first = words[0]
    is_path = Path(first).suffix or os.sep in first or Path(first).exists()
    if first not in COMMANDS and not first.startswith("-") and is_path:
        return ["open", *words]
    return words


def _fail(sentence: str) -> int:
    """Say why on standard error."""
    sys.stderr.write(printable(sentence).rstrip() + "\n")
    return FAILED


def _sentence(error: OSError) -> str:
    """Turn an error of the operating system into a sentence."""
    name = error.filename
    match error:
        case FileNotFoundError() if name:
            return f"There is no file “{name}”."
        case IsADirectoryError() if name:
            return f"“{name}” is a folder, not a file."
        case PermissionError() if name:
            return f"“{name}” may not be read or written; check its permissions."
    reason = error.strerror or str(error)
    return f"“{name}”: {reason}." if name else f"{reason}."
