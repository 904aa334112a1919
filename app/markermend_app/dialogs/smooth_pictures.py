"""What smoothing does, drawn: the curve, its spectrum, and Winter's residual analysis."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pyqtgraph as pg
from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QColor
from PySide6.QtWidgets import QWidget

from markermend.arrays import FloatArray
from markermend_app import units
from markermend_app.items.axis import Axis
from markermend_app.items.curve import Curve, CurveView
from markermend_app.items.plot import Plot
from markermend_app.items.time_axis import TimeAxis
from markermend_app.items.value_axis import LABEL_PX, ValueAxis
from markermend_app.panels.plots.frame import TIME_HEIGHT
from markermend_app.panels.plots.range import value_range
from markermend_app.style import theme

_FLOOR = 1e-12
"""Least power drawn, mm²/Hz; the logarithm of nothing is nowhere."""
_VALUES_WIDTH = 72
_FEWEST_FRAMES = 5
_ROUGH = 3
"""Width of what was there before: where both agree, it shows on either side of what comes."""
_LEAST_EXTENT = 1e-3
_RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
_DASHED = Qt.PenStyle.DashLine


class _PowerAxis(ValueAxis):
    """Left axis of logarithms to the base of ten, with whole powers written out."""

    def tickValues(
        self, minVal: float, maxVal: float, size: float
    ) -> list[tuple[float, list[float]]]:
        """Whole powers, not closer than their numbers are high."""
        low, high = sorted((minVal, maxVal))
        step = max(1, math.ceil(LABEL_PX * (high - low) / max(size, 1.0)))
        count = range(math.ceil(low / step), math.floor(high / step) + 1)
        return [(float(step), [float(k * step) for k in count])]

    def tickStrings(self, values: list[float], scale: float, spacing: float) -> list[str]:
        """10⁻², 1, 10²."""
        powers = (str(round(v)).translate(_RAISED) for v in values)
        return [f"10{power}" if v else "1" for v, power in zip(values, powers, strict=True)]


class _View(CurveView):
    """An area in which the mouse moves what lies below, and beside which it moves values.

    Signals
    -------
    values_moved() : the range of values was zoomed or panned by hand
    """

    values_moved = Signal()

    def wheelEvent(self, ev: Any, axis: int | None = None) -> None:
        """Zoom."""
        self._tell(axis)
        super().wheelEvent(ev, 0 if axis is None else axis)

    def mouseDragEvent(self, ev: Any, axis: int | None = None) -> None:
        """Pan with the left or middle button, zoom with the right one."""
        self._tell(axis)
        super().mouseDragEvent(ev, 0 if axis is None else axis)

    def _tell(self, axis: int | None) -> None:
        if axis == 1 and self.mouseEnabled()[1]:
            self.values_moved.emit()


class _Picture:
    """One of the plots.

    Attributes
    ----------
    view : its area
    title : written above, where there is room for it
    """

    def __init__(self, left: Axis, bottom: Axis, *curves: Curve) -> None:
        self.view = _View(enableMenu=False)
        self.view.disableAutoRange()
        self.view.setDefaultPadding(0)
        self.left, self.bottom = left, bottom
        self.plot = Plot(self.view, left, bottom)
        self.title = pg.LabelItem("")
        left.setWidth(_VALUES_WIDTH)
        bottom.setHeight(TIME_HEIGHT)
        for curve in curves:
            self.view.add_curve(curve)

    def say(self, text: str) -> None:
        """Write above it."""
        self.title.setText(text, size=f"{theme.SMALL_PT}pt", color=theme.current().muted)

    def restyle(self) -> None:
        """Take over the theme's colours."""
        for axis in (self.left, self.bottom):
            axis.restyle()


