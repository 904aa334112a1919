"""The whole take at a glance: every marker over all of time, coloured by class."""

from __future__ import annotations

import numpy as np
from PySide6.QtCore import QEvent, QPoint, QPointF, QRectF, QSize, Qt
from PySide6.QtGui import (
    QFont,
    QFontMetrics,
    QHelpEvent,
    QImage,
    QMouseEvent,
    QPainter,
    QPaintEvent,
    QPen,
    QResizeEvent,
)
from PySide6.QtWidgets import QToolTip, QWidget

from markermend.artifact import Artifact
from markermend.edits import Change
from markermend.take import Take
from markermend_app import theme
from markermend_app.document import Document
from markermend_app.panels.artifact_text import describe
from markermend_app.panels.overview_picture import (
    Rows,
    arrange,
    draw,
    missing_share,
    row_edges,
)

# Aligned with the plots above: their values stand left, their margin right.
_LEFT, _RIGHT, _TOP, _BOTTOM = 80, 12, 4, 18
_REACH_PX = 4.0
_TICK_PX = 90


class Overview(QWidget):
    """A strip of markers over time; click to go there, drag to scrub."""

    def __init__(self, document: Document, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.document = document
        self._view = (0.0, 0.0)
        self._rows: Rows | None = None
        self._artifacts: tuple[Artifact, ...] = ()
        self._missing = np.zeros((0, 0))
        self._image: QImage | None = None
        self._column_of: dict[str, int] = {}
        self._place = np.zeros((0, 3), dtype=np.int64)
        self.setAccessibleName(self.tr("Overview of the whole take"))
        self.setMinimumHeight(72)
        document.opened.connect(self._opened)
        document.artifacts_changed.connect(self._reread)
        document.data_changed.connect(self._refresh)
        document.current_changed.connect(self.update)
        document.shown_changed.connect(self.update)
        document.frame_changed.connect(self._move_cursor)
        theme.watcher.changed.connect(self._repaint)
        self._opened()

    def set_view(self, start: float, stop: float) -> None:
        """Frame the part of time that the plots show."""
        self._view = (start, stop)
        self.update()

    def sizeHint(self) -> QSize:
        """Low and wide."""
        return QSize(600, 128)

    # What the document says

    @property
    def _take(self) -> Take | None:
        """The take as it stands."""
        return None if self.document.session is None else self.document.session.take

    def _opened(self) -> None:
        """Arrange the markers of another take."""
        take = self._take
        self._rows = None if take is None else arrange(take.markers, self.document.mesh)
        self._column_of = {} if take is None else {m: i for i, m in enumerate(take.labels)}
        self._missing = np.zeros((0, 0))
        self._view = (0.0, 0.0 if take is None else float(take.frames))
        self.setCursor(
            Qt.CursorShape.ArrowCursor if take is None else Qt.CursorShape.PointingHandCursor
        )
        self._reread()

    def _reread(self) -> None:
        """Take over the artifacts."""
        session, rows = self.document.session, self._rows
        if session is None or rows is None:
            self._artifacts = ()
        else:
            self._artifacts = session.artifacts
            self._place = np.array(
                [
                    (a.start, a.stop, rows.row_of[self._column_of[a.marker]])
                    for a in self._artifacts
                ],
                dtype=np.int64,
            ).reshape(-1, 3)
        self._repaint()

    def _refresh(self, change: Change) -> None:
        """Look for missing samples again where samples changed."""
        take = self._take
        if take is not None and self._missing.size:
            columns = [take.index(name) for name in change.markers]
            width = self._missing.shape[1]
            self._missing[columns] = missing_share(take.origin[:, columns], width)
        self._repaint()

    def _move_cursor(self, frame: int) -> None:
        """Draw the cursor elsewhere."""
        self.update()

    def _repaint(self) -> None:
        """Paint the picture anew when it is next needed."""
        self._image = None
        self.update()

    # Places on screen

    def _area(self) -> QRectF:
        """Where the picture stands."""
        return QRectF(
            _LEFT,
            _TOP,
            max(1, self.width() - _LEFT - _RIGHT),
            max(1, self.height() - _TOP - _BOTTOM),
        )

    def _x(self, frame: float) -> float:
        """Pixel at which a frame begins."""
        take, area = self._take, self._area()
        frames = 1 if take is None else max(1, take.frames)
        return area.left() + frame * area.width() / frames

    def _frame_at(self, x: float) -> int:
        """Frame under a pixel."""
        take, area = self._take, self._area()
        frames = 1 if take is None else take.frames
        return int(np.clip((x - area.left()) * frames / area.width(), 0, max(0, frames - 1)))

    def _marker_at(self, y: float) -> str | None:
        """Marker under a pixel."""
        take, rows, area = self._take, self._rows, self._area()
        if take is None or rows is None or not rows.columns:
            return None
        row = int((y - area.top()) * len(rows.columns) / area.height())
        if not 0 <= row < len(rows.columns):
            return None
        return take.labels[rows.columns[row]]

    def artifact_at(self, at: QPointF) -> Artifact | None:
        """The artifact under a point, or the nearest within a few pixels."""
        if self._rows is None or not len(self._place):
            return None
        area = self._area()
        height = area.height() / len(self._rows.columns)
        low, high = self._x(0), self._x(1)
        left = low + self._place[:, 0] * (high - low)
        right = low + self._place[:, 1] * (high - low)
        top = area.top() + self._place[:, 2] * height
        dx = np.maximum(0, np.maximum(left - at.x(), at.x() - right))
        dy = np.maximum(0, np.maximum(top - at.y(), at.y() - top - height))
        away = np.hypot(dx, dy)
        nearest = int(np.argmin(away))
        return self._artifacts[nearest] if away[nearest] <= _REACH_PX else None

    # What the mouse says

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Go to what was clicked: an artifact, else a marker and a frame."""
        if event.button() != Qt.MouseButton.LeftButton or self._take is None:
            super().mousePressEvent(event)
            return
        at = event.position()
        artifact = self.artifact_at(at)
        if artifact is not None:
            self.document.select(artifact.id)
            return
        marker = self._marker_at(at.y())
        if marker is not None and marker not in self.document.shown:
            self.document.show((marker,))
        self.document.go_to(self._frame_at(at.x()))

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        """Scrub."""
        if event.buttons() & Qt.MouseButton.LeftButton and self._take is not None:
            self.document.go_to(self._frame_at(event.position().x()))

    def event(self, event: QEvent) -> bool:
        """Say what lies under the mouse."""
        if isinstance(event, QHelpEvent) and event.type() == QEvent.Type.ToolTip:
            QToolTip.showText(event.globalPos(), self.describe(event.pos()), self)
            return True
        return super().event(event)

    def describe(self, at: QPoint) -> str:
        """Name the artifact under a point, else marker and frame."""
        take = self._take
        if take is None:
            return ""
        artifact = self.artifact_at(QPointF(at))
        if artifact is not None:
            return describe(take, artifact)
        marker, frame = self._marker_at(at.y()), self._frame_at(at.x())
        text = self.tr("Frame {frame} · {time:.2f} s").format(
            frame=take.frame_number(frame), time=frame / take.rate
        )
        return text if marker is None else f"{marker} · {text}"

    # Painting

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Draw at the new size."""
        self._missing = np.zeros((0, 0))
        self._repaint()

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint picture, names, view and cursor."""
        look = theme.current()
        painter = QPainter(self)
        painter.fillRect(self.rect(), look.window)
        take, rows, area = self._take, self._rows, self._area()
        font = QFont(self.font())
        font.setPointSize(theme.SMALL_PT - 1)
        painter.setFont(font)
        painter.setPen(look.muted)
        if take is None or rows is None or take.frames == 0 or take.markers == 0:
            painter.drawText(
                self.rect(),
                Qt.AlignmentFlag.AlignCenter,
                self.tr("The whole take appears here once one is open."),
            )
            return
        painter.drawImage(area, self._picture(take, rows))
        self._paint_groups(painter, rows, area)
        self._paint_time(painter, take, area)
        self._paint_marks(painter, rows, area)

    def _picture(self, take: Take, rows: Rows) -> QImage:
        """The picture at the screen's own resolution, painted when it is out of date."""
        if self._image is None:
            area, ratio = self._area(), self.devicePixelRatioF()
            size = max(1, round(area.width() * ratio)), max(1, round(area.height() * ratio))
            if self._missing.shape != (take.markers, size[0]):
                self._missing = missing_share(take.origin, size[0])
            self._image = draw(
                size, rows, self._missing, self._artifacts, self._column_of, take.frames
            )
        return self._image

    def _paint_groups(self, painter: QPainter, rows: Rows, area: QRectF) -> None:
        """Names of the groups, where there is room, and which markers are shown."""
        look = theme.current()
        metrics = QFontMetrics(painter.font())
        height = area.height() / len(rows.columns)
        free_from = 0.0
        for name, first, last in rows.groups:
            middle = area.top() + (first + last) / 2 * height
            top = middle - metrics.height() / 2
            if top >= free_from:
                text = metrics.elidedText(name, Qt.TextElideMode.ElideRight, _LEFT - 16)
                box = QRectF(4, top, _LEFT - 14, metrics.height())
                painter.setPen(look.muted)
                painter.drawText(
                    box, Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter, text
                )
                free_from = top + metrics.height()
        edges = row_edges(len(rows.columns), round(area.height()))
        for name in self.document.shown:
            top, bottom = edges[rows.row_of[self._column_of[name]]]
            tick = QRectF(area.left() - 6, area.top() + top, 4, max(2, bottom - top))
            painter.fillRect(tick, look.accent)

    def _paint_time(self, painter: QPainter, take: Take, area: QRectF) -> None:
        """Seconds below."""
        look, metrics = theme.current(), QFontMetrics(painter.font())
        step = _round_step(take.frames / take.rate / max(1.0, area.width() / _TICK_PX))
        for i in range(int(take.frames / take.rate / step) + 1):
            x = self._x(i * step * take.rate)
            painter.setPen(look.border)
            painter.drawLine(QPointF(x, area.bottom()), QPointF(x, area.bottom() + 3))
            painter.setPen(look.muted)
            width = min(_TICK_PX, 2.0 * (self.width() - x))
            box = QRectF(x - width / 2, area.bottom() + 2, width, _BOTTOM - 2)
            if width > metrics.horizontalAdvance(text := f"{i * step:g} s"):
                painter.drawText(box, Qt.AlignmentFlag.AlignCenter, text)

    def _paint_marks(self, painter: QPainter, rows: Rows, area: QRectF) -> None:
        """The current artifact, the part in view, and the cursor."""
        look, current = theme.current(), self.document.current
        painter.setBrush(Qt.BrushStyle.NoBrush)
        painter.setPen(QPen(look.border, 1))
        painter.drawRect(area.adjusted(-0.5, -0.5, 0.5, 0.5))
        left = max(area.left(), self._x(self._view[0] + 0.5))
        right = min(area.right(), self._x(self._view[1] + 0.5))
        if right - left < area.width() - 1:
            veil = theme.faded(look.window, 0.35)
            painter.fillRect(
                QRectF(area.left(), area.top(), left - area.left(), area.height()), veil
            )
            painter.fillRect(QRectF(right, area.top(), area.right() - right, area.height()), veil)
            painter.setPen(QPen(look.accent, 1.5))
            painter.drawRect(QRectF(left, area.top(), max(2.0, right - left), area.height()))
        if current is not None:
            top, bottom = row_edges(len(rows.columns), round(area.height()))[
                rows.row_of[self._column_of[current.marker]]
            ]
            x0, x1 = self._x(current.start), self._x(current.stop)
            box = QRectF(x0, area.top() + top, max(3.0, x1 - x0), max(3, bottom - top))
            painter.setPen(QPen(look.text, 1))
            painter.drawRect(box.adjusted(-1.5, -1.5, 1.5, 1.5))
        x = self._x(self.document.frame + 0.5)
        painter.setPen(QPen(look.text, 1))
        painter.drawLine(QPointF(x, area.top() - 2), QPointF(x, area.bottom() + 2))


def _round_step(seconds: float) -> float:
    """The next larger of 1, 2, 5 times a power of ten."""
    power = 10.0 ** np.floor(np.log10(max(seconds, 1e-6)))
    return float(next(m * power for m in (1, 2, 5, 10) if m * power >= seconds * 0.999))
