"""What a repair that is taken back returns to: samples as read, or as hand work left them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from markermend.arrays import ByteArray, FloatArray, IntArray
from markermend.patch import Patch, apply_patch
from markermend.take import Take

Own = tuple[IntArray, FloatArray, ByteArray]
"""(n,) frames of a marker that hand work wrote, rising, their (n, 3) samples and (n,) origins."""


class Base:
    """Samples as read, and beside them the frames of each marker that hand work wrote.

    Only these are kept: a whole marker of a long take takes long to copy.

    Parameters
    ----------
    take : as it was read
    """

    def __init__(self, take: Take) -> None:
        self._take = take
        self._own: dict[int, Own] = {}

    def read(self, column: int, start: int, stop: int) -> tuple[FloatArray, ByteArray]:
        """Frames of a marker.

        Parameters
        ----------
        column : the marker
        start, stop : half-open interval of 0-based frames

        Returns
        -------
        (stop - start, 3) float64 mm, NaN = missing; and (stop - start,) uint8, see
        :class:`markermend.take.Origin`; copies
        """
        positions = self._take.positions[start:stop, column].copy()
        origin = self._take.origin[start:stop, column].copy()
        if column in self._own:
            frames, values, origins = self._own[column]
            low, high = np.searchsorted(frames, (start, stop))
            inside = frames[low:high] - start
            positions[inside], origin[inside] = values[low:high], origins[low:high]
        return positions, origin

    def write(self, column: int, patch: Patch) -> Own | None:
        """Write a patch that names all axes, so that it cannot fail.

        Returns what was held of the marker, for :meth:`put_back`.
        """
        start, stop = patch.start, patch.stop
        positions, origin = patch.values, patch.origin
        if origin is None:
            positions, origin = self.read(column, start, stop)
            here = replace(patch, start=0, stop=stop - start)
            apply_patch(positions[:, None], origin[:, None], 0, here)
        frames = np.arange(start, stop)
        before = self._own.get(column)
        if before is not None:
            known, values, origins = before
            low, high = np.searchsorted(known, (start, stop))
            frames = np.concatenate((known[:low], frames, known[high:]))
            positions = np.concatenate((values[:low], positions, values[high:]))
            origin = np.concatenate((origins[:low], origin, origins[high:]))
        self._own[column] = frames, positions, origin
        return before

    def put_back(self, column: int, own: Own | None) -> Own | None:
        """Hold what was held of a marker before; returns what is held now."""
        now = self._own.pop(column, None)
        if own is not None:
            self._own[column] = own
        return now
