"""Esc for a line of text itself, before the window takes it to let go what is selected."""

from __future__ import annotations

from PySide6.QtCore import QEvent, Qt
from PySide6.QtGui import QKeyEvent


def wants_escape(event: QEvent) -> bool:
    """Claim Esc when an event asks whose it is; whether this was that question."""
    if not isinstance(event, QKeyEvent) or event.type() != QEvent.Type.ShortcutOverride:
        return False
    claimed = event.key() == Qt.Key.Key_Escape
    if claimed:
        event.accept()
    return claimed
