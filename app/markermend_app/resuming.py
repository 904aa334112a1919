"""Going on where a review was left, also by a crash."""

from __future__ import annotations

from PySide6.QtCore import QObject, QTimer

from markermend.review.left_at import LeftAt
from markermend_app.document import Document

REST_MS = 500


class Resuming(QObject):
    """Keeps which artifact and frame are looked at with the review, and goes back to them."""

    def __init__(self, document: Document, parent: QObject) -> None:
        super().__init__(parent)
        self._document = document
        # Until the first artifact is looked at, what was kept before holds.
        self._waiting = True
        # Playing moves the cursor all the time: it is written down where it rests.
        self._rest = QTimer(self, singleShot=True, interval=REST_MS)
        self._rest.timeout.connect(self._write)
        document.opened.connect(self._opened)
        document.current_changed.connect(self._note)
        document.frame_changed.connect(self._note)

    def go_back(self) -> bool:
        """Put what was under review under review again, at that frame; whether it is there."""
        self._waiting = False
        session = self._document.session
        left = None if session is None else session.left_at
        if session is None or left is None or left.artifact is None:
            return False
        if session.find(left.artifact) not in session.listed:
            return False
        self._document.select(left.artifact)
        self._document.go_to(left.frame)
        return True

    def _opened(self) -> None:
        if not self._document.renaming:
            self._waiting = True
            self._rest.stop()

    def _note(self) -> None:
        """Remember where the operator stands now, and write it down soon."""
        document = self._document
        current, session = document.current, document.session
        if session is None or not document.editable or (self._waiting and current is None):
            return
        self._waiting = False
        session.left_at = LeftAt(None if current is None else current.id, document.frame)
        self._rest.start()

    def _write(self) -> None:
        if self._document.file is not None:
            self._document.file.keep_left_at()
