"""The range within which a proposed curve is expected to be right."""

from __future__ import annotations

import numpy as np
import pyqtgraph as pg
from pyqtgraph.functions import arrayToQPolygonF
from PySide6.QtCore import QRectF, Qt
from PySide6.QtGui import QColor, QPainter, QPolygonF

from markermend.arrays import FloatArray, runs


class Band(pg.GraphicsObject):
    """A filled, see-through region around a curve."""

    def __init__(self) -> None:
        super().__init__()
        self._polygons: list[QPolygonF] = []
        self._color = QColor()
        self.setZValue(5)

    def set_color(self, color: QColor) -> None:
        """Fill with this colour, its alpha included."""
        self._color = color
        self.update()

    def set_data(self, x: FloatArray, middle: FloatArray, half_width: FloatArray) -> None:
        """Fill ``middle ± half_width``; all (n,); stretches without a value are left out."""
        self.prepareGeometryChange()
        low, high = middle - half_width, middle + half_width
        self._polygons = []
        for start, stop in runs(np.isfinite(low)).tolist():
            part = slice(start, stop)
            there_and_back = np.concatenate((x[part], x[part][::-1]))
            edges = np.concatenate((high[part], low[part][::-1]))
            self._polygons.append(arrayToQPolygonF(there_and_back, edges))
        self.update()

    def clear(self) -> None:
        """Show nothing."""
        self.set_data(np.zeros(0), np.zeros(0), np.zeros(0))

    def boundingRect(self) -> QRectF:
        """What the region covers."""
        box = QRectF()
        for polygon in self._polygons:
            box = box.united(polygon.boundingRect())
        return box

    def dataBounds(self, axis: int, frac: float = 1.0, orthoRange: object = None) -> None:
        """Take no part in fitting the view."""

    def paint(self, painter: QPainter, *_: object) -> None:
        """Fill it."""
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(self._color)
        for polygon in self._polygons:
            painter.drawPolygon(polygon)
