"""What the app remembers between starts: recent takes, theme, layout.

Preferences are written by a thread of their own, for Qt waits until they are on the disk; what
was read or remembered once is known from then on, so that nobody waits for that thread.
"""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from functools import cache
from pathlib import Path
from typing import Any

from PySide6.QtCore import QByteArray, QSettings

RECENT = 10

_known: dict[str, Any] = {}
"""Values by name; None where nothing is remembered."""


def store() -> QSettings:
    """Where settings are kept for this user."""
    return QSettings("Markermend", "Markermend")


def recent() -> list[Path]:
    """Takes opened lately and still there, newest first."""
    return _paths(_value("recent"))


def add_recent(path: Path) -> None:
    """Put a take on top of the recent ones."""
    _known["recent"] = _on_top(path, recent())
    _writer().submit(_write_recent, path)


def flag(name: str, default: bool) -> bool:
    """Read an on/off preference."""
    value = _value(name)
    if value is None:
        return default
    # A file of settings holds words.
    return str(value).lower() not in ("false", "0", "")


def number(name: str, default: float) -> float:
    """Read a preference that is a number; the default where it is none."""
    value = _value(name)
    try:
        return default if value is None else float(str(value))
    except ValueError:
        return default


def text(name: str, default: str) -> str:
    """Read a preference that is a word."""
    value = _value(name)
    return default if value is None else str(value)


def layout(name: str) -> QByteArray | None:
    """Read a stored window layout, or None."""
    value = _value(name)
    return value if isinstance(value, QByteArray) and not value.isEmpty() else None


def remember(name: str, value: object) -> None:
    """Store a preference, or forget it where the value is None."""
    _known[name] = value
    _writer().submit(_write, name, value)


def settle() -> None:
    """Wait until everything remembered is on the disk."""
    _writer().submit(int).result()


def _paths(value: Any) -> list[Path]:
    """The takes of a stored list that are still there; a list of one is stored as a word."""
    names: list[str] = [value] if isinstance(value, str) else list(value or [])
    return [p for p in map(Path, names) if p.exists()]


def _on_top(path: Path, takes: list[Path]) -> list[str]:
    rest = [p for p in takes if p != path]
    return [str(p) for p in [path, *rest][:RECENT]]


def _value(name: str) -> Any:
    """What is remembered under a name, or None."""
    if name in _known:
        return _known[name]
    # Another thread may have remembered something meanwhile, which holds.
    return _known.setdefault(name, store().value(name))


@cache
def _writer() -> ThreadPoolExecutor:
    """The thread that writes, one thing after the other."""
    return ThreadPoolExecutor(1, thread_name_prefix="settings")


def _write(name: str, value: object) -> None:
    kept = store()
    if value is None:
        kept.remove(name)
    else:
        kept.setValue(name, value)
    kept.sync()


def _write_recent(path: Path) -> None:
    """Put a take on top of what is stored, to which another window may have added meanwhile."""
    kept = store()
    kept.sync()
    kept.setValue("recent", _on_top(path, _paths(kept.value("recent"))))
    kept.sync()
