"""A value axis whose numbers never cover each other, however low its plot is."""

from __future__ import annotations

import pyqtgraph as pg

LABEL_PX = 15.0


class ValueAxis(pg.AxisItem):
    """Left axis with as many numbers as there is room for."""

    def __init__(self) -> None:
        super().__init__("left")

    def tickSpacing(self, minVal: float, maxVal: float, size: float) -> list[tuple[float, float]]:
        """Wider steps where numbers would be less than a line apart."""
        levels = super().tickSpacing(minVal, maxVal, size)
        wanted = LABEL_PX * abs(maxVal - minVal) / max(size, 1.0)
        spacing, offset = levels[0]
        while spacing < wanted:
            spacing *= 2
        return [(spacing, offset), *(level for level in levels[1:] if level[0] < spacing)]
