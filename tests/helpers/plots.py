"""Real mouse events on the trajectory plots, in frames and axes instead of pixels."""

from __future__ import annotations

from PySide6.QtCore import QEvent, QPoint, QPointF, Qt
from PySide6.QtGui import QMouseEvent, QWheelEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication

from markermend_app.document import Document
from markermend_app.panels.plots.trajectories import TrajectoryPanel

LEFT, RIGHT = Qt.MouseButton.LeftButton, Qt.MouseButton.RightButton
NONE, SHIFT = Qt.KeyboardModifier.NoModifier, Qt.KeyboardModifier.ShiftModifier


class Bench:
    """A panel on a document, and gestures in frames and plots instead of pixels."""

    def __init__(self, panel: TrajectoryPanel, document: Document):
        self.panel, self.document = panel, document
        self.port = panel.canvas.viewport()

    def at(self, frame: float, axis: str = "x", up: float = 0.7) -> QPoint:
        """Pixel of a frame in an axis' plot, at a share of its height."""
        view = self.panel.rows["xyz".index(axis)].view
        box = view.sceneBoundingRect()
        x = view.mapViewToScene(QPointF(frame, 0)).x()
        return self.panel.canvas.mapFromScene(QPointF(x, box.bottom() - up * box.height()))

    def click(self, frame: float, axis: str = "x", button=LEFT) -> None:
        QTest.mouseMove(self.port, self.at(frame, axis))
        QTest.mouseClick(self.port, button, NONE, self.at(frame, axis))

    def double_click(self, frame: float) -> None:
        """Click twice in the same place, whatever the first click brings there."""
        point = self.at(frame)
        QTest.mouseClick(self.port, LEFT, NONE, point)
        QTest.mouseDClick(self.port, LEFT, NONE, point)
        QTest.mouseRelease(self.port, LEFT, NONE, point)

    def drag(self, start: float, stop: float, axis="x", button=LEFT, keys=NONE, up=0.7) -> None:
        """Press, move in steps, release."""
        # A layout under way would move the plot beneath the hand.
        QTest.qWait(20)
        a, b = self.at(start, axis, up), self.at(stop, axis, up)
        QTest.mouseMove(self.port, a)
        QTest.mousePress(self.port, button, keys, a)
        for share in (0.25, 0.5, 0.75, 1.0):
            point = QPoint(round(a.x() + (b.x() - a.x()) * share), b.y())
            self._move(point, button, keys)
        QTest.mouseRelease(self.port, button, keys, b)

    def _move(self, point: QPoint, button, keys) -> None:
        """Move with a button held: what QTest.mouseMove cannot."""
        QTest.qWait(12)
        event = QMouseEvent(
            QEvent.Type.MouseMove,
            QPointF(point),
            QPointF(self.port.mapToGlobal(point)),
            Qt.MouseButton.NoButton,
            button,
            keys,
        )
        QApplication.sendEvent(self.port, event)

    def wheel(self, frame: float, notches: int, keys=NONE, axis="x") -> None:
        point = self.at(frame, axis)
        event = QWheelEvent(
            QPointF(point),
            QPointF(self.port.mapToGlobal(point)),
            QPoint(),
            QPoint(0, 120 * notches),
            Qt.MouseButton.NoButton,
            keys,
            Qt.ScrollPhase.NoScrollPhase,
            False,
        )
        QApplication.sendEvent(self.port, event)

    @property
    def time(self) -> tuple[float, float]:
        low, high = self.panel.rows[0].view.viewRange()[0]
        return low, high
