"""Accept, Reject and Repair, standing beside the artifact under review."""

from __future__ import annotations

from PySide6.QtCore import QRectF, QSize, Qt
from PySide6.QtWidgets import QFrame, QHBoxLayout, QToolButton, QWidget

from markermend.artifact import Status
from markermend_app.actions.shortcuts import KeyTip
from markermend_app.document import Document
from markermend_app.offered import can_repair
from markermend_app.style import theme

_GAP = 8


class FloatingButtons(QFrame):
    """Three small buttons over the plots, one for each decision."""

    def __init__(self, document: Document, parent: QWidget) -> None:
        super().__init__(parent)
        self._document = document
        self.setObjectName("floatingButtons")
        self.setAccessibleName(self.tr("Decide about this artifact"))
        self.setCursor(Qt.CursorShape.ArrowCursor)
        self._row = layout = QHBoxLayout(self)
        layout.setContentsMargins(2, 2, 2, 2)
        layout.setSpacing(2)
        self.accept = self._add("accept", self.tr("Accept: the flag is right"))
        self.reject = self._add("reject", self.tr("Reject: a false alarm"))
        self.repair = self._add("repair", self.tr("Repair: replace the samples as shown"))
        self.accept.clicked.connect(document.decisions.accept_current)
        self.reject.clicked.connect(document.decisions.reject_current)
        self.repair.clicked.connect(document.decisions.repair_current)
        theme.watcher.changed.connect(self._restyle)
        self._restyle()
        self.hide()

    def refresh(self) -> None:
        """Enable what can be done to the current artifact."""
        current = self._document.current
        editable = self._document.editable and current is not None
        status = None if current is None else current.status
        self.accept.setEnabled(editable and status is not Status.ACCEPTED)
        self.reject.setEnabled(editable and status is not Status.REJECTED)
        self.repair.setEnabled(can_repair(self._document))

    def place(self, interval: QRectF | None, plot: QRectF) -> None:
        """Stand to the right of an interval, else to its left, else inside; hide without one.

        It stays within the plot, whose axes would be covered else; a low one at its upper edge.
        """
        if interval is None:
            self.hide()
            return
        size = self.sizeHint()
        x = interval.right() + _GAP
        if x + size.width() > plot.right():
            x = interval.left() - _GAP - size.width()
        if x < plot.left():
            x = min(interval.right(), plot.right()) - _GAP - size.width()
        self.resize(size)
        y = max(plot.top(), min(plot.top() + _GAP, plot.bottom() - size.height()))
        self.move(round(max(x, plot.left())), round(y))
        self.show()
        self.raise_()

    def _add(self, name: str, tip: str) -> QToolButton:
        """One button."""
        button = QToolButton()
        button.setObjectName(name)
        KeyTip(button, tip, name)
        button.setIconSize(QSize(18, 18))
        # The keys do the same; the focus stays with the plots.
        button.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self._row.addWidget(button)
        return button

    def _restyle(self) -> None:
        """Draw the icons in the theme's colour."""
        for button in (self.accept, self.reject, self.repair):
            button.setIcon(theme.icon(button.objectName()))
