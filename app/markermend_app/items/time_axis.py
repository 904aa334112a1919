"""A time axis that people can read: the file's frame number above, seconds below."""

from __future__ import annotations

import math

from markermend_app.items.axis import Axis


class TimeAxis(Axis):
    """Bottom axis over frame indices, labelled with frame numbers and seconds."""

    def __init__(self) -> None:
        super().__init__("bottom")
        self._first_frame = 1
        self._rate = 100.0
        self._frames = 0

    def set_clock(self, first_frame: int, rate: float, frames: int) -> None:
        """Say which number index 0 has in the file, the frames a second, and those of the take."""
        self._first_frame, self._rate, self._frames = first_frame, rate, frames
        self.picture = None
        self.update()

    def tickValues(
        self, minVal: float, maxVal: float, size: float
    ) -> list[tuple[float, list[float]]]:
        """Ticks at round frame numbers, never between two frames or beside the take."""
        shift = self._first_frame
        levels = [
            (spacing, [v - shift for v in values if 0 <= v - shift < self._frames])
            for spacing, values in super().tickValues(minVal + shift, maxVal + shift, size)
            if spacing >= 1
        ]
        if levels:
            return levels
        # So near that what is round lies between frames: each of them.
        inside = range(max(0, math.ceil(minVal)), min(self._frames, math.floor(maxVal) + 1))
        return [(1.0, [float(v) for v in inside])]

    def tickStrings(self, values: list[float], scale: float, spacing: float) -> list[str]:
        """Two lines a tick."""
        step_s = spacing / self._rate
        places = min(3, max(1, 1 + math.ceil(-math.log10(step_s) - 1e-9)))
        return [f"{round(v) + self._first_frame}\n{v / self._rate:.{places}f} s" for v in values]
