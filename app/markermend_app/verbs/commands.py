"""What the actions on files and on the artifact under review do.

Asking (dialogs) and doing (engine work, document verbs) are kept apart.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

from PySide6.QtCore import QObject, QTimer, Signal
from PySide6.QtWidgets import QFileDialog, QWidget

from markermend.errors import DataError, MarkermendError, NoSkeletonError
from markermend.mesh import Mesh
from markermend.progress import Progress
from markermend.review.file import SessionFile
from markermend_app import settings
from markermend_app.background.jobs import Lane
from markermend_app.background.loading import Opened, load, same_file, takes_folder
from markermend_app.background.saver import Saver
from markermend_app.dialogs import ask as dialogs
from markermend_app.dialogs.file_filters import WITHOUT_PATTERNS, open_filter
from markermend_app.document import Document
from markermend_app.later import SOON_MS
from markermend_app.resuming import Resuming
from markermend_app.telling import told
from markermend_app.verbs.detecting import Detecting
from markermend_app.verbs.exporting import Exporter
from markermend_app.verbs.skeletons import give_skeleton


class Commands(QObject):
    """The verbs behind the actions.

    Signals
    -------
    said(str) : a sentence for the status bar
    """

    said = Signal(str)

    def __init__(
        self, document: Document, lane: Lane, detecting: Detecting, window: QWidget
    ) -> None:
        super().__init__(window)
        self._document = document
        self._lane = lane
        self._detecting = detecting
        self._window = window
        self._saver = Saver(self)
        self._resuming = Resuming(document, self)
        self._exporter = Exporter(document, lane, self._saver, window)
        self._exporter.said.connect(self.said)
        self._exporter.replaced.connect(self.open_path)
        lane.finished.connect(self._go_on)
        document.failed.connect(self._tell_refused)
        document.proposals.failed.connect(self.show_problem)

    # Opening and closing

    def open(self) -> None:
        """Ask for a take and open it."""
        start = str(takes_folder(self._document.path))
        name, _ = QFileDialog.getOpenFileName(
            self._window, self.tr("Open take"), start, open_filter(), "", WITHOUT_PATTERNS
        )
        if name:
            self.open_path(Path(name))

    def open_demo(self) -> None:
        """Open the take that comes with Markermend."""
        from markermend_resources import demo_take

        self.open_path(demo_take())

    def open_path(self, path: Path) -> None:
        """Open a take, after asking what becomes of the one that is open."""
        if self.let_go():
            self.open_by(path, lambda progress: Opened(load(path, progress)))

    def open_by(
        self,
        path: Path,
        work: Callable[[Progress], Opened],
        broke: Callable[[Exception], None] | None = None,
    ) -> None:
        """Open a take by work to be done on the worker; ``broke`` is told what prevented it."""
        if self._document.path is not None and same_file(path, self._document.path):
            # The review is locked while it is open, for this window too.
            self._document.open(None, None)

        def done(opened: Opened) -> None:
            self._document.open(opened.file, opened.mesh)
            self._document.proposals.keep(opened.proposals)
            settings.add_recent(path)
            self._tell_opened()
            # Once the take is painted: libraries that the worker may load hold the window up.
            QTimer.singleShot(SOON_MS, self, lambda: go_on(opened))

        def go_on(opened: Opened) -> None:
            if self._document.file is not opened.file:
                return
            if opened.file.session.artifacts:
                self._look_at_first(opened.file, label)
            if opened.mesh is None:
                self._learn_body(opened.file)

        def dropped(opened: Opened) -> None:
            # Its lock would keep the take read-only for the next who opens it.
            opened.file.close()

        def failed(error: Exception) -> None:
            if isinstance(error, NoSkeletonError) and give_skeleton(self._window, path, error):
                self.open_by(path, work, broke)
                return
            if broke is not None:
                broke(error)
            if not isinstance(error, NoSkeletonError):
                self.show_problem(error)

        label = self.tr("Opening {0}").format(path.name)
        self._lane.submit(label, work, done, failed, dropped)

    def _look_at_first(self, file: SessionFile, label: str) -> None:
        """Look where the review was left, else at the first artifact or, with none, marker.

        That is once the methods listed are loaded.
        """

        def done() -> None:
            beginning = self._document.file is file and self._document.current is None
            if beginning and not self._resuming.go_back():
                self._document.step(1)

        self._load_methods(label, done)

    def _load_methods(self, label: str, done: Callable[[], None] = lambda: None) -> None:
        """Load the repair methods on the worker, before an artifact is looked at."""

        def work(progress: Progress) -> None:
            import markermend.repairs  # noqa: F401

        if "markermend.repairs" in sys.modules:
            done()
        else:
            self._lane.submit(label, work, lambda _: done(), self.show_problem)

    def _learn_body(self, file: SessionFile) -> None:
        """Look how the body moves, and for artifacts in a take that is new."""
        take = file.session.original

        def work(progress: Progress) -> Any:
            from markermend.mesh import infer_mesh
            from markermend.repairs import REPAIRS

            # The first look at them reads what all packages on this machine bring.
            len(REPAIRS)
            return infer_mesh(take, progress=progress)

        def get_ready(progress: Progress) -> None:
            from markermend.repairs.skeleton import get_ready

            get_ready(take, progress)

        def done(mesh: Mesh) -> None:
            if self._document.file is not file:
                return
            if take.skeleton and file.session.begun:
                # Detecting does that in a new one. Proposals rest on it, and are let go on walking.
                self._document.learn(mesh, propose=False)
                self._lane.submit(label, get_ready, lambda _: None, self.show_problem)
            else:
                self._document.learn(mesh)
            new = not file.session.begun and not file.read_only
            if new and settings.flag("detect_on_open", True):
                self._detecting.search(slow=False, by_itself=True)
            else:
                self._look_at_first(file, label)

        label = self.tr("Looking at the body")
        self._lane.submit(label, work, done, self.show_problem)

    def _go_on(self) -> None:
        """Let repairs be proposed that waited for a job, whether it was done or cancelled."""
        if not self._lane.busy:
            self._document.go_on()

    def close_take(self) -> None:
        """Close the take, after asking what becomes of unexported work."""
        if self.let_go():
            self._document.open(None, None)

    def quit(self) -> None:
        """Close the window."""
        self._window.close()

    def let_go(self) -> bool:
        """Ask what becomes of unexported work; False to stay with it."""
        document = self._document
        self._exporter.finish()
        if document.file is None or document.session is None or not document.editable:
            self._lane.cancel()
            return True
        if document.session.exported:
            self._lane.cancel()
            if document.session.history:
                # Where it cannot be saved the journal still has it, and an export has the samples.
                self._save(document.file)
            return True
        from markermend.review.standing import changed_outside

        session = document.session
        changed = changed_outside(session.original, session.take, (0, 0))
        renamed = session.renamed
        kept = document.file.path
        answer = dialogs.ask_unexported(self._window, document.path, kept, changed, renamed)
        if answer == "cancel":
            return False
        self._lane.cancel()
        if answer == "export":
            return self.export(wait=True)
        if answer == "discard":
            document.file.discard()
            document.open(None, None)
            return True
        return self._save(document.file)

    def put_by(self) -> bool:
        """Stop what is under way and keep the review, without asking; whether it is saved."""
        self._exporter.finish()
        self._lane.cancel()
        document = self._document
        if document.file is None or not document.editable or document.session is None:
            return True
        return not document.session.history or self._save(document.file)

    def save_review(self) -> None:
        """Save the review as it stands; what cannot be saved now is in the journal all the same."""
        document = self._document
        if document.file is None or document.session is None or not document.editable:
            return
        if document.session.history or document.session.undone:
            self._saver.save(document.file, lambda error: self.said.emit(told(str(error))))

    def _save(self, file: SessionFile) -> bool:
        """Save the review; when that is not possible say why."""
        try:
            file.save()
        except MarkermendError as error:
            self.show_problem(error)
            return False
        return True

    # Deciding

    def accept(self) -> None:
        """Accept the current artifact."""
        self._document.decisions.accept_current()

    def reject(self) -> None:
        """Reject the current artifact."""
        self._document.decisions.reject_current()

    def repair(self) -> None:
        """Repair the current artifact by the method shown."""
        file = self._document.file
        if file is not None and self._document.mesh is None and not self._lane.busy:
            # Looking at the body was cancelled, and no repair comes without it.
            self._learn_body(file)
        self._document.decisions.repair_current()

    def reopen(self) -> None:
        """Take the decision on the current artifact back."""
        if self._document.current is not None:
            self._document.decisions.reopen(self._document.together)

    def remove(self) -> None:
        """Take the current artifact off the list."""
        if self._document.current is not None:
            self._document.decisions.remove(self._document.together)

    # Walking

    def next(self) -> None:
        """Go to the next artifact."""
        self._document.step(1)

    def previous(self) -> None:
        """Go to the previous artifact."""
        self._document.step(-1)

    def undo(self) -> None:
        """Take the last step back, and say which; it may lie out of view."""
        session = self._document.session
        if session is not None and session.undoable:
            what = session.history[-1]
            self._document.undo()
            self.said.emit(self.tr("Undone: {0}").format(told(what)))

    def redo(self) -> None:
        """Bring the last undone step back, and say which."""
        session = self._document.session
        if session is not None and session.undone:
            self._document.redo()
            self.said.emit(self.tr("Done again: {0}").format(told(session.history[-1])))

    # Exporting

    def export(self, *, wait: bool = False) -> bool:
        """Ask what to write and where to, and write it; see :meth:`Exporter.export`."""
        return self._exporter.export(wait=wait)

    # Telling

    def show_problem(self, error: Exception) -> None:
        """Show an error as one sentence, with details folded away."""
        dialogs.show_problem(self._window, error)

    def _tell_refused(self, error: Exception) -> None:
        """Say aside what the take does not allow, so that the review goes on; else ask to look."""
        if isinstance(error, DataError):
            self.said.emit(told(str(error)))
        else:
            self.show_problem(error)

    def _tell_opened(self) -> None:
        """Say what was opened and anything odd about it."""
        file = self._document.file
        if file is None:
            return
        take = file.session.original
        text = self.tr("{0} markers, {1} frames at {2:g} Hz.")
        if take.skeleton:
            text = self.tr("{0} joints, {1} frames at {2:g} Hz.")
        elif len(take.named) == 1:
            text = self.tr("1 marker, {1} frames at {2:g} Hz.")
        text = text.format(len(take.named), take.frames, take.rate)
        if file.read_only:
            text = self.tr(
                "It was open in another window: this one is read-only. To review here, close that "
                "one and open the take again."
            )
        elif file.recovered and not file.session.exported:
            # A detection run that was cut short is no work of the operator's.
            text = self.tr("An interrupted review was recovered; last step: {0}.").format(
                told(file.session.history[-1]) if file.session.history else self.tr("opened")
            )
        elif file.warning:
            text = told(file.warning)
        elif take.warnings:
            text = told(take.warnings[0])
        self.said.emit(text)
        if take.read_only:
            dialogs.tell_damaged(self._window, take)
