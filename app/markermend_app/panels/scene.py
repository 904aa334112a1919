"""The take in space: markers, body and trails, painted without a graphics card."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace

import numpy as np
from PySide6.QtCore import QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QContextMenuEvent, QMouseEvent, QPainter, QPaintEvent, QWheelEvent
from PySide6.QtWidgets import QHBoxLayout, QMenu, QToolButton, QVBoxLayout, QWidget

from markermend.arrays import FloatArray, IntArray
from markermend.artifact import Kind, Status, axis_columns
from markermend.take import is_unlabelled
from markermend_app import theme
from markermend_app.document import Document
from markermend_app.panels import scene_paint as paint
from markermend_app.panels.naming import short_names
from markermend_app.panels.scene_camera import Camera
from markermend_app.panels.scene_stage import Stage, centre_at, set_stage

PICK_PX = 14.0
TRAIL_S = 0.5
SCRUB_S_PER_PX = 0.02
RADIUS_MM = 13.0
MANY_LABELS = 40
BODY = 0.56
"""Radius of the view of a body that is followed, as a share of the body's size."""


class Scene(QWidget):
    """Markers of the current frame in perspective.

    Left drag turns, middle, right or Shift drag moves, the wheel zooms, Ctrl drag runs through
    time. A click shows the nearest marker in the plots, with Ctrl beside the others, unless
    ``pick`` takes it for something else; a double click beside the markers shows everything.
    """

    def __init__(self, document: Document, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._document = document
        self.camera = Camera()
        self.pick: Callable[[str], bool] = lambda marker: False
        self.stage: Stage | None = None
        self._vertical: int | None = None
        self._links: IntArray = np.zeros((0, 2), dtype=np.int64)
        self._radius: FloatArray = np.zeros(0)
        self._names: Mapping[str, str] = {}
        self._open: list[tuple[int, int, int, Kind]] = []
        self._starts, self._stops = np.zeros(0, np.int64), np.zeros(0, np.int64)
        self._followed: FloatArray | None = None
        self._at: FloatArray = np.zeros((0, 2))
        self._pressed: QPointF | None = None
        self._last = QPointF()
        self._dragged = False
        self._scrub_from = 0
        self.setMinimumSize(200, 160)
        self.setFocusPolicy(Qt.FocusPolicy.ClickFocus)
        self.setAccessibleName(self.tr("3D view"))
        self._make_buttons()

        document.opened.connect(self._opened)
        document.mesh_changed.connect(self._link)
        document.artifacts_changed.connect(self._take_artifacts)
        document.frame_changed.connect(self._frame_changed)
        for signal in (
            document.data_changed,
            document.current_changed,
            document.proposal_changed,
            document.shown_changed,
        ):
            signal.connect(self._redraw)
        theme.watcher.changed.connect(self._recolour)
        self._recolour()
        self._opened()

    def sizeHint(self) -> QSize:
        """Room for a body."""
        return QSize(400, 360)

    def _make_buttons(self) -> None:
        """The column of buttons in the upper right corner."""
        self.fit = self._button(self.tr("Show everything (double click)"), self.reset, False)
        self.follow = self._button(self.tr("Keep the body in the middle"), self._follow_toggled)
        self.follow.setChecked(True)
        self.trails = self._button(self.tr("Trails of all markers"), self.update)
        self.labels = self._button(self.tr("Names of all markers"), self.update)
        column = QVBoxLayout()
        column.setSpacing(0)
        for button in (self.fit, self.follow, self.trails, self.labels):
            column.addWidget(button)
        column.addStretch(1)
        row = QHBoxLayout(self)
        row.setContentsMargins(4, 4, 4, 4)
        row.addStretch(1)
        row.addLayout(column)

    def _button(self, tip: str, do: Callable[[], object], checkable: bool = True) -> QToolButton:
        button = QToolButton(self)
        button.setToolTip(tip)
        button.setAccessibleName(tip)
        button.setCheckable(checkable)
        button.setCursor(Qt.CursorShape.ArrowCursor)
        button.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        button.clicked.connect(lambda _=False: do())
        return button

    # What is seen

    def reset(self) -> None:
        """Bring the whole take, or the followed body, into view."""
        if self.stage is not None:
            self.camera = self.stage.camera(self.camera)
            if self.follow.isChecked():
                self.camera = self.camera.zoomed(BODY * self.stage.size / self.stage.radius)
                self._followed = None
                self._keep_up()
        self.update()

    def set_vertical(self, axis: int | None) -> None:
        """Say which axis points up (0, 1, 2), or None to guess it from the take."""
        self._vertical = axis
        session = self._document.session
        if session is not None:
            self.stage = set_stage(session.original, axis)
            self.reset()

    def _opened(self) -> None:
        """Another take, or none."""
        session = self._document.session
        self.stage, self._followed, self._vertical = None, None, None
        for button in (self.fit, self.follow, self.trails, self.labels):
            button.setVisible(session is not None)
        if session is not None:
            take = session.original
            self.stage = set_stage(take)
            self.camera = Camera()
            self._link()
            small = np.array([is_unlabelled(label) for label in take.labels], dtype=bool)
            body = min(RADIUS_MM, 0.008 * self.stage.size)
            self._names = short_names(take.labels)
            self._radius = np.where(small, 0.5 * body, body)
            self.reset()
        self._take_artifacts()

    def _link(self) -> None:
        """Join the markers that move together."""
        mesh = self._document.mesh
        links = () if mesh is None else mesh.links
        self._links = np.array(links, dtype=np.int64).reshape(-1, 2)
        self.update()

    def _take_artifacts(self) -> None:
        """Remember which frames of which markers are flagged and undecided."""
        session = self._document.session
        found = () if session is None else session.with_status(Status.PENDING)
        self._open = [
            (a.start, a.stop, session.original.index(a.marker), a.kind)
            for a in found
            if session is not None
        ]
        self._starts = np.array([a[0] for a in self._open], dtype=np.int64)
        self._stops = np.array([a[1] for a in self._open], dtype=np.int64)
        self.update()

    def rings(self) -> dict[int, Kind]:
        """Class of the open artifact each marker's column is in, at the current frame."""
        frame = self._document.frame
        hit = np.flatnonzero((self._starts <= frame) & (frame < self._stops))
        return {self._open[i][2]: self._open[i][3] for i in hit.tolist()}

    def ghost(self) -> tuple[str, FloatArray, int] | None:
        """Marker, (frames, 3) way of the previewed repair and the first frame of that way."""
        artifact, proposal, session = (
            self._document.current,
            self._document.proposal,
            self._document.session,
        )
        if artifact is None or session is None or proposal is None:
            return None
        patch = next((p for p in proposal.patches if p.marker == artifact.marker), None)
        if patch is None:
            return None
        column = session.original.index(patch.marker)
        way = session.positions[patch.start : patch.stop, column].copy()
        way[:, axis_columns(patch.axes)] = patch.values
        return patch.marker, way, patch.start

    def paintEvent(self, _: QPaintEvent) -> None:
        """Paint the frame."""
        t = theme.current()
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.fillRect(self.rect(), t.plot)
        session = self._document.session
        if session is None or self.stage is None:
            painter.setPen(t.muted)
            text = self.tr("Open a take to see it in space.")
            painter.drawText(QRectF(self.rect()), Qt.AlignmentFlag.AlignCenter, text)
            return
        sight = paint.Sight(painter, self.camera, self.width(), self.height())
        frame, take = self._document.frame, session.original
        positions = session.positions
        now = positions[frame]
        shown = {take.index(s): i for i, s in enumerate(self._document.shown) if s in take}
        paint.paint_floor(sight, self.stage)
        self._paint_trails(sight, positions, shown)
        paint.paint_links(sight, now, self._links, theme.blend(t.plot, t.muted, 0.6), 1.6)
        plain = theme.blend(t.plot, t.text, 0.62)
        discs = paint.Discs(now, self._radius, shown, self.rings(), plain)
        self._at = paint.paint_discs(sight, discs)
        spots = self._paint_ghost(sight, now)
        followed = [take.index(s) for s in self._document.preview.references]
        paint.paint_followed(sight, spots[followed])
        named = list(dict.fromkeys([*list(shown)[:MANY_LABELS], *followed]))
        if self.labels.isChecked():
            named += [i for i in range(take.markers) if i not in named]
        names = [(i, self._names[take.labels[i]]) for i in named]
        paint.paint_labels(sight, spots, names)
        paint.paint_triad(sight)
        unit = self.stage.unit
        text = f"{unit / 1000:g} m" if unit >= 100 else f"{unit:g} mm"
        paint.paint_note(sight, self.tr("One square: {0}").format(text))

    def _paint_trails(
        self, sight: paint.Sight, positions: FloatArray, shown: dict[int, int]
    ) -> None:
        """Paint where markers come from and go to."""
        session = self._document.session
        if session is None:
            return
        reach = max(2, round(TRAIL_S * session.original.rate))
        frame = self._document.frame
        near = positions[max(0, frame - reach) : frame + reach + 1]
        if self.trails.isChecked():
            color = theme.faded(theme.current().muted, 0.5)
            paint.paint_trails(sight, near.transpose(1, 0, 2), color, 1.0)
        for column, place in shown.items():
            color = theme.faded(theme.marker_color(place), 0.7)
            paint.paint_trails(sight, near[None, :, column], color, 1.6)

    def _paint_ghost(self, sight: paint.Sight, now: FloatArray) -> FloatArray:
        """Paint the way of the previewed repair, and its place in this frame.

        Returns (markers, 2) pixels where names stand: a missing marker's at its proposed place.
        """
        ghost, session = self.ghost(), self._document.session
        if ghost is None or session is None:
            return self._at
        marker, way, start = ghost
        color = theme.current().accent
        paint.paint_trails(sight, way[None], color, 1.6, Qt.PenStyle.DashLine)
        at = self._document.frame - start
        spots = self._at.copy()
        if 0 <= at < len(way):
            column = session.original.index(marker)
            spot = paint.paint_ghost(sight, way[at], now[column])
            if np.isnan(spots[column, 0]):
                spots[column] = spot
        return spots

    # Hands

    def marker_at(self, at: QPointF) -> str | None:
        """Marker nearest to a point of the view, or None when none is near."""
        session = self._document.session
        if session is None or not len(self._at):
            return None
        away = np.hypot(self._at[:, 0] - at.x(), self._at[:, 1] - at.y())
        if np.isnan(away).all() or np.nanmin(away) > PICK_PX:
            return None
        return session.original.labels[int(np.nanargmin(away))]

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Begin a click or a drag."""
        self._pressed = self._last = event.position()
        self._dragged = False
        self._scrub_from = self._document.frame

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        """Turn, move, or run through time."""
        session = self._document.session
        if self._pressed is None or session is None:
            return
        whole = event.position() - self._pressed
        if not self._dragged and whole.manhattanLength() < 4:
            return
        self._dragged = True
        step = event.position() - self._last
        self._last = event.position()
        held, buttons = event.modifiers(), event.buttons()
        if held & Qt.KeyboardModifier.ControlModifier:
            frames = whole.x() * SCRUB_S_PER_PX * session.original.rate
            self._document.go_to(self._scrub_from + round(frames))
        elif buttons & Qt.MouseButton.LeftButton and not held & Qt.KeyboardModifier.ShiftModifier:
            self.camera = self.camera.orbited(step.x(), step.y())
        else:
            self.camera = self.camera.panned(step.x(), step.y(), self.height())
        self.update()

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        """Show the marker that was clicked."""
        clicked = self._pressed is not None and not self._dragged
        self._pressed = None
        if not clicked or event.button() != Qt.MouseButton.LeftButton:
            return
        marker = self.marker_at(event.position())
        if marker is None or self.pick(marker):
            return
        shown = self._document.shown
        if not event.modifiers() & Qt.KeyboardModifier.ControlModifier:
            self._document.show([marker])
        elif marker in shown:
            self._document.show([s for s in shown if s != marker])
        else:
            self._document.show([*shown, marker])

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        """Show everything when nothing was hit."""
        if event.button() == Qt.MouseButton.LeftButton and self.marker_at(event.position()) is None:
            self.reset()

    def wheelEvent(self, event: QWheelEvent) -> None:
        """Zoom."""
        self.camera = self.camera.zoomed(0.999 ** event.angleDelta().y())
        self.update()
        event.accept()

    def contextMenuEvent(self, event: QContextMenuEvent) -> None:
        """Offer the vertical axis, unless the right button was used to move."""
        if self._dragged or self.stage is None:
            return
        menu = QMenu(self)
        menu.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        menu.addSection(self.tr("Axis that points up"))
        for text, axis in (
            (self.tr("As the take suggests"), None),
            ("X", 0),
            ("Y", 1),
            ("Z", 2),
        ):
            action = menu.addAction(text)
            action.setCheckable(True)
            action.setChecked(self._vertical == axis)
            action.triggered.connect(lambda _=False, axis=axis: self.set_vertical(axis))
        menu.popup(event.globalPos())

    # Following the document

    def _frame_changed(self, _: int) -> None:
        self._keep_up()
        self.update()

    def _follow_toggled(self) -> None:
        """Begin to follow, nearer, or see the whole take again."""
        self._followed = None
        self.reset()

    def _keep_up(self) -> None:
        """Move the camera with the body."""
        session, stage = self._document.session, self.stage
        if not self.follow.isChecked() or session is None or stage is None:
            return
        centre = centre_at(session.positions, self._document.frame)
        if np.isnan(centre).any():
            return
        if self._followed is None:
            x, y, z = centre.tolist()
            self.camera = replace(self.camera, target=(x, y, z))
        else:
            self.camera = self.camera.moved(centre - self._followed)
        self._followed = centre

    def _redraw(self, *_: object) -> None:
        self.update()

    def _recolour(self) -> None:
        for button, name in (
            (self.fit, "frame"),
            (self.follow, "body"),
            (self.trails, "trail"),
            (self.labels, "labels"),
        ):
            button.setIcon(theme.icon(name))
        self.update()
