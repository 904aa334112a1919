"""One plot's view: turns wheel, drags and clicks into what the operator means by them.

The wheel zooms time at the cursor, with Ctrl it zooms values; the middle or right button pans;
the left button scrubs, with Shift it sweeps a range. Time is not changed here but asked for, so
that all plots follow together.
"""

from __future__ import annotations

from typing import Any

from PySide6.QtCore import QPointF, Qt, Signal

from markermend_app.items.curve import CurveView

_STEP = 1.25


class PlotView(CurveView):
    """The area of a plot.

    Signals
    -------
    time_wanted(float, float) : show these frames
    values_moved() : the range of values was zoomed or panned by hand
    pressed(QPointF) : a click with the left button, in scene coordinates
    double_pressed(QPointF) : a double click
    menu_wanted(QPointF, QPointF) : a click with the right button, in scene and screen coordinates
    scrubbed(float) : the cursor is dragged to this frame
    swept(QPointF, float, bool) : a range is being swept from a point to a frame; last when True
    """

    time_wanted = Signal(float, float)
    values_moved = Signal()
    pressed = Signal(object)
    double_pressed = Signal(object)
    menu_wanted = Signal(object, object)
    scrubbed = Signal(float)
    swept = Signal(object, float, bool)

    def __init__(self) -> None:
        super().__init__(enableMenu=False)
        self.setMouseEnabled(x=False, y=False)

    def frame_at(self, scene: QPointF) -> float:
        """Frame index under a point of the scene, not rounded."""
        return float(self.mapSceneToView(scene).x())

    def wheelEvent(self, ev: Any, axis: int | None = None) -> None:
        """Zoom at the mouse; a sideways wheel moves through time."""
        ev.accept()
        notches = ev.delta() / 120.0
        (low, high), (bottom, top) = self.viewRange()
        if ev.orientation() == Qt.Orientation.Horizontal:
            shift = -notches * 0.1 * (high - low)
            self.time_wanted.emit(low + shift, high + shift)
            return
        at = self.mapSceneToView(ev.scenePos())
        factor = _STEP**-notches
        if axis == 1 or ev.modifiers() & Qt.KeyboardModifier.ControlModifier:
            y = at.y()
            self.values_moved.emit()
            self.setYRange(y - (y - bottom) * factor, y + (top - y) * factor, padding=0)
        else:
            x = at.x()
            self.time_wanted.emit(x - (x - low) * factor, x + (high - x) * factor)

    def mouseDragEvent(self, ev: Any, axis: int | None = None) -> None:
        """Scrub, sweep or pan."""
        ev.accept()
        here = self.mapSceneToView(ev.scenePos())
        if ev.button() == Qt.MouseButton.LeftButton and axis != 1:
            if ev.modifiers() & Qt.KeyboardModifier.ShiftModifier:
                begin = ev.buttonDownScenePos()
                self.swept.emit(begin, float(here.x()), bool(ev.isFinish()))
            else:
                self.scrubbed.emit(float(here.x()))
            return
        before = self.mapSceneToView(ev.lastScenePos())
        (low, high), (bottom, top) = self.viewRange()
        dx, dy = before.x() - here.x(), before.y() - here.y()
        self.values_moved.emit()
        self.setYRange(bottom + dy, top + dy, padding=0)
        self.time_wanted.emit(low + dx, high + dx)

    def mouseClickEvent(self, ev: Any) -> None:
        """Tell which button was clicked where."""
        if ev.button() == Qt.MouseButton.LeftButton:
            ev.accept()
            (self.double_pressed if ev.double() else self.pressed).emit(ev.scenePos())
        elif ev.button() == Qt.MouseButton.RightButton:
            ev.accept()
            self.menu_wanted.emit(ev.scenePos(), ev.screenPos())
