"""A page of the manual, whose pictures are never wider than it is."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from pathlib import Path

from PySide6.QtGui import QImageReader, QResizeEvent, QTextCursor, QTextFragment
from PySide6.QtWidgets import QTextBrowser

MARGIN = 24


class ManualPage(QTextBrowser):
    """Shows Markdown.

    Parameters
    ----------
    folder : where pictures lie
    """

    def __init__(self, folder: Path) -> None:
        super().__init__()
        self._folder = folder
        self.setSearchPaths([str(folder)])
        self.setOpenLinks(False)
        self.document().setDocumentMargin(MARGIN)

    def fit_pictures(self) -> None:
        """Make pictures as wide as they are, but no wider than the page."""
        room = self.viewport().width() - 2 * MARGIN
        for fragment in list(self._pictures()):
            form = fragment.charFormat().toImageFormat()
            width = min(_width(self._folder / form.name()), room)
            if width > 0 and form.width() != width:
                form.setWidth(width)
                cursor = QTextCursor(self.document())
                cursor.setPosition(fragment.position())
                end = fragment.position() + fragment.length()
                cursor.setPosition(end, QTextCursor.MoveMode.KeepAnchor)
                cursor.setCharFormat(form)

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Fit the pictures to the page."""
        super().resizeEvent(event)
        self.fit_pictures()

    def _pictures(self) -> Iterator[QTextFragment]:
        """Stretches of the text that are pictures."""
        block = self.document().begin()
        while block.isValid():
            place = block.begin()
            while not place.atEnd():
                if place.fragment().charFormat().isImageFormat():
                    yield place.fragment()
                place += 1
            block = block.next()


@cache
def _width(path: Path) -> int:
    """Pixels that a picture is wide, or -1 where there is none."""
    return QImageReader(str(path)).size().width()
