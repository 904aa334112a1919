"""The whole take at a glance: every marker over time, as damage, gaps or residuals."""

from __future__ import annotations

import numpy as np
from PySide6.QtCore import QEvent, QPoint, QPointF, QRectF, QSize, Qt, Signal
from PySide6.QtGui import (
    QFont,
    QHelpEvent,
    QImage,
    QKeyEvent,
    QMouseEvent,
    QPainter,
    QPaintEvent,
    QResizeEvent,
    QWheelEvent,
)
from PySide6.QtWidgets import QToolTip, QWidget

from markermend.artifact import Artifact
from markermend.review.edits import Change
from markermend.take import Take
from markermend_app import units
from markermend_app.background.jobs import Lane
from markermend_app.document import Document
from markermend_app.items.focus import paint_focus
from markermend_app.later import Later
from markermend_app.panels.inspector.artifact_text import describe
from markermend_app.panels.overview import marks
from markermend_app.panels.overview.artifacts import ArtifactRows
from markermend_app.panels.overview.keys import row_by_key, span_by_key
from markermend_app.panels.overview.levels import Levels
from markermend_app.panels.overview.mode import ModeButton
from markermend_app.panels.overview.picture import (
    MOST_MM,
    Rows,
    arrange,
    heat,
    paint_artifacts,
    paint_levels,
)
from markermend_app.panels.overview.places import Places
from markermend_app.panels.overview.region_edges import RegionEdges
from markermend_app.panels.plots.range import time_range
from markermend_app.style import theme

# Aligned with the plots above: their values stand left, their margin right.
_LEFT, _RIGHT, _TOP, _BOTTOM = 80, 12, 4, 18
_STEP = 1.25


