"""A few coloured words in the upper left corner of a plot, on a veil so that they can be read."""

from __future__ import annotations

from collections.abc import Sequence

import pyqtgraph as pg
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QFont, QFontMetricsF, QPainter

from markermend_app.style import theme

_PAD, _GAP = 4.0, 10.0


class Caption(pg.GraphicsObject):
    """Words in pixels of the view it is a child of; as many as have room."""

    def __init__(self, view: pg.ViewBox) -> None:
        super().__init__(view)
        self._view = view
        self._words: tuple[tuple[str, QColor], ...] = ()
        self._extent = 0.0, 0.0
        self.setZValue(40)
        self.setAcceptedMouseButtons(Qt.MouseButton.NoButton)

    @property
    def text(self) -> str:
        """What it says, whether or not there is room."""
        return " ".join(word for word, _ in self._words)

    def say(self, words: Sequence[tuple[str, QColor]]) -> None:
        """Write these, each in its colour."""
        self.prepareGeometryChange()
        self._words = tuple(words)
        metrics = QFontMetricsF(_font())
        width = sum(metrics.horizontalAdvance(w) + _GAP for w, _ in self._words) + 2 * _PAD
        # Kept, since a scene asks for it many times in each picture.
        self._extent = width, metrics.height() + 2
        self.update()

    def boundingRect(self) -> QRectF:
        """The line of words."""
        width, height = self._extent
        return QRectF(4, 2, min(width, self._view.width() - 8), height)

    def paint(self, painter: QPainter, *_: object) -> None:
        """Write them."""
        if not self._words:
            return
        box = self.boundingRect()
        painter.setFont(_font())
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(theme.faded(theme.current().plot, 0.8))
        painter.drawRoundedRect(box, 3, 3)
        painter.setClipRect(box)
        metrics = QFontMetricsF(_font())
        x = box.left() + _PAD
        for word, color in self._words:
            painter.setPen(color)
            painter.drawText(QPointF(x, box.top() + metrics.ascent() + 1), word)
            x += metrics.horizontalAdvance(word) + _GAP


def _font() -> QFont:
    """The small font."""
    font = QFont()
    font.setPointSize(theme.SMALL_PT)
    return font
