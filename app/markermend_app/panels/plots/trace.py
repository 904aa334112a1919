"""The curves of one marker in one plot, each made when it first has something to show."""

from __future__ import annotations

import numpy as np
from PySide6.QtCore import Qt

from markermend.arrays import BoolArray, FloatArray
from markermend_app.items.curve import Curve, CurveView
from markermend_app.items.points import pieces
from markermend_app.style import theme

PARTS = ("original", "measured", "filled", "edited", "lone", "predicted")
"""From the back to the front: the source where the working samples differ, samples as recorded,
those filled, those edited, those without neighbours, and where the body says the marker is."""
_MENDED = {"filled": Qt.PenStyle.DashLine, "edited": Qt.PenStyle.DashDotLine}


class Trace:
    """Most of a marker's curves stay empty.

    Parameters
    ----------
    view : where they are drawn
    index : the marker's place among those shown; gives its colour
    before : whether the source's samples stand in front of the working ones

    Attributes
    ----------
    made : the curves that were made so far, by part
    """

    def __init__(self, view: CurveView, index: int, before: bool) -> None:
        self._view, self._index, self._before = view, index, before
        self.made: dict[str, Curve] = {}

    def item(self, part: str) -> Curve:
        """The curve of one of :data:`PARTS`."""
        if part not in self.made:
            self.made[part] = self._make(part)
        return self.made[part]

    def fill_whole(self, part: str, values: FloatArray) -> None:
        """Give a curve one value a frame; a curve without any is emptied."""
        if np.isnan(values).all():
            self.clear(part)
        else:
            self.item(part).set_values(values)

    def fill_pieces(self, part: str, values: FloatArray, mask: BoolArray, join: int = 1) -> None:
        """Give a curve the masked stretches of some values."""
        if mask.any():
            self.item(part).set_points(*pieces(values, mask, join))
        else:
            self.clear(part)

    def clear(self, part: str) -> None:
        """Empty a curve."""
        if part in self.made:
            self.made[part].clear()

    def clear_all(self) -> None:
        """Empty all curves."""
        for curve in self.made.values():
            curve.clear()

    def remove(self) -> None:
        """Take all curves out of the plot."""
        for curve in self.made.values():
            self._view.remove_curve(curve)

    def style(self, before: bool) -> None:
        """Give the curves their pens; the source's samples in front, or the working ones."""
        self._before = before
        for part, curve in self.made.items():
            self._wear(part, curve)

    def _make(self, part: str) -> Curve:
        """An empty curve in its place and look."""
        curve = Curve(theme.marker_color(self._index), dots=part == "lone")
        self._view.add_curve(curve)
        self._wear(part, curve)
        return curve

    def _wear(self, part: str, curve: Curve) -> None:
        look, color = theme.current(), theme.marker_color(self._index)
        dotted = Qt.PenStyle.DotLine
        # What steps back lies behind every marker: one's source is where a swap put the other.
        back = part in _MENDED if self._before else part == "original"
        curve.setZValue(10 - back - self._index * 0.01 + PARTS.index(part) * 0.001)
        if part == "predicted":
            curve.wear(theme.blend(look.accent, color, 0.3), style=dotted)
        elif part in _MENDED:
            # The foremost changes its colour, too; others would look like it, and like each other.
            mended = color if self._index else theme.blend(color, look.accent, 0.55)
            curve.wear(
                look.original if self._before else mended,
                style=dotted if self._before else _MENDED[part],
            )
        else:
            curve.wear(look.original if part == "original" and not self._before else color)
