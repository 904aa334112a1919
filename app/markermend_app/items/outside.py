"""A veil over the frames outside the region of interest."""

from __future__ import annotations

import pyqtgraph as pg
from PySide6.QtCore import QPointF, QRectF
from PySide6.QtGui import QPainter, QPen, QTransform

from markermend_app.style import theme

_VEIL = 0.72


class Outside(pg.GraphicsObject):
    """Pales what lies before and after an interval of frames, with a line at each edge."""

    def __init__(self) -> None:
        super().__init__()
        self._region: tuple[int, int] | None = None
        # Over the curves, under the cursor.
        self.setZValue(20)
        self.hide()

    def show_region(self, region: tuple[int, int] | None) -> None:
        """Leave these frames clear; None pales nothing."""
        self._region = region
        self.setVisible(region is not None)
        self.update()

    def boundingRect(self) -> QRectF:
        """Everything in view."""
        return QRectF(self.viewRect()) if self.getViewBox() is not None else QRectF()

    def dataBounds(self, axis: int, frac: float = 1.0, orthoRange: object = None) -> None:
        """Take no part in fitting the view."""

    def viewRangeChanged(self, *_: object) -> None:
        """Follow the view."""
        self.prepareGeometryChange()
        self.update()

    def paint(self, painter: QPainter, *_: object) -> None:
        """Paint the veils, in screen pixels."""
        view, region = self.getViewBox(), self._region
        back, ok = self.sceneTransform().inverted()
        if view is None or region is None or not ok:
            return
        box, (low, high) = view.sceneBoundingRect(), view.viewRange()[0]
        painter.setWorldTransform(QTransform(back) * painter.worldTransform())
        look = theme.current()
        veil, line = theme.faded(look.plot, _VEIL), QPen(look.muted, 1)
        left, right = (
            box.left() + (edge - 0.5 - low) * box.width() / (high - low) for edge in region
        )
        if left > box.left():
            end = min(left, box.right())
            painter.fillRect(QRectF(box.topLeft(), QPointF(end, box.bottom())), veil)
        if right < box.right():
            begin = max(right, box.left())
            painter.fillRect(QRectF(QPointF(begin, box.top()), box.bottomRight()), veil)
        painter.setPen(line)
        for x in (left, right):
            if box.left() < x < box.right():
                painter.drawLine(QPointF(x, box.top()), QPointF(x, box.bottom()))
