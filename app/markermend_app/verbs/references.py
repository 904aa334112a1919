"""Choosing by hand, in the 3D view or in the tree, which markers a repair follows."""

from __future__ import annotations

from PySide6.QtCore import QObject, Signal

from markermend_app.document import Document


class References(QObject):
    """While it chooses, a click on a marker, or Return, puts it in or takes it out.

    Signals
    -------
    said(str) : a sentence for the status bar
    changed(bool) : clicks choose references from now on, or mean what they always do again

    Attributes
    ----------
    choosing : whether clicks choose references
    """

    said = Signal(str)
    changed = Signal(bool)

    def __init__(self, document: Document, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._document = document
        self._artifact: str | None = None
        self.choosing = False
        document.current_changed.connect(self._current_changed)

    def choose(self, on: bool) -> None:
        """Begin to choose for the current artifact, or end; what was chosen stays chosen."""
        current = self._document.current
        self.choosing = on and current is not None
        if self.choosing and current is not None:
            self._artifact = current.id
            text = self.tr(
                "Choose the markers that {0} is to follow: by clicks in the 3D view, or by Return "
                "in the tree."
            )
            if self._document.joints:
                text = self.tr(
                    "Choose the joints that {0} is to follow: by clicks in the 3D view, or by "
                    "Return in the tree."
                )
            self.said.emit(text.format(current.marker))
        else:
            self.said.emit("")
        self.changed.emit(self.choosing)

    def toggle(self, marker: str) -> bool:
        """Put a marker in or take it out; whether the click was meant for this."""
        current = self._document.current
        if not self.choosing or current is None:
            return False
        if marker != current.marker:
            had = self._document.preview.references
            rest = tuple(m for m in had if m != marker)
            self._document.follow(rest if marker in had else (*had, marker))
        return True

    def _current_changed(self) -> None:
        """End when another artifact comes under review."""
        current = self._document.current
        if self.choosing and (current is None or current.id != self._artifact):
            self.choose(False)
