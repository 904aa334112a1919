"""The frame around a painted panel that has the keyboard."""

from __future__ import annotations

from PySide6.QtCore import QRectF, Qt
from PySide6.QtGui import QPainter, QPen
from PySide6.QtWidgets import QWidget

from markermend_app.style import theme


def paint_focus(painter: QPainter, widget: QWidget) -> None:
    """Draw a frame along the edge of a widget while the keyboard is there."""
    if widget.hasFocus():
        painter.setBrush(Qt.BrushStyle.NoBrush)
        painter.setPen(QPen(theme.current().accent, 2))
        painter.drawRect(QRectF(widget.rect()).adjusted(1, 1, -1, -1))
