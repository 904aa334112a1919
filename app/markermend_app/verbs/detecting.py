"""Looking for artifacts in the open take, on the worker."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from PySide6.QtCore import QObject, Signal
from PySide6.QtWidgets import QWidget

from markermend.artifact import Artifact, within
from markermend.progress import Progress
from markermend.review.session import Session
from markermend_app import detection
from markermend_app.background.jobs import Lane
from markermend_app.background.loading import SEARCHED
from markermend_app.dialogs import ask as dialogs
from markermend_app.document import Document
from markermend_app.later import Later
from markermend_app.telling import told


class Detecting(QObject):
    """The verbs behind the actions that detect.

    Signals
    -------
    said(str) : a sentence for the status bar
    """

    said = Signal(str)

    def __init__(self, document: Document, lane: Lane, window: QWidget) -> None:
        super().__init__(window)
        self._document, self._lane, self._window = document, lane, window
        self._searched: Session | None = None
        self._first = Later(self._begin, self)

    def detect(self) -> None:
        """Look for sudden artifacts and gaps."""
        self.search(slow=False)

    def detect_slow(self) -> None:
        """Look for every class."""
        self.search(slow=True)

    def search(self, *, slow: bool, by_itself: bool = False) -> None:
        """Look for every class, or for the quick ones; ``by_itself`` where nobody asked for it."""
        session, mesh = self._document.session, self._document.mesh
        if session is None:
            return
        take = session.original

        def work(progress: Progress) -> Any:
            return detection.search(take, mesh, progress, slow=slow)

        def done(found: Sequence[Artifact]) -> None:
            if self._document.session is not session:
                return
            if session.original is not take:
                text = self.tr("Markers were renamed meanwhile; detect again.")
                if take.skeleton:
                    text = self.tr("Joints were renamed meanwhile; detect again.")
                self.said.emit(text)
                return
            name = "all kinds" if slow else SEARCHED
            self._document.decisions.add_detected(found, name, by_itself=by_itself)
            one, many = self.tr("1 artifact found."), self.tr("{0} artifacts found.")
            text = one if len(found) == 1 else many.format(len(found))
            if session.region is not None:
                inside = len(within(found, session.region))
                text += " " + self.tr("In the region of interest: {0}.").format(inside)
            # What is odd about the file was said before, and must not be lost.
            self.said.emit(" ".join((text, *map(told, take.warnings[:1]))))
            self._searched = session
            self._first.ask()

        def failed(error: Exception) -> None:
            dialogs.show_problem(self._window, error)

        self._lane.submit(self.tr("Looking for artifacts"), work, done, failed)

    def _begin(self) -> None:
        """Begin with the first artifact that was found, unless one is looked at."""
        if self._document.session is self._searched and self._document.current is None:
            self._document.step(1)
