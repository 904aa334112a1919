"""A line that narrows a list down; the keyboard goes from it to the list and back to review."""

from __future__ import annotations

from PySide6.QtCore import QEvent, Qt, Signal
from PySide6.QtGui import QAction, QKeyEvent, QResizeEvent
from PySide6.QtWidgets import QLineEdit, QWidget

from markermend_app.panels.own_escape import wants_escape
from markermend_app.style import theme

_BESIDE = 48
"""Pixels that the icon and the frame take."""


class FilterLine(QLineEdit):
    """Escape clears it; Return and Down go on to the list, as does Escape when it is empty.

    Parameters
    ----------
    text : what it is for, shown while it is empty
    target : the list

    Signals
    -------
    went_on() : the keyboard went on to the list, for what was found
    """

    went_on = Signal()

    def __init__(self, text: str, target: QWidget, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._target, self._text = target, text
        self.set_text(text)
        self.setClearButtonEnabled(True)
        self._search = QAction(self)
        self.addAction(self._search, QLineEdit.ActionPosition.LeadingPosition)
        theme.watcher.changed.connect(self._recolour)
        self._recolour()

    def set_text(self, text: str) -> None:
        """Say what it is for."""
        self._text = text
        self.setAccessibleName(text)
        self._fit()

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Let the icon say it alone where the words have no room."""
        super().resizeEvent(event)
        self._fit()

    def _fit(self) -> None:
        fits = self.fontMetrics().horizontalAdvance(self._text) + _BESIDE <= self.width()
        self.setPlaceholderText(self._text if fits else "")

    def event(self, event: QEvent) -> bool:
        """Keep Esc for the line."""
        return wants_escape(event) or super().event(event)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Leave the line, or clear it."""
        key = event.key()
        if key == Qt.Key.Key_Escape and self.text():
            self.clear()
        elif key in (Qt.Key.Key_Escape, Qt.Key.Key_Return, Qt.Key.Key_Enter, Qt.Key.Key_Down):
            self._target.setFocus(Qt.FocusReason.ShortcutFocusReason)
            if key != Qt.Key.Key_Escape:
                self.went_on.emit()
        else:
            super().keyPressEvent(event)

    def _recolour(self) -> None:
        self._search.setIcon(theme.icon("search"))
