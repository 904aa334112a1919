"""An axis with a line and a number at each of its round values, quick to be drawn anew."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

import pyqtgraph as pg
from PySide6.QtCore import QLineF, QPointF, QRectF, Qt
from PySide6.QtGui import (
    QColor,
    QFont,
    QFontMetricsF,
    QPainter,
    QPen,
    QStaticText,
    QTextOption,
    QTransform,
)

from markermend_app.style import theme

_ALPHA_PX = 20.0
"""Lines that are less than this apart fade."""


@dataclass(frozen=True)
class _Drawing:
    """What an axis looks like in its own coordinates."""

    edge: QLineF
    lines: Sequence[QLineF]
    lines_pen: QPen
    numbers: Sequence[tuple[QPointF, QStaticText]]


class Axis(pg.AxisItem):
    """Left or bottom axis of a plot with a grid, whose lines cross the plot.

    Of what pyqtgraph's own can do, logarithms, prefixes of units and ticks of one's own are left
    out.

    While time or values are moved, every axis is drawn anew each time: as pyqtgraph does it, by
    measuring each number and drawing each line by itself, that took half of every picture.
    """

    picture: _Drawing | None

    def __init__(self, orientation: str) -> None:
        super().__init__(orientation)
        self.setStyle(maxTickLevel=0)
        self.enableAutoSIPrefix(False)

    def restyle(self) -> None:
        """Take over the theme's colours and size of small text."""
        look = theme.current()
        self.setPen(pg.mkPen(look.border))
        self.setTickPen(pg.mkPen(look.grid))
        self.setTextPen(pg.mkPen(look.muted))
        font = self.font()
        font.setPointSize(theme.SMALL_PT)
        self.setTickFont(font)

    def boundingRect(self) -> QRectF:
        """Its own room and the plot's, which a scene asks for many times in each picture."""
        return self._own() | self._inner()

    def tickValues(
        self, minVal: float, maxVal: float, size: float
    ) -> list[tuple[float, list[float]]]:
        """Multiples of a step that is round in the unit shown, as pyqtgraph chooses it."""
        scale = self.scale
        low, high = sorted((minVal * scale, maxVal * scale))
        levels = self.tickSpacing(low, high, size)
        if not levels:
            return []
        spacing = levels[0][0]
        count = range(math.ceil(low / spacing), math.floor(high / spacing) + 1)
        return [(spacing / scale, [k * spacing / scale for k in count])]

    def paint(self, painter: QPainter, *_: object) -> None:
        """Draw lines and numbers, which are placed anew only where something has changed."""
        # Whatever changes an axis forgets its picture.
        if self.picture is None:
            self.picture = self._drawing()
        drawing = self.picture
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, False)
        painter.setPen(self.pen())
        painter.drawLine(drawing.edge)
        painter.setPen(drawing.lines_pen)
        painter.drawLines(drawing.lines)
        painter.setPen(self.textPen())
        painter.setFont(self._font())
        for at, text in drawing.numbers:
            painter.drawStaticText(at, text)

    def _own(self) -> QRectF:
        """The room of its numbers."""
        return QRectF(QPointF(), self.size())

    def _inner(self) -> QRectF:
        """The room of its lines: the view beside it, which a plot neither turns nor stretches."""
        view = self.linkedView()
        if view is None:
            return self._own()
        room: QRectF = view.boundingRect().translated(view.pos() - self.pos())
        return room

    def _font(self) -> QFont:
        font = self.style["tickFont"]
        return QFont() if font is None else font

    def _drawing(self) -> _Drawing:
        """Place what is drawn."""
        bounds, inner = self._own(), self._inner()
        upright = self.orientation == "left"
        if upright:
            x, top, bottom = bounds.right() - 1, bounds.top() - 1, bounds.bottom() + 1
            edge = QLineF(x, top, x, bottom)
        else:
            y, left, right = bounds.top() + 1, bounds.left() - 1, bounds.right() + 1
            edge = QLineF(left, y, right, y)
        low, high = self.range
        length = bounds.height() if upright else bounds.width()
        levels = self.tickValues(low, high, length) if length > 0 and high != low else []
        if not levels:
            return _Drawing(edge, (), QPen(), ())
        spacing, values = levels[0]
        if upright:
            places = [bounds.bottom() - (v - low) / (high - low) * length for v in values]
            lines = [QLineF(inner.right(), y, bounds.right(), y) for y in places]
        else:
            places = [bounds.left() + (v - low) / (high - low) * length for v in values]
            lines = [QLineF(x, inner.top(), x, bounds.top()) for x in places]
        color = QColor(self.tickPen().color())
        color.setAlphaF(min(1.0, length / (_ALPHA_PX * (len(values) + 1))))
        pen = QPen(self.tickPen())
        pen.setColor(color)
        numbers: list[tuple[QPointF, QStaticText]] = []
        if self.style["showValues"]:
            room, font = bounds | inner, self._font().toString()
            texts = self.tickStrings(values, self.scale, spacing)
            for place, text in zip(places, texts, strict=True):
                number, width, height = _laid_out(text, font)
                if upright:
                    at = QPointF(bounds.right() - self.style["tickTextOffset"][0] - width, place)
                    at.setY(place - height / 2)
                else:
                    at = QPointF(place - width / 2, bounds.top() + self.style["tickTextOffset"][1])
                # What is around the digits themselves may lie outside.
                ink = QRectF(at.x(), at.y() + 0.1 * height, width, 0.8 * height)
                if room.contains(ink):
                    numbers.append((at, number))
        return _Drawing(edge, lines, pen, numbers)


@lru_cache(maxsize=4096)
def _laid_out(text: str, font_name: str) -> tuple[QStaticText, float, float]:
    """A number or time in a font, and its width and height; its lines lie amid each other."""
    font = QFont()
    font.fromString(font_name)
    metrics = QFontMetricsF(font)
    lines = text.split("\n")
    width = max(metrics.horizontalAdvance(line) for line in lines)
    # A mere line feed does not end a line there, where both have room in one.
    laid = QStaticText(text.replace("\n", "\N{LINE SEPARATOR}"))
    laid.setTextFormat(Qt.TextFormat.PlainText)
    if len(lines) > 1:
        laid.setTextOption(QTextOption(Qt.AlignmentFlag.AlignHCenter))
        width = math.ceil(width) + 1.0
        laid.setTextWidth(width)
    laid.prepare(QTransform(), font)
    return laid, width, laid.size().height()
