"""What stands around and over the overview's picture: groups, time, scale, what is looked at."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QFontMetrics, QLinearGradient, QPainter, QPen

from markermend_app.panels.overview.picture import Rows
from markermend_app.panels.overview.places import Places
from markermend_app.style import theme

TICK_PX = 90
_BAND = 5.0
_BELOW = 2.0


def paint_groups(painter: QPainter, rows: Rows, area: QRectF) -> None:
    """Names of the groups, where there is room, each with its band beside the picture."""
    look, metrics = theme.current(), QFontMetrics(painter.font())
    height = area.height() / len(rows.columns)
    free_from = 0.0
    for i, (name, first, last) in enumerate(rows.groups):
        top, bottom = area.top() + first * height, area.top() + last * height
        tint = theme.blend(look.window, look.muted, 0.55 if i % 2 else 0.25)
        painter.fillRect(QRectF(area.left() - _BAND - 1, top, _BAND, bottom - top), tint)
        line = (top + bottom - metrics.height()) / 2
        # Below the picture stands what it is of.
        if line >= free_from and line + metrics.height() <= area.bottom() + _BELOW:
            width = area.left() - _BAND - 10
            text = metrics.elidedText(name, Qt.TextElideMode.ElideMiddle, int(width))
            painter.setPen(look.muted)
            side = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter
            painter.drawText(QRectF(4, line, width, metrics.height()), side, text)
            free_from = line + metrics.height()


def paint_time(
    painter: QPainter, area: QRectF, span: tuple[float, float], rate: float, room: float
) -> None:
    """Seconds below, and frame numbers' worth of decimals; nothing in the last ``room`` pixels."""
    look, metrics = theme.current(), QFontMetrics(painter.font())
    start, stop = (frame / rate for frame in span)
    step = round_step((stop - start) / max(1.0, area.width() / TICK_PX))
    for i in range(int(np.ceil(start / step - 1e-9)), int(stop / step + 1e-9) + 1):
        x = area.left() + (i * step - start) / (stop - start) * area.width()
        painter.setPen(look.border)
        painter.drawLine(QPointF(x, area.bottom()), QPointF(x, area.bottom() + 3))
        painter.setPen(look.muted)
        text = f"{round(i * step, 6):g} s"
        half = metrics.horizontalAdvance(text) / 2 + 2
        if x + half <= area.right() + 10 - room:
            box = QRectF(x - half, area.bottom() + 2, 2 * half, metrics.height())
            painter.drawText(box, Qt.AlignmentFlag.AlignCenter, text)


def paint_scale(
    painter: QPainter, area: QRectF, colors: Sequence[QColor], least: str, most: str
) -> float:
    """A bar of the heat's colours in the lower right corner; returns the pixels it takes."""
    look, metrics = theme.current(), QFontMetrics(painter.font())
    width, height, gap = 70.0, 7.0, 5.0
    last, first = metrics.horizontalAdvance(most), metrics.horizontalAdvance(least)
    middle = area.bottom() + 2 + metrics.height() / 2
    bar = QRectF(area.right() - last - gap - width, middle - height / 2, width, height)
    fill = QLinearGradient(bar.topLeft(), bar.topRight())
    for i, color in enumerate(colors):
        fill.setColorAt(i / (len(colors) - 1), color)
    painter.fillRect(bar, fill)
    painter.setPen(look.border)
    painter.setBrush(Qt.BrushStyle.NoBrush)
    painter.drawRect(bar)
    painter.setPen(look.muted)
    base = middle + metrics.ascent() / 2 - 1
    painter.drawText(QPointF(bar.right() + gap, base), most)
    painter.drawText(QPointF(bar.left() - gap - first, base), least)
    return width + last + first + 6 * gap


def round_step(seconds: float) -> float:
    """The next larger of 1, 2, 5 times a power of ten."""
    power = 10.0 ** np.floor(np.log10(max(seconds, 1e-6)))
    return float(next(m * power for m in (1, 2, 5, 10) if m * power >= seconds * 0.999))


def paint_words(painter: QPainter, area: QRectF, text: str) -> None:
    """Write a line over the middle of the picture."""
    look = theme.current()
    box = QRectF(0, 0, painter.fontMetrics().horizontalAdvance(text) + 20, 22)
    box.moveCenter(area.center())
    painter.setPen(look.border)
    painter.setBrush(theme.faded(look.raised, 0.9))
    painter.drawRoundedRect(box, 4, 4)
    painter.setPen(look.text)
    painter.drawText(box, Qt.AlignmentFlag.AlignCenter, text)


def paint_shown(painter: QPainter, places: Places, rows: Sequence[int]) -> None:
    """Tick the markers that the plots show, left of their rows."""
    for row in rows:
        box = places.box(row, *places.span)
        tick = QRectF(places.area.left() - 7, box.top(), 6, box.height())
        painter.fillRect(tick, theme.current().accent)


def paint_region(painter: QPainter, places: Places, start: int, stop: int) -> None:
    """Pale the frames outside the region of interest, with a bracket at each edge."""
    look, area = theme.current(), places.area
    left = min(max(area.left(), places.x(start)), area.right())
    right = min(max(area.left(), places.x(stop)), area.right())
    veil = theme.faded(look.window, 0.8)
    painter.fillRect(QRectF(area.left(), area.top(), left - area.left(), area.height()), veil)
    painter.fillRect(QRectF(right, area.top(), area.right() - right, area.height()), veil)
    painter.setPen(QPen(look.accent, 2))
    for x, inwards in ((left, 6.0), (right, -6.0)):
        painter.drawLine(QPointF(x, area.top()), QPointF(x, area.bottom()))
        for y in (area.top(), area.bottom()):
            painter.drawLine(QPointF(x, y), QPointF(x + inwards, y))


def paint_view(painter: QPainter, places: Places, start: float, stop: float) -> None:
    """Frame the picture and, unless it is all of it, the part that the plots show."""
    look, area = theme.current(), places.area
    painter.setBrush(Qt.BrushStyle.NoBrush)
    painter.setPen(QPen(look.border, 1))
    painter.drawRect(area.adjusted(-0.5, -0.5, 0.5, 0.5))
    left = max(area.left(), places.x(start + 0.5))
    right = min(area.right(), places.x(stop + 0.5))
    if right - left >= area.width() - 1:
        return
    veil = theme.faded(look.window, 0.35)
    painter.fillRect(QRectF(area.left(), area.top(), left - area.left(), area.height()), veil)
    painter.fillRect(QRectF(right, area.top(), area.right() - right, area.height()), veil)
    painter.setPen(QPen(look.accent, 1.5))
    painter.drawRect(QRectF(left, area.top(), max(2.0, right - left), area.height()))


def paint_current(painter: QPainter, box: QRectF) -> None:
    """Frame the artifact under review."""
    painter.setPen(QPen(theme.current().text, 1))
    painter.drawRect(box.adjusted(-1.5, -1.5, 1.5, 1.5))


def paint_cursor(painter: QPainter, places: Places, frame: int) -> None:
    """Draw a line through the frame of the cursor."""
    x, area = places.x(frame + 0.5), places.area
    painter.setPen(QPen(theme.current().text, 1))
    painter.drawLine(QPointF(x, area.top() - 2), QPointF(x, area.bottom() + 2))
