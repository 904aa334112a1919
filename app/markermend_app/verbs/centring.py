"""Joint centres in the window: worked out on a thread, looked at, saved and opened."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

from PySide6.QtCore import QObject, Signal
from PySide6.QtWidgets import QFileDialog, QWidget

from markermend.artifact import Status
from markermend.errors import ExportError, MarkermendError
from markermend.progress import Progress
from markermend.review.session import Session
from markermend_app.background.jobs import Lane
from markermend_app.background.loading import is_there, proposed_place, same_file
from markermend_app.dialogs import ask as dialogs
from markermend_app.dialogs.joint_centres import JointCentresDialog
from markermend_app.document import Document
from markermend_app.telling import told


class Centring(QObject):
    """The verb behind the action that works out joint centres.

    Signals
    -------
    said(str) : a sentence for the status bar
    open_wanted(Path) : joints were saved, to be opened in place of the take

    Attributes
    ----------
    dialog : while it is open
    """

    said = Signal(str)
    open_wanted = Signal(object)

    def __init__(self, document: Document, window: QWidget) -> None:
        super().__init__(window)
        self._document, self._window = document, window
        self._lane = Lane("joint centres", self)
        self._lane.progressed.connect(self._progressed)
        self.dialog: JointCentresDialog | None = None

    def joint_centres(self) -> None:
        """Work out the joint centres of the take as it stands, and show how far to trust each."""
        session, path = self._document.session, self._document.path
        if session is None or session.original.skeleton:
            return
        held, original, region = session.state.held(), session.original, session.region
        dialog = JointCentresDialog(self._origin(session), self._warning(session), self._window)

        def work(progress: Progress) -> Any:
            from markermend.files.restructure import crop
            from markermend.poses.from_markers import joint_centres
            from markermend.review.hand import without_emptied

            take = without_emptied(held(), original)
            if region is None:
                return joint_centres(take, progress=progress)
            found = joint_centres(crop(take, *region), progress=progress)
            # As in every part of a take, time goes on from the whole one's.
            pose = replace(found.pose, first_time=region[0] / take.rate)
            return replace(found, pose=pose)

        def failed(error: Exception) -> None:
            if isinstance(error, MarkermendError):
                dialog.tell_nothing(told(str(error)))
            else:
                dialog.reject()
                dialogs.show_problem(self._window, error)

        dialog.save_wanted.connect(lambda then_open: self._save(dialog, path, then_open))
        dialog.finished.connect(self._closed)
        self.dialog = dialog
        dialog.open()
        self._lane.submit(self.tr("Joint centres"), work, dialog.tell, failed)

    def _origin(self, session: Session) -> str:
        """Say which frames are used."""
        if session.region is None:
            return self.tr("From all frames of the take as it stands.")
        start, stop = session.region
        first, last = (session.original.frame_number(i) for i in (start, stop - 1))
        text = self.tr("From frames {0}–{1} of the take as it stands, the region of interest.")
        return text.format(first, last)

    def _warning(self, session: Session) -> str:
        """Say whether damage is left."""
        left = len(session.listed_with(Status.PENDING, Status.ACCEPTED))
        if not left:
            return ""
        if left == 1:
            return self.tr("1 artifact is not repaired. Damage pulls joint centres along.")
        return self.tr("{0} artifacts are not repaired. Damage pulls joint centres along.").format(
            left
        )

    def _progressed(self, share: float, doing: str) -> None:
        if self.dialog is not None:
            self.dialog.tell_progress(share, told(doing))

    def _closed(self) -> None:
        """Stop what is still worked out or written."""
        self._lane.cancel()
        if self.dialog is not None:
            self.dialog.deleteLater()
            self.dialog = None

    # Saving

    def _save(self, dialog: JointCentresDialog, source: Path | None, then_open: bool) -> None:
        """Ask where to, write the joints, and open them where that is wanted."""
        found = dialog.found
        target = self._ask_target(dialog, source)
        if found is None or target is None:
            return

        def work(progress: Progress) -> None:
            from markermend.files.pose import write_pose

            write_pose(found.pose, target, progress=progress)

        def done(_: None) -> None:
            self.said.emit(self.tr("Joint centres written to {0}.").format(target))
            dialog.accept()
            if then_open:
                self.open_wanted.emit(target)

        def failed(error: Exception) -> None:
            dialog.show_work(False)
            dialogs.show_problem(dialog, error)

        dialog.show_work(True)
        self._lane.submit(self.tr("Joint centres"), work, done, failed)

    def _ask_target(self, dialog: JointCentresDialog, source: Path | None) -> Path | None:
        """Ask where to write; never over the take, nor over another file unasked."""
        proposed = proposed_place(source, "_joints.csv") if source else Path("joints.csv")
        name, _ = QFileDialog.getSaveFileName(
            dialog, self.tr("Save joint centres"), str(proposed), "CSV (*.csv)"
        )
        target = dialogs.with_ending(dialog, name, ".csv") if name else None
        if target and source is not None and is_there(target) and same_file(target, source):
            text = self.tr("{0} is the take itself; choose another name.")
            dialogs.show_problem(dialog, ExportError(text.format(target.name)))
            return None
        return target
