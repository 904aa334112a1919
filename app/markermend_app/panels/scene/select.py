"""Selecting markers in the 3D view with a box or a lasso."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QPainter, QPen, QPolygonF

from markermend.arrays import BoolArray, FloatArray
from markermend_app.style import theme


@dataclass
class Outline:
    """What is being drawn around markers.

    Attributes
    ----------
    tool : ``"box"`` or ``"lasso"``
    points : way of the mouse in pixels, its start first
    """

    tool: str
    points: list[QPointF] = field(default_factory=list)

    def polygon(self) -> QPolygonF:
        """The outline as it stands."""
        if self.tool == "box":
            return QPolygonF(QRectF(self.points[0], self.points[-1]).normalized())
        return QPolygonF(self.points)

    def holds(self, at: FloatArray) -> BoolArray:
        """(markers,) bool: which of the (markers, 2) pixels lie inside; NaN never does."""
        polygon, inside = self.polygon(), np.zeros(len(at), dtype=bool)
        for i in np.flatnonzero(np.isfinite(at).all(axis=1)).tolist():
            point = QPointF(at[i, 0], at[i, 1])
            inside[i] = polygon.containsPoint(point, Qt.FillRule.WindingFill)
        return inside

    def paint(self, painter: QPainter) -> None:
        """Draw it."""
        look = theme.current()
        painter.setPen(QPen(look.accent, 1.5, Qt.PenStyle.DashLine))
        painter.setBrush(theme.faded(look.accent, 0.12))
        painter.drawPolygon(self.polygon())


def nearest(at: FloatArray, point: QPointF, reach: float) -> int | None:
    """Which of the (markers, 2) pixels is nearest to a point, or None when none is in reach."""
    away = np.hypot(at[:, 0] - point.x(), at[:, 1] - point.y())
    if not np.isfinite(away).any() or np.nanmin(away) > reach:
        return None
    return int(np.nanargmin(away))
