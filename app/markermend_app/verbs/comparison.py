"""The ranked methods for the artifact under review, side by side, while a key is held."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from typing import Any

from PySide6.QtCore import QCoreApplication, QEvent, QObject, Qt, QTimer, Signal
from PySide6.QtGui import QKeyEvent, QKeySequence

from markermend.artifact import Artifact, Status
from markermend.progress import Progress
from markermend_app.background.jobs import Lane
from markermend_app.document import Document

MOST = 6
"""Candidates that are drawn; more lines than this nobody tells apart."""

LET_GO_MS = 80
"""A key that is held repeats itself, and a busy desktop tells its repeats as letting go."""


class Comparison(QObject):
    """Works the candidates out on a thread of its own, and walks through them.

    Signals
    -------
    changed() : it is shown or hidden, the candidates have come, or another one is chosen
    said(str) : a sentence for the status bar

    Attributes
    ----------
    shown : whether candidates are being compared
    candidates : :class:`markermend.repairs.Advice` with an answer, best first; None while they
        are worked out
    hopeless : how many more methods have no answer here
    """

    changed = Signal()
    said = Signal(str)

    def __init__(self, document: Document, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._document = document
        self._lane = Lane("advice", self)
        self._known: dict[Artifact, tuple[Any, ...]] = {}
        self._keys: frozenset[str] = frozenset()
        self.shown = False
        self.candidates: tuple[Any, ...] | None = None
        self.hopeless = 0
        self._came = False
        self._letting_go = QTimer(self, interval=LET_GO_MS, singleShot=True)
        self._letting_go.timeout.connect(self._let_go)
        document.opened.connect(self._forget)
        document.data_changed.connect(self._forget)
        document.current_changed.connect(self._follow)
        document.proposal_changed.connect(self._tell)

    @property
    def place(self) -> int | None:
        """Which of the candidates is previewed, or None."""
        proposal = self._document.proposal
        names = [c.method for c in self.candidates or ()]
        return names.index(proposal.method) if proposal and proposal.method in names else None

    def start(self, keys: Iterable[str]) -> None:
        """Show the candidates until one of the keys is let go; when they are shown, hide them."""
        if self._letting_go.isActive():
            self._letting_go.stop()
        elif self.shown:
            self.stop()
        elif self._document.current is not None:
            self._keys = frozenset(key.rpartition("+")[2] for key in keys)
            self.shown, self._came = True, False
            # Only while it is needed: a filter sees every event of the app.
            _app().installEventFilter(self)
            self._follow()

    def stop(self) -> None:
        """Hide them; the one that was walked to stays previewed."""
        self._letting_go.stop()
        if self.shown:
            self.shown = False
            _app().removeEventFilter(self)
            self.changed.emit()

    def _let_go(self) -> None:
        """Hide them once the key is let go; whoever tapped it would have seen nothing happen."""
        if self.shown and self.candidates is None and not self._came:
            self.said.emit(self.tr("Hold the key until the repairs to compare are there."))
        self.stop()

    def step(self, by: int) -> None:
        """Preview the next or the previous candidate."""
        current = self._document.current
        if current is None or not self.candidates:
            return
        place = self.place
        at = 0 if place is None else min(max(place + by, 0), len(self.candidates) - 1)
        repair = self.candidates[at].repair
        # It is worked out already, with its expected error measured.
        self._document.proposals.keep({(current, repair.method, ()): repair})
        self._document.choose_method(repair.method)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Take the arrows, and notice when the key is let go."""
        if not isinstance(event, QKeyEvent):
            return False
        if QKeySequence(event.key()).toString() in self._keys:
            if event.isAutoRepeat():
                # A key that is held repeats itself, with releases between.
                event.accept()
                return True
            if event.type() == QEvent.Type.KeyRelease:
                self._letting_go.start()
        by = {int(Qt.Key.Key_Down): 1, int(Qt.Key.Key_Up): -1}.get(event.key(), 0)
        if not by:
            return False
        if event.type() == QEvent.Type.ShortcutOverride:
            event.accept()
            return True
        if not watched.isWidgetType():
            # The desktop gives keys to the window's frame, which hands them on to a widget.
            return False
        if event.type() == QEvent.Type.KeyPress:
            self.step(by)
        return True

    def _follow(self) -> None:
        """Compare for the artifact that is under review now."""
        if not self.shown:
            return
        current, session = self._document.current, self._document.session
        if current is None or session is None or current.status is Status.REPAIRED:
            self.candidates, self.hopeless = (), 0
        elif current in self._known:
            self._take(self._known[current])
        else:
            self.candidates = None
            self._ask(current)
        self.changed.emit()

    def _ask(self, artifact: Artifact) -> None:
        """Have the candidates ranked."""
        session, mesh = self._document.session, self._document.mesh
        if session is None:
            return
        take, everything = session.take, session.artifacts

        def work(progress: Progress) -> Any:
            from markermend.repairs import advise, compared, evidence_for
            from markermend.repairs.look_again import looked_at

            progress(0.0, artifact.marker)
            others = (a for a in everything if a.id != artifact.id)
            evidence = evidence_for(take, (*others, artifact), mesh, progress=progress)
            found = advise(evidence, artifact, methods=compared(take))
            if take.skeleton:
                # The detector that looks again knows markers, which do not tremble as joints do.
                return found
            return tuple(replace(a, repair=looked_at(take, a.repair)) for a in found)

        def done(advice: Any) -> None:
            self._known[artifact] = advice
            self._share(artifact, advice)
            self._follow()

        def failed(error: Exception) -> None:
            self.stop()
            self._document.failed.emit(error)

        self._lane.cancel()
        self._lane.submit("Compare", work, done, failed)

    def _share(self, artifact: Artifact, advice: tuple[Any, ...]) -> None:
        """Let the details tell the errors that were measured here, not others."""
        measured = {a.method: a.repair for a in advice if a.trials}
        proposals = self._document.proposals
        proposals.keep({(artifact, name, ()): repair for name, repair in measured.items()})
        best = proposals.get(artifact, "auto")
        if best is not None and best.method in measured:
            told = replace(best, error_mm=measured[best.method].error_mm)
            proposals.keep({(artifact, "auto", ()): told})
        self._document.proposal_changed.emit()

    def _take(self, advice: tuple[Any, ...]) -> None:
        self._came = True
        able = tuple(a for a in advice if a.repair.patches)
        self.candidates, self.hopeless = able[:MOST], len(advice) - len(able)

    def _forget(self, *_: object) -> None:
        """Let go what rests on samples that have changed."""
        self._lane.cancel()
        self._known.clear()

    def _tell(self) -> None:
        if self.shown:
            self.changed.emit()


def _app() -> QCoreApplication:
    """The application."""
    app = QCoreApplication.instance()
    assert app is not None
    return app