class Overview(QWidget):
    """A strip of markers over time; click to go there, drag to scrub.

    The wheel zooms time at the mouse, middle or right drag pans, a double click shows everything.
    With the keyboard here, ↑ and ↓ go from marker to marker, + and − zoom.

    Signals
    -------
    region_dragged(int, int) : the region of interest is to be these frames, half-open
    """

    region_dragged = Signal(int, int)

    def __init__(self, document: Document, first: Lane | None = None) -> None:
        super().__init__()
        self.document = document
        self._soon = Later(self._catch_up, self)
        self._view = (0.0, 0.0)
        self._span = (0.0, 1.0)
        self.levels = Levels(document, first, self)
        self.levels.changed.connect(self._repaint)
        self._edges = RegionEdges(document)
        self._held: tuple[float, tuple[float, float]] | None = None
        self._rows: Rows | None = None
        self._artifacts: tuple[Artifact, ...] = ()
        self._image: QImage | None = None
        self._column_of: dict[str, int] = {}
        self._lying = ArtifactRows()
        self.setAccessibleName(self.tr("Overview of the whole take"))
        self.setMinimumHeight(72)
        self.setMouseTracking(True)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.mode = ModeButton(self)
        self.mode.chosen.connect(self._repaint)
        document.opened.connect(self._opened)
        document.artifacts_changed.connect(self._reread)
        document.data_changed.connect(self._refresh)
        document.current_changed.connect(self._soon.ask)
        document.shown_changed.connect(self._soon.ask)
        document.mesh_changed.connect(self._arrange)
        document.frame_changed.connect(self._soon.ask)
        theme.watcher.changed.connect(self._repaint)
        self._opened()

    def set_span(self, start: float, stop: float) -> None:
        """Show these frames, as far as the take reaches."""
        take = self._take
        if take is None:
            return
        low, high = time_range(start, stop, take.frames)
        span = min(high - low, float(take.frames))
        low = float(np.clip(low, 0.0, take.frames - span))
        if (low, low + span) != self._span:
            self._span = (low, low + span)
            self._repaint()

    def set_view(self, start: float, stop: float) -> None:
        """Frame the part of time that the plots show; what is zoomed in follows it."""
        self._view = (start, stop)
        low, high = self._span
        if stop < low or start > high:
            middle = (start + stop - (high - low)) / 2
            self.set_span(middle, middle + high - low)
        self._soon.ask()

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
        self._column_of = {} if take is None else {m: i for i, m in enumerate(take.labels)}
        if not self.document.renaming:
            self._span = (0.0, 1.0 if take is None else max(1.0, float(take.frames)))
            self._view = self._span
        self.levels.forget()
        self.mode.setVisible(take is not None and take.markers > 0)
        self._show_pointer(edge=False)
        self._arrange()

    def _arrange(self) -> None:
        """Put the markers of one body part beside one another."""
        take = self._take
        self._rows = None if take is None else arrange(take.markers, self.document.mesh)
        self._reread()

    def _reread(self) -> None:
        """Take over the artifacts."""
        session = self.document.session
        self._artifacts = () if session is None or self._rows is None else session.artifacts
        self._lying = ArtifactRows(self._artifacts, self._row_of)
        self._repaint()

    def _refresh(self, change: Change) -> None:
        """Paint changed samples anew."""
        self.levels.note(change, (self._column_of[m] for m in change.markers))
        self._repaint()

    def _catch_up(self) -> None:
        """Paint, with what changed."""
        if self.levels.catch_up():
            # It may have been painted meanwhile, as it was.
            self._image = None
        self.update()

    def _repaint(self, *_: object) -> None:
        """Paint the picture anew when it is next needed."""
        self._image = None
        self._soon.ask()

    # Places on screen

    @property
    def _places(self) -> Places:
        """What lies where."""
        width = max(1, self.width() - _LEFT - _RIGHT)
        height = max(1, self.height() - _TOP - _BOTTOM)
        rows = 0 if self._rows is None else len(self._rows.columns)
        return Places(QRectF(_LEFT, _TOP, width, height), self._span, rows)

    @property
    def _columns(self) -> int:
        """How many of the screen's pixels the picture is wide."""
        return max(1, round(self._places.area.width() * self.devicePixelRatioF()))

    def _frame_at(self, x: float) -> int:
        """Frame under a pixel, within the take."""
        take, frame = self._take, np.floor(self._places.frame(x))
        return int(np.clip(frame, 0, 0 if take is None else max(0, take.frames - 1)))

    def _marker_at(self, y: float) -> str | None:
        """Marker under a pixel."""
        take, rows, row = self._take, self._rows, self._places.row(y)
        if take is None or rows is None or row is None:
            return None
        return take.labels[rows.columns[row]]

    def _row_of(self, marker: str) -> int:
        """Row of a marker."""
        assert self._rows is not None
        return self._rows.row_of[self._column_of[marker]]

    def artifact_at(self, at: QPointF) -> Artifact | None:
        """The artifact under a point, or the nearest within a few pixels."""
        return self._lying.at(at, self._places)

    # What the mouse says

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Go to what was clicked: an artifact, else a marker and a frame."""
        if event.button() != Qt.MouseButton.LeftButton and self._take is not None:
            self._held = (event.position().x(), self._span)
            return
        if self._take is None:
            super().mousePressEvent(event)
            return
        if not self._edges.take(self._places, event.position()):
            self._click(event.position())

    def _click(self, at: QPointF) -> None:
        """Go to what lies under the mouse."""
        artifact = self.artifact_at(at)
        if artifact is not None:
            self.document.select(artifact.id)
            frame = self._frame_at(at.x())
            self.document.go_to(min(max(frame, artifact.start), artifact.stop - 1))
            return
        marker = self._marker_at(at.y())
        if marker is not None and marker not in self.document.shown:
            self.document.show((marker,))
        self.document.go_to(self._frame_at(at.x()))

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        """Scrub or drag an edge of the region with the left button, pan with another one."""
        x = event.position().x()
        if self._edges.held:
            self._edges.drag(self._places, x)
            self._soon.ask()
        elif not event.buttons():
            self._show_pointer(self._edges.near(self._places, event.position()) is not None)
        elif event.buttons() & Qt.MouseButton.LeftButton and self._take is not None:
            self.document.go_to(self._frame_at(event.position().x()))
        elif self._held is not None:
            x, (low, high) = self._held
            by = (x - event.position().x()) * (high - low) / self._places.area.width()
            self.set_span(low + by, high + by)

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        """End a pan, or put an edge of the region where it was dragged."""
        self._held = None
        if self._edges.held and event.button() == Qt.MouseButton.LeftButton:
            region = self._edges.drop()
            if region is None:
                self._click(event.position())
            else:
                self.region_dragged.emit(*region)
        super().mouseReleaseEvent(event)

    def let_go(self) -> bool:
        """Leave the edge that is dragged where it was; whether one was."""
        held = self._edges.held
        self._edges.forget()
        self._soon.ask()
        return held

    def _show_pointer(self, edge: bool) -> None:
        """Show by the mouse's look whether an edge can be dragged, or something clicked."""
        shape = Qt.CursorShape.PointingHandCursor
        if self._take is None:
            shape = Qt.CursorShape.ArrowCursor
        elif edge:
            shape = Qt.CursorShape.SplitHCursor
        if self.cursor().shape() != shape:
            self.setCursor(shape)

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        """Show the whole take."""
        if self._take is not None and event.button() == Qt.MouseButton.LeftButton:
            self.set_span(0.0, float(self._take.frames))

    def wheelEvent(self, event: QWheelEvent) -> None:
        """Zoom time at the mouse; a sideways wheel moves through it."""
        low, high = self._span
        notches = event.angleDelta().y() / 120.0
        at = min(max(self._places.frame(event.position().x()), low), high)
        factor = _STEP**-notches
        by = -event.angleDelta().x() / 120.0 * 0.1 * (high - low)
        self.set_span(at - (at - low) * factor + by, at + (high - at) * factor + by)
        event.accept()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Walk from marker to marker with ↑ and ↓; + and − zoom time at the cursor."""
        take, columns = self._take, () if self._rows is None else self._rows.columns
        shown = [self._column_of[m] for m in self.document.shown[:1]]
        row = row_by_key(event.key(), columns.index(shown[0]) if shown else None, len(columns))
        span = span_by_key(event.key(), self._span, self.document.frame + 0.5)
        if row is not None and take is not None:
            self.document.show((take.labels[columns[row]],))
        elif span is not None:
            self.set_span(*span)
        else:
            super().keyPressEvent(event)

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
        residuals = self.levels.residuals.values
        if self.mode.mode == "residual" and marker is not None and residuals is not None:
            off = residuals[take.index(marker), frame]
            if np.isfinite(off):
                text += " · " + self.tr("{0} off its body").format(units.length(off))
        return text if marker is None else f"{marker} · {text}"

    # Painting

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Draw at the new size."""
        self.mode.setGeometry(2, self.height() - _BOTTOM, _LEFT - 10, _BOTTOM)
        self._repaint()

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint picture, names, view and cursor."""
        look = theme.current()
        painter = QPainter(self)
        painter.fillRect(self.rect(), look.window)
        paint_focus(painter, self)
        take, rows, places = self._take, self._rows, self._places
        area = places.area
        font = QFont(self.font())
        font.setPointSize(theme.SMALL_PT - 1)
        painter.setFont(font)
        painter.setPen(look.muted)
        if take is None or rows is None or take.frames == 0 or take.markers == 0:
            text = self.tr("The whole take appears here once one is open.")
            if take is not None:
                text = self.tr("There are no markers to be seen here.")
            painter.drawText(self.rect(), Qt.AlignmentFlag.AlignCenter, text)
            return
        painter.drawImage(area, self._picture(rows))
        marks.paint_groups(painter, rows, area)
        room = 0.0
        if self.mode.mode == "residual":
            room = marks.paint_scale(
                painter, area, heat(self.mode.mode), "0", units.length(MOST_MM, 0)
            )
        marks.paint_time(painter, area, self._span, take.rate, room)
        painter.setClipRect(area.adjusted(-8, -4, 2, 4))
        self._paint_marks(painter, places)
        share = self.levels.residuals.share
        if self.mode.mode == "residual" and share is not None:
            marks.paint_words(
                painter, area, self.tr("Working out residuals… {0:.0%}").format(share)
            )

    def _picture(self, rows: Rows) -> QImage:
        """The picture at the screen's own resolution, painted when it is out of date."""
        if self._image is None:
            size = (
                self._columns,
                max(1, round(self._places.area.height() * self.devicePixelRatioF())),
            )
            mode = self.mode.mode
            levels = self.levels.of(mode, size[0], self._span)
            self._image = paint_levels(size, rows, levels, heat(mode))
            if mode == "damage":
                paint_artifacts(self._image, rows, self._artifacts, self._column_of, self._span)
        return self._image

    def _paint_marks(self, painter: QPainter, places: Places) -> None:
        """Which markers are shown, the part in view, the current artifact, and the cursor."""
        marks.paint_shown(painter, places, [self._row_of(m) for m in self.document.shown])
        marks.paint_view(painter, places, *self._view)
        if self._edges.region is not None:
            marks.paint_region(painter, places, *self._edges.region)
        current = self.document.current
        if current is not None:
            for marker in current.markers:
                box = places.box(self._row_of(marker), current.start, current.stop)
                marks.paint_current(painter, box)
        marks.paint_cursor(painter, places, self.document.frame)
