"""Home and End for a list itself, before the window takes them to go to the take's ends."""

from __future__ import annotations

from PySide6.QtCore import QEvent, QObject, Qt
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QWidget


class OwnEnds(QObject):
    """Claims both keys while a list has the keyboard: its first and its last row.

    Parameters
    ----------
    view : whose keys they are
    """

    def __init__(self, view: QWidget) -> None:
        super().__init__(view)
        view.installEventFilter(self)

    def eventFilter(self, view: QObject, event: QEvent) -> bool:
        """Answer when it is asked whose a key is."""
        if not isinstance(event, QKeyEvent) or event.type() != QEvent.Type.ShortcutOverride:
            return False
        claimed = event.key() in (Qt.Key.Key_Home, Qt.Key.Key_End)
        if claimed and not event.modifiers() & ~Qt.KeyboardModifier.KeypadModifier:
            event.accept()
            return True
        return False
