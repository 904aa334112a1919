"""Saves a review beside what goes on."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QEventLoop, QObject
from PySide6.QtWidgets import QApplication

from markermend.errors import MarkermendError
from markermend.review.file import SessionFile
from markermend_app.background.jobs import Lane


class Saver(QObject):
    """Writes a review on a worker, again where it went on meanwhile."""

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self._lane = Lane("saving", self)

    def finish(self) -> None:
        """Wait for what is under way; the window stays alive."""
        while self._lane.busy:
            QApplication.processEvents(QEventLoop.ProcessEventsFlag.WaitForMoreEvents)

    def save(self, file: SessionFile, failed: Callable[[Exception], None]) -> None:
        """Save a review; ``failed`` is told what prevented it."""
        if file.read_only:
            return
        taken = file.snapshot()

        def done(_: object) -> None:
            try:
                if not file.take_over(taken) and file.is_open:
                    self.save(file, failed)
            except MarkermendError as error:
                failed(error)

        self._lane.submit(
            "Saving", lambda _: taken.write(), done, failed, lambda _: taken.discard()
        )
