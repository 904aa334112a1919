"""Buttons that Tab has reached are pressed by key, although the space bar plays elsewhere."""

from __future__ import annotations

from PySide6.QtCore import QEvent, QObject, Qt
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QAbstractButton, QApplication, QComboBox, QDialog, QWidget

_PRESSED = (QAbstractButton, QComboBox)
_RETURN = (Qt.Key.Key_Return, Qt.Key.Key_Enter)


class Pressing(QObject):
    """Gives Space and Return to the button that has the keyboard, before they are shortcuts.

    Parameters
    ----------
    window : whose buttons are pressed; those in dialogs have these keys anyway
    """

    def __init__(self, window: QWidget) -> None:
        super().__init__(window)
        for part in window.findChildren(QWidget):
            if isinstance(part, _PRESSED) and part.focusPolicy() & Qt.FocusPolicy.TabFocus:
                # After a click the keys stay with the review.
                part.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        app = QApplication.instance()
        assert isinstance(app, QApplication)
        app.focusChanged.connect(self._follow)

    def _follow(self, before: QWidget | None, now: QWidget | None) -> None:
        """Listen to the keys of the button that has the keyboard only."""
        if before is not None:
            before.removeEventFilter(self)
        if isinstance(now, _PRESSED) and not isinstance(now.window(), QDialog):
            now.installEventFilter(self)

    def eventFilter(self, pressed: QObject, event: QEvent) -> bool:
        """Claim the keys; Return, which Qt does not press buttons by outside dialogs, as well."""
        if not isinstance(event, QKeyEvent) or event.key() not in (Qt.Key.Key_Space, *_RETURN):
            return False
        if event.type() == QEvent.Type.ShortcutOverride:
            event.accept()
            return True
        if event.type() != QEvent.Type.KeyPress or event.key() not in _RETURN:
            return False
        if not event.isAutoRepeat():
            if isinstance(pressed, QComboBox):
                pressed.showPopup()
            elif isinstance(pressed, QAbstractButton):
                pressed.click()
        return True
