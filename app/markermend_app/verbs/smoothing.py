"""Smoothing in the window: worked out on a thread, looked at, done as one step."""

from __future__ import annotations

from typing import Any

from PySide6.QtCore import QObject, Signal
from PySide6.QtWidgets import QWidget

from markermend.artifact import Status
from markermend.progress import Progress
from markermend.review import hand
from markermend.take import Take
from markermend_app.background.jobs import Lane
from markermend_app.dialogs.smooth import SmoothDialog, Smoothed
from markermend_app.dialogs.smooth_pictures import SmoothPictures
from markermend_app.document import Document
from markermend_app.later import Later
from markermend_app.scope import Scope, scopes
from markermend_app.telling import told


class Smoothing(QObject):
    """The verb behind the action that smooths.

    Signals
    -------
    said(str) : a sentence for the status bar

    Attributes
    ----------
    dialog : while it is open
    """

    said = Signal(str)

    def __init__(self, document: Document, window: QWidget) -> None:
        super().__init__(window)
        self._document, self._window = document, window
        self._lane = Lane("smoothing", self)
        self._lane.progressed.connect(self._progressed)
        self._last: tuple[str, dict[str, Any]] = ("auto", {})
        self.dialog: SmoothDialog | None = None
        self._pictures: SmoothPictures | None = None
        self._ahead = Later(self._make_ahead, self)
        self._stale = False
        document.data_changed.connect(self._note_change)
        document.opened.connect(self._note_change)
        document.mesh_changed.connect(self._get_ready)

    def smooth(self) -> None:
        """Ask what to smooth and how, with a preview."""
        session, swept = self._document.session, self._document.selection
        shown = self._document.shown
        if session is None or not (swept or shown):
            return
        # Where another marker was pointed at beside the one that is swept, it is meant.
        marker = swept.marker if swept and swept.marker not in shown[1:] else shown[0]
        where = scopes(self._document, marker)
        if swept:
            first, last = (session.original.frame_number(i) for i in (swept.start, swept.stop - 1))
            text = self.tr("Frames {0}–{1} of {2}").format(first, last, swept.marker)
            own = Scope(text, frozenset({swept.marker}), swept.start, swept.stop)
            where = (own, *where) if swept.marker == marker else (*where, own)
        # No copy, which takes long: what changes under the dialog is noticed, and nothing done.
        take, self._stale = session.take, False
        left = session.listed_with(Status.PENDING, Status.ACCEPTED)
        looked_at = marker, self._document.frame
        dialog = SmoothDialog(
            take, where, *looked_at, *self._last, left, self._plots(), self._window
        )
        dialog.wanted.connect(lambda: self._work_out(dialog, take))
        dialog.look_wanted.connect(lambda: self._inspect(dialog, take))
        dialog.accepted.connect(lambda: self._carry_out(dialog))
        dialog.finished.connect(self._closed)
        self.dialog = dialog
        dialog.open()

    def _note_change(self, *_: object) -> None:
        """What the dialog shows rests on samples that are others now."""
        self._stale = True

    def _get_ready(self) -> None:
        """Load the smoothers on the worker and make the plots, which the first dialog waits for."""
        self._lane.submit(self.tr("Smoothing"), _load_smoothers, _let_be, _let_be)
        self._ahead.ask()

    def _plots(self) -> SmoothPictures:
        """What the dialogs draw in, one after the other."""
        while self._make_one():
            pass
        assert self._pictures is not None
        return self._pictures

    def _make_one(self) -> bool:
        """Make them, then one more of their plots at a time; whether some are left to be made."""
        if self._pictures is None:
            self._pictures = SmoothPictures(self._window)
            return True
        return self._pictures.make_one()

    def _make_ahead(self) -> None:
        """Make them bit by bit, each in a turn of its own."""
        if self._make_one():
            self._ahead.ask()

    def _work_out(self, dialog: SmoothDialog, take: Take) -> None:
        """Smooth what the dialog says, on the worker."""
        method, params, scope = dialog.chosen_method, dialog.params.values(), dialog.chosen_scope
        self._last = method, params

        def work(progress: Progress) -> Smoothed:
            from markermend.smoothers import percent_sm1, smooth

            markers = tuple(s for s in take.labels if scope.markers is None or s in scope.markers)
            stop = take.frames if scope.stop is None else scope.stop
            made = smooth(
                take,
                method,
                markers=markers,
                start=scope.start,
                stop=stop,
                params=params,
                progress=progress,
            )
            part = slice(scope.start, stop), [take.index(s) for s in markers]
            before, after, origin = take.positions[part], made.positions[part], made.origin[part]
            percent = percent_sm1(before, after)
            return Smoothed(made, markers, scope.start, stop, after, origin, percent)

        self._lane.cancel()
        self._lane.submit(self.tr("Smoothing"), work, dialog.tell, dialog.tell_problem)

    def _inspect(self, dialog: SmoothDialog, take: Take) -> None:
        """Look at the spectra of the marker that is shown."""
        answer = dialog.answer
        if answer is None:
            return
        column, frames = take.index(dialog.looked_at), slice(answer.start, answer.stop)

        def work(progress: Progress) -> Any:
            from markermend.smoothers import inspect

            before, after = (t.positions[frames, column] for t in (take, answer.take))
            return inspect(before, after, take.rate)

        self._lane.cancel()
        self._lane.submit("Spectra", work, dialog.tell_found, dialog.tell_problem)

    def _progressed(self, share: float, _: str) -> None:
        if self.dialog is not None:
            self.dialog.bar.setValue(round(1000 * share))

    def _closed(self) -> None:
        """Stop what is still worked out."""
        self._lane.cancel()
        if self.dialog is not None:
            # Else they would go with the dialog.
            self._plots().setParent(self._window)
            self.dialog.deleteLater()
            self.dialog = None

    def _carry_out(self, dialog: SmoothDialog) -> None:
        """Write what was previewed, as one step."""
        session, answer = self._document.session, dialog.answer
        if session is None or answer is None:
            return
        if self._stale:
            self.said.emit(self.tr("The review changed meanwhile; do it again."))
            return
        if self._document.do(
            lambda s: hand.replace_samples(
                s, "Smooth", answer.markers, answer.start, answer.positions, answer.origin
            )
        ):
            self._document.sweep(None)
            self.said.emit(self.tr("{0}.").format(told(session.history[-1])))


def _load_smoothers(progress: Progress) -> None:
    import markermend.smoothers  # noqa: F401


def _let_be(_: object) -> None:
    """What matters is that it was loaded; a failure shows when it is needed."""
