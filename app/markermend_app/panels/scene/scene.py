"""The take in space: markers, body and trails, painted without a graphics card."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

import numpy as np
from PySide6.QtCore import QEvent, QPoint, QPointF, QRectF, QSize, Qt
from PySide6.QtGui import (
    QContextMenuEvent,
    QKeyEvent,
    QMouseEvent,
    QPainter,
    QPaintEvent,
    QWheelEvent,
)
from PySide6.QtWidgets import QHBoxLayout, QMenu, QWidget

from markermend.arrays import FloatArray
from markermend_app import units
from markermend_app.document import Document
from markermend_app.items.focus import paint_focus
from markermend_app.later import Later
from markermend_app.panels.markers.marker_menu import add_marker_verbs, point_at
from markermend_app.panels.scene import paint
from markermend_app.panels.scene.buttons import SceneButtons
from markermend_app.panels.scene.camera import Camera, is_view_key
from markermend_app.panels.scene.follow import Follower
from markermend_app.panels.scene.looks import Looks, marker_colours
from markermend_app.panels.scene.seen import Seen
from markermend_app.panels.scene.select import Outline, nearest
from markermend_app.panels.scene.stage import Stage, set_stage
from markermend_app.panels.scene.versions import paint_other_version, paint_proposal
from markermend_app.panels.scene.views import add_views
from markermend_app.style import theme

PICK_PX = 14.0
SCRUB_S_PER_PX = 0.02
RADIUS_MM = 13.0
MANY_LABELS = 40


class Scene(QWidget):
    """Markers of the current frame in perspective.

    Left drag turns, middle, right or Shift drag moves, the wheel zooms, Ctrl drag runs through
    time. A click shows the nearest marker in the plots, with Ctrl beside the others, unless
    ``pick`` takes it for something else; a double click beside the markers shows everything. With
    the box or the lasso chosen, a left drag shows the markers inside, with Ctrl beside the others.
    The right button offers what can be done to a marker, by ``do``, and what can be seen.
    """

    def __init__(self, document: Document, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._document = document
        self.camera = Camera()
        self.pick: Callable[[str], bool] = lambda marker: False
        self.do: Callable[[str], None] = lambda action: None
        self.stage: Stage | None = None
        self._vertical: int | None = None
        self.looks = Looks()
        self.before = self._choosing = False
        self.seen = Seen(document)
        self._outline: Outline | None = None
        self.follower = Follower(document)
        self._at: FloatArray = np.zeros((0, 2))
        self._pressed: QPointF | None = None
        self._last = QPointF()
        self._dragged = False
        self._scrub_from = 0
        self.setMinimumWidth(200)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setAccessibleName(self.tr("3D view"))
        self._make_buttons()
        self._soon = Later(self.update, self)
        self._entering = Later(self._enter, self)
        self._afresh = True

        document.opened.connect(self._opened)
        document.mesh_changed.connect(self._link)
        document.artifacts_changed.connect(self._redraw)
        document.artifacts_changed.connect(self.follower.forget)
        document.data_changed.connect(self.follower.forget)
        document.frame_changed.connect(self._frame_changed)
        document.data_changed.connect(self._redraw)
        document.current_changed.connect(self._redraw)
        # What is proposed changes no damage, which takes long to count.
        document.proposal_changed.connect(self._soon.ask)
        document.proposals.ready.connect(self._soon.ask)
        document.shown_changed.connect(self._shown_changed)
        theme.watcher.changed.connect(self.update)
        self._opened()
        self._entering.catch_up()

    def sizeHint(self) -> QSize:
        """Room for a body."""
        return QSize(400, 360)

    def _make_buttons(self) -> None:
        """The column of buttons in the upper right corner."""
        self.buttons = SceneButtons(self)
        self.follow, self.trails = self.buttons.follow, self.buttons.trails
        self.labels, self.fit = self.buttons.labels, self.buttons.fit
        self.buttons.fit_wanted.connect(self.reset)
        self.buttons.follow_changed.connect(self.reset)
        self.buttons.changed.connect(self.update)
        self.buttons.menu.aboutToShow.connect(lambda: self._fill(self.buttons.menu, None))
        row = QHBoxLayout(self)
        row.setContentsMargins(4, 4, 4, 4)
        row.addStretch(1)
        row.addWidget(self.buttons, 0, Qt.AlignmentFlag.AlignTop)

    def _fill(self, menu: QMenu, marker: str | None) -> None:
        """Offer what can be done to a marker, and what can be seen."""
        menu.clear()
        if marker is not None:
            point_at(self._document, marker)
            add_marker_verbs(menu, self._document, self.do)
            menu.addSeparator()
        joints = self._document.joints
        views = partial(add_views, up=self.camera.up, look_from=self.look_from)
        looks, vertical = self.looks, self._vertical
        looks.fill(menu, vertical, self.set_vertical, self.update, views, joints=joints)

    # What is seen

    def reset(self) -> None:
        """Bring the whole take, or the followed body, into view."""
        if self.stage is not None:
            self.camera = self.stage.camera(self.camera)
            if self.follow.isChecked():
                camera = self.camera.zoomed(self.follower.reach() / self.stage.radius)
                self.camera = self.follower.aimed(camera)
        self.update()

    def look_from(self, axis: int, side: int) -> None:
        """Look along an axis of the take, from its positive side (1) or the other (-1)."""
        self.camera = self.camera.seen_from(axis, side)
        self.update()

    def set_before(self, before: bool) -> None:
        """Show the samples as they were in the file, or as they stand."""
        self.before = before
        self.update()

    def set_choosing(self, choosing: bool) -> None:
        """Say that clicks choose the markers which a repair follows, or no longer."""
        self._choosing = choosing
        self.update()

    def drop_tool(self) -> None:
        """Let a drag turn the view again; an outline under way is forgotten."""
        self.buttons.drop_tool()
        self._outline = None
        self.update()

    def set_vertical(self, axis: int | None) -> None:
        """Say which axis points up (0, 1, 2), or None to guess it from the take."""
        self._vertical = axis
        session = self._document.session
        # Of a take that was opened just now the room is worked out soon.
        if session is not None and self.stage is not None:
            self.stage = set_stage(session.original, axis)
            self.reset()

    def _opened(self) -> None:
        """Another take, none, or other names of the same markers."""
        session, renaming = self._document.session, self._document.renaming
        self.stage = None
        # Where markers of the take before were, nothing can be clicked.
        self._at = np.zeros((0, 2))
        if not renaming:
            self._vertical, self._afresh = None, True
            self.follower.start()
        self.buttons.setVisible(session is not None)
        self.buttons.say_joints(self._document.joints)
        self.drop_tool()
        self.seen.forget()
        self._entering.ask()
        if renaming:
            # The room that is in sight does not go for a moment.
            self._entering.catch_up()

    def _enter(self) -> None:
        """Work out the room of the take, and look at all of it unless it is known."""
        session = self._document.session
        if session is not None:
            take = session.original
            self.stage = set_stage(take, self._vertical)
            self.seen.take_over(take, min(RADIUS_MM, 0.008 * self.stage.size))
            if self._afresh:
                self.camera = Camera()
                self.reset()
        self._afresh = False
        self.update()

    def _link(self) -> None:
        """Join the markers that move together."""
        self.seen.link()
        self.update()

    def paintEvent(self, _: QPaintEvent) -> None:
        """Paint the frame."""
        t = theme.current()
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.fillRect(self.rect(), t.plot)
        session = self._document.session
        if session is None or self.stage is None or not session.original.frames:
            text = ""
            if session is None:
                text = self.tr("Open a take to see it in space.")
            elif not session.original.frames:
                text = self.tr("No frames")
            paint.paint_message(painter, QRectF(self.rect()), text)
            paint_focus(painter, self)
            return
        sight = paint.Sight(painter, self.camera, self.width(), self.height())
        frame, take = self._document.frame, session.original
        positions, others = session.positions, take.positions
        if self.before:
            positions, others = others, positions
        now = positions[frame]
        shown = {take.index(s): i for i, s in enumerate(self._document.shown) if s in take}
        paint.paint_floor(sight, self.stage)
        paint.paint_paths(sight, positions[self.seen.near()], shown, self.trails.isChecked())
        if self.looks.ghost:
            versions = positions, others
            paint_other_version(sight, self._document, self.seen, versions, shown)
        off = self.seen.off(now) & self.looks.lengths
        paint.paint_body(sight, now, self.seen.links, off)
        damage = self.seen.damage() if self.looks.colours == "damage" else np.zeros(0)
        colours = marker_colours(self.looks, take.markers, self._document.mesh, damage)
        rings, least = self.seen.rings(), self.looks.least
        discs = paint.Discs(now, self.seen.radius, shown, rings, colours, least)
        self._at = paint.paint_discs(sight, discs)
        spots = paint_proposal(sight, self._document, self.seen, now, self._at)
        followed = [take.index(s) for s in self._document.preview.references]
        paint.paint_followed(sight, spots[followed])
        named = list(dict.fromkeys([*list(shown)[:MANY_LABELS], *followed]))
        if self.labels.isChecked():
            named += [i for i in range(take.markers) if i not in named]
        names = [(i, self.seen.names[take.labels[i]]) for i in named]
        paint.paint_labels(sight, spots, names)
        paint.paint_triad(sight)
        square = f"{self.stage.unit * units.FACTORS[units.unit()]:g} {units.unit()}"
        paint.paint_note(sight, self.tr("One square: {0}").format(square))
        if self._choosing:
            text = self.tr("Click the markers to follow")
            text = self.tr("Click the joints to follow") if take.skeleton else text
            paint.paint_title(sight, text, t.accent)
        elif self.before:
            paint.paint_title(sight, self.tr("Before repair"), t.muted)
        if self._outline is not None:
            self._outline.paint(painter)
        paint_focus(painter, self)

    # Hands

    def marker_at(self, at: QPointF) -> str | None:
        """Marker nearest to a point of the view, or None when none is near."""
        session = self._document.session
        hit = nearest(self._at, at, PICK_PX)
        return None if session is None or hit is None else session.original.labels[hit]

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Begin a click or a drag."""
        self._pressed = self._last = event.position()
        self._dragged = False
        self._scrub_from = self._document.frame
        self.setFocus(Qt.FocusReason.MouseFocusReason)
        if self.buttons.tool and event.button() == Qt.MouseButton.LeftButton:
            self._outline = Outline(self.buttons.tool, [event.position()])

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
        if self._outline is not None:
            self._outline.points.append(event.position())
            self.update()
            return
        if held & Qt.KeyboardModifier.ControlModifier:
            frames = whole.x() * SCRUB_S_PER_PX * session.original.rate
            self._document.go_to(self._scrub_from + round(frames))
        elif buttons & Qt.MouseButton.LeftButton and not held & Qt.KeyboardModifier.ShiftModifier:
            self.camera = self.camera.orbited(step.x(), step.y())
        else:
            self.camera = self.camera.panned(step.x(), step.y(), self.height())
        self.update()

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        """Show the marker that was clicked, or those in the outline."""
        clicked = self._pressed is not None and not self._dragged
        outline, self._pressed, self._outline = self._outline, None, None
        if outline is not None and self._dragged:
            self._show_inside(outline, event.modifiers())
            return
        if clicked and event.button() == Qt.MouseButton.RightButton:
            self._offer(event.position(), event.globalPosition().toPoint())
        if not clicked or event.button() != Qt.MouseButton.LeftButton:
            return
        marker = self.marker_at(event.position())
        if marker is None or self.pick(marker):
            return
        beside = event.modifiers() & Qt.KeyboardModifier.ControlModifier
        shown = self._document.shown if beside else ()
        kept = [s for s in shown if s != marker]
        self._document.show(kept if marker in shown else [*shown, marker])

    def _show_inside(self, outline: Outline, held: Qt.KeyboardModifier) -> None:
        """Show the markers inside an outline, with Ctrl beside the others."""
        session = self._document.session
        self.update()
        if session is None:
            return
        labels = session.original.labels
        inside = [labels[i] for i in np.flatnonzero(outline.holds(self._at)).tolist()]
        before = self._document.shown if held & Qt.KeyboardModifier.ControlModifier else ()
        if inside:
            self._document.show((*before, *inside))

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
        """Offer what can be done by the menu key.

        The mouse's comes when the right button is let go: by some systems it comes with the press,
        before anyone can tell a click from a drag that moves.
        """
        if event.reason() != QContextMenuEvent.Reason.Mouse:
            self._offer(QPointF(event.pos()), event.globalPos())

    def _offer(self, at: QPointF, screen: QPoint) -> None:
        """Open the menu of what is there."""
        if self.stage is None:
            return
        menu = QMenu(self)
        menu.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self._fill(menu, self.marker_at(at))
        menu.popup(screen)

    def event(self, event: QEvent) -> bool:
        """Keep keys of the keypad that turn the view, which choose repair methods elsewhere."""
        if (
            isinstance(event, QKeyEvent)
            and event.type() == QEvent.Type.ShortcutOverride
            and is_view_key(event.key(), event.modifiers())
        ):
            event.accept()
        return super().event(event)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Turn, move and zoom."""
        moved = self.camera.by_key(Qt.Key(event.key()), event.modifiers(), self.height())
        if moved is not None:
            self.camera = moved
        else:
            super().keyPressEvent(event)
        self.update()

    # Following the document

    def _frame_changed(self, _: int) -> None:
        if self.follow.isChecked() and self.stage is not None:
            self.camera = self.follower.kept_up(self.camera)
        self._soon.ask()

    def _shown_changed(self) -> None:
        """Follow the subject of the foremost marker; the first one fills the view."""
        first = self.follower.everyone
        if self.follower.turn() and self.follow.isChecked():
            if first:
                self.reset()
            self.camera = self.follower.aimed(self.camera)
        self._redraw()

    def _redraw(self, *_: object) -> None:
        self.seen.forget()
        self._soon.ask()
