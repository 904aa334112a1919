"""What is under review stays among what is listed, once the list is narrowed down."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QObject, QTimer, Signal

from markermend.artifact import Artifact
from markermend_app.document import Document
from markermend_app.rows import Rows

REST_MS = 300


class KeptListed(QObject):
    """Goes on to what is listed when filters take away what is under review.

    Keys would decide unseen about what nobody looks for any more. What was left comes back with
    the filters, unless something else is under review by then.

    Parameters
    ----------
    document : what is under review there
    row_of : row in which an artifact is listed, or None when it is not

    Signals
    -------
    said(str) : a sentence for the status bar
    taken_back(str) : what was said does not hold any more
    """

    said = Signal(str)
    taken_back = Signal(str)

    def __init__(
        self, document: Document, row_of: Callable[[str], int | None], parent: QObject
    ) -> None:
        super().__init__(parent)
        self._document, self._row_of = document, row_of
        self._walked = Rows()
        self._left: str | None = None
        self._nothing = self.tr("No artifact is listed, so that none is under review.")
        # Each letter of a name lists others; the plots need not follow all of them.
        self._rest = QTimer(self, singleShot=True, interval=REST_MS)
        self._rest.timeout.connect(self._settle)

    def forget(self) -> None:
        """Come back to nothing: another take is open."""
        self._rest.stop()
        self._left = None

    def narrowed(self, walked: Rows, *, typing: bool) -> None:
        """Be told that others are listed, and how rows were walked until now."""
        if not self._rest.isActive():
            self._walked = walked
        if typing:
            self._rest.start()
        else:
            self._settle()

    def leave(self) -> None:
        """Go on at once, rather than wait for another letter."""
        if self._rest.isActive():
            self._settle()

    def _settle(self) -> None:
        """Put under review what is listed."""
        self._rest.stop()
        current = self._document.current
        if current is not None and self._row_of(current.id) is not None:
            self._left = None
            return
        if current is None and self._left is None:
            return
        found = self._next_listed(current)
        if current is not None:
            self._left = current.id
        if found is not None:
            self._document.select(found, unless_seen=True)
            self.taken_back.emit(self._nothing)
        elif current is not None:
            self._document.select(None)
            self.said.emit(self._nothing)

    def _next_listed(self, current: Artifact | None) -> str | None:
        """What was left before; else the rest of an event, what followed it, or the first."""
        order, with_it = list(self._walked.ids), tuple[str, ...]()
        if current is not None:
            with_it, row = self._walked.together(current.id), self._walked.row_of(current.id)
            order = order[order.index(row) + 1 :] if row in order else []
        wanted = (self._left, *with_it, *order, *self._document.queue)
        return next((i for i in wanted if i and self._row_of(i) is not None), None)
