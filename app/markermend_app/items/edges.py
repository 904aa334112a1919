"""The two edges of the artifact under review, to be dragged."""

from __future__ import annotations

from typing import Any

import pyqtgraph as pg
from PySide6.QtCore import QObject, Qt, Signal
from PySide6.QtGui import QColor


class _Edge(pg.InfiniteLine):
    """One edge; with Shift a drag is a sweep, also when it begins here."""

    def mouseDragEvent(self, ev: Any) -> None:
        """Move, or leave it to the plot."""
        if ev.modifiers() & Qt.KeyboardModifier.ShiftModifier:
            self.getViewBox().mouseDragEvent(ev)
        else:
            super().mouseDragEvent(ev)


class Edges(QObject):
    """A start and a stop line in one plot.

    Signals
    -------
    dragged(), dropped() : an edge is being moved by hand, was moved
    """

    dragged = Signal()
    dropped = Signal()

    def __init__(self, view: pg.ViewBox) -> None:
        super().__init__()
        self.lines = (_Edge(angle=90), _Edge(angle=90))
        for line in self.lines:
            line.setZValue(20)
            line.sigDragged.connect(lambda _: self.dragged.emit())
            line.sigPositionChangeFinished.connect(lambda _: self.dropped.emit())
            view.addItem(line, ignoreBounds=True)

    @property
    def visible(self) -> bool:
        """Whether they are drawn."""
        return bool(self.lines[0].isVisible())

    @property
    def frames(self) -> tuple[float, float]:
        """Start and stop where the lines stand: half-open, not rounded."""
        low, high = sorted(line.value() for line in self.lines)
        return low + 0.5, high + 0.5

    def place(self, start: float, stop: float) -> None:
        """Stand around the frames ``[start, stop)``."""
        for line, frame in zip(self.lines, (start, stop), strict=True):
            line.setValue(frame - 0.5)

    def show(self, shown: bool, movable: bool) -> None:
        """Draw them or not, and let hands move them or not."""
        for line in self.lines:
            line.setVisible(shown)
            line.setMovable(movable)

    def set_color(self, color: QColor) -> None:
        """Draw in this colour, thicker under the mouse."""
        for line in self.lines:
            line.setPen(pg.mkPen(color, width=1))
            line.setHoverPen(pg.mkPen(color, width=3))
