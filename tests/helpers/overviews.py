"""Places and colours in an overview as tests open it."""

from __future__ import annotations

from PySide6.QtCore import QPoint
from PySide6.QtGui import QColor

from markermend_app.panels.overview.overview import Overview


def point(panel: Overview, frame: float, row: float) -> QPoint:
    """Pixel of a frame in a row: the picture is 600 by 160 at (80, 4)."""
    return QPoint(round(80 + frame * 600 / 400), round(4 + (row + 0.5) * 160 / 8))


def color(panel: Overview, at: QPoint) -> QColor:
    """What is painted at a pixel."""
    image = panel.grab().toImage()
    ratio = image.devicePixelRatio()
    return image.pixelColor(round(at.x() * ratio), round(at.y() * ratio))
