"""Repairing many artifacts with their best methods, on the worker."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from PySide6.QtCore import QObject, Signal
from PySide6.QtWidgets import QWidget

from markermend.artifact import Status
from markermend.progress import Progress
from markermend_app.background.jobs import Lane
from markermend_app.dialogs import ask as dialogs
from markermend_app.document import Document
from markermend_app.telling import told


class Repairing(QObject):
    """The verbs behind the actions that repair what is accepted or selected.

    Signals
    -------
    said(str) : a sentence for the status bar
    """

    said = Signal(str)

    def __init__(self, document: Document, lane: Lane, window: QWidget) -> None:
        super().__init__(window)
        self._document, self._lane, self._window = document, lane, window

    def repair_accepted(self) -> None:
        """Repair every accepted artifact, as one step."""
        session = self._document.session
        if session is not None:
            ids = [a.id for a in session.listed_with(Status.ACCEPTED)]
            self.repair_many(ids, "Repair all accepted")

    def repair_many(self, ids: Sequence[str], label: str = "") -> None:
        """Repair artifacts with their best methods, as one step."""
        session, mesh = self._document.session, self._document.mesh
        if session is None:
            return
        chosen = [session.artifact(i) for i in ids]
        chosen = [a for a in chosen if a.status is not Status.REPAIRED]
        if not chosen:
            self.said.emit(self.tr("There is nothing to repair: no artifact is accepted."))
            return
        take, everything, revision = session.take, session.artifacts, session.revision

        def work(progress: Progress) -> Any:
            from markermend.repairs import repair_all

            return repair_all(
                take, chosen, others=everything, min_confidence=0.0, mesh=mesh, progress=progress
            )

        def moved_on() -> bool:
            """Whether the samples that the work read are not those of now; says so."""
            changed = self._document.session is not session or session.revision != revision
            if changed:
                self.said.emit(self.tr("The review changed meanwhile; repair again."))
            return changed

        def failed(error: Exception) -> None:
            # Samples that changed under the work may be all that was wrong.
            if not moved_on():
                dialogs.show_problem(self._window, error)

        def done(repairs: Any) -> None:
            if moved_on():
                return
            good = [(a.id, r) for a, r in repairs if r.patches]
            if good:
                name = label or f"Repair {len(good)} artifacts"
                self._document.decisions.repair_many(good, name)
            left = len(repairs) - len(good)
            text = self.tr("{0} repaired.").format(len(good))
            if left:
                why = next(r.reason for _, r in repairs if not r.patches)
                one, many = (
                    self.tr("1 left as it is: {1}"),
                    self.tr("{0} left as they are: {1}"),
                )
                text += " " + (one if left == 1 else many).format(left, told(why))
            self.said.emit(text)

        self._lane.submit(self.tr("Repairing"), work, done, failed)
