"""Exporting from the window: ask what to write and where to, and write it on the worker."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from PySide6.QtCore import QEventLoop, QObject, Signal
from PySide6.QtWidgets import QApplication, QFileDialog, QWidget

from markermend.artifact import Status
from markermend.errors import ExportError, RangeError
from markermend.files import Export
from markermend.progress import Progress
from markermend.take import Take
from markermend_app import settings, units
from markermend_app.background.jobs import Lane
from markermend_app.background.loading import is_there, proposed_place, same_file
from markermend_app.background.saver import Saver
from markermend_app.dialogs import ask as dialogs
from markermend_app.dialogs import export as export_dialog
from markermend_app.dialogs.file_filters import export_filter
from markermend_app.document import Document

# Repaired joints are expected to be off by more anyway; what is told then needs no answer.
_HARDLY_OFF_MM = 5.0


class Exporter(QObject):
    """Writes the open take.

    Signals
    -------
    said(str) : a sentence for the status bar
    replaced(Path) : the source itself was replaced; what is open is no longer what is on disk
    """

    said = Signal(str)
    replaced = Signal(object)

    def __init__(self, document: Document, lane: Lane, saver: Saver, window: QWidget) -> None:
        super().__init__(window)
        self._document = document
        self._lane, self._saver = lane, saver
        self._window = window
        self._writing = False
        lane.finished.connect(self._rest)

    def finish(self) -> None:
        """Wait for an export under way; the window stays alive and it can be cancelled."""
        while self._writing and self._lane.busy:
            QApplication.processEvents(QEventLoop.ProcessEventsFlag.WaitForMoreEvents)
        self._saver.finish()

    def _rest(self) -> None:
        """Note that nothing is written any longer, be it done or cancelled."""
        if not self._lane.busy:
            self._writing = False

    def export(self, *, wait: bool = False) -> bool:
        """Ask what to write and where to, and write it.

        With ``wait`` the answer is whether the file was written; else whether writing began.
        """
        from markermend.files import stale_outputs

        document = self._document
        session = document.session
        if session is None:
            return False
        choice = export_dialog.ask_export(
            self._window,
            session.with_status(Status.PENDING),
            session.with_status(Status.ACCEPTED),
            stale_outputs(session.take),
            session.original.first_frame,
            settings.flag("record_repairs", False),
            empty=not session.artifacts and not session.history,
            region=session.region,
            joints=document.joints,
        )
        if choice is None:
            return False
        settings.remember("record_repairs", choice.record)
        target = self._ask_target(session.original)
        if target is None:
            return False
        overwrite = False
        source = document.path
        if source is not None and is_there(target) and same_file(target, source):
            if choice.region and session.region is not None:
                text = self.tr("A part of {0} cannot replace it; choose another name.")
                dialogs.show_problem(self._window, ExportError(text.format(target.name)))
                return False
            if not dialogs.ask_replace_source(self._window, target):
                return False
            overwrite = True
        return self.export_to(target, choice, overwrite=overwrite, wait=wait)

    def export_to(
        self,
        target: Path,
        choice: export_dialog.ExportChoice,
        *,
        overwrite: bool = False,
        as_float: bool = False,
        wait: bool = False,
    ) -> bool:
        """Write the take as it stands; says so when done."""
        session = self._document.session
        if session is None:
            return False
        label = self.tr("Exporting {0}").format(target.name)
        written: list[bool] = []
        complete: list[bool] = []
        wrote: list[str] = []

        held, original, revision = session.state.held(), session.original, session.revision
        region = session.region if choice.region else None
        record = session.repairs_in_words(region) if choice.record else ()

        def work(progress: Progress) -> Any:
            from markermend.files import write
            from markermend.review.hand import without_emptied
            from markermend.review.place import file_hash
            from markermend.review.standing import changed_outside

            take = held()
            complete.append(region is None or not changed_outside(original, take, region))
            export = write(
                without_emptied(take, original),
                target,
                overwrite=overwrite,
                as_float=as_float,
                record=record,
                mark_outputs=choice.mark_outputs,
                frames=region,
                progress=progress,
            )
            wrote.append(file_hash(target) if overwrite else "")
            return export

        def done(export: Any) -> None:
            written.append(True)
            self._writing = False
            if session.revision == revision and complete[-1]:
                session.mark_exported()
            self._document.history_changed.emit()
            self.said.emit(self._summary(export))
            if self._document.session is session and self._document.file is not None:
                self._save(wrote[-1] if session.revision == revision else "")
                if overwrite and not wait:
                    self.replaced.emit(target)
            # Last, since what waits for an answer must not keep the review from being saved.
            self._tell_off(export, wait=wait)

        def failed(error: Exception) -> None:
            self._writing = False
            if isinstance(error, RangeError) and dialogs.ask_float(self._window, str(error)):
                again = self.export_to(
                    target, choice, overwrite=overwrite, as_float=True, wait=wait
                )
                written.append(again)
                return
            written.append(False)
            # What was said of an export before is no longer the last that happened.
            self.said.emit(self.tr("{0} was not written.").format(target.name))
            if not isinstance(error, RangeError):
                dialogs.show_problem(self._window, error)

        self._writing = True
        self._lane.submit(label, work, done, failed)
        # A cancelled job answers nothing.
        while wait and not written and self._lane.busy:
            QApplication.processEvents(QEventLoop.ProcessEventsFlag.WaitForMoreEvents)
        if wait:
            self._saver.finish()
        return any(written) if wait else True

    def _save(self, wrote: str) -> None:
        """Save the review, with the hash of what was written over the source, or none."""
        file = self._document.file
        if file is not None:
            file.wrote = wrote
            self._saver.save(file, lambda error: dialogs.show_problem(self._window, error))

    def _tell_off(self, export: Export, *, wait: bool) -> None:
        """Say where what was written is not what was seen."""
        if export.off_mm > _HARDLY_OFF_MM or export.lost:
            dialogs.tell_off(self._window, export, wait=wait)

    def _summary(self, export: Export) -> str:
        """Say what was written."""
        one = self.tr("Exported to {0}; 1 sample differs.")
        many = self.tr("Exported to {0}; {1} samples differ.")
        text = (one if export.samples == 1 else many).format(export.path, export.samples)
        if export.off:
            rigid = self.tr("Its bones are rigid: {0} is {1} off there, no joint is more.")
            text += " " + rigid.format(export.off[0][0], units.length(export.off_mm))
        if export.backup is not None:
            text += " " + self.tr("The original is kept as {0}.").format(export.backup.name)
        if export.dropped:
            lost = self.tr("It was written anew, so without further columns of its source: {0}.")
            text += " " + lost.format(", ".join(export.dropped))
        return text

    def _ask_target(self, take: Take) -> Path | None:
        """Ask where to write; never proposes the source, nor a format that is only read."""
        from markermend.plugins.formats import writable

        path = self._document.path
        ending = "_clean.c3d"
        if path is not None and take.skeleton:
            kept = path.suffix.lower() in writable(skeleton=True)
            ending = f"_clean{path.suffix if kept else '.csv'}"
        proposal = str(proposed_place(path, ending)) if path else "take_clean.c3d"
        kinds = export_filter(take, Path(proposal).suffix)
        name, chosen = QFileDialog.getSaveFileName(
            self._window, self.tr("Export repaired take"), proposal, kinds
        )
        if not name:
            return None
        target = Path(name)
        if not target.suffix:
            target = target.with_suffix(chosen[chosen.find("*") + 1 : chosen.find(")")])
            # The file dialog has asked about the name without the ending only.
            if is_there(target) and not dialogs.ask_replace(self._window, target):
                return None
        return target
