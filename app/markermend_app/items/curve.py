"""Curves that show gaps, stay quick at any length and keep one-sample spikes visible."""

from __future__ import annotations

import numpy as np
import pyqtgraph as pg
from PySide6.QtCore import Qt
from PySide6.QtGui import QColor, QGuiApplication

from markermend.arrays import BoolArray, FloatArray, runs


def prepare_plot(plot: pg.PlotItem) -> None:
    """Set a plot up for long curves; it has to be done before curves are added.

    ``addItem`` overwrites an item's own settings with the plot's, so they are set here.
    """
    plot.setDownsampling(auto=True, mode="peak")
    plot.setClipToView(True)
    plot.disableAutoRange()


def wear(
    item: pg.PlotDataItem,
    color: QColor,
    *,
    width: float = 1,
    style: Qt.PenStyle = Qt.PenStyle.SolidLine,
) -> None:
    """Draw a curve in a colour, as wide in every zoom; ``width`` in the screen's own points.

    Qt counts such widths in pixels, of which a screen of high resolution has several to a point.
    Curves of width 1, and dashed ones, stay as thin as can be there: wide ones of a whole take
    cannot be moved at 60 Hz.
    """
    app, wide = QGuiApplication.instance(), style == Qt.PenStyle.SolidLine and width > 1
    ratio = app.devicePixelRatio() if wide and isinstance(app, QGuiApplication) else 1.0
    item.setPen(pg.mkPen(color, width=width * ratio, style=style, cosmetic=True))
    # As one line, a wide one that jumps up and down takes a hundred times as long.
    item.curve.setSegmentedLineMode("on" if wide else "off")


def curve(
    color: QColor, *, width: int = 1, style: Qt.PenStyle = Qt.PenStyle.SolidLine
) -> pg.PlotDataItem:
    """An empty curve, to be filled with ``setData``; NaN leaves a hole."""
    item = pg.PlotDataItem(connect="finite", autoDownsampleFactor=1.0, antialias=True)
    wear(item, color, width=width, style=style)
    item.setZValue(10)
    return item


def dots(color: QColor) -> pg.PlotDataItem:
    """An empty set of points, for samples that have no neighbour to be joined with."""
    item = pg.PlotDataItem(pen=None, symbol="o", symbolSize=4, symbolPen=None, symbolBrush=color)
    item.setZValue(10)
    return item


def pieces(values: FloatArray, mask: BoolArray, join: int = 1) -> tuple[FloatArray, FloatArray]:
    """Take the masked stretches of a curve, apart from each other.

    Parameters
    ----------
    values : (frames,) float64, NaN = missing
    mask : (frames,) bool, the samples wanted
    join : samples on either side that are drawn along, so that a stretch meets its surroundings

    Returns
    -------
    x, y : frame indices and values, a NaN in y between two stretches
    """
    wanted = mask.copy()
    for step in range(1, join + 1):
        wanted[:-step] |= mask[step:]
        wanted[step:] |= mask[:-step]
    index = np.flatnonzero(wanted)
    breaks = np.flatnonzero(np.diff(index) > 1) + 1
    x = np.insert(index.astype(np.float64), breaks, index[breaks - 1] + 0.5)
    y = np.insert(values[index], breaks, np.nan)
    return x, y


def lone_samples(values: FloatArray) -> BoolArray:
    """(frames,) bool: samples with a hole on either side, which a line would not show."""
    mask = np.zeros(len(values), dtype=bool)
    found = runs(np.isfinite(values))
    mask[found[found[:, 1] - found[:, 0] == 1, 0]] = True
    return mask
