"""What trajectories say besides their coordinates: speed, acceleration, distances, lengths.

Everything here is as rough as the samples are: nothing is smoothed, since damage is what it shows.
For derivatives to be used in an analysis see :func:`markermend.smoothers.derivatives`.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from markermend.arrays import BoolArray, FloatArray, IntArray, deviation_of_seen, median_of_seen

_SAMPLED = 500
_SPREADS, _LEAST_MM = 5.0, 10.0
_NORMAL = 1.4826
"""Standard deviations a median absolute deviation is, for normal numbers."""


def speed(positions: FloatArray, rate: float) -> FloatArray:
    """Speed of a trajectory.

    Parameters
    ----------
    positions : (frames, 3) float64, mm; NaN = missing
    rate : Hz

    Returns
    -------
    (frames,) float64, m/s: the central difference, beside a gap or an end the one-sided one; NaN
    where the sample or both its neighbours are missing
    """
    ahead, behind = np.full_like(positions, np.nan), np.full_like(positions, np.nan)
    ahead[:-1] = behind[1:] = np.diff(positions, axis=0)
    central = np.where(np.isnan(ahead), behind, np.where(np.isnan(behind), ahead, ahead + behind))
    both = ~np.isnan(ahead[:, 0]) & ~np.isnan(behind[:, 0])
    return _size(central) * np.where(both, 0.5, 1.0) * (rate / 1000.0)


def acceleration(positions: FloatArray, rate: float) -> FloatArray:
    """Size of a trajectory's acceleration.

    Parameters
    ----------
    positions : (frames, 3) float64, mm; NaN = missing
    rate : Hz

    Returns
    -------
    (frames,) float64, m/s²: the second difference; NaN where the sample or a neighbour is missing,
    and at both ends
    """
    result = np.full(len(positions), np.nan)
    if len(positions) > 2:
        result[1:-1] = _size(np.diff(positions, 2, axis=0)) * (rate * rate / 1000.0)
    return result


def distance(positions: FloatArray, others: FloatArray) -> FloatArray:
    """(...,) distance in mm between two sets of (..., 3) points; NaN where either is missing."""
    return _size(positions - others)


def differing(positions: FloatArray, others: FloatArray) -> BoolArray:
    """(n,) bool: which of two versions of (n, 3) samples differ, also by one being missing."""
    same = (positions == others) | (np.isnan(positions) & np.isnan(others))
    return np.asarray(~same.all(axis=1))


def _size(vectors: FloatArray) -> FloatArray:
    """(...,) lengths of (..., 3) vectors; summing over an axis of three takes ten times longer."""
    x, y, z = vectors[..., 0], vectors[..., 1], vectors[..., 2]
    return np.asarray(np.sqrt(x * x + y * y + z * z))


@dataclass(frozen=True, eq=False)
class Lengths:
    """How long a body's segments are, and how much that usually changes.

    Attributes
    ----------
    links : (n, 2) int64, columns of the two markers of each segment
    usual : (n,) mm, the median; NaN where the two are never seen together
    allowed : (n,) mm, the deviation from which on a length is off
    """

    links: IntArray
    usual: FloatArray
    allowed: FloatArray

    def off(self, positions: FloatArray) -> BoolArray:
        """(n,) bool: segments too long or too short in a frame.

        Parameters
        ----------
        positions : (markers, 3) mm; NaN = missing, whose segments are not off
        """
        now = distance(positions[self.links[:, 0]], positions[self.links[:, 1]])
        return np.asarray(np.abs(now - self.usual) > self.allowed)


def measure_lengths(positions: FloatArray, links: IntArray) -> Lengths:
    """Learn how long segments are from frames spread over a take.

    Parameters
    ----------
    positions : (frames, markers, 3) float64, mm; NaN = missing
    links : (n, 2) int64, columns of the markers that keep their distance

    Notes
    -----
    A length is off five robust standard deviations from its median, and 10 mm at least: skin
    moves that much over bones. The median and the median absolute deviation do not follow damage
    in less than half of the frames.
    """
    links = np.asarray(links, dtype=np.int64).reshape(-1, 2)
    some = positions[:: max(1, len(positions) // _SAMPLED)]
    long = distance(some[:, links[:, 0]], some[:, links[:, 1]])
    if len(some):
        usual, spread = median_of_seen(long), deviation_of_seen(long.T)
    else:
        usual, spread = np.full(len(links), np.nan), np.full(len(links), np.nan)
    return Lengths(links, usual, np.maximum(_SPREADS * _NORMAL * spread, _LEAST_MM))
