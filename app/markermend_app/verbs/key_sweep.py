"""A range swept by the keyboard: from where the cursor is to where it goes."""

from __future__ import annotations

from PySide6.QtCore import QObject, Signal

from markermend_app.actions.shortcuts import with_key
from markermend_app.document import Document
from markermend_app.looking import Selection


class KeySweep(QObject):
    """While it sweeps, the range follows the cursor; letting the range go ends it.

    Signals
    -------
    said(str) : a sentence for the status bar
    """

    said = Signal(str)

    def __init__(self, document: Document, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._document = document
        self._begun: Selection | None = None
        document.frame_changed.connect(self._follow)
        document.selection_changed.connect(self._forget)

    def sweep(self) -> None:
        """Begin a range on the foremost marker at the cursor, or end the one begun."""
        if self._begun is not None:
            self._forget()
            self.said.emit("")
            return
        frame = self._document.frame
        self._sweep(Selection(self._document.shown[0], frame, frame + 1), frame)
        text = self.tr("Move the cursor to where the selection ends, then press again")
        self.said.emit(with_key(text, "sweep"))

    def _follow(self, frame: int) -> None:
        """Sweep up to the cursor, as long as the marker stays foremost."""
        begun = self._begun
        if begun is not None and self._document.shown[:1] == (begun.marker,):
            self._sweep(begun, frame)
        else:
            self._forget()

    def _sweep(self, begun: Selection, frame: int) -> None:
        start, stop = min(begun.start, frame), max(begun.stop, frame + 1)
        self._document.sweep(Selection(begun.marker, start, stop))
        # Only now: that the range changed is told of, whoever changed it.
        self._begun = begun

    def _forget(self) -> None:
        """End when the range is let go, or another's."""
        self._begun = None
