"""Where hidden joints were before and after, at other moments as at the borders of a gap."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from markermend.arrays import Float32Array, FloatArray, IntArray

# How much places at the borders count beside poses, and how much speeds, from so far inside on.
_PLACES, _SPEEDS, _INSIDE_S = 1.0, 0.3, 0.5
# Over this time speeds are told.
_SPEED_S = 0.05
# Places in a gap that other moments are looked at from: so far apart, and so many at least.
_APART_S, _LEAST = 0.15, 3


@dataclass(frozen=True, eq=False)
class Borders:
    """The borders of a gap.

    Attributes
    ----------
    path : (frames, n) what the gap hides, over the whole recording, filled, without NaN
    start, stop : the gap, which does not last throughout
    rate : frames per second
    """

    path: Float32Array
    start: int
    stop: int
    rate: float

    def looks(self) -> list[tuple[int, slice, FloatArray]]:
        """Places in the gap to look from: which, for what part, and (part,) how much each counts.

        Each counts less the further away it is, nothing from the next one on; all together by 1.
        """
        length = self.stop - self.start
        count = max(int(np.ceil(length / (_APART_S * self.rate))) + 1, _LEAST)
        places = np.unique(np.linspace(0, length - 1, min(count, length)).round().astype(int))
        found = []
        for n, place in enumerate(places.tolist()):
            share = np.interp(np.arange(length), places, np.eye(len(places))[n])
            # Where one look takes over from another nothing shall bend.
            share = share**2 * (3.0 - 2.0 * share)
            counts = np.flatnonzero(share)
            part = slice(int(counts[0]), int(counts[-1]) + 1)
            found.append((place, part, share[part]))
        return found

    def views(
        self, place: int, frames: IntArray, others: Sequence[tuple[IntArray, Float32Array]]
    ) -> list[tuple[Float32Array, float]]:
        """What moments and the gap are compared by, and how much it counts.

        Parameters
        ----------
        place : in the gap, in frames from its beginning
        frames : (moments,) when that was, in frames
        others : moments of others, such as the other side of the body: when that was, and where
            theirs was over their whole recording, as ``path``

        Returns
        -------
        (moments + others + 1, k) places, and as many speeds, without NaN, in units of the path:
        those as long before and after each moment as a border is before and after the place; last
        those at the borders themselves.
        """
        back, on = place + 1, self.stop - self.start - place
        before, after = frames - back, frames + on
        # What the gap hides is taken to be as at its borders.
        before, after = (
            np.where((there >= self.start) & (there < self.stop), border, there)
            for there, border in ((before, self.start - 1), (after, self.stop))
        )
        rows = [self._at(self.path, before, after)]
        rows += [self._at(path, then - back, then + on) for then, path in others]
        rows.append(self._at(self.path, np.array([self.start - 1]), np.array([self.stop])))
        inner = min(min(back, on) / (_INSIDE_S * self.rate), 1.0)
        places, speeds = (np.vstack(parts) for parts in zip(*rows, strict=True))
        return [(places, inner * _PLACES), (speeds, inner * _SPEEDS)]

    def _at(
        self, path: Float32Array, before: IntArray, after: IntArray
    ) -> tuple[Float32Array, Float32Array]:
        """(moments, k) each, places and speeds; of a border that the recording lacks none."""
        last, step = len(path) - 1, max(round(_SPEED_S * self.rate), 1)
        places, speeds = [], []
        for there, frames, way in (
            (self.start > 0, before, -step),
            (self.stop < len(self.path), after, step),
        ):
            if there:
                at = path[np.clip(frames, 0, last)]
                places.append(at)
                speeds.append(path[np.clip(frames + way, 0, last)] - at)
        return np.hstack(places), np.hstack(speeds)
