"""How far a batch is: lines on a terminal, failures in a pipe, or JSON lines for programs."""

from __future__ import annotations

import json
import shutil
import sys
import time
from typing import Any, Self

from markermend.batch import BatchResult, Source
from markermend.batch.pool import Message
from markermend.cli.console import say, warn

_BAR_WIDTH = 24
_REDRAW_S = 0.1


class Lines:
    """One line for all takes and one for each in work, on a terminal; failures anywhere."""

    def __init__(self) -> None:
        self._shown = sys.stderr.isatty()
        self._drawn = 0
        self._when = 0.0
        self._working: dict[str, Message] = {}

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *error: object) -> None:
        self._clear()

    def __call__(self, message: Message, take: Source, overall: float) -> None:
        """Show what happened."""
        if message.what in ("started", "progress"):
            self._working[take.name] = message
        else:
            self._working.pop(take.name, None)
        if message.what == "failed":
            self._clear()
            warn(f"{take.name}: {message.result}")
        now = time.monotonic()
        if self._shown and (now - self._when >= _REDRAW_S or message.what != "progress"):
            self._when = now
            self._draw(overall)

    def _draw(self, overall: float) -> None:
        """Replace what is shown."""
        self._clear()
        lines = [bar(overall, "all takes")]
        lines += [bar(m.share, f"{name}: {m.doing}") for name, m in self._working.items()]
        # What has scrolled out of the terminal could not be taken away again.
        lines = lines[: shutil.get_terminal_size().lines - 1]
        sys.stderr.write("\n".join(lines))
        sys.stderr.flush()
        self._drawn = len(lines)

    def _clear(self) -> None:
        """Take away what is shown."""
        if self._drawn:
            up = f"\033[{self._drawn - 1}A" if self._drawn > 1 else ""
            sys.stderr.write(f"\r{up}\033[J")
            sys.stderr.flush()
        self._drawn = 0


class JsonLines:
    """Every message as one line of JSON on standard output."""

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *error: object) -> None:
        sys.stdout.flush()

    def __call__(self, message: Message, take: Source, overall: float) -> None:
        """Write one line."""
        values: dict[str, Any] = {"event": message.what, "take": take.name}
        if message.what == "progress":
            values |= {"share": round(message.share, 4), "doing": message.doing}
        if message.what == "failed":
            values["why"] = message.result
        if message.what == "done":
            values["skipped"] = not message.result
        self._write(values | {"overall": round(overall, 4)})

    def finished(self, result: BatchResult) -> None:
        """Write the last line."""
        self._write(
            {
                "event": "finished",
                "cleaned": len(result.takes),
                "skipped": result.skipped,
                "failed": len(result.failures),
                "review": result.review,
                "overall": 1.0,
            }
        )

    def _write(self, values: dict[str, Any]) -> None:
        """Write one line at once, since a program waits for it."""
        say(json.dumps(values, ensure_ascii=False, allow_nan=False))
        sys.stdout.flush()


def bar(share: float, text: str) -> str:
    """A bar with what it stands for, cut to the terminal's width."""
    full = round(_BAR_WIDTH * min(max(share, 0.0), 1.0))
    room = max(shutil.get_terminal_size().columns - _BAR_WIDTH - 8, 0)
    return f"{'█' * full}{'░' * (_BAR_WIDTH - full)} {share:4.0%} {text[:room]}"
