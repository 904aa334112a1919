"""Events of the file as flags: a line through a plot, and a pennant with the event's name."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QFont, QFontMetricsF, QPainter, QPen, QPolygonF, QTransform

from markermend_app.items.in_view import InView
from markermend_app.style import theme

_POLE = 6.0


class Flags(InView):
    """Vertical dashed lines at events; names only in the plot that is told to write them."""

    def __init__(self) -> None:
        super().__init__()
        self._frames = np.zeros(0)
        self._names: tuple[str, ...] = ()
        self._order = np.zeros(0, dtype=np.int64)
        self.named = False
        self.setZValue(-5)

    def show_events(self, events: Sequence[tuple[float, str]]) -> None:
        """Draw these: frame and name."""
        ordered = sorted(events)
        self._frames = np.array([frame for frame, _ in ordered], dtype=np.float64)
        self._names = tuple(name for _, name in ordered)
        self.update()

    def set_named(self, named: bool) -> None:
        """Write names, or draw lines alone."""
        self.named = named
        self.update()

    @property
    def height(self) -> float:
        """Pixels at the top that names take."""
        if not self.named or not len(self._names):
            return 0.0
        return QFontMetricsF(_font(QFont())).height() + 2.0

    def paint(self, painter: QPainter, *_: object) -> None:
        """Paint what is in view, in screen pixels; a name that has no room is left out."""
        view = self.getViewBox()
        back, ok = self.sceneTransform().inverted()
        if view is None or not ok or not len(self._frames):
            return
        box, (low, high) = view.sceneBoundingRect(), view.viewRange()[0]
        painter.setWorldTransform(QTransform(back) * painter.worldTransform())
        look = theme.current()
        first, last = np.searchsorted(self._frames, (low, high))
        places = box.left() + (self._frames[first:last] - low) * box.width() / (high - low)
        painter.setPen(QPen(theme.faded(look.flag, 0.7), 1, Qt.PenStyle.DashLine))
        for x in places.tolist():
            painter.drawLine(QPointF(x, box.top()), QPointF(x, box.bottom()))
        if self.named:
            self._paint_names(painter, places.tolist(), self._names[first:last], box)

    def _paint_names(
        self, painter: QPainter, places: list[float], names: Sequence[str], box: QRectF
    ) -> None:
        """A pennant at the top of each line, as far as they do not cover each other."""
        look = theme.current()
        painter.setFont(_font(painter.font()))
        metrics = painter.fontMetrics()
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        free_from = -np.inf
        height = metrics.height() + 2.0
        for i, (x, name) in enumerate(zip(places, names, strict=True)):
            room = (places[i + 1] if i + 1 < len(places) else box.right()) - x
            text = metrics.elidedText(name, Qt.TextElideMode.ElideRight, int(room - _POLE - 6))
            width = metrics.horizontalAdvance(text) + _POLE + 4
            written = len(text) > 1 and x >= free_from and width <= room
            width = width if written else _POLE
            top = box.top() + 1
            pennant = QPolygonF(
                [
                    QPointF(x, top),
                    QPointF(x + width, top),
                    QPointF(x + width + (3 if written else 0), top + height / 2),
                    QPointF(x + width, top + height),
                    QPointF(x, top + height),
                ]
                if written
                else [QPointF(x, top), QPointF(x + width, top + 4), QPointF(x, top + 8)]
            )
            painter.setPen(Qt.PenStyle.NoPen)
            painter.setBrush(look.flag)
            painter.drawPolygon(pennant)
            if written:
                painter.setPen(look.plot)
                painter.drawText(
                    QRectF(x + 4, top, width, height), Qt.AlignmentFlag.AlignVCenter, text
                )
                free_from = x + width + 4


def _font(font: QFont) -> QFont:
    """Small letters."""
    small = QFont(font)
    small.setPointSize(theme.SMALL_PT - 1)
    return small
