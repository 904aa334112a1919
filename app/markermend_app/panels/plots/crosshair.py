"""The crosshair: lines through the sample under the mouse, and the line of text that reads it."""

from __future__ import annotations

import math

from PySide6.QtCore import QObject, QPointF

from markermend_app.document import Document
from markermend_app.panels.inspector.artifact_text import describe
from markermend_app.panels.plots.beside import BesideRow
from markermend_app.panels.plots.frame import PlotFrame
from markermend_app.panels.plots.header import PlotHeader
from markermend_app.panels.plots.readout import read_out
from markermend_app.panels.plots.row import PlotRow
from markermend_app.panels.plots.stack import PlotStack


class Crosshair(QObject):
    """Follows the mouse over the plots; without it the cursor's frame is read out.

    Attributes
    ----------
    before : whether the source's samples stand in front and are read, or the working ones
    """

    def __init__(self, document: Document, canvas: PlotStack, header: PlotHeader) -> None:
        super().__init__(canvas)
        self._document, self._canvas, self._header = document, canvas, header
        self.before = False
        canvas.scene().sigMouseMoved.connect(self.follow)

    def follow(self, at: QPointF) -> None:
        """Say what lies under the mouse: the sample above the plots, an artifact as a tooltip."""
        session = self._document.session
        rows = self._canvas.frames
        under = next((r for r in rows if r.view.sceneBoundingRect().contains(at)), None)
        if session is None or under is None or not self._readable(under):
            self.leave()
            return
        if isinstance(under, PlotRow):
            hit = under.intervals.hit(at)
            tip = "" if hit is None else describe(session.take, session.artifact(hit))
            under.intervals.setToolTip(tip)
        frame = max(0, min(round(under.view.frame_at(at)), session.take.frames - 1))
        self._draw(under, frame)
        self.read_out(frame, under)

    def leave(self) -> None:
        """Take the lines away and read out the cursor's frame."""
        self._draw(None, None)
        self.read_out(self._document.frame)

    def read_out(self, frame: int, row: PlotFrame | None = None) -> None:
        """Say frame, time and values: in a row, else the foremost marker's position."""
        session, shown = self._document.session, self._document.shown
        if session is None or not session.take.frames or not self._readable(row):
            self._header.clear()
        else:
            take = session.original if self.before else session.take
            self._header.read_out(read_out(take, shown, frame, row))

    def _readable(self, row: PlotFrame | None) -> bool:
        """Whether there are values: channels have some without any marker."""
        return bool(self._document.shown) or isinstance(row, BesideRow)

    def _draw(self, under: PlotFrame | None, frame: int | None) -> None:
        """Draw the lines: the level goes through the foremost marker's sample."""
        value = None
        if isinstance(under, PlotRow) and frame is not None:
            value = under.value_at(self._document.shown[0], frame)
        if value is not None and not math.isfinite(value):
            value = None
        for row in self._canvas.frames:
            row.show_cross(frame, value if row is under else None)
