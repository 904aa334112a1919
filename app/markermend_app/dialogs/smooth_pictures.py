"""What smoothing does, drawn: the curve, its spectrum, and Winter's residual analysis."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pyqtgraph as pg
from PySide6.QtCore import Qt
from PySide6.QtGui import QColor
from PySide6.QtWidgets import QWidget

from markermend.arrays import FloatArray
from markermend_app import units
from markermend_app.items.time_axis import TimeAxis
from markermend_app.items.value_axis import ValueAxis
from markermend_app.panels.plots.frame import TIME_HEIGHT
from markermend_app.style import theme

_FLOOR = 1e-12
"""Least power drawn, mm²/Hz; the logarithm of nothing is nowhere."""


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

    def make_one(self) -> bool:
        """Make one more of the plots, which takes long; whether some are left to be made."""
        if self._todo:
            self._todo.pop(0)()
        return bool(self._todo)

    def _make_way(self) -> None:
        self._time = TimeAxis()
        axes = {"bottom": self._time, "left": ValueAxis()}
        self.way = pg.PlotItem(axisItems=axes, enableMenu=False)
        self.addItem(self.way, 0, 0, 1, 2)
        self._time.setHeight(TIME_HEIGHT)
        # Before curves are added, which take the settings of their plot over.
        self.way.setDownsampling(auto=True, mode="peak")
        self.way.setClipToView(True)
        self.way.disableAutoRange()
        self.way.getViewBox().setAutoVisible(y=True)
        look = theme.current()
        # Where both agree, what was there before shows on either side of what comes.
        self.raw, self.smooth = _curve(look.original, width=3), _curve(look.accent)
        self._prepare(self.way, self.raw, self.smooth)

    def _make_spectrum(self) -> None:
        look = theme.current()
        self.spectrum = pg.PlotItem(enableMenu=False)
        self.addItem(self.spectrum, 1, 0)
        self.spectrum.setLogMode(y=True)
        self._power = {True: _curve(look.original, width=3), False: _curve(look.accent)}
        self._over_frequency(self.spectrum, self.tr("Spectrum"))
        self._prepare(self.spectrum, *self._power.values())

    def _make_residual(self) -> None:
        look = theme.current()
        self.residual = pg.PlotItem(enableMenu=False)
        self.addItem(self.residual, 1, 1)
        self._taken, self._noise = _curve(look.text), _curve(look.muted)
        self._chosen = pg.InfiniteLine(angle=90, movable=False)
        self._over_frequency(self.residual, self.tr("Residuals"))
        self._prepare(self.residual, self._taken, self._noise, self._chosen)

    def _over_frequency(self, plot: pg.PlotItem, title: str) -> None:
        """Say so, and let the mouse move nothing in it."""
        self._say(plot, title)
        plot.setMouseEnabled(False, False)
        plot.setLabel("bottom", self.tr("Hz"))

    def _prepare(self, plot: pg.PlotItem, *items: pg.GraphicsObject) -> None:
        """Put curves into a plot."""
        plot.hideButtons()
        plot.showGrid(x=True, y=True, alpha=1.0)
        plot.getAxis("left").setWidth(72)
        for item in items:
            plot.addItem(item)

    def _finish(self) -> None:
        self.ci.layout.setRowStretchFactor(0, 3)
        self.ci.layout.setRowStretchFactor(1, 2)
        for column in (0, 1):
            self.ci.layout.setColumnPreferredWidth(column, 100)
            self.ci.layout.setColumnStretchFactor(column, 1)
        self.ci.layout.setContentsMargins(8, 8, 12, 8)
        self.restyle()

    def start_over(self) -> None:
        """Show nothing, in the theme as it is now: making plots takes long, so they are kept."""
        for item in (self.raw, self.smooth):
            item.setData([], [])
        self.show_inspection(None, 0, theme.current().muted)
        self._say(self.residual, self.tr("Residuals"))
        self.restyle()

    def set_clock(self, first_frame: int, rate: float, frames: int) -> None:
        """Say how the file counts frames, and how many there are."""
        self._time.set_clock(first_frame, rate, frames)
        self.way.setLimits(xMin=-1, xMax=frames, minXRange=5)

    def show_frames(self, start: int, stop: int) -> None:
        """Bring frames into view."""
        self.way.setXRange(start, stop, padding=0)

    def show_way(
        self, raw: FloatArray, smooth: FloatArray | None, name: str, unit: str, color: QColor
    ) -> None:
        """Draw (frames,) values before and after; without the latter only those before."""
        text, factor, _ = units.scaled(unit)
        self.raw.setData(raw * factor)
        self.smooth.setVisible(smooth is not None)
        self.smooth.setPen(pg.mkPen(color, width=1, cosmetic=True))
        if smooth is not None:
            self.smooth.setData(smooth * factor)
        label = {"color": color.name(), "font-size": f"{theme.SMALL_PT}pt"}
        self.way.setLabel("left", f"{name} ({text})", **label)
        self.way.enableAutoRange(axis="y")

    def show_inspection(self, found: Any, axis: int, color: QColor) -> None:
        """Draw the spectra and the residuals of one axis.

        Parameters
        ----------
        found : :class:`markermend.smoothers.Inspection`, or None when there is none
        axis : 0, 1, 2
        color : of what is smoothed
        """
        label = {"color": theme.current().muted.name(), "font-size": f"{theme.SMALL_PT}pt"}
        self._power[False].setPen(pg.mkPen(color, width=1, cosmetic=True))
        items = (*self._power.values(), self._taken, self._noise, self._chosen)
        for item in items:
            item.setVisible(found is not None)
        if found is None:
            self._say(self.residual, self.tr("Residuals: too few frames without a gap"))
            return
        # At 0 Hz stands what was taken away with the trend.
        for before, power in ((True, found.before), (False, found.after)):
            self._power[before].setData(
                found.frequencies_hz[1:], np.maximum(power[1:, axis], _FLOOR)
            )
        top = found.before[1:, axis].max()
        high = np.log10(max(top, _FLOOR))
        low = np.log10(max(found.before[1:, axis].min(), _FLOOR)) - 3
        self.spectrum.setXRange(0, found.frequencies_hz[-1], padding=0)
        self.spectrum.setYRange(low, high, padding=0.05)
        self.spectrum.setLabel("left", self.tr("mm²/Hz"), **label)
        found = found.residuals
        text, factor, _ = units.scaled("mm")
        residual, noise = found.residual_mm[:, axis] * factor, found.noise_mm[axis] * factor
        self._taken.setData(found.cutoffs_hz, residual)
        self._noise.setData([0.0, found.cutoffs_hz[-1]], [noise, noise])
        self._chosen.setValue(found.chosen_hz[axis])
        self.residual.setXRange(0, found.cutoffs_hz[-1], padding=0)
        # The knee is what is looked for, not how much a filter that stops all motion takes.
        self.residual.setYRange(0, min(residual[0], 8 * max(noise, residual[-1])), padding=0.05)
        self.residual.setLabel("left", text, **label)
        self._say(
            self.residual,
            self.tr("Residuals: cut at {0:.1f} Hz, noise {1}").format(
                found.chosen_hz[axis], units.length(found.noise_mm[axis], 2)
            ),
        )

    def restyle(self) -> None:
        """Take over the theme's colours."""
        look = theme.current()
        self.setBackground(look.plot)
        for plot in (self.way, self.spectrum, self.residual):
            for side in ("left", "bottom"):
                axis = plot.getAxis(side)
                axis.setZValue(-1000)
                axis.enableAutoSIPrefix(False)
                axis.setStyle(maxTickLevel=0)
                axis.setPen(pg.mkPen(look.border))
                axis.setTickPen(pg.mkPen(look.grid))
                axis.setTextPen(pg.mkPen(look.muted))
                font = axis.font()
                font.setPointSize(theme.SMALL_PT)
                axis.setTickFont(font)
        for item in (self.raw, self._power[True]):
            item.setPen(pg.mkPen(look.original, width=3, cosmetic=True))
        self._taken.setPen(pg.mkPen(look.text, cosmetic=True))
        self._noise.setPen(pg.mkPen(look.muted, style=Qt.PenStyle.DashLine, cosmetic=True))
        self._chosen.setPen(pg.mkPen(look.accent, width=1, style=Qt.PenStyle.DashLine))

    def _say(self, plot: pg.PlotItem, text: str) -> None:
        """Write above a plot."""
        plot.setTitle(text, size=f"{theme.SMALL_PT}pt", color=theme.current().muted)


def _curve(color: QColor, width: int = 1) -> pg.PlotDataItem:
    """An empty curve that a plot can choose its range by; NaN leaves a hole."""
    item = pg.PlotDataItem(connect="finite", autoDownsampleFactor=1.0, antialias=True)
    item.setPen(pg.mkPen(color, width=width, cosmetic=True))
    # As one line, a wide one that jumps up and down takes a hundred times as long.
    item.curve.setSegmentedLineMode("on" if width > 1 else "off")
    return item
