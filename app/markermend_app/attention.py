"""Tells a review's stopwatch when the operator does something."""

from __future__ import annotations

from PySide6.QtCore import QObject

from markermend_app.document import Document


class Attention(QObject):
    """Takes every change of what is looked at for work: steps, views, markers, the cursor."""

    def __init__(self, document: Document, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._document = document
        for signal in (
            document.current_changed,
            document.shown_changed,
            document.selection_changed,
            document.frame_changed,
        ):
            signal.connect(self.touch)

    def touch(self, *_: object) -> None:
        """Something was done just now."""
        if self._document.session is not None:
            self._document.session.stopwatch.touch()
