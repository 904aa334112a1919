"""What a repair that is taken back returns to: samples as read, or as hand work left them."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from markermend.arrays import ByteArray, FloatArray, IntArray
from markermend.patch import Patch, apply_patch
from markermend.take import Take


@dataclass(frozen=True, eq=False)
class Held:
    """What hand work wrote of one marker within an interval.

    Attributes
    ----------
    start, stop : half-open interval of 0-based frames; of those not in ``frames`` nothing is held.
        Only what a step holds means one
    frames : (n,) that hand work wrote, rising
    values : (n, 3) float64 mm, NaN = missing
    origins : (n,) uint8, see :class:`markermend.take.Origin`
    """

    start: int
    stop: int
    frames: IntArray
    values: FloatArray
    origins: ByteArray


_NOTHING = Held(0, 0, np.zeros(0, np.intp), np.zeros((0, 3)), np.zeros(0, np.uint8))


class Base:
    """Samples as read, and beside them the frames of each marker that hand work wrote.

    Only these are kept: a whole marker of a long take takes long to copy.

    Parameters
    ----------
    take : as it was read
    """

    def __init__(self, take: Take) -> None:
        self._take = take
        self._held: dict[int, Held] = {}

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
        if column in self._held:
            held = self._held[column]
            low, high = np.searchsorted(held.frames, (start, stop))
            inside = held.frames[low:high] - start
            positions[inside], origin[inside] = held.values[low:high], held.origins[low:high]
        return positions, origin

    def write(self, column: int, patch: Patch) -> Held:
        """Write a patch that names all axes, so that it cannot fail.

        Returns what was held of its frames, for :meth:`put`.
        """
        start, stop = patch.start, patch.stop
        positions, origin = patch.values, patch.origin
        if origin is None:
            positions, origin = self.read(column, start, stop)
            here = replace(patch, start=0, stop=stop - start)
            apply_patch(positions[:, None], origin[:, None], 0, here)
        return self.put(column, Held(start, stop, np.arange(start, stop), positions, origin))

    def put(self, column: int, held: Held) -> Held:
        """Hold this of the frames of its interval and nothing else; returns what was held there.

        Where nothing is held beside it nothing is copied, which takes long for a whole marker of
        a long take.
        """
        known = self._held.get(column, _NOTHING)
        low, high = np.searchsorted(known.frames, (held.start, held.stop))
        if high - low == len(known.frames):
            self._held[column] = held
            return replace(known, start=held.start, stop=held.stop)
        self._held[column] = Held(
            held.start,
            held.stop,
            np.concatenate((known.frames[:low], held.frames, known.frames[high:])),
            np.concatenate((known.values[:low], held.values, known.values[high:])),
            np.concatenate((known.origins[:low], held.origins, known.origins[high:])),
        )
        # Views would keep alive all that was held of the marker, for as long as the step is known.
        return Held(
            held.start,
            held.stop,
            known.frames[low:high].copy(),
            known.values[low:high].copy(),
            known.origins[low:high].copy(),
        )