class SmoothPictures(pg.GraphicsLayoutWidget):
    """Three plots: over time above, over frequency below; :meth:`make_one` makes them.

    Attributes
    ----------
    way, spectrum, residual : the plots
    raw, smooth : curves over time
    """

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setAccessibleName(self.tr("Curve, spectrum and residuals before and after"))
        self.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self._todo: list[Callable[[], None]] = [self._make_way, self._make_spectrum]
        self._todo += [self._make_residual, self._finish]
        self._follows = True

    def make_one(self) -> bool:
        """Make one more of the plots, which takes long; whether some are left to be made."""
        if self._todo:
            self._todo.pop(0)()
        return bool(self._todo)

    def _make_way(self) -> None:
        look = theme.current()
        self._time = TimeAxis()
        self.raw, self.smooth = Curve(look.original, width=_ROUGH), Curve(look.accent)
        self.way = _Picture(ValueAxis(), self._time, self.raw, self.smooth)
        self.way.view.sigXRangeChanged.connect(self._show_values)
        self.way.view.values_moved.connect(self._let_go)
        self.addItem(self.way.plot, 0, 0, 1, 2)

    def _make_spectrum(self) -> None:
        look = theme.current()
        self._power = {True: Curve(look.original, width=_ROUGH), False: Curve(look.accent)}
        self.spectrum = _Picture(_PowerAxis(), Axis("bottom"), *self._power.values())
        self._over_frequency(self.spectrum, 0)
        self.spectrum.say(self.tr("Spectrum"))

    def _make_residual(self) -> None:
        look = theme.current()
        self._taken, self._noise = Curve(look.text), Curve(look.muted, style=_DASHED)
        self._chosen = pg.InfiniteLine(angle=90, movable=False)
        self.residual = _Picture(ValueAxis(), Axis("bottom"), self._taken, self._noise)
        self.residual.view.addItem(self._chosen, ignoreBounds=True)
        self._over_frequency(self.residual, 1)
        self.residual.say(self.tr("Residuals"))

    def _over_frequency(self, picture: _Picture, column: int) -> None:
        """Put a plot below, and let the mouse move nothing in it."""
        picture.view.setMouseEnabled(x=False, y=False)
        self.addItem(picture.title, 1, column)
        self.addItem(picture.plot, 2, column)

    def _finish(self) -> None:
        self.ci.layout.setRowStretchFactor(0, 3)
        self.ci.layout.setRowStretchFactor(2, 2)
        for column in (0, 1):
            self.ci.layout.setColumnPreferredWidth(column, 100)
            self.ci.layout.setColumnStretchFactor(column, 1)
        self.ci.layout.setContentsMargins(8, 8, 12, 8)
        self.restyle()

    def start_over(self) -> None:
        """Show nothing, in the theme as it is now: making plots takes long, so they are kept."""
        for curve in (self.raw, self.smooth):
            curve.clear()
        self.show_inspection(None, 0, theme.current().muted)
        self.residual.say(self.tr("Residuals"))
        self.restyle()

    def set_clock(self, first_frame: int, rate: float, frames: int) -> None:
        """Say how the file counts frames, and how many there are."""
        self._time.set_clock(first_frame, rate, frames)
        # A range that has no room within its own limits would be corrected without end.
        fewest = min(_FEWEST_FRAMES, frames + 1)
        self.way.view.setLimits(xMin=-1, xMax=frames, minXRange=fewest)

    def show_frames(self, start: int, stop: int) -> None:
        """Bring frames into view."""
        self.way.view.setXRange(start, stop, padding=0)

    def show_way(
        self, raw: FloatArray, smooth: FloatArray | None, name: str, unit: str, color: QColor
    ) -> None:
        """Draw (frames,) values before and after; without the latter only those before."""
        text, factor, _ = units.scaled(unit)
        self.raw.set_values(raw * factor)
        self.smooth.setVisible(smooth is not None)
        self.smooth.wear(color)
        if smooth is not None:
            self.smooth.set_values(smooth * factor)
        self.way.left.setLabel(f"{name} ({text})", **_label(color))
        self._follows = True
        self._show_values()

    def _let_go(self) -> None:
        """Leave the values as the operator put them, until there is something else to be seen."""
        self._follows = False

    def _show_values(self, *_: object) -> None:
        """Show what there is of values among the frames in view."""
        if not self._follows:
            return
        low, high = self.way.view.viewRange()[0]
        part = slice(max(0, math.floor(low)), max(0, math.ceil(high) + 1))
        shown = (self.raw, self.smooth) if self.smooth.isVisible() else (self.raw,)
        seen = [c.values[part] for c in shown if c.values is not None]
        values = value_range(seen, least=_LEAST_EXTENT, whole=True)
        if values is not None:
            self.way.view.setYRange(*values, padding=0)

    def show_inspection(self, found: Any, axis: int, color: QColor) -> None:
        """Draw the spectra and the residuals of one axis.

        Parameters
        ----------
        found : :class:`markermend.smoothers.Inspection`, or None when there is none
        axis : 0, 1, 2
        color : of what is smoothed
        """
        label = _label(theme.current().muted)
        self._power[False].wear(color)
        items = (*self._power.values(), self._taken, self._noise, self._chosen)
        for item in items:
            item.setVisible(found is not None)
        if found is None:
            self.residual.say(self.tr("Residuals: too few frames without a gap"))
            return
        # At 0 Hz stands what was taken away with the trend.
        for before, power in ((True, found.before), (False, found.after)):
            logarithm = np.log10(np.maximum(power[1:, axis], _FLOOR))
            self._power[before].set_points(found.frequencies_hz[1:], logarithm)
        top = found.before[1:, axis].max()
        high = np.log10(max(top, _FLOOR))
        low = np.log10(max(found.before[1:, axis].min(), _FLOOR)) - 3
        self.spectrum.view.setRange(
            xRange=(0, found.frequencies_hz[-1]), yRange=_roomy(low, high), padding=0
        )
        self.spectrum.left.setLabel(self.tr("mm²/Hz"), **label)
        found = found.residuals
        text, factor, _ = units.scaled("mm")
        residual, noise = found.residual_mm[:, axis] * factor, found.noise_mm[axis] * factor
        last = found.cutoffs_hz[-1]
        self._taken.set_points(found.cutoffs_hz, residual)
        self._noise.set_points(np.array([0.0, last]), np.array([noise, noise]))
        self._chosen.setValue(found.chosen_hz[axis])
        # The knee is what is looked for, not how much a filter that stops all motion takes.
        most = min(residual[0], 8 * max(noise, residual[-1]))
        self.residual.view.setRange(xRange=(0, last), yRange=_roomy(0, most), padding=0)
        self.residual.left.setLabel(text, **label)
        self.residual.say(
            self.tr("Residuals: cut at {0:.1f} Hz, noise {1}").format(
                found.chosen_hz[axis], units.length(found.noise_mm[axis], 2)
            )
        )

    def restyle(self) -> None:
        """Take over the theme's colours."""
        look = theme.current()
        self.setBackground(look.plot)
        for picture in (self.way, self.spectrum, self.residual):
            picture.restyle()
        for picture in (self.spectrum, self.residual):
            picture.bottom.setLabel(self.tr("Hz"), **_label(look.muted))
        for curve in (self.raw, self._power[True]):
            curve.wear(look.original, width=_ROUGH)
        self._taken.wear(look.text)
        self._noise.wear(look.muted, style=_DASHED)
        self._chosen.setPen(pg.mkPen(look.accent, width=1, style=_DASHED))


def _label(color: QColor) -> dict[str, str]:
    """How what an axis shows is written."""
    return {"color": color.name(), "font-size": f"{theme.SMALL_PT}pt"}


def _roomy(low: float, high: float) -> tuple[float, float]:
    """A range with a twentieth of room on either side."""
    room = 0.05 * (high - low)
    return low - room, high + room
