"""Which frame and which marker's row lie where in the overview's picture."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from PySide6.QtCore import QPointF, QRectF

from markermend.arrays import FloatArray, IntArray
from markermend_app.panels.overview.picture import row_edges


@dataclass(frozen=True)
class Places:
    """The picture's place on the screen, and what it shows.

    Attributes
    ----------
    area : pixels
    span : frames from its left to its right edge
    rows : markers above one another
    """

    area: QRectF
    span: tuple[float, float]
    rows: int

    def x(self, frame: float) -> float:
        """Pixel at which a frame begins."""
        start, stop = self.span
        return self.area.left() + (frame - start) * self.area.width() / (stop - start)

    def frame(self, x: float) -> float:
        """Frame under a pixel, with the share of it that lies left of the pixel."""
        start, stop = self.span
        return start + (x - self.area.left()) * (stop - start) / self.area.width()

    def row(self, y: float) -> int | None:
        """Row under a pixel."""
        row = int((y - self.area.top()) * self.rows / self.area.height()) if self.rows else -1
        return row if 0 <= row < self.rows else None

    def box(self, row: int, start: float, stop: float) -> QRectF:
        """Frames of a row, at least three pixels wide and high."""
        top, bottom = row_edges(self.rows, round(self.area.height()))[row]
        left, right = self.x(start), self.x(stop)
        width, height = max(3.0, right - left), max(3, bottom - top)
        return QRectF(left, self.area.top() + top, width, height)

    def away(self, at: QPointF, intervals: IntArray) -> FloatArray:
        """(n,) pixels from a point to (n, 3) intervals: start, stop and row of each."""
        height = self.area.height() / max(1, self.rows)
        low, high = self.x(0), self.x(1)
        left = low + intervals[:, 0] * (high - low)
        right = low + intervals[:, 1] * (high - low)
        top = self.area.top() + intervals[:, 2] * height
        dx = np.maximum(0, np.maximum(left - at.x(), at.x() - right))
        dy = np.maximum(0, np.maximum(top - at.y(), at.y() - top - height))
        return np.asarray(np.hypot(dx, dy))
