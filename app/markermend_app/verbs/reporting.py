"""A report of the open review, written on the worker and shown in the browser."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import QObject, QUrl, Signal
from PySide6.QtGui import QDesktopServices
from PySide6.QtWidgets import QFileDialog, QWidget

from markermend.progress import Progress
from markermend_app import languages
from markermend_app.background.jobs import Lane
from markermend_app.background.loading import proposed_place
from markermend_app.dialogs import ask as dialogs
from markermend_app.document import Document
from markermend_app.report_words import told_report


class Reporting(QObject):
    """The verb behind the action that reports.

    Signals
    -------
    said(str) : a sentence for the status bar
    """

    said = Signal(str)

    def __init__(self, document: Document, lane: Lane, window: QWidget) -> None:
        super().__init__(window)
        self._document, self._lane, self._window = document, lane, window

    def report(self) -> None:
        """Ask where to, write the report and open it."""
        path = self._document.path
        proposed = str(proposed_place(path, "_report.html")) if path else "report.html"
        name, _ = QFileDialog.getSaveFileName(
            self._window, self.tr("Report on this review"), proposed, self.tr("HTML (*.html)")
        )
        if name:
            target = Path(name)
            page = target.suffix.lower() in (".html", ".htm")
            self.report_to(target if page else target.with_name(f"{target.name}.html"))

    def report_to(self, target: Path) -> None:
        """Write the report of the review as it stands, and open it."""
        from markermend.report import review_report, reviewed

        session, path = self._document.session, self._document.path
        if session is None:
            return
        review = reviewed(session)
        title = path.name if path is not None else target.stem
        code = languages.language()

        def work(progress: Progress) -> None:
            from markermend.files.atomic import write_text

            progress(0.0, title)
            page = review_report(review, name=title)
            if code != "en":
                page = told_report(page, {title, *review.before.labels}, code)
            progress(0.9, target.name)
            write_text(target, page)

        def written(_: None) -> None:
            self.said.emit(self.tr("Report written to {0}.").format(target))
            QDesktopServices.openUrl(QUrl.fromLocalFile(str(target)))

        def failed(error: Exception) -> None:
            dialogs.show_problem(self._window, error)

        self._lane.submit(self.tr("Reporting"), work, written, failed)
