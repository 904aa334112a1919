"""The line in which a note on the artifact under review is written."""

from __future__ import annotations

from PySide6.QtCore import QEvent, Qt, Signal
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QLineEdit, QWidget

from markermend_app.document import Document
from markermend_app.panels.own_escape import wants_escape


class NoteLine(QLineEdit):
    """Return keeps the note, Escape what was there; both give the keys back to the review.

    Signals
    -------
    left() : the keys are to go back
    """

    left = Signal()

    def __init__(self, document: Document, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._document = document
        self._of: str | None = None
        self.setPlaceholderText(self.tr("Nothing written yet"))
        self.setAccessibleName(self.tr("Note"))
        self.setToolTip(self.tr("Kept with the review; shown in the queue and in reports"))
        self.editingFinished.connect(self._keep)
        document.current_changed.connect(self._refresh)
        self._refresh()

    def event(self, event: QEvent) -> bool:
        """Keep Esc for the line."""
        return wants_escape(event) or super().event(event)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Leave the line."""
        key = event.key()
        if key == Qt.Key.Key_Escape:
            self._refresh(anew=True)
        if key in (Qt.Key.Key_Escape, Qt.Key.Key_Return, Qt.Key.Key_Enter):
            # Editing is finished by losing the focus.
            self.left.emit()
        else:
            super().keyPressEvent(event)

    def _refresh(self, *, anew: bool = False) -> None:
        """Show the current artifact's note; one that is being written stays."""
        current = self._document.current
        now = None if current is None else current.id
        if now == self._of and self.hasFocus() and not anew:
            return
        if now != self._of and self.hasFocus():
            self._keep()
        self._of = now
        self.setText("" if current is None else current.note)
        self.setEnabled(current is not None and self._document.editable)

    def _keep(self) -> None:
        """Write the note into the review."""
        session, written = self._document.session, self._of
        if session is None or written is None or session.find(written) is None:
            return
        if self.text().strip() != session.artifact(written).note:
            self._document.do(lambda s: s.annotate(written, self.text()))
