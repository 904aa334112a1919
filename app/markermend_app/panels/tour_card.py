"""The tour's card: a few words beside a widget, an arrow, and a ring around it."""

from __future__ import annotations

from PySide6.QtCore import QPoint, QPointF, QRect, QRectF, QSize, Qt
from PySide6.QtGui import QAccessible, QAccessibleEvent, QPainter, QPaintEvent, QPen, QPolygonF
from PySide6.QtWidgets import QHBoxLayout, QLabel, QPushButton, QVBoxLayout, QWidget

from markermend_app.style import theme

WIDTH, ARROW, PAD, RADIUS = 320, 10, 12, 6


class Ring(QWidget):
    """A frame around a widget, through which it is used as ever."""

    def __init__(self, window: QWidget) -> None:
        super().__init__(window)
        self.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)
        self.hide()

    def paintEvent(self, event: QPaintEvent) -> None:
        """Draw the frame."""
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setPen(QPen(theme.current().accent, 2))
        painter.drawRoundedRect(QRectF(self.rect()).adjusted(1, 1, -1, -1), RADIUS, RADIUS)


class TourCard(QWidget):
    """Says what to do, and points at the widget that it speaks of.

    Parameters
    ----------
    window : the window it floats over
    """

    def __init__(self, window: QWidget) -> None:
        super().__init__(window)
        self.ring = Ring(window)
        self._tip: QPointF | None = None
        self.title, self.text, self.count = QLabel(), QLabel(), QLabel()
        self.title.setProperty("role", "heading")
        self.count.setProperty("role", "small")
        # In other languages a title may need two lines.
        for label in (self.title, self.text):
            label.setWordWrap(True)
        self.skip = QPushButton(self.tr("Skip this step"))
        self.end = QPushButton()
        for button in (self.skip, self.end):
            # The review keys go on working.
            button.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        top = QHBoxLayout()
        top.addWidget(self.title, 1)
        top.addWidget(self.count)
        row = QHBoxLayout()
        row.setSpacing(8)
        row.addStretch(1)
        row.addWidget(self.skip)
        row.addWidget(self.end)
        column = QVBoxLayout(self)
        edge = ARROW + PAD
        column.setContentsMargins(edge, edge, edge, edge)
        column.setSpacing(8)
        column.addLayout(top)
        column.addWidget(self.text)
        column.addLayout(row)
        self.setFixedWidth(WIDTH + 2 * ARROW)
        self.hide()

    def say(self, title: str, text: str, count: str, *, last: bool) -> None:
        """Write the card; the last one can only be closed."""
        self.title.setText(title)
        self.text.setText(text)
        self.count.setText(count)
        self.skip.setVisible(not last)
        self.end.setText(self.tr("Close") if last else self.tr("End the tour"))
        self.setAccessibleName(f"{title}. {text}")
        self.show()
        QAccessible.updateAccessibility(QAccessibleEvent(self, QAccessible.Event.Alert))

    def leave(self) -> None:
        """Take card and ring away."""
        self.hide()
        self.ring.hide()

    def point_at(self, target: QWidget | None) -> None:
        """Stand beside a widget, or in the middle when it cannot be seen."""
        window = self.parentWidget()
        assert window is not None
        size = QSize(self.width(), self.heightForWidth(self.width()))
        seen = None if target is None else _seen(target, window)
        if seen is None:
            self.ring.hide()
            corner, tip = window.rect().center() - QPoint(size.width(), size.height()) / 2, None
        else:
            around = seen.adjusted(-4, -4, 4, 4) & window.rect()
            corner, tip = _beside(around, size, window.rect())
            self.ring.setGeometry(around)
            self.ring.show()
            self.ring.raise_()
        place = QRect(corner, size)
        if place != self.geometry() or tip != self._tip:
            self._tip = tip
            self.setGeometry(place)
            self.update()
        self.raise_()

    def paintEvent(self, event: QPaintEvent) -> None:
        """Draw the card and the arrow that reaches out of it."""
        t = theme.current()
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        body = QRectF(self.rect()).adjusted(ARROW, ARROW, -ARROW, -ARROW)
        painter.setPen(QPen(t.accent, 1.5))
        painter.setBrush(t.raised)
        painter.drawRoundedRect(body, RADIUS, RADIUS)
        if self._tip is not None:
            painter.setPen(Qt.PenStyle.NoPen)
            painter.setBrush(t.accent)
            painter.drawPolygon(_arrow(body, self._tip - QPointF(self.pos())))


def _seen(target: QWidget, window: QWidget) -> QRect | None:
    """What is seen of a widget, in the window; None when nothing is."""
    part = target.visibleRegion().boundingRect()
    if part.isEmpty():
        return None
    corner = window.mapFromGlobal(target.mapToGlobal(part.topLeft()))
    inside = QRect(corner, part.size()) & window.rect()
    return None if inside.isEmpty() else inside


def _beside(target: QRect, size: QSize, room: QRect) -> tuple[QPoint, QPointF]:
    """Corner of a card beside a widget, and where the arrow's tip is, both in the window.

    It stands left or right of it where there is room, else below or above, else in the room's
    lower corner.
    """
    width, height = size.width(), size.height()
    level = min(max(target.center().y() - height // 2, room.top()), room.bottom() - height)
    middle = min(max(target.center().x() - width // 2, room.left()), room.right() - width)
    across, along = QPointF(target.center()).y(), QPointF(target.center()).x()
    for corner, tip in (
        (QPoint(target.right() + 1, level), QPointF(target.right() + 1, across)),
        (QPoint(target.left() - width, level), QPointF(target.left(), across)),
        (QPoint(middle, target.bottom() + 1), QPointF(along, target.bottom() + 1)),
        (QPoint(middle, target.top() - height), QPointF(along, target.top())),
    ):
        if room.contains(QRect(corner, size)):
            return corner, tip
    corner = room.bottomRight() - QPoint(width, height)
    return corner, QPointF(target.center())


def _arrow(body: QRectF, tip: QPointF) -> QPolygonF:
    """A triangle from the card's edge to the tip, as wide as it is long on both sides."""
    x = min(max(tip.x(), body.left() + 2 * ARROW), body.right() - 2 * ARROW)
    y = min(max(tip.y(), body.top() + 2 * ARROW), body.bottom() - 2 * ARROW)
    if body.top() <= tip.y() <= body.bottom():
        edge = body.left() if tip.x() < body.left() else body.right()
        return QPolygonF([tip, QPointF(edge, y - ARROW), QPointF(edge, y + ARROW)])
    edge = body.top() if tip.y() < body.top() else body.bottom()
    return QPolygonF([tip, QPointF(x - ARROW, edge), QPointF(x + ARROW, edge)])
