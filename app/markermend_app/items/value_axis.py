"""A value axis whose numbers never cover each other, however low its plot is."""

from __future__ import annotations

import math

from markermend_app.items.axis import Axis

LABEL_PX = 15.0


class ValueAxis(Axis):
    """Left axis with as many numbers as there is room for."""

    def __init__(self) -> None:
        super().__init__("left")

    def tickValues(
        self, minVal: float, maxVal: float, size: float
    ) -> list[tuple[float, list[float]]]:
        """Only every second value, or fewer, where their numbers would be less than a line apart.

        Multiples of the wider step are taken, as long as there is one in view.
        """
        levels = super().tickValues(minVal, maxVal, size)
        if not levels:
            return []
        spacing, values = levels[0]
        step = math.ceil(LABEL_PX * abs(maxVal - minVal) / max(size, 1.0) / spacing)
        if step < 2 or not values:
            return levels
        first = -round(values[0] / spacing) % step
        return [(spacing, values[first if first < len(values) else 0 :: step])]
