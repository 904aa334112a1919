"""A menu of check marks that stays open while one after the other is set."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtGui import QAction, QKeyEvent, QMouseEvent
from PySide6.QtWidgets import QMenu


class StayingMenu(QMenu):
    """Closes after what is no check mark, as menus do; a check mark is set and may be set back."""

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        """Set a check mark."""
        if not _check(self.actionAt(event.position().toPoint())):
            super().mouseReleaseEvent(event)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Set a check mark with the space bar; Return closes the menu as well."""
        if event.key() != Qt.Key.Key_Space or not _check(self.activeAction()):
            super().keyPressEvent(event)


def _check(action: QAction | None) -> bool:
    """Trigger what is a check mark; whether it was one."""
    if action is None or not action.isCheckable() or not action.isEnabled():
        return False
    action.trigger()
    return True
