"""What a list says in its middle when what was typed leaves none of its rows."""

from __future__ import annotations

from PySide6.QtCore import QEvent, QObject, Qt
from PySide6.QtWidgets import QAbstractItemView

from markermend_app.panels.markers.badge import hint


class Nothing(QObject):
    """A calm sentence over a list.

    Parameters
    ----------
    view : the list
    text : the sentence
    """

    def __init__(self, view: QAbstractItemView, text: str) -> None:
        super().__init__(view)
        self._area = view.viewport()
        self.label = hint(text, self._area)
        self.label.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)
        self.label.hide()
        self._area.installEventFilter(self)

    def show(self, empty: bool) -> None:
        """Say it while the list is empty."""
        self.label.resize(self._area.size())
        self.label.setVisible(empty)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Fill the list's area."""
        if event.type() == QEvent.Type.Resize:
            self.label.resize(self._area.size())
        return False
