"""The line in which a note on the artifact under review is written."""

from __future__ import annotations

from PySide6.QtCore import QEvent, Qt, Signal
from PySide6.QtGui import QFocusEvent, QKeyEvent
from PySide6.QtWidgets import QLineEdit, QWidget

from markermend_app.document import Document
from markermend_app.panels.own_escape import wants_escape


class NoteLine(QLineEdit):
    """Return keeps the note, Escape what was there; both give the keys back to the review.

    A note on one joint of several that are decided at once is one on all of them.

    Signals
    -------
    left() : the keys are to go back
    """

    left = Signal()

    def __init__(self, document: Document, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._document = document
        self._of: tuple[str, ...] = ()
        self.setPlaceholderText(self.tr("Nothing written yet"))
        self.setAccessibleName(self.tr("Note"))
        self.setToolTip(self.tr("Kept with the review; shown in the queue and in reports"))
        self.editingFinished.connect(self._keep)
        document.current_changed.connect(self._refresh)
        self._refresh()

    def event(self, event: QEvent) -> bool:
        """Keep Esc for the line."""
        return wants_escape(event) or super().event(event)

    def focusInEvent(self, event: QFocusEvent) -> None:
        """Be on what is decided at once now; the queue may have been filtered meanwhile."""
        self._of = self._document.together
        super().focusInEvent(event)

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
        now = self._document.together
        writing = self.hasFocus() and self.isModified()
        if now[:1] == self._of[:1] and writing and not anew:
            return
        if now[:1] != self._of[:1] and self.hasFocus():
            self._keep()
        self._of = now
        self.setText("" if current is None else current.note)
        self.setEnabled(current is not None and self._document.editable)

    def _keep(self) -> None:
        """Write the note into the review."""
        session = self._document.session
        if session is None or not self.isModified():
            return
        self.setModified(False)
        one, *others = [i for i in self._of if session.find(i) is not None] or [""]
        if one and self.text().strip() != session.artifact(one).note:
            self._document.do(lambda s: s.annotate(one, self.text(), others=others))
