"""Deciding about many artifacts at once, and asking once when a sort of them looks wrong."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any

from PySide6.QtCore import QObject, Signal
from PySide6.QtWidgets import QWidget

from markermend.artifact import Artifact, Kind
from markermend.progress import Progress
from markermend.review.alike import Doubt, answered, doubts, leave, lower
from markermend.review.edits import Change
from markermend_app.background.jobs import Lane
from markermend_app.dialogs.alike import AlikeDialog
from markermend_app.document import Document
from markermend_app.scope import scopes
from markermend_app.telling import told


class Bulk(QObject):
    """The verbs behind the actions that mean all artifacts of a sort.

    Signals
    -------
    said(str) : a sentence for the status bar
    doubts_changed() : :attr:`doubts` are others, or none

    Attributes
    ----------
    doubts : a class that was rejected several times, on each marker of which it was, while the
        question stands; joints are mostly rejected together, and are asked about together
    """

    said = Signal(str)
    doubts_changed = Signal()

    def __init__(self, document: Document, window: QWidget) -> None:
        super().__init__(window)
        self._document, self._window = document, window
        self._lane = Lane("alike", self)
        self._lane.progressed.connect(self._progressed)
        self._asked: set[tuple[str, Kind]] = set()
        self.doubts: tuple[Doubt, ...] = ()
        self.dialog: AlikeDialog | None = None
        document.opened.connect(self._forget_asked)
        document.artifacts_changed.connect(self._look_for_doubts)

    def repair_alike(self) -> None:
        """List the artifacts like the current one with their repairs, to be made in one step."""
        self._open(repairing=True)

    def reject_alike(self) -> None:
        """List the artifacts like the current one, to be rejected in one step."""
        self._open(repairing=False)

    def lower_doubted(self) -> None:
        """Make the rest of a sort that was rejected several times less sure."""
        number = sum(len(doubt.rest) for doubt in self.doubts)
        if self._answer(lower):
            one = self.tr("1 artifact comes last now.")
            many = self.tr("{0} artifacts come last now.")
            self.said.emit(one if number == 1 else many.format(number))

    def keep_doubted(self) -> None:
        """Leave them as they are and do not ask again."""
        self._answer(leave)

    def _answer(self, verb: Callable[..., Change]) -> bool:
        """Do something about what is in doubt, and ask no more; whether it could be done."""
        found, self.doubts = self.doubts, ()
        if not found:
            return False
        self._asked |= {(doubt.marker, doubt.kind) for doubt in found}
        self.doubts_changed.emit()
        return self._document.do(lambda session: verb(session, *found))

    def _forget_asked(self) -> None:
        """Ask anew in another take."""
        if not self._document.renaming:
            self._asked.clear()

    def _look_for_doubts(self) -> None:
        """Ask about the first class that was rejected several times, unless asked before."""
        session = self._document.session
        new: tuple[Doubt, ...] = ()
        if session is not None and self._document.editable:
            every, place = doubts(session.artifacts, session.listed), session.original.index
            self._asked |= {(d.marker, d.kind) for d in every if answered(session, d)}
            found = [d for d in every if (d.marker, d.kind) not in self._asked]
            same = [d for d in found if d.kind is found[0].kind]
            # As in a row of joints, which mostly has the name of the first.
            new = tuple(sorted(same, key=lambda d: place(d.marker)))
        if new != self.doubts:
            self.doubts = new
            self.doubts_changed.emit()

    def _open(self, *, repairing: bool) -> None:
        like = self._document.current
        if like is None:
            return
        where, session = scopes(self._document, like.marker), self._document.session
        if session is not None and session.region is not None and like in session.listed:
            where = (*where[:-1], replace(where[-1], text=self.tr("In the region of interest")))
        dialog = AlikeDialog(self._document, like, where, repairing, self._window)
        dialog.wanted.connect(lambda artifacts: self._work_out(dialog, artifacts))
        dialog.accepted.connect(lambda: self._carry_out(dialog, like, repairing))
        dialog.finished.connect(self._closed)
        self.dialog = dialog
        dialog.open()

    def _work_out(self, dialog: AlikeDialog, artifacts: Sequence[Artifact]) -> None:
        """Propose repairs for what the dialog lists, on the worker."""
        session, mesh = self._document.session, self._document.mesh
        if session is None or mesh is None:
            return
        take, everything = session.take, session.artifacts

        def work(progress: Progress) -> Any:
            from markermend.repairs import repair_all

            return repair_all(
                take,
                artifacts,
                others=everything,
                min_confidence=0.0,
                mesh=mesh,
                progress=progress,
            )

        def done(pairs: Any) -> None:
            dialog.tell({a.id: repair for a, repair in pairs})

        def failed(error: Exception) -> None:
            self.said.emit(told(str(error)))
            dialog.close()

        self._lane.cancel()
        self._lane.submit("Repair alike", work, done, failed)

    def _progressed(self, share: float, _: str) -> None:
        if self.dialog is not None:
            self.dialog.bar.setValue(round(1000 * share))

    def _closed(self) -> None:
        """Stop what is still worked out."""
        self._lane.cancel()
        if self.dialog is not None:
            self.dialog.deleteLater()
            self.dialog = None

    def _carry_out(self, dialog: AlikeDialog, like: Artifact, repairing: bool) -> None:
        """Do what the dialog lists, as one step."""
        ids = dialog.chosen()
        if not repairing:
            self._document.decisions.reject(ids)
        else:
            # One alone is named as any other repair is.
            many = f"Repair {len(ids)} artifacts alike ({like.kind})"
            label = many if len(ids) > 1 else ""
            chosen = [(i, repair) for i, repair in dialog.repairs.items() if i in ids]
            self._document.decisions.repair_many(chosen, label)
        said = self.tr("{0} repaired.") if repairing else self.tr("{0} rejected.")
        self.said.emit(said.format(len(ids)))
