"""Curves that show gaps, stay quick at any length and keep one-sample spikes visible."""

from __future__ import annotations

from typing import Any

import numpy as np
import pyqtgraph as pg
from pyqtgraph.functions import arrayToQPath, arrayToQPolygonF
from PySide6.QtCore import QLineF, Qt
from PySide6.QtGui import QColor, QGuiApplication, QPainter, QPainterPath, QPen, QPolygonF
from PySide6.QtWidgets import QGraphicsPathItem

from markermend.arrays import FloatArray
from markermend_app.items.points import Place, thinned_points, thinned_values

_FAR = 1e12
"""Values are drawn at most so far out: beyond, coordinates on the screen lose their meaning."""
_DOT = 4.0
_NOWHERE: FloatArray = np.zeros(0)
_NO_PEN = QPen(Qt.PenStyle.NoPen)


class Curve(QGraphicsPathItem):
    """Values over frames in a :class:`CurveView`; NaN leaves a hole.

    What is drawn is worked out when a view is painted in which it or the frames in view have
    changed. pyqtgraph's own curves do so at every change of the range, of values too, and their
    extent many times in each picture: half of a turn of the wheel went to that, where several
    markers are shown.

    Parameters
    ----------
    color, width, style : see :meth:`wear`
    dots : points that are not joined, for samples without neighbours

    Attributes
    ----------
    frames : (n,) of the points, or None where there is one value a step
    values : (n,) what was given to be drawn, or None
    view : where it is drawn, if anywhere
    worn : the pen it is drawn with
    """

    def __init__(
        self,
        color: QColor,
        *,
        width: float = 1,
        style: Qt.PenStyle = Qt.PenStyle.SolidLine,
        dots: bool = False,
    ) -> None:
        super().__init__()
        self.view: CurveView | None = None
        self.frames: FloatArray | None = None
        self.values: FloatArray | None = None
        self._step = 1.0
        self._fitted: Place | None = None
        self._dots = dots
        # The path does not tell: of one point at the origin it has no element.
        self._empty = True
        self._drawn: QPainterPath | QPolygonF | list[QLineF] = QPainterPath()
        # Qt would work out what a pen adds to the extent by stroking the whole path.
        self.setPen(_NO_PEN)
        self.setZValue(10)
        self.wear(color, width=width, style=style)

    def wear(
        self,
        color: QColor,
        *,
        width: float = 1,
        style: Qt.PenStyle = Qt.PenStyle.SolidLine,
    ) -> None:
        """Draw in a colour, as wide in every zoom; ``width`` in the screen's own points.

        Qt counts such widths in pixels, of which a screen of high resolution has several to a
        point. Curves of width 1, and dashed ones, stay as thin as can be there: wide ones of a
        whole take cannot be moved at 60 Hz.
        """
        app = QGuiApplication.instance()
        wide = self._dots or (style == Qt.PenStyle.SolidLine and width > 1)
        ratio = app.devicePixelRatio() if wide and isinstance(app, QGuiApplication) else 1.0
        if self._dots:
            width = _DOT
        self.worn = pg.mkPen(color, width=width * ratio, style=style, cosmetic=True)
        if self._dots:
            self.worn.setCapStyle(Qt.PenCapStyle.RoundCap)
        # As one line, a wide one that jumps up and down takes a hundred times as long.
        segments = wide and not self._dots
        if segments != isinstance(self._drawn, list):
            self._drawn = [] if segments else QPainterPath()
            self._outdate()
        else:
            self.update()

    def set_values(self, values: FloatArray, step: float = 1.0) -> None:
        """Draw one value each ``step`` frames, the first one at frame 0."""
        self.frames, self.values, self._step = None, values, step
        self._outdate()

    def set_points(self, frames: FloatArray, values: FloatArray) -> None:
        """Draw values at frames that rise, a NaN between stretches that lie apart."""
        self.frames, self.values = frames, values
        self._outdate()

    def clear(self) -> None:
        """Draw nothing; one that is empty already is left alone, as most are."""
        if self.values is not None:
            self.frames = self.values = None
            self._outdate()

    def fit(self, place: Place) -> None:
        """Work out what is to be drawn there, unless it stands."""
        if place == self._fitted:
            return
        self._fitted = place
        if self.values is None:
            x = y = _NOWHERE
        elif self.frames is None:
            x, y = thinned_values(self.values, self._step, place)
        else:
            x, y = thinned_points(self.frames, self.values, place)
        if not len(x) and self._empty:
            return
        self._empty = not len(x)
        y = np.clip(y, -_FAR, _FAR)
        path = QPainterPath()
        if self._dots:
            there = np.isfinite(y)
            points = arrayToQPolygonF(x[there], y[there]) if there.any() else QPolygonF()
            self._drawn = points
            path.addPolygon(points)
            self.setPath(path)
            return
        path = arrayToQPath(x, y, connect="finite")
        if isinstance(self._drawn, list):
            there = np.isfinite(y)
            ends = np.column_stack((x[:-1], y[:-1], x[1:], y[1:]))[there[:-1] & there[1:]]
            self._drawn = [QLineF(*line) for line in ends.tolist()]
        else:
            self._drawn = path
        self.setPath(path)

    def shape(self) -> QPainterPath:
        """Nothing that a mouse could hit."""
        return QPainterPath()

    def paint(self, painter: QPainter, *_: Any) -> None:
        """Draw it."""
        drawn = self._drawn
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setPen(self.worn)
        if isinstance(drawn, QPainterPath):
            painter.setBrush(Qt.BrushStyle.NoBrush)
            painter.drawPath(drawn)
        elif isinstance(drawn, list):
            painter.drawLines(drawn)
        else:
            painter.drawPoints(drawn)

    def _outdate(self) -> None:
        """Have it worked out anew when the view is painted next, which is soon."""
        self._fitted = None
        if self.view is not None:
            self.view.update()


class CurveView(pg.ViewBox):
    """The area of a plot, which brings its curves up to date before it is painted."""

    def __init__(self, **options: Any) -> None:
        super().__init__(**options)
        self._curves: list[Curve] = []

    @property
    def curves(self) -> tuple[Curve, ...]:
        """Those in it, in the order added."""
        return tuple(self._curves)

    def add_curve(self, curve: Curve) -> None:
        """Draw a curve here."""
        self._curves.append(curve)
        curve.view = self
        self.addItem(curve, ignoreBounds=True)

    def remove_curve(self, curve: Curve) -> None:
        """Draw it no longer."""
        self._curves.remove(curve)
        curve.view = None
        self.removeItem(curve)

    def prepareForPaint(self) -> None:
        """Have the curves fitted to the frames in view."""
        super().prepareForPaint()
        (low, high), width = self.viewRange()[0], self.width()
        if high > low and width > 0:
            for curve in self._curves:
                curve.fit((low, high, width))
