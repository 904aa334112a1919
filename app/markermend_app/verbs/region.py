"""The region of interest: frames that are reviewed, and that alone can be exported."""

from __future__ import annotations

from PySide6.QtCore import QObject, Signal

from markermend_app.document import Document


class RegionOfInterest(QObject):
    """The verbs behind the actions that choose the frames that matter.

    Signals
    -------
    said(str) : a sentence for the status bar
    """

    said = Signal(str)

    def __init__(self, document: Document, parent: QObject) -> None:
        super().__init__(parent)
        self._document = document

    def region_start(self) -> None:
        """Begin it at the cursor."""
        frame, (_, stop) = self._document.frame, self._now
        self.choose(frame, stop if frame < stop else self._frames)

    def region_end(self) -> None:
        """End it with the frame at the cursor."""
        frame, (start, _) = self._document.frame, self._now
        self.choose(start if start <= frame else 0, frame + 1)

    def region_selection(self) -> None:
        """Make the swept range the region."""
        swept = self._document.selection
        if swept is not None and self.choose(swept.start, swept.stop):
            self._document.sweep(None)

    def region_whole(self) -> None:
        """Review the whole take again."""
        self.choose(0, self._frames)

    def choose(self, start: int, stop: int) -> bool:
        """Choose these frames, and say so."""
        session = self._document.session
        if session is None or not self._document.do(lambda s: s.set_region((start, stop))):
            return False
        self.said.emit(self._told())
        return True

    @property
    def _frames(self) -> int:
        """Frames of the take."""
        session = self._document.session
        return 0 if session is None else session.original.frames

    @property
    def _now(self) -> tuple[int, int]:
        """The region as it is."""
        session = self._document.session
        return (session.region if session is not None else None) or (0, self._frames)

    def _told(self) -> str:
        """What is reviewed now."""
        session = self._document.session
        if session is None or session.region is None:
            return self.tr("The whole take is reviewed.")
        first, last = session.original.frame_numbers(*session.region)
        text = self.tr("Frames {0}–{1} are reviewed.").format(first, last)
        outside = len(session.artifacts) - len(session.listed)
        if outside:
            text += " " + self.tr("Artifacts outside them: {0}.").format(outside)
        return text
