"""Whether the artifact under review can be seen: no key may decide about one that cannot."""

from __future__ import annotations

from PySide6.QtCore import QObject, Signal

from markermend.artifact import Artifact
from markermend_app.document import Document
from markermend_app.style import theme


class Sight(QObject):
    """Follows what the plots show, and brings the artifact under review back into them.

    Signals
    -------
    changed() : the artifact under review came into sight, left it, or is another one
    said(str) : a sentence for the status bar
    taken_back(str) : what was said does not hold any more
    """

    changed = Signal()
    said = Signal(str)
    taken_back = Signal(str)

    def __init__(self, document: Document, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._document = document
        self._view = (0.0, 0.0)
        self._told: Artifact | None = None
        self._said: tuple[str, str] | None = None
        document.current_changed.connect(self._tell)
        document.shown_changed.connect(self._shown_changed)

    def set_view(self, start: float, stop: float) -> None:
        """Be told which frames the plots show."""
        self._view = (start, stop)
        if self.lost != self._told:
            self._tell()

    def _shown_changed(self) -> None:
        """Tell of other markers, unless their frames are about to come into view."""
        if not self._document.bringing:
            self._tell()

    def _tell(self) -> None:
        """Say that something changed."""
        self._told = self.lost
        self._take_back()
        self.changed.emit()

    def _take_back(self) -> None:
        """Say no longer what was said of another artifact."""
        current = self._document.current
        if self._said is not None and (current is None or current.id != self._said[0]):
            text, self._said = self._said[1], None
            self.taken_back.emit(text)

    @property
    def lost(self) -> Artifact | None:
        """The artifact under review if its markers or its frames are not in view, else None."""
        a, (start, stop) = self._document.current, self._view
        if a is None or (a.concerns(self._document.shown) and a.start < stop and a.stop > start):
            return None
        return a

    def look_back(self) -> Artifact | None:
        """Look at the artifact under review again if it is out of sight; which one was."""
        lost = self.lost
        if lost is not None:
            self._document.look_at(lost.markers, *self._document.asked_frames(lost))
        return lost

    def bring_back(self) -> bool:
        """Look back before what a key decides is decided, and say so; whether that was needed."""
        lost = self.look_back()
        if lost is None:
            return False
        text = self.tr("{0} on {1} is under review, but was out of sight. Press again to decide.")
        text = text.format(theme.kind_name(lost.kind), lost.marker)
        self._said = lost.id, text
        self.said.emit(text)
        return True
