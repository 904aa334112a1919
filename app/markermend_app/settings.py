"""What the app remembers between starts: recent takes, theme, layout."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from PySide6.QtCore import QByteArray, QSettings

RECENT = 10


def store() -> QSettings:
    """Where settings are kept for this user."""
    return QSettings("Markermend", "Markermend")


def recent() -> list[Path]:
    """Takes opened lately and still there, newest first."""
    value: Any = store().value("recent", [])
    names: list[str] = [value] if isinstance(value, str) else list(value or [])
    return [p for p in map(Path, names) if p.exists()]


def add_recent(path: Path) -> None:
    """Put a take on top of the recent ones."""
    rest = [p for p in recent() if p != path]
    store().setValue("recent", [str(p) for p in [path, *rest][:RECENT]])


def flag(name: str, default: bool) -> bool:
    """Read an on/off preference."""
    return bool(store().value(name, default, type=bool))


def number(name: str, default: float) -> float:
    """Read a preference that is a number; the default where it is none."""
    try:
        return float(str(store().value(name, default)))
    except ValueError:
        return default


def text(name: str, default: str) -> str:
    """Read a preference that is a word."""
    return str(store().value(name, default))


def layout(name: str) -> QByteArray | None:
    """Read a stored window layout, or None."""
    value = store().value(name)
    return value if isinstance(value, QByteArray) and not value.isEmpty() else None


def remember(name: str, value: object) -> None:
    """Store a preference."""
    store().setValue(name, value)
