"""What lies outside the region of interest, on another ground."""

from __future__ import annotations

from PySide6.QtCore import QPointF, QRectF
from PySide6.QtGui import QPainter, QPen, QTransform

from markermend_app.items.in_view import InView
from markermend_app.style import theme

_SHARE = 0.22
_BRACKET_PX = 6.0


class Outside(InView):
    """A ground of its own before and after an interval of frames, and a bracket at each edge."""

    def __init__(self) -> None:
        super().__init__()
        self._region: tuple[int, int] | None = None
        # Under all that is drawn: see-through over curves it would take as long as they do.
        self.setZValue(-20)
        self.hide()

    def show_region(self, region: tuple[int, int] | None) -> None:
        """Set these frames off from the others; None sets off nothing."""
        self._region = region
        self.setVisible(region is not None)
        self.update()

    def paint(self, painter: QPainter, *_: object) -> None:
        """Paint ground and brackets, in screen pixels."""
        view, region = self.getViewBox(), self._region
        back, ok = self.sceneTransform().inverted()
        if view is None or region is None or not ok:
            return
        box, (low, high) = view.sceneBoundingRect(), view.viewRange()[0]
        painter.setWorldTransform(QTransform(back) * painter.worldTransform())
        look = theme.current()
        ground = theme.blend(look.plot, look.muted, _SHARE)
        left, right = (
            box.left() + (edge - 0.5 - low) * box.width() / (high - low) for edge in region
        )
        if left > box.left():
            end = min(left, box.right())
            painter.fillRect(QRectF(box.topLeft(), QPointF(end, box.bottom())), ground)
        if right < box.right():
            begin = max(right, box.left())
            painter.fillRect(QRectF(QPointF(begin, box.top()), box.bottomRight()), ground)
        painter.setPen(QPen(look.accent, 2))
        for x, inwards in ((left, _BRACKET_PX), (right, -_BRACKET_PX)):
            if box.left() < x < box.right():
                painter.drawLine(QPointF(x, box.top()), QPointF(x, box.bottom()))
                for y in (box.top() + 1, box.bottom() - 1):
                    painter.drawLine(QPointF(x, y), QPointF(x + inwards, y))
