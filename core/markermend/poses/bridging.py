"""Cross a gap from its two sides: the part that time alone tells."""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from markermend.arrays import FloatArray, IntArray

SIDE = 2
"""Known frames on each side that a bridge stands on."""


@lru_cache(maxsize=4096)
def bridge(length: int) -> FloatArray:
    """Weights of the frames beside a gap for each frame within it.

    Half of the way between the straight line from side to side, which stays calm in long gaps, and
    the curve of least second differences, which follows the movement into short ones.

    Parameters
    ----------
    length : of the gap, in frames

    Returns
    -------
    (length, 2 · SIDE) float64; the columns are the two frames before and the two after
    """
    differences = np.diff(np.eye(length + 2 * SIDE), 2, axis=0)
    inside = differences[:, SIDE : SIDE + length]
    outside = np.delete(differences, np.s_[SIDE : SIDE + length], axis=1)
    curve = -np.linalg.lstsq(inside, outside, rcond=None)[0]
    return np.asarray(0.5 * curve + 0.5 * straight(length))


@lru_cache(maxsize=4096)
def straight(length: int) -> FloatArray:
    """Weights as :func:`bridge` has them, of the straight line from side to side."""
    share = np.arange(1, length + 1) / (length + 1)
    weights = np.zeros((length, 2 * SIDE))
    weights[:, SIDE - 1], weights[:, SIDE] = 1.0 - share, share
    return weights


def around(start: int, stop: int) -> IntArray:
    """Frames a bridge over ``[start, stop)`` stands on."""
    return np.asarray(np.r_[start - SIDE : start, stop : stop + SIDE])
