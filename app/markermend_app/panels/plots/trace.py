"""The curves of one marker in one plot, each made when it first has something to show."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
import pyqtgraph as pg
from PySide6.QtCore import Qt

from markermend.arrays import BoolArray, FloatArray, IntArray
from markermend_app.items.curve import curve, dots, pieces, wear
from markermend_app.style import theme

PARTS = ("original", "measured", "filled", "edited", "lone", "predicted")
"""From the back to the front: the source where the working samples differ, samples as recorded,
those filled, those edited, those without neighbours, and where the body says the marker is."""
_MENDED = {"filled": Qt.PenStyle.DashLine, "edited": Qt.PenStyle.DashDotLine}
_NONE: FloatArray = np.zeros(0)


@lru_cache(maxsize=2)
def _frames(count: int) -> IntArray:
    """Frame indices, shared by all curves of a take; whole numbers are not searched for NaN."""
    frames = np.arange(count)
    frames.flags.writeable = False
    return frames


class Trace:
    """Making a curve takes a millisecond, and most of a marker's curves stay empty.

    Parameters
    ----------
    plot : where they are drawn
    index : the marker's place among those shown; gives its colour
    before : whether the source's samples stand in front of the working ones

    Attributes
    ----------
    made : the curves that were made so far, by part
    """

    def __init__(self, plot: pg.PlotItem, index: int, before: bool) -> None:
        self._plot, self._index, self._before = plot, index, before
        self.made: dict[str, pg.PlotDataItem] = {}

    def item(self, part: str) -> pg.PlotDataItem:
        """The curve of one of :data:`PARTS`."""
        if part not in self.made:
            self.made[part] = self._make(part)
        return self.made[part]

    def fill(self, part: str, x: FloatArray | IntArray = _NONE, y: FloatArray = _NONE) -> None:
        """Give a curve its points; one that is empty already is left alone, which most are."""
        if len(x) or (part in self.made and self.made[part].xData is not None):
            self.item(part).setData(x, y)

    def fill_whole(self, part: str, values: FloatArray) -> None:
        """Give a curve one value a frame; a curve without any is emptied."""
        if np.isnan(values).all():
            self.fill(part)
        else:
            self.fill(part, _frames(len(values)), values)

    def fill_pieces(self, part: str, values: FloatArray, mask: BoolArray, join: int = 1) -> None:
        """Give a curve the masked stretches of some values."""
        if mask.any():
            self.fill(part, *pieces(values, mask, join))
        else:
            self.fill(part)

    def clear(self) -> None:
        """Empty all curves."""
        for part in self.made:
            self.fill(part)

    def remove(self) -> None:
        """Take all curves out of the plot."""
        for item in self.made.values():
            self._plot.removeItem(item)

    def style(self, before: bool) -> None:
        """Give the curves their pens; the source's samples in front, or the working ones."""
        self._before = before
        for part, item in self.made.items():
            self._wear(part, item)

    def _make(self, part: str) -> pg.PlotDataItem:
        """An empty curve in its place and look."""
        color = theme.marker_color(self._index)
        item = dots(color) if part == "lone" else curve(color)
        self._plot.addItem(item)
        self._wear(part, item)
        return item

    def _wear(self, part: str, item: pg.PlotDataItem) -> None:
        look, color = theme.current(), theme.marker_color(self._index)
        dotted = Qt.PenStyle.DotLine
        # What steps back lies behind every marker: one's source is where a swap put the other.
        back = part in _MENDED if self._before else part == "original"
        item.setZValue(10 - back - self._index * 0.01 + PARTS.index(part) * 0.001)
        if part == "lone":
            item.setSymbolBrush(color)
        elif part == "predicted":
            wear(item, theme.blend(look.accent, color, 0.3), style=dotted)
        elif part in _MENDED:
            mended = theme.blend(color, look.accent, 0.55)
            wear(
                item,
                look.original if self._before else mended,
                style=dotted if self._before else _MENDED[part],
            )
        else:
            wear(item, look.original if part == "original" and not self._before else color)
